"""Runs that are left and taken up again: the same bytes as runs that are not (docs/reference/checkpoint.md).

    test_resume.py                              what ctest runs: a few examples made small, five kills, refusals
    test_resume.py --all [NAME ...]             every example made small, on the cpu, an OpenCL device and a target device, in three precisions
    test_resume.py --kills 50 [--of NAME]       one run (beams-fracture, or this example) killed fifty times at random moments
"""
import argparse
import filecmp
import glob
import itertools
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

PROGRAM = os.path.abspath(os.environ.get("BRC_PROGRAM", "build/bin/breccia"))
SOURCE = os.path.abspath(os.environ.get("BRC_SOURCE_DIR", "."))
ALWAYS = "output.checkpoint.wall=1 us"  # a checkpoint wherever there can be one

# Overrides that make an example small; others are made small by their fills alone.
SHORT = {
    "ball-breaks": ["bodies.0.fill.noisy_grid.elements=300", "stages.0.solver.dynamic.duration=60 us"],
    "bar-release-tension": ["bodies.0.fill.noisy_grid.elements=500", "stages.0.solver.dynamic.duration=2 ms"],
    "bar-release-torsion": ["bodies.0.fill.noisy_grid.elements=500", "stages.0.solver.dynamic.duration=2 ms"],
    "beams-events": ["bodies.0.fill.packing.elements=400", "stages.0.solver.static.events.most=12"],
    "beams-fracture": ["bodies.0.fill.packing.elements=1000"],
    "beams-tension": ["bodies.0.fill.packing.elements=1000", "stages.0.solver.static.increments=4"],
    "branching": ["bodies.0.fill.noisy_grid.elements=3700", "stages.1.solver.dynamic.duration=10 us"],
    "ceramic-plate": ["bodies.0.fill.noisy_grid.cells=[10, 10, 2]"],
    "cells-events": ["bodies.0.fill.noisy_grid.elements=200", "stages.0.solver.static.events.most=12"],
    "compact-tension": ["stages.0.solver.dynamic.duration=20 us"],
    "edge-impact": ["bodies.0.fill.noisy_grid.elements=18000", "stages.0.solver.dynamic.duration=3 us"],
    "indenter": ["bodies.0.fill.noisy_grid.elements=600", "stages.0.solver.dynamic.duration=1.5 us"],
    "intergranular": ["bodies.0.fill.packing.elements=1000", "bodies.0.grains.number=10"],
    "plate-impact": ["bodies.0.fill.noisy_grid.elements=600", "stages.0.solver.dynamic.duration=4 us"],
    "ring-on-ring": ["bodies.0.fill={noisy_grid: {elements: 1200}}", "stages.0.solver.dynamic.duration=60 us"],
    "rolling-ball": ["bodies.0.fill.noisy_grid.elements=300", "stages.0.solver.dynamic.duration=0.2 s"],
    "sliding-blocks": ["bodies.0.fill.noisy_grid.cells=[3, 2, 2]", "bodies.1.fill.noisy_grid.cells=[3, 2, 2]", "stages.0.solver.dynamic.duration=50 ms"],
    "sphere-on-wall": ["bodies.0.fill.noisy_grid.elements=300"],
    "tension": ["bodies.0.fill.noisy_grid.elements=500", "stages.0.solver.static.increments=4"],
    "tension-dynamic": ["bodies.0.fill.noisy_grid.elements=300", "stages.0.solver.dynamic.duration=8 ms", "output.frames=5"],
    "uniaxial-compression": ["bodies.0.fill.packing.elements=500"],
    "two-models": ["bodies.0.fill.noisy_grid.cells=[16, 4, 4]", "bodies.1.fill.packing.elements=300", "stages.0.solver.dynamic.duration=200 us"],
}
# Examples with something more: NAME+WHAT.
MORE = {
    "ball-breaks+softening": ["materials.plaster.strength.fracture_energy=20 J/m^2"],
    "cantilever+column": ["bodies.0.fill.noisy_grid.cells=[40, 4, 4]", "stages.0.solver={static: {increments: 6}}", "stages.0.loads.1.traction.x=-32 MPa"],
    "twisted-bar+far": ["bodies.0.fill.noisy_grid.cells=[40, 4, 4]", "stages.0.solver={static: {increments: 2}}",
                        "stages.0.loads.1.face_displacement.gradient={y: [0, -0.5, -0.8660254], z: [0, 0.8660254, -0.5]}"],
    "beams-fracture+softening": ["materials.glass.strength.fracture_energy=10 J/m^2"],
}
SINGLE = {"tension": ["stages.0.solver.static.tolerance=1e-4"]}  # what a lower precision cannot reach otherwise


KILLED = "beams-fracture"


def all_compared(prefix, names, precisions, compared):
    """compared(name, folder, precision) for each, in a folder of its own: its line, or what differs. Returns how many differ."""
    failures = 0
    for precision in precisions:
        for name in names:
            with tempfile.TemporaryDirectory(prefix=prefix, dir=".") as folder:
                try:
                    print(compared(name, folder, precision), flush=True)
                except AssertionError as error:
                    failures += 1
                    print(f"FAILED {error}", flush=True)
    return failures


def scene_of(name):
    return f"{SOURCE}/examples/{name.split('+')[0]}/scene.yaml"


def shrink(name):
    """Overrides for an example that the table does not know: a tenth of its elements, by its text."""
    found, body, kind, inside = [], -1, "", False
    for line in open(scene_of(name), encoding="utf-8"):
        if re.match(r"\w", line):
            inside = line.startswith("bodies:")
        if not inside:
            continue
        body += line.startswith("  - ")
        kind = (re.findall(r"(noisy_grid|packing):", line) or [kind])[0]
        number = re.search(r"\belements: (\d+)", line)
        if number and kind:
            found.append(f"bodies.{body}.fill.{kind}.elements={max(300, int(number.group(1)) // 10)}")
    return found


def overrides(name, precision="double"):
    return (SHORT.get(name.split("+")[0]) or shrink(name)) + MORE.get(name, [])


def command(name, folder, sets, device="cpu", precision="double", more=()):
    line = [PROGRAM, "run", scene_of(name), "-o", folder, "--device", device, "--precision", precision, "--threads", "1", *more]
    for one in sets:
        line += ["--set", one]
    return line


def run(line, expect=0):
    done = subprocess.run(line, capture_output=True, text=True, timeout=900)
    if done.returncode != expect:
        raise AssertionError(f"exit code {done.returncode} instead of {expect}: {' '.join(line)}\n{done.stdout}\n{done.stderr}")
    return done.stderr


def checkpoints(folder):
    return sorted(path for path in glob.glob(f"{folder}/checkpoints/*.h5"))


def newest(folder):
    there = checkpoints(folder)
    return int(os.path.basename(there[-1])[:-3]) if there else -1


def kill_at(line, folder, moment, signum=signal.SIGKILL):
    """Start a run and end it by a signal when checkpoint `moment` is there; False if it was done before."""
    child = subprocess.Popen(line, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    end = time.monotonic() + 600
    while child.poll() is None and newest(folder) < moment and time.monotonic() < end:
        time.sleep(0.002)
    if child.poll() is not None:
        return False
    child.send_signal(signum)
    return child.wait() != 0


def same(a, b, what):
    """Every result but the times in summary.json, and the state at the end."""
    listing = lambda folder: sorted(os.path.relpath(path, folder) for path in glob.glob(f"{folder}/*") + glob.glob(f"{folder}/frames/*") if os.path.isfile(path))
    assert listing(a) == listing(b), f"{what}: files {listing(a)} and {listing(b)}"
    for name in listing(a):
        if name != "summary.json":
            assert filecmp.cmp(f"{a}/{name}", f"{b}/{name}", shallow=False), f"{what}: {name} differs"
    assert filecmp.cmp(checkpoints(a)[-1], checkpoints(b)[-1], shallow=False), f"{what}: the state at the end differs"
    one, other = (json.load(open(f"{folder}/summary.json", encoding="utf-8")) for folder in (a, b))
    for key in ("counts", "ledger", "measures", "sensors", "steps", "frames", "time_step", "end"):
        assert one[key] == other[key], f"{what}: {key} of summary.json differs"


def whole(name, folder, sets, **kind):
    """A run that is not left, with a checkpoint wherever there can be one."""
    run(command(name, folder, sets + [ALWAYS], **kind))
    return newest(folder)


def goes_on(name, folder, device, precision):
    """The run as a whole; without any checkpoint; killed half way and taken up again."""
    kind = {"device": device, "precision": precision}
    sets = overrides(name) + (SINGLE.get(name, []) if precision != "double" else [])
    what = f"{name} on {device} in {precision}"
    try:
        last = whole(name, f"{folder}/whole", sets, **kind)
    except AssertionError as error:
        if precision != "double" and "no equilibrium" in str(error):
            return f"{what}: the example itself finds no equilibrium in this precision"
        raise
    if last < 1:
        return f"{what}: nothing to leave it at"
    run(command(name, f"{folder}/plain", sets, **kind))
    for path in ["histories.csv", "cracks.csv"] + [os.path.relpath(p, f"{folder}/plain") for p in glob.glob(f"{folder}/plain/frames/*")]:
        if os.path.exists(f"{folder}/plain/{path}"):
            assert filecmp.cmp(f"{folder}/plain/{path}", f"{folder}/whole/{path}", shallow=False), f"{what}: checkpoints change {path}"
    line = command(name, f"{folder}/left", sets + [ALWAYS], **kind)
    moment = max(0, last // 2)
    if not kill_at(line, f"{folder}/left", moment):
        return f"{what}: done before it could be killed"
    at = newest(f"{folder}/left")
    run(line + ["--resume"])
    same(f"{folder}/whole", f"{folder}/left", what)
    return f"{what}: left at checkpoint {at} of {last}, the same bytes"


def readable(folder):
    """All frames so far can be read: export goes through them."""
    frames = glob.glob(f"{folder}/frames/*.vtkhdf")
    if frames and os.path.exists(f"{folder}/result.h5"):
        run([PROGRAM, "export", folder, "--format", "vtu"])
        shutil.rmtree(f"{folder}/export")
    return len(frames)


def killed_again_and_again(folder, n, name=KILLED):
    """Killed n times at random moments, taken up after each: the frames can be read, and the end is that of a run that was left alone."""
    draw = random.Random(1)
    sets = overrides(name) + ["output.frames=40", "output.history_every=1"]
    last = whole(name, f"{folder}/whole", sets)
    line = command(name, f"{folder}/left", sets + [ALWAYS])
    kills = resumed = 0
    for k in range(n):
        there = checkpoints(f"{folder}/left") != []
        child = subprocess.Popen(line + (["--resume"] if there else []), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        goal, end = newest(f"{folder}/left") + draw.randrange(0, max(2, 2 * last // n)), time.monotonic() + 600
        while child.poll() is None and newest(f"{folder}/left") < goal and time.monotonic() < end:
            time.sleep(0.001)
        time.sleep(0.1 * draw.random())
        if child.poll() is not None:
            assert child.returncode == 0, f"kill {k}: the run ended by itself with {child.returncode}"
            shutil.rmtree(f"{folder}/left")  # it came to its end: begin anew
            continue
        child.kill()
        child.wait()
        kills += 1
        resumed += there
        readable(f"{folder}/left")
    run(line + (["--resume"] if checkpoints(f"{folder}/left") else []))
    same(f"{folder}/whole", f"{folder}/left", f"{name} killed {kills} times")
    return f"{name}: killed {kills} times, taken up {resumed} times, {last + 1} pauses, the same bytes"


def ends_by_a_signal(folder):
    """SIGTERM: exit code 3, a checkpoint though the scene asks for none, and the sentence says where."""
    name, sets = "tension-dynamic", overrides("tension-dynamic")
    run(command(name, f"{folder}/whole", sets))
    line = command(name, f"{folder}/left", sets)
    child = subprocess.Popen(line, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    while child.poll() is None and not glob.glob(f"{folder}/left/frames/000001.vtkhdf"):
        time.sleep(0.002)
    child.send_signal(signal.SIGTERM)
    text = child.stderr.read()
    assert child.wait() == 3, f"exit code {child.returncode}: {text}"
    assert "interrupted at step" in text and "checkpoints/000000.h5; --resume goes on" in text, text
    summary = json.load(open(f"{folder}/left/summary.json", encoding="utf-8"))
    assert summary["end"]["status"] == "interrupted", summary["end"]
    run(line + ["--resume"])
    for path in ["histories.csv", "result.h5"] + [f"frames/{os.path.basename(p)}" for p in glob.glob(f"{folder}/whole/frames/*")]:
        assert filecmp.cmp(f"{folder}/whole/{path}", f"{folder}/left/{path}", shallow=False), path
    prediction = json.load(open(f"{folder}/left/summary.json", encoding="utf-8"))["prediction"]
    assert not (prediction["actual_seconds"] or 0) > 600, f"a run taken up in the middle of a stage took {prediction['actual_seconds']} s?"  # counted from when it was taken up
    return "a run that is interrupted goes on to the same bytes"


def says(line, code, *parts):
    text = run(line, expect=code)
    for part in parts:
        assert part in text, f"'{part}' is not in: {text}"


def is_refused_with_reason(folder):
    name, sets = "tension-dynamic", overrides("tension-dynamic")
    left, kept = f"{folder}/left", f"{folder}/kept"
    line = command(name, left, sets + [ALWAYS]) + ["--resume"]
    says(line, 2, "there is no checkpoint to go on from", "run without --resume")
    whole(name, left, sets)
    shutil.copytree(left, kept)
    before = open(f"{left}/histories.csv", "rb").read()
    says(command(name, left, sets + [ALWAYS, "materials.stone.nu=0.2"]) + ["--resume"], 2, "the scene is not that of the checkpoint", "materials: stone:", "'nu: 0.3' there, 'nu: 0.2' here")
    says(command(name, left, sets + [ALWAYS], precision="mixed") + ["--resume"], 2, "in precision double, this run in mixed; go on with --precision double")
    assert open(f"{left}/histories.csv", "rb").read() == before, "a refusal changed the results"
    # a scene may ask for other checkpoints; a run that is done is done again from its last moment
    run(command(name, left, sets) + ["--resume"])
    assert open(f"{left}/histories.csv", "rb").read() == before, "the end was not the same"
    newest_path, older = checkpoints(left)[-1], checkpoints(left)[-2]
    with open(newest_path, "r+b") as file:  # cut short: passed over
        file.truncate(os.path.getsize(newest_path) // 2)
    says(line, 0, f"{newest_path} is passed over: it has no seal", f"goes on from {older}")
    same(kept, left, "after a file that was cut short")
    good = os.path.basename(checkpoints(left)[-1])
    with open(f"{left}/checkpoints/{good}", "r+b") as file:  # one byte in the middle
        file.seek(os.path.getsize(f"{left}/checkpoints/{good}") // 2)
        byte = file.read(1)
        file.seek(-1, 1)
        file.write(bytes([byte[0] ^ 1]))
    says(line, 0, f"{good} is passed over: it was changed after it was written")
    for path in checkpoints(left):
        open(path, "wb").write(b"not a checkpoint")
    says(line, 2, "none of the 2 checkpoints is whole")
    run(command(name, left, sets))
    assert checkpoints(left) == [], "a new run left old checkpoints"
    open(f"{left}/checkpoints", "w", encoding="utf-8").write("in the way")
    says(command(name, left, sets + [ALWAYS]), 3, "is a file where a folder is needed")
    return "what cannot be gone on from is refused with its reason"


def devices():
    text = subprocess.run([PROGRAM, "devices"], capture_output=True, text=True, check=True).stdout
    listed = re.split(r"\n(?=[* ] \w)", text)
    return [re.match(r"[* ] (\S+)", part).group(1) for part in listed if re.match(r"[* ] \S+:?\d* ", part) and "not usable" not in part]


def all_examples(names, device=None):
    names = names or sorted(name for name in os.listdir(f"{SOURCE}/examples") if os.path.exists(f"{SOURCE}/examples/{name}/scene.yaml")) + sorted(MORE)
    failures = 0
    for where, precision, name in itertools.product([device] if device else devices(), ("double", "mixed", "single"), names):
        with tempfile.TemporaryDirectory(prefix="resume-", dir=".") as folder:
            try:
                print(goes_on(name, folder, where, precision), flush=True)
            except (AssertionError, subprocess.TimeoutExpired) as error:
                failures += 1
                print(f"FAILED {error}", flush=True)
    print(f"{failures} failures")
    return failures


def few():
    there = devices()
    opencl = [device for device in there if device.startswith("opencl")][:1]
    cases = [lambda f: goes_on("beams-fracture", f, "cpu", "mixed"), lambda f: goes_on("cells-events", f, "cpu", "double"),
             lambda f: goes_on("two-models", f, "cpu", "single"), lambda f: goes_on("tension", f, "cpu", "double"),
             lambda f: goes_on("cantilever+column", f, "cpu", "double"), lambda f: goes_on("twisted-bar+far", f, "cpu", "double"),
             lambda f: killed_again_and_again(f, 5), ends_by_a_signal, is_refused_with_reason]
    cases += [lambda f, d=d: goes_on("tension-dynamic", f, d, "double") for d in opencl]
    for case in cases:
        with tempfile.TemporaryDirectory(prefix="resume-", dir=".") as folder:
            print(case(folder), flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--all", nargs="*", metavar="NAME", help="every example, or these")
    parser.add_argument("--device", help="this device only")
    parser.add_argument("--kills", type=int, help="so many kills")
    parser.add_argument("--of", metavar="NAME", default=KILLED, help="of this example")
    options = parser.parse_args()
    if options.all is not None:
        sys.exit(1 if all_examples(options.all, options.device) else 0)
    elif options.kills:
        with tempfile.TemporaryDirectory(prefix="resume-", dir=".") as scratch:
            print(killed_again_and_again(scratch, options.kills, options.of))
    else:
        few()
