#!/usr/bin/env python3
"""Predicted against actual cost of examples, as a table in Markdown: price_table.py [--run-only] PROGRAM OUT [EXAMPLE ...]

Runs each example (default: all) with one thread of the cpu device and keeps what it took in OUT/<example>/cost.json: processor seconds (other programs on
the machine do not lengthen them), the most memory that it counted and that was resident, and the bytes of the folder. Then asks `breccia check` what it would have said, with
the same device, and prints both; examples of many minutes are run for a part of their time (shortened below), which their row says; and what the run itself predicted of its dynamic stages after their first half second, in seconds of the clock. A cost.json that is there already is taken as it is, so that a long table can be made in parts."""
import json
import os
import pathlib
import re
import subprocess
import sys

run_only = "--run-only" in sys.argv
program, out, *names = [a for a in sys.argv[1:] if a != "--run-only"]
program, out = os.path.abspath(program), pathlib.Path(out)
examples = pathlib.Path(__file__).resolve().parent.parent / "examples"
names = names or sorted(p.parent.name for p in examples.glob("*/scene.yaml"))
device = ["--device", "cpu", "--threads", "1"]
# 39 165 steps each, some 515 s: the first 1000 steps of them.
shortened = {name: ["--set", "stages.0.solver.dynamic.duration=0.9 ms"] for name in ("bar-release-tension", "bar-release-torsion")}


def folder_bytes(folder):
    return sum(p.stat().st_size for p in folder.rglob("*") if p.is_file() and p.name != "cost.json")


def measure(name):
    """What the run took; of an earlier call, if there was one."""
    folder = out / name
    kept = folder / "cost.json"
    if kept.exists():
        return json.loads(kept.read_text())
    folder.mkdir(parents=True, exist_ok=True)
    child = subprocess.Popen([program, "run", str(examples / name / "scene.yaml"), *device, *shortened.get(name, []), "-o", str(folder)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    summary = json.loads((folder / "summary.json").read_text())
    cost = {"exit": os.waitstatus_to_exitcode(status), "processor_s": usage.ru_utime + usage.ru_stime, "wall_s": summary["timing"]["total_s"],
            "resident_bytes": summary["memory"]["resident_bytes"], "host_bytes": summary["memory"]["host_bytes"], "device_bytes": summary["memory"]["device_bytes"],
            "disk_bytes": folder_bytes(folder), "version": summary["commit"], "prediction": summary.get("prediction")}
    kept.write_text(json.dumps(cost))
    return cost


def predict(name):
    """The line `predicted:` of check, as numbers; and processor seconds that check itself took."""
    before = os.times()
    check = subprocess.run([program, "check", "--all", str(examples / name / "scene.yaml"), *device, *shortened.get(name, [])], capture_output=True, text=True)
    after = os.times()
    number = r"([-+.\de]+)"
    found = re.search(r"^predicted: %s s(?:.*? from %s to %s s)?.*; %s MB on the host, %s MB on the device, %s MB resident; %s MB on disk" % ((number,) * 7), check.stdout, re.M)
    keys = ("processor_s", "least_s", "most_s", "host_bytes", "device_bytes", "resident_bytes", "disk_bytes")
    p = {k: v and float(v) * (1e6 if k.endswith("bytes") else 1) for k, v in zip(keys, found.groups())} if found else {}
    more = re.search(r"if all bonds broke: up to %s MB on the host and %s MB on disk" % (number, number), check.stdout)
    p.update({} if not more else {"most_host_bytes": float(more.group(1)) * 1e6, "most_disk_bytes": float(more.group(2)) * 1e6})
    p["took_s"] = after.children_user + after.children_system - before.children_user - before.children_system
    return p


def off(predicted, actual):
    return "-" if not predicted or not actual else "%+.0f %%" % (100 * (predicted / actual - 1))


def megabytes(predicted, actual, key):
    ranged = predicted.get("most_" + key)
    limits = "" if not ranged else " (%.3g to %.3g)" % (predicted[key] / 1e6, ranged / 1e6)
    return "%.3g, %s%s" % (actual[key] / 1e6, off(predicted.get(key), actual[key]), limits)


if not run_only:
    print("| example | check: s | run: s | off | stated range: s | inside | check took: s | told in the run, off | host MB, off | device MB, off | resident MB, off | disk MB, off |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
for name in names:
    cost = measure(name)
    if run_only:
        print(name, cost, flush=True)
        continue
    p = predict(name)
    ranged = p.get("least_s") is not None
    inside = cost.get("prediction") or {}
    print("| %s | %.3g | %.3g | %s | %s | %s | %.3g | %s | %s | %s | %s | %s |" % (
        name + (" (0.9 ms of it)" if name in shortened else ""), p.get("processor_s", float("nan")), cost["processor_s"], off(p.get("processor_s"), cost["processor_s"]),
        "%.3g to %.3g" % (p["least_s"], p["most_s"]) if ranged else "-", ("yes" if p["least_s"] <= cost["processor_s"] <= p["most_s"] else "no") if ranged else "-",
        p["took_s"], off(inside.get("seconds"), inside.get("actual_seconds")), megabytes(p, cost, "host_bytes"), megabytes(p, cost, "device_bytes"), megabytes(p, cost, "resident_bytes"), megabytes(p, cost, "disk_bytes")), flush=True)
