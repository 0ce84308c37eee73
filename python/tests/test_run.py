import os
import signal
import threading
import warnings

import numpy as np
import pytest

import breccia

FILES = ["histories.csv", "cracks.csv", "fragments.csv"] + [f"frames/{k:06d}.vtkhdf" for k in range(7)]


def same_bytes(one, other):
    for name in FILES:
        with open(os.path.join(one, name), "rb") as a, open(os.path.join(other, name), "rb") as b:
            if a.read() != b.read():
                return f"{name} differs"
    return ""


def test_views_share_memory_with_the_library(burst):
    with breccia.Scene(burst).start(device="cpu") as run:
        assert run.step(10) == 10
        one, other = run.view("displacement"), run.view("displacement")
        assert one.shape == (len(run.rows()), 3) and one.dtype == np.float64 and not one.flags.owndata and not one.flags.writeable
        assert np.shares_memory(one, other) and one.ctypes.data == other.ctypes.data
        before, copy = one.copy(), run.array("displacement")
        assert not np.shares_memory(one, copy)
        run.step(10)
        assert np.any(one != before)  # nobody has asked again: it is the device's memory
        assert np.array_equal(one[run.rows() >= 0][np.argsort(run.rows()[run.rows() >= 0])], run.array("displacement"))
        assert np.array_equal(run.array("position"), run.array("reference") + run.array("displacement"))
        del one, other


def test_the_state_agrees_with_the_files(burst, tmp_path):
    seen = {}

    def look(run):
        seen.update(stage=run.moment.stage_name, stress=run.array("stress"), damage=run.array("damage"), sensors=run.sensors(), bonds=run.bonds)

    results = breccia.Scene(burst).run(tmp_path, observers=[breccia.Observer(look, stage_ends=True)], device="cpu")
    last = results.frames[-1]
    order = [0, 1, 2, 5, 3, 4]  # xx yy zz yz xz xy as VTK has them
    assert np.array_equal(last.field("stress"), seen["stress"][:, order].astype(np.float32)) and last.unit("stress") == "Pa"
    assert np.array_equal(last.field("damage"), seen["damage"]) and seen["damage"].max() > 0
    assert seen["stage"] == "after" and seen["sensors"]["broken"] == seen["bonds"][1] == len(results.cracks())
    assert seen["sensors"]["kinetic"] == results.histories()["kinetic [J]"].iloc[-1]


def test_observers_and_hands_leave_no_trace(burst, tmp_path):
    scene = breccia.Scene(burst)
    scene.run(tmp_path / "alone", device="cpu")
    steps = []
    observers = [breccia.Observer(lambda run: steps.append((run.moment.stage, run.moment.step, run.sensors(), run.array("stress")[0, 0])), steps=7)]
    scene.run(tmp_path / "observed", observers=observers, device="cpu", progress=lambda moment: None)
    assert [step for stage, step, *_ in steps if stage == 0] == list(range(0, 121, 7))
    assert same_bytes(tmp_path / "alone", tmp_path / "observed") == ""
    with scene.start(tmp_path / "by-hand", device="cpu") as run:
        assert run.step(0) == 0 and run.moment.step == 0 and run.names()[:3] == ["displacement", "velocity", "force"]
        made = [run.step(11)]
        while made[-1]:
            made.append(run.step(11))
        assert sum(made) == 150 and run.moment.total_steps == 150
    assert run.report["steps"] == 150 and run.results.status == "done"
    assert same_bytes(tmp_path / "alone", tmp_path / "by-hand") == ""


def test_an_observer_by_time_looks_at_each_multiple(burst):
    times = []
    with breccia.Scene(burst).start() as run:
        run.observe(lambda run: times.append((run.moment.time, run.moment.time_step)), seconds=0.25)
        while run.step(1000):
            pass
    first = [time for time, step in times if step == times[0][1]]
    assert len(first) > 4
    for k, time in enumerate(first):
        assert 0.25 * k - 1e-12 <= time < 0.25 * k + times[0][1]


def test_observers_end_stages_and_runs(burst, tmp_path):
    def end(run):
        return breccia.END_STAGE if run.moment.step == 21 else None

    def stop(run):
        return breccia.STOP if run.moment.step == 21 else None

    scene = breccia.Scene(burst)
    results = scene.run(tmp_path / "end", observers=[breccia.Observer(end, steps=7)])
    assert results.status == "done" and results.summary["steps"] == 42
    with pytest.raises(breccia.Interrupted) as caught:
        scene.run(tmp_path / "stop", observers=[breccia.Observer(stop, steps=7)])
    assert caught.value.results.status == "interrupted" and caught.value.results.summary["steps"] == 40
    assert len(caught.value.results.histories()) == 2
    assert scene.run(tmp_path / "stop", resume=True).summary["steps"] == 150


def test_what_an_observer_raises_is_raised(burst, tmp_path):
    with pytest.raises(ZeroDivisionError):
        breccia.Scene(burst).run(tmp_path, observers=[breccia.Observer(lambda run: 1 / 0, steps=50)])
    assert breccia.Results(tmp_path).status == "interrupted"
    with pytest.raises(TypeError, match="END_STAGE"):
        breccia.Scene(burst).run(observers=[breccia.Observer(lambda run: True, steps=50)])


def interrupted_after(steps):
    """An observer: Ctrl-C comes once so many steps are done, however long they take."""
    reached = threading.Event()

    def wait():
        reached.wait()
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=wait, daemon=True).start()
    return breccia.Observer(lambda run: reached.set() if run.moment.total_steps > steps else None, steps=10)


def test_control_c_leaves_results(burst, tmp_path):
    long = breccia.Scene(burst, set={"stages.1.solver.dynamic.steps": 100000000})
    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt) as caught:
        long.run(tmp_path, observers=[interrupted_after(130)])
    assert signal.getsignal(signal.SIGINT) is before
    results = caught.value.results
    assert results.status == "interrupted" and results.summary["steps"] > 120 and len(results.histories()) > 3
    observer = interrupted_after(30)
    with long.start() as run:
        run.observe(observer.look, steps=observer.steps)
        run.step(10)
        with pytest.raises(KeyboardInterrupt):
            run.step(100000000)


def test_progress_and_log_are_heard(burst):
    told, lines = [], []
    results = breccia.Scene(burst, set={"stages.1.solver.dynamic.steps": 3000}).run(progress=told.append, log=lambda level, line: lines.append((level, line)))
    assert told and all(0 <= moment.step <= moment.planned for moment in told)
    assert any(level == 2 and "fracture is" in line for level, line in lines)
    folder = results.folder
    assert os.path.isdir(folder)
    del results
    assert not os.path.exists(folder)


def test_views_that_outlive_the_run_are_told(burst):
    run = breccia.Scene(burst).start()
    run.step(1)
    view = run.view("velocity")[:5]
    with pytest.warns(RuntimeWarning, match="outlive"):
        run.end()
    del view
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        run = breccia.Scene(burst).start()
        run.step(1)
        run.view("velocity")
        run.end()


def test_calls_out_of_place_are_refused(burst):
    run = breccia.Scene(burst).start()
    with pytest.raises(breccia.InputError, match="not there"):
        run.view("velocity")
    with pytest.raises(breccia.InputError):
        run.moment
    run.step(1)
    with pytest.raises(breccia.InputError, match="voltage"):
        run.view("voltage")
    with pytest.raises(breccia.InputError, match="begun"):
        run.observe(lambda run: None, steps=1)
    run.end()
    with pytest.raises(breccia.InputError, match="ended"):
        run.step(1)
    with pytest.raises(breccia.InputError, match="folder"):
        run.results
