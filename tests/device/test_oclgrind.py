"""Small runs on oclgrind, a simulator of an OpenCL GPU: no access beyond a buffer, no race between work-items but of equal values.

Kernels are compiled without optimisation, inlining and `restrict`, whose traces in LLVM's code oclgrind 21.10 does not know. Its search for
values that were not set is left out: without optimisation it takes copies of structs for such.
"""
import csv
import os
import re
import shutil
import subprocess
import sys
import tempfile

PROGRAM = os.environ["BRC_PROGRAM"]
OPTIONS = "-O0 -D restrict= -D always_inline=unused"
# Its device has 32 KB of local memory, and it counts that of kernels whose names begin alike together.
GROUP = "64"
# Work-items store the same value in one place (STORE_SAME), while others read it: both readings lead to the same.
EQUAL_VALUES = {"ring_spread", "contact_spread"}

SCENE = """version: 1
title: a body for oclgrind
materials: {{stone: {{density: 1 kg/m^3, E: 1 Pa, nu: 0.2{strength}}}}}
model: {model}
{effects}bodies: [{{name: block, shape: {{box: {{size: [1 m, 1 m, 1 m]}}}}, {fill}, material: stone}}]
stages: [{{name: swing, solver: {{dynamic: {{steps: 2, time_step: {step}}}}}, initial: [velocity: {{gradient: {{x: [1e-1 1/s, 0, 0]}}}}]}}]
output: {{picture: false, frames: none}}
"""
CELLS = "fill: {noisy_grid: {cells: [2, 2, 2], spread: 90 %}}"
SPHERES = "beams: 8, fill: {packing: {elements: 60, coordination: 4}}"
# Case: what fills the scene, and kernels that must have run.
CASES = {
    "dlsm": ({"model": "dlsm", "fill": CELLS}, {"dlsm_gradient", "dlsm_stress", "dlsm_flux_pass", "dlsm_force", "dlsm_energy", "advance"}),
    "published": ({"model": "dlsm-published", "fill": CELLS}, {"published_strain_pass", "published_force_pass", "advance_rotation"}),
    "cbm": ({"model": "cbm", "fill": SPHERES}, {"cbm_force_pass"}),
    "fracture": ({"model": "dlsm", "fill": CELLS, "strength": ", strength: {tension: 1e-4 Pa}", "step": "10 ms",
                  "effects": "fracture: {criterion: bond-normal}\ninteractions: {contact: {friction: 0.3}}\n"},
                 {"cells_check", "cells_break", "ring_spread", "scan_sums", "rim_stress", "contact_cells"}),
}


def errors_in(log):
    """The first lines of oclgrind's errors, but of races of equal values."""
    found = []
    for report in re.split(r"\n(?=\S)", log):
        kernel = re.search(r"Kernel: (\w+)", report)
        race = "data race" in report.split("\n", 1)[0]
        if kernel and not (race and kernel.group(1) in EQUAL_VALUES):
            found.append(f"{kernel.group(1)}: {' '.join(report.split())[:300]}")
    return found


def simulate(name, folder):
    words, kernels = CASES[name]
    scene, log, profile = (f"{folder}/{name}.{ending}" for ending in ("yaml", "log", "csv"))
    with open(scene, "w", encoding="utf-8") as file:
        file.write(SCENE.format(**{"strength": "", "effects": "", "step": "1 ms", **words}))
    done = subprocess.run(["oclgrind", "--log", log, "--build-options", OPTIONS, "--data-races", "--max-errors", "100000", PROGRAM, "run", scene,
                           "--device", "opencl:0", "--threads", "1", "-o", f"{folder}/{name}"], capture_output=True, text=True,
                          env=dict(os.environ, BRECCIA_OPENCL_PROFILE=profile, BRECCIA_OPENCL_GROUP=GROUP))
    assert done.returncode == 0 and "on opencl:0 (Oclgrind Simulator" in done.stderr + done.stdout, f"{name}: {done.stdout}{done.stderr}"
    with open(profile, encoding="utf-8") as file:
        launched = {row["kernel"] for row in csv.DictReader(file)}
    assert kernels <= launched, f"{name}: {kernels - launched} never ran, of {sorted(launched)}"
    with open(log, encoding="utf-8") as file:
        failures = errors_in(file.read())
    print(f"{name}: {len(launched)} kernels, {len(failures)} errors", flush=True)
    return failures


def main():
    example = "\nInvalid read of size 8 at global memory address 0x1\n\tKernel: dlsm_force\n\nRead-write data race at global\n\tKernel: ring_spread\n"
    assert len(errors_in(example)) == 1, "an invalid read is an error, a race of equal values is none"
    if not shutil.which("oclgrind"):
        refused = bool(os.environ.get("BRC_NO_SKIPS"))
        print(f"SKIPPED{', but BRC_NO_SKIPS is set' if refused else ''}: no oclgrind (Debian package oclgrind)")
        sys.exit(1 if refused else 77)
    with tempfile.TemporaryDirectory(prefix="oclgrind-", dir=".") as folder:
        failures = [found for name in (sys.argv[1:] or CASES) for found in simulate(name, folder)]
    for failure in failures[:20]:
        print("oclgrind:", failure)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
