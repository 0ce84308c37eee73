"""Examples made small in the layout of a GPU on an OpenCL device (PoCL in CI) and on the cpu, every rounding as written.

    test_gpu_layout.py                what ctest runs: a few examples in three precisions
    test_gpu_layout.py --all [NAME]   every example made small, or these

Dynamic examples give the same bytes in every frame of the elements, once the time step is given: sums over the body (energies, the
power iteration behind `time_step: auto`) are taken in the order of the storage, and slices of 32 have another order than slices of 8.
Histories, which hold such sums, agree to the rounding of the precision. Static stages stop within their tolerance by way of
such sums: there only histories are compared, to that tolerance. One example fails with --all (docs/notebook/devices.md).
"""
import argparse
import csv
import filecmp
import glob
import json
import os
import re
import subprocess
import sys
import test_resume as resume

DEVICE = "opencl:0"
PRECISIONS = ("double", "mixed", "single")
# Largest difference of a history over the largest number in its column, for sums of the same numbers in another order and for
# runs that such sums steer.
ROUNDING = {"double": 1e-11, "mixed": 1e-5, "single": 1e-4}
STEERED = {"double": 1e-4, "mixed": 1e-3, "single": 1e-2}
FEW = ["tension-dynamic", "ball-breaks", "sliding-blocks", "two-models"]


def stages_of(name):
    """Kinds of the stages of an example, in order."""
    with open(resume.scene_of(name), encoding="utf-8") as file:
        text = file.read()
    return re.findall(r"^\s+(?:solver: *[{])?(dynamic|static|modes): *(?:[{]|$)", text[text.index("\nstages:"):], re.M)


def run(name, folder, sets, device, precision):
    done = subprocess.run(resume.command(name, folder, sets, device, precision, ["--exact"]), capture_output=True, text=True, timeout=900,
                          env=dict(os.environ, BRECCIA_OPENCL_LAYOUT="gpu", BRECCIA_OPENCL_PROGRAM="parts"))
    return done.returncode, done.stderr


def histories(folder):
    with open(f"{folder}/histories.csv", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return rows[0], [[float(word) if word else 0.0 for word in row] for row in rows[1:]]


def apart(a, b):
    """(largest difference of a column over its largest number, that column); not of the ledger's closure, itself a rounding."""
    (names, one), (_, other) = histories(a), histories(b)
    assert len(one) == len(other), f"{len(one)} and {len(other)} rows of histories"
    worst = (0.0, "none")
    for column, name in enumerate(names):
        if name.startswith("closure"):
            continue
        scale = max((abs(row[column]) for row in one), default=0)
        off = max((abs(x[column] - y[column]) for x, y in zip(one, other)), default=0)
        worst = max(worst, (off / scale if scale else off, name))
    return worst


def fixed_step(name, folder, sets, precision):
    """Overrides that give the dynamic stages a time step of three digits."""
    code, text = run(name, folder, sets, "cpu", precision)
    if code:
        return code, text
    with open(f"{folder}/summary.json", encoding="utf-8") as file:
        step = json.load(file)["time_step"]["value_s"]
    return 0, [f"stages.{k}.solver.dynamic.time_step={0.98 * step:.2e} s" for k, kind in enumerate(stages_of(name)) if kind == "dynamic"]


def compared(name, folder, precision):
    """What was found, in a line; AssertionError where the two differ."""
    what = f"{name} in {precision}"
    sets = resume.overrides(name) + (resume.SINGLE.get(name, []) if precision != "double" else [])
    dynamic = "dynamic" in stages_of(name)
    code, found = fixed_step(name, f"{folder}/probe", sets, precision) if dynamic else (0, [])
    results = [(code, found)] if code else [run(name, f"{folder}/{device[:3]}", sets + found, device, precision) for device in ("cpu", DEVICE)]
    refused = [text for code, text in results if code]
    if refused and precision != "double" and all("no equilibrium" in text for text in refused):
        return f"{what}: the example itself finds no equilibrium in this precision"
    assert not refused, f"{what}: {refused}"
    one, other = f"{folder}/cpu", f"{folder}/{DEVICE[:3]}"
    frames = sorted(os.path.basename(path) for path in glob.glob(f"{one}/frames/*.vtkhdf"))
    same = set(stages_of(name)) == {"dynamic"}
    if same:
        assert frames and frames == sorted(os.path.basename(path) for path in glob.glob(f"{other}/frames/*.vtkhdf")), f"{what}: other frames"
        for frame in frames:
            assert filecmp.cmp(f"{one}/frames/{frame}", f"{other}/frames/{frame}", shallow=False), f"{what}: {frame} differs"
    off, column = apart(one, other)
    bound = (ROUNDING if same else STEERED)[precision]
    assert off <= bound, f"{what}: histories differ by {off:.1e} in {column}, at most {bound:g}"
    return f"{what}: {len(frames) if same else 'no'} frames of the same bytes, histories within {off:.1e}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--all", nargs="*", metavar="NAME", help="every example, or these")
    options = parser.parse_args()
    if DEVICE not in resume.devices():
        refused = bool(os.environ.get("BRC_NO_SKIPS"))
        print(f"SKIPPED{', but BRC_NO_SKIPS is set' if refused else ''}: no usable {DEVICE} (Debian: pocl-opencl-icd)")
        sys.exit(1 if refused else 77)
    names = FEW if options.all is None else options.all or sorted(
        name for name in os.listdir(f"{resume.SOURCE}/examples") if os.path.exists(f"{resume.SOURCE}/examples/{name}/scene.yaml"))
    sys.exit(1 if resume.all_compared("gpu-layout-", names, PRECISIONS, compared) else 0)


if __name__ == "__main__":
    main()
