import json
import math
import os

import pytest

import breccia
from breccia.sweep import student

GRID = {"materials.glass.nu": [0.1, 0.3], "bodies.0.fill.noisy_grid.seed": [1, 2, 3]}


def test_a_sweep_goes_on_where_it_was_left(burst, tmp_path):
    burst = {**burst, "output": {"frames": "none", "picture": False}}
    whole = breccia.sweep(burst, GRID, tmp_path / "whole", jobs=2, device="cpu")
    assert [row["status"] for row in whole.rows] == ["done"] * 6 and len({row["most"] for row in whole.rows}) == 6
    done = breccia.sweep(burst, [{"materials.glass.nu": 0.1, "bodies.0.fill.noisy_grid.seed": 1}], tmp_path / "left", jobs=1, device="cpu")
    stamp = os.stat(tmp_path / "left" / "00000" / "summary.json").st_mtime_ns
    assert len(done.rows) == 1
    os.makedirs(tmp_path / "left" / "00001")  # a run that was killed
    (tmp_path / "left" / "00001" / "summary.json").write_text(json.dumps({"end": {"status": "running"}}))
    breccia.sweep(burst, GRID, tmp_path / "left", jobs=1, device="cpu")
    assert os.stat(tmp_path / "left" / "00000" / "summary.json").st_mtime_ns == stamp
    tables = [(tmp_path / name / "table.csv").read_bytes() for name in ("whole", "left")]
    assert tables[0] == tables[1] and tables[0].count(b"\n") == 7
    means = whole.means("most", over="bodies.0.fill.noisy_grid.seed")
    assert [mean["n"] for mean in means] == [3, 3] and means[0]["materials.glass.nu"] == 0.1
    values = [row["most"] for row in whole.rows[:3]]
    mean = sum(values) / 3
    deviation = math.sqrt(sum((value - mean) ** 2 for value in values) / 2)
    assert means[0]["mean"] == pytest.approx(mean, rel=1e-12) and means[0]["deviation"] == pytest.approx(deviation, rel=1e-9)
    assert means[0]["confidence"] == pytest.approx(4.303 * deviation / math.sqrt(3), rel=1e-9)
    assert len(whole.table()) == 6


def test_a_run_that_fails_leaves_the_others(burst, tmp_path):
    burst = {**burst, "output": {"frames": "none", "picture": False}}
    result = breccia.sweep(burst, {"materials.glass.nu": [0.2, 7]}, tmp_path, jobs=1, device="cpu")
    assert [row["status"] for row in result.rows] == ["done", "failed"] and "nu" in result.rows[1]["error"]


def test_students_t_beyond_the_table():
    assert student(1) == 12.706 and student(30) == pytest.approx(2.042, rel=2e-3) and student(1000) == pytest.approx(1.962, rel=1e-3)
