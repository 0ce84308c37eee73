import csv
import json
import math
import os
import subprocess

import pytest

import breccia
from breccia._program import program

SEED = "bodies.0.fill.noisy_grid.seed"
NU = "materials.glass.nu"
GRID = {NU: [0.1, 0.3], SEED: [1, 2, 3]}
QUIET = {"output": {"frames": "none", "picture": False}}


def test_a_sweep_goes_on_where_it_was_left(burst, tmp_path):
    burst = {**burst, **QUIET}
    whole = breccia.sweep(
        burst, GRID, tmp_path / "whole", average=[SEED], fit=[{"power": "most", "by": NU}], jobs=2, device="cpu"
    )
    assert [row["status"] for row in whole.rows] == ["done"] * 6 and len({row["most"] for row in whole.rows}) == 6
    assert whole.rows[4][NU] == 0.3 and whole.rows[4][SEED] == 2 and whole.rows[4]["set"] == {NU: 0.3, SEED: 2}
    done = breccia.sweep(burst, [{NU: 0.1, SEED: 1}], tmp_path / "left", jobs=1, device="cpu")
    stamp = os.stat(tmp_path / "left" / "00000" / "summary.json").st_mtime_ns
    assert len(done.rows) == 1
    os.makedirs(tmp_path / "left" / "00001")  # a run that was killed
    (tmp_path / "left" / "00001" / "summary.json").write_text(json.dumps({"end": {"status": "running"}}))
    breccia.sweep(burst, GRID, tmp_path / "left", jobs=1, device="cpu")
    assert os.stat(tmp_path / "left" / "00000" / "summary.json").st_mtime_ns == stamp
    tables = [(tmp_path / name / "table.csv").read_bytes() for name in ("whole", "left")]
    assert tables[0] == tables[1] and tables[0].count(b"\n") == 7
    means = whole.means("most")
    assert [mean["n"] for mean in means] == [3, 3] and float(means[0][NU]) == 0.1
    values = [row["most"] for row in whole.rows[:3]]
    mean = sum(values) / 3
    deviation = math.sqrt(sum((value - mean) ** 2 for value in values) / 2)
    assert means[0]["mean"] == pytest.approx(mean, rel=1e-12) and means[0]["deviation"] == pytest.approx(
        deviation, rel=1e-9
    )
    assert means[0]["confidence"] == pytest.approx(4.303 * deviation / math.sqrt(3), rel=1e-9)
    fit, factor = whole.fits()
    assert (
        fit["law"] == "power" and fit["n"] == 6 and fit["parameter"] == "exponent" and factor["parameter"] == "factor"
    )
    assert math.isfinite(fit["value"]) and fit["error"] > 0 and fit[NU] == ""
    assert len(whole.table()) == 6


def test_a_sweep_is_the_study_of_the_program(burst, tmp_path):
    burst = {**burst, **QUIET}
    swept = breccia.sweep(burst, GRID, tmp_path / "swept", jobs=2, device="cpu")
    told = tmp_path / "told.yaml"
    told.write_text(
        f"scene: swept/scene.yaml\nvary:\n  - {{key: {NU}, values: [0.1, 0.3]}}\n  - {{key: {SEED}, from: 1, to: 3}}\n"
    )
    subprocess.run(
        [program(), "study", str(told), "-o", str(tmp_path / "told"), "--now", "--device", "cpu"],
        check=True,
        capture_output=True,
    )
    assert (tmp_path / "told" / "table.csv").read_bytes() == (tmp_path / "swept" / "table.csv").read_bytes()
    again = breccia.study(told, tmp_path / "told", device="cpu")
    assert [row["most"] for row in again.rows] == [row["most"] for row in swept.rows] and again.rows[5][SEED] == "3"


def test_points_of_a_list_are_runs(burst, tmp_path):
    points = [{NU: 0.1, "materials.glass.E": (1, "Pa")}, {NU: 0.2, "materials.glass.E": "2 Pa"}]
    result = breccia.sweep(
        {**burst, **QUIET}, points, tmp_path, set={"stages.0.solver.dynamic.steps": 20}, device="cpu"
    )
    with open(tmp_path / "table.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["status"] for row in result.rows] == ["done", "done"] and [row[NU] for row in rows] == ["0.1", "0.2"]
    assert [row["stages.0.solver.dynamic.steps"] for row in rows] == ["20", "20"]
    with pytest.raises(ValueError):
        breccia.sweep(burst, [{NU: 0.1}, {SEED: 1}], tmp_path / "uneven")


def test_a_run_that_fails_leaves_the_others(burst, tmp_path):
    result = breccia.sweep({**burst, **QUIET}, {NU: [0.2, 7]}, tmp_path, jobs=1, device="cpu")
    assert [row["status"] for row in result.rows] == ["done", "bad_input"] and "nu" in result.rows[1]["error"]


def test_what_the_program_refuses_is_raised(burst, tmp_path):
    with pytest.raises(breccia.InputError, match="a key of `vary`"):
        breccia.sweep(burst, {NU: [0.2]}, tmp_path, fit=[{"power": "most", "by": "nowhere"}])


def test_new_writes_a_scene_and_never_over_one(tmp_path):
    names = [line.split()[0] for line in breccia.new().split("\n\n")[0].splitlines()]
    assert {"brazilian", "bend", "impact", "compression", "fragmentation", "polycrystal", "study"} <= set(names)
    path = breccia.new("brazilian", tmp_path / "disc.yaml")
    assert breccia.Scene.load(path).check(trial=False).n_elements > 1000
    with pytest.raises(breccia.InputError, match="there already"):
        breccia.new("brazilian", path)
