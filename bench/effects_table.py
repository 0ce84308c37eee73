#!/usr/bin/env python3
"""What each example is made of: effects_table.py PROGRAM OUTPUT.csv [SCENE ...] runs `breccia check SCENE --effects` for every example (or the scenes
named), writes a row each for effects in and out, kernels and arrays, and prints the table of docs/notebook/performance.md."""
import csv
import glob
import os
import re
import subprocess
import sys

program, output = sys.argv[1:3]
scenes = sys.argv[3:] or sorted(glob.glob(os.path.join(os.path.dirname(__file__), "../examples/*/*.yaml")))
rows = []
print("| example | effects in | kernels launched | arrays | MB |\n| --- | --- | --- | --- | --- |")
for scene in scenes:
    name = "/".join(scene.split("/")[-2:]).removesuffix("/scene.yaml").removesuffix(".yaml")
    try:
        done = subprocess.run([program, "check", scene, "--effects", "--device", "cpu", "--threads", "1"], capture_output=True, text=True, timeout=900)
    except subprocess.TimeoutExpired:
        print(f"{name}: no end in a quarter of an hour", file=sys.stderr)
        continue
    if done.returncode:
        print(f"{name}: {done.stderr.strip().splitlines()[-1] if done.stderr.strip() else done.returncode}", file=sys.stderr)
        continue
    effects, absent = [], []
    for where, names in (("in", effects), ("out", absent)):
        for line in re.findall(r"^effects %s.*?: (.*)$" % where, done.stdout, re.M):
            names += [e for e in line.split(", ") if e not in names]
    absent = [e for e in absent if e not in effects]  # of scenes with several models: out of all of them
    kernels = re.findall(r"^kernel (.*): (\d+) launches$", done.stdout, re.M)
    arrays = re.findall(r"^array (.*): (\d+) bytes$", done.stdout, re.M)
    rows += [(name, "effect", e, "") for e in effects] + [(name, "effect out", e, "") for e in absent] + [(name, "kernel", k, n) for k, n in kernels] + [(name, "array", a, n) for a, n in arrays]
    print(f"| {name} | {', '.join(effects)} | {len(kernels)} | {len(arrays)} | {sum(int(n) for _, n in arrays) / 1e6:.3g} |", flush=True)
with open(output, "w", newline="") as file:
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(("example", "kind", "name", "launches or bytes"))
    writer.writerows(rows)
