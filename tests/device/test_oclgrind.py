"""Small runs on oclgrind, a simulator of an OpenCL GPU: no access beyond a buffer, no value used that was not set, no race between
work-items but of equal values.

    test_oclgrind.py                  what ctest runs
    test_oclgrind.py --all            every case; NAME ...: these
    test_oclgrind.py --kernels ...    also which kernels no case launched

Kernels are compiled without optimisation, inlining and `restrict`, whose traces in LLVM's code oclgrind 21.10 does not know. It does not
know either that clEnqueueFillBuffer sets values: oclgrind/fill.c, loaded before it, writes them instead.
"""
import csv
import os
import re
import subprocess
import sys
import tempfile

PROGRAM = os.environ["BRC_PROGRAM"]
FILL = os.environ["BRC_BUILD_DIR"] + "/tests/libbrc_oclgrind_fill.so"
RUNTIME = "/usr/lib/oclgrind/liboclgrind-rt.so"
OPTIONS = "-O0 -D restrict= -D always_inline=unused"
# Its device has 32 KB of local memory, and it counts that of kernels whose names begin alike together.
GROUP = "64"
# Work-items store the same value in one place (STORE_SAME), while others read it: both readings lead to the same.
EQUAL_VALUES = {"ring_spread", "contact_spread"}

SCENE = """version: 1
title: a body for oclgrind
materials: {{stone: {{density: 1 kg/m^3, E: 1 Pa, nu: 0.2{strength}}}{other}}}
model: {model}
{effects}bodies: [{{name: block, shape: {{box: {{size: [1 m, 1 m, 1 m]}}}}, {fill}, material: stone{regions}}}]
stages: [{{name: swing, {stage}}}]
output: {{picture: false, frames: none}}
"""
CELLS = "fill: {noisy_grid: {cells: [2, 2, 2], spread: 90 %}}"
SPHERES = "beams: 8, fill: {packing: {elements: 60, coordination: 4}}"
STEPS = "solver: {{dynamic: {{steps: {n}, time_step: {step}}}}}, initial: [velocity: {{gradient: {{x: [1e-1 1/s, 0, 0]}}}}]"
PULLED = "loads: [face_displacement: {set: x-, x: 0}, face_velocity: {set: x+, x: 1e-3 m/s}, traction: {set: y+, y: 1e-3 Pa}]"
ENDS = "sets: {left: {elements: {wall: x-}}, right: {elements: {wall: x+}}}\n"
ENDS_PULLED = "loads: [element_velocity: {set: right, x: 1e-3 m/s}]"
WEAK = ", strength: {tension: 1e-4 Pa}"
BY_BOND = "fracture: {criterion: bond-normal}\n"
CONTACT = "interactions: {contact: {friction: 0.3, restitution: 0.7}}\n"
BALL = ("strikers: {ball: {shape: {sphere: {radius: 0.25 m, centre: [0.5 m, 0.45 m, 1.24 m]}}, facets: 24, material: stone, "
        "motion: {free: {velocity: [0, 0, -1 m/s]}}}}\n")
SOFT = ", strength: {{tension: 1e-4 Pa, fracture_energy: {energy}}}"
PRINCIPAL = "fracture: {criterion: virial-principal}\n"
SHELLS = "fracture: {criterion: {drucker-prager: {cohesion: 1e-4 Pa, friction: 30 deg, level: 2}}}\n"
APART = "loads: [face_displacement: {set: x-, x: 0}, face_displacement: {set: x+, x: 1e-3 m}]"
ENDS_APART = "loads: [element_displacement: {set: left, x: 0}, element_displacement: {set: right, x: 1e-3 m}]"


def static(preconditioner, loads):
    return f"solver: {{static: {{finite_strain: false, tolerance: 1e-2, preconditioner: {preconditioner}}}}}, {loads}"


def steps(n=2, step="1 ms", more=""):
    return STEPS.format(n=n, step=step) + (f", {more}" if more else "")


# Case: what fills the scene, and kernels that must have run.
CASES = {
    "faces": ({"model": "dlsm", "fill": CELLS, "stage": steps(more=PULLED), "effects": "gravity: [0, 0, -1 m/s^2]\n"},
              {"dlsm_gradient", "dlsm_flux_pass", "dlsm_gradient_held", "dlsm_stress_held", "dlsm_force_held", "gravity"}),
    "published": ({"model": "dlsm-published", "fill": CELLS}, {"published_strain_pass", "published_force_pass", "advance_rotation"}),
    "cbm": ({"model": "cbm", "fill": SPHERES}, {"cbm_force_pass"}),
    "fracture": ({"model": "dlsm", "fill": CELLS, "strength": WEAK, "stage": steps(step="10 ms"), "effects": BY_BOND + CONTACT},
                 {"cells_check", "cells_break", "ring_spread", "scan_sums", "rim_stress", "contact_cells"}),
    "statics": ({"model": "dlsm", "fill": CELLS, "stage": static("blocks", APART)}, {"block_precondition", "dlsm_flux_linear"}),
}
MORE = {
    "dlsm": ({"model": "dlsm", "fill": CELLS}, {"dlsm_gradient", "dlsm_stress", "dlsm_flux_pass", "dlsm_force", "dlsm_energy", "advance"}),
    "materials": ({"model": "dlsm", "fill": CELLS, "other": ", clay: {density: 2 kg/m^3, E: 2 Pa, nu: 0.3}",
                   "regions": ", regions: [{where: {half_space: {point: [0.5 m, 0, 0], normal: [1, 0, 0]}}, material: clay}]"}, {"dlsm_flux_pass"}),
    "published-fracture": ({"model": "dlsm-published", "fill": CELLS, "strength": ", strength: {tension: 1e-5 Pa}", "stage": steps(more=ENDS_PULLED),
                            "effects": BY_BOND + ENDS}, {"published_breaking_force", "published_check"}),
    "softening": ({"model": "dlsm", "fill": CELLS, "strength": SOFT.format(energy="1e-6 J/m^2"), "stage": steps(3, "10 ms", PULLED),
                   "effects": "fracture: {}\n"},
                  {"soft_check", "soft_begin", "soft_move", "soft_flux", "soft_book"}),
    "criteria": ({"model": "dlsm", "fill": CELLS, "strength": WEAK, "stage": steps(step="10 ms"), "effects": SHELLS},
                 {"fracture_stress_second", "cells_record"}),
    "closure": ({"model": "dlsm", "fill": CELLS, "strength": WEAK, "stage": steps(3, "10 ms"), "effects": BY_BOND},
                {"closed_follow", "closed_press", "closed_energy"}),
    "beams-break": ({"model": "cbm", "fill": SPHERES, "strength": WEAK, "stage": steps(3, "1 ms", ENDS_PULLED), "effects": PRINCIPAL + ENDS},
                    {"fracture_check", "fracture_break", "closure_begin", "closure_move", "closure_force"}),
    "beams-soften": ({"model": "cbm", "fill": SPHERES, "strength": SOFT.format(energy="1e-6 J/m^2"), "stage": steps(3, "1 ms", ENDS_PULLED),
                      "effects": PRINCIPAL + ENDS}, {"beam_soft_begin", "beam_soft_move", "beam_soft_force"}),
    "statics-coarse": ({"model": "dlsm", "fill": CELLS, "stage": static("multigrid", APART)}, {"multigrid_step"}),
    "statics-beams": ({"model": "cbm", "fill": SPHERES, "stage": static("blocks", ENDS_APART), "effects": ENDS}, {"block6_precondition", "impose_zero"}),
    "drags": ({"model": "dlsm", "fill": CELLS, "stage": "solver: {dynamic: {steps: 2, time_step: 1 ms, mass_damping: 1 1/s}}, " + PULLED},
              {"damp_mass"}),
    "loads": ({"model": "cbm", "fill": SPHERES, "effects": ENDS, "stage": "solver: {dynamic: {steps: 2, time_step: 1 ms, integrator: tchamwa-wielgosz}}, "
               "loads: [element_displacement: {set: left, x: 0}, element_rotation: {set: right, x: 1 mrad}, element_force: {set: right, y: 1e-3 N}]"},
              {"impose_turn", "turn_book", "push_elements", "advance_tchamwa", "numerical_close"}),
    "ball": ({"model": "dlsm", "fill": CELLS, "stage": steps(3, "5 ms"), "effects": CONTACT + BALL}, {"striker_advance", "contact_striker_parts"}),
}

ALL = {**CASES, **MORE}


def errors_in(log):
    """The first lines of oclgrind's errors, but of races of equal values."""
    found = []
    for report in re.split(r"\n(?=\S)", log):
        kernel = re.search(r"Kernel: (\w+)", report)
        race = "data race" in report.split("\n", 1)[0]
        if kernel and not (race and kernel.group(1) in EQUAL_VALUES):
            found.append(f"{kernel.group(1)}: {' '.join(report.split())[:300]}")
    return found


def oclgrind_environment(log):
    """As the command `oclgrind` sets it, which cannot load fill.c before its own library."""
    return {"LD_PRELOAD": f"{FILL} {RUNTIME}", "OCLGRIND_LOG": log, "OCLGRIND_BUILD_OPTIONS": OPTIONS, "OCLGRIND_DATA_RACES": "1",
            "OCLGRIND_UNINITIALIZED": "1", "OCLGRIND_MAX_ERRORS": "100000"}


def simulate(name, folder):
    words, kernels = ALL[name]
    scene, log, profile = (f"{folder}/{name}.{ending}" for ending in ("yaml", "log", "csv"))
    with open(scene, "w", encoding="utf-8") as file:
        file.write(SCENE.format(**{"strength": "", "effects": "", "other": "", "regions": "", "stage": steps(), **words}))
    done = subprocess.run([PROGRAM, "run", scene, "--device", "opencl:0", "--threads", "1", "-o", f"{folder}/{name}"], capture_output=True, text=True,
                          env={**os.environ, **oclgrind_environment(log), "BRECCIA_OPENCL_PROFILE": profile, "BRECCIA_OPENCL_GROUP": GROUP})
    assert done.returncode == 0 and "on opencl:0 (Oclgrind Simulator" in done.stderr + done.stdout, f"{name}: {done.stdout}{done.stderr}"
    with open(profile, encoding="utf-8") as file:
        launched = {row["kernel"] for row in csv.DictReader(file)}
    assert kernels <= launched, f"{name}: {kernels - launched} never ran, of {sorted(launched)}"
    with open(log, encoding="utf-8") as file:
        failures = errors_in(file.read())
    print(f"{name}: {len(launched)} kernels, {len(failures)} errors", flush=True)
    return failures, launched


def never_launched(launched):
    with open(f"{os.environ['BRC_BUILD_DIR']}/generated/device/kernel_list.h", encoding="utf-8") as file:
        return sorted(set(re.findall(r"X\((\w+)\)", file.read().split("X)", 1)[1])) - launched)


def main():
    example = "\nInvalid read of size 8 at global memory address 0x1\n\tKernel: dlsm_force\n\nRead-write data race at global\n\tKernel: ring_spread\n"
    assert len(errors_in(example)) == 1, "an invalid read is an error, a race of equal values is none"
    if not os.path.exists(RUNTIME):
        refused = bool(os.environ.get("BRC_NO_SKIPS"))
        print(f"SKIPPED{', but BRC_NO_SKIPS is set' if refused else ''}: no oclgrind (Debian package oclgrind)")
        sys.exit(1 if refused else 77)
    names = [word for word in sys.argv[1:] if not word.startswith("--")] or (ALL if "--all" in sys.argv else CASES)
    failures, launched = [], set()
    with tempfile.TemporaryDirectory(prefix="oclgrind-", dir=".") as folder:
        for name in names:
            found, ran = simulate(name, folder)
            failures += found
            launched |= ran
    if "--kernels" in sys.argv:
        missing = never_launched(launched)
        print(f"{len(launched)} kernels ran, {len(missing)} did not: {' '.join(missing)}")
    for failure in failures[:20]:
        print("oclgrind:", failure)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
