"""The quick runs of `breccia bench accuracy`: each within a bound that geometry gives, finer ones better, and all the files."""
import csv
import json
import math
import os
import shutil
import subprocess
import sys

# Most error by problem, model and elements wanted, known before any run; where there are two sizes, the finer one must also be better where said (True).
K = 2 * math.pi  # wave number of the pulse [1/m]; central differences of step h are late by (K h)^2 / 24 of the way, here 6 m
LAYERS = {4: 1 / (1 - 1.12 / 16) - 1, 6: 1 / (1 - 1.12 / 36) - 1}  # strain constant in n layers of cells leaves out their own moments: validation/cantilever
BOUNDS = {
    ("cube", "dlsm"): ([0.03, 0.03], True),            # the bound of 216 cells in validation/cube-vibration, more cells are no worse
    ("sphere", "dlsm"): ([0.03], False),               # the same for as many cells
    ("cylinder", "dlsm"): ([0.03], False),
    ("pressure-wave", "dlsm"): ([(K / n) ** 2 / 24 * K * 6 for n in (16, 24)], True),
    # Beams: the pulse's slope over itself (rms) by how early it arrives: a diameter (0.033) at the first of three arrivals and once more at each, and half of 2.5 % in E of 1, 3, 5 lengths.
    ("pressure-wave", "cbm"): ([K / 3 ** 0.5 * (0.033 * (14 / 3) ** 0.5 + 0.0125 * (35 / 3) ** 0.5)], False),
    ("shear-wave", "dlsm"): ([(K / n) ** 2 / 24 * K * 6 for n in (16, 24)], True),
    ("kirsch", "dlsm"): ([1 / 4, 1 / 6], True),        # cells of constant stress, where it changes by itself over a radius: h / a
    ("kirsch", "dlsm-published"): ([1.5 / 4, 1.5 / 6], True), # and planes of symmetry are held half a cell away
    ("hondros", "dlsm"): ([1 / 10, 1 / 15], True),     # the same: h / R
    ("tension", "dlsm"): ([1e-5], False),              # patch test: the bound of validation/agh19-table3
    ("tension", "cbm"): ([0.07], False),               # 2.5 % of 10 000 spheres and twice the scatter (0.5 % of 10 000) of 500
    ("bending", "dlsm"): ([LAYERS[4], LAYERS[6]], True),
    ("cantilever", "dlsm"): ([LAYERS[4], LAYERS[6]], True),
    ("torsion", "dlsm"): ([0.104, 0.046], True),       # validation/twisted-bar
    ("square-torsion", "dlsm"): ([0.166, 0.074], False),
    ("hertz", "dlsm"): ([0.1], False),                 # what validation/hertz-sphere asks of twenty times as many cells
    ("strength", "dlsm"): ([0.01], False),             # a uniform state
}


def main():
    program = os.environ.get("BRC_PROGRAM", "breccia")
    folder = f"validation-accuracy-{os.getpid()}"
    subprocess.run([program, "bench", "accuracy", "--quick", "-o", folder], check=True, env=dict(os.environ, OMP_WAIT_POLICY="passive", OMP_NUM_THREADS="1"))
    with open(os.path.join(folder, "curves.csv"), newline="") as file:
        points = list(csv.DictReader(file))
    with open(os.path.join(folder, "rows.json")) as file:
        rows = json.load(file)
    failed = []

    def expect(truth, sentence):
        if not truth:
            failed.append(sentence)

    expect(len(rows) == len(points), "rows.json has as many rows as curves.csv")
    found = {}
    for p in points:
        found.setdefault((p["problem"], p["model"]), []).append(p)
        expect(p["error"] != "" and p["note"] == "" or p["model"] == "dlsm-published", f"{p['problem']} {p['run']}: {p['note']}")
        expect(float(p["ns_per_bond_update"]) > 0 and float(p["steps_per_crossing"]) > 0 and float(p["seconds"]) > 0, f"{p['problem']} {p['run']} is priced")
    for key, (bounds, falling) in BOUNDS.items():
        errors = [float(p["error"] or "nan") for p in found.get(key, [])]
        expect(len(errors) == len(bounds), f"{key}: {len(errors)} points, expected {len(bounds)}")
        for error, bound in zip(errors, bounds):
            expect(error <= bound, f"{key}: error {error:.3g}, expected at most {bound:.3g}")
        if falling and len(errors) > 1:
            expect(errors[-1] < errors[0], f"{key}: errors {errors} do not fall")
    for ours, published in zip(found[("cube", "dlsm")], found[("cube", "dlsm-published")]):
        expect(float(ours["error"]) < float(published["error"]), "the conservative law is nearer to the exact modes than the published one on the same cells")
    own, around = (float(p["error"]) for p in sorted(found[("kirsch", "cbm")], key=lambda p: p["level"]))
    expect(around < own, "the stress of a sphere with its neighbours is nearer to the field around a hole than its own")
    # Going on with the folder makes no run twice; without --resume it is refused.
    again = subprocess.run([program, "bench", "accuracy", "--quick", "--resume", "--problems", "cube", "-o", folder], check=True, capture_output=True, text=True)
    expect(again.stdout.startswith(f"{len(points)} points"), "--resume goes on with the points that are there")
    expect(subprocess.run([program, "bench", "accuracy", "--quick", "-o", folder], capture_output=True).returncode == 2, "a folder with points is refused")
    expect(subprocess.run([program, "bench", "accuracy", "--problems", "cubus", "-o", folder + "-2"], capture_output=True).returncode == 2, "an unknown problem is refused")
    shutil.rmtree(folder + "-2", ignore_errors=True)
    for sentence in failed:
        print("FAILED:", sentence)
    if not failed:
        shutil.rmtree(folder)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
