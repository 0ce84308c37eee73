#!/usr/bin/env python3
"""Predicted against actual cost of examples, as a table in Markdown: price_table.py PROGRAM OUT [EXAMPLE ...]

Runs `breccia check` and `breccia run` of each example (default: all) and prints what check predicted, what the run predicted of itself
from its first half second, and what it took. OUT: folder of the runs."""
import json
import pathlib
import re
import subprocess
import sys

program, out = sys.argv[1], pathlib.Path(sys.argv[2])
examples = pathlib.Path(__file__).resolve().parent.parent / "examples"
names = sys.argv[3:] or sorted(p.parent.name for p in examples.glob("*/scene.yaml"))


def number(value, form="%.3g"):
    return "-" if value is None else form % value


def ratio(predicted, actual):
    return "-" if not predicted or not actual else "%+.0f %%" % (100 * (predicted / actual - 1))


print("| example | check: s | run: s | off | paced: s | steps: s | off | host MB, off | device MB, off |")
print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
for name in names:
    scene = str(examples / name / "scene.yaml")
    check = subprocess.run([program, "check", scene, "--device", "cpu"], capture_output=True, text=True)
    found = re.search(r"^predicted: ([-+.\de]+) s", check.stdout, re.M)
    subprocess.run([program, "run", scene, "--device", "cpu", "-o", str(out / name)], capture_output=True, text=True)
    summary = json.loads((out / name / "summary.json").read_text())
    p, total = summary["prediction"], summary["timing"]["total_s"]
    predicted = float(found.group(1)) if found else None
    print("| %s | %s | %s | %s | %s | %s | %s | %s, %s | %s, %s |" % (
        name, number(predicted), number(total), ratio(predicted, total), number(p["seconds"]), number(p["actual_seconds"]), ratio(p["seconds"], p["actual_seconds"]),
        number(p["actual_host_bytes"] and p["actual_host_bytes"] / 1e6), ratio(p["host_bytes"], p["actual_host_bytes"]),
        number(p["actual_device_bytes"] and p["actual_device_bytes"] / 1e6), ratio(p["device_bytes"], p["actual_device_bytes"])), flush=True)
