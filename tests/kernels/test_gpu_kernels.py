"""The kernels compiled for a card without one (bench/gpu_kernels.py): they compile to PTX as a GPU gets them, no pass of a step keeps
an array in local memory, and with ptxas (PyPI: nvidia-cuda-nvcc) none spills or takes more registers than its budget on sm_90."""
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.environ["BRC_SOURCE_DIR"], "bench"))
import gpu_kernels

# Passes of an elastic step: the most registers in double and in mixed precision, one material, sm_90, ptxas 13.0: at
# least 25 % of the warps in double (128 registers) and 37 % in mixed (80).
BUDGET = {
    "dlsm_gradient": (64, 48), "dlsm_stress": (96, 72), "dlsm_flux_pass": (128, 80), "dlsm_flux_linear": (128, 80), "dlsm_force": (80, 56), "advance": (32, 32),
    "dlsm_gradient_held": (80, 48), "dlsm_stress_held": (128, 80), "dlsm_force_held": (96, 56), "cells_force_held": (128, 80),
    "published_strain_pass": (80, 64), "published_force_pass": (128, 80), "advance_rotation": (64, 64),
    "cbm_force_pass": (128, 80), "kinetic_energy": (32, 32), "guard_probe": (40, 40), "vector_sum": (32, 32),
}
# Kernels that keep arrays in local memory, and how many bytes at most, with what they call; every other has none.
ARRAYS = {"contact_cells": 15104, "fracture_stress_second": 2048, "rim_flux": 272, "rim_force": 272,
          "block6_precondition": 96, "multigrid_step": 96, "closed_again": 96}  # the last: only in steps with breaks


def skip(why, excused=False):
    """excused: what no Debian package brings is a skip even where BRC_NO_SKIPS is set (tests/skip.h)."""
    refused = bool(os.environ.get("BRC_NO_SKIPS")) and not excused
    print(f"SKIPPED{', but BRC_NO_SKIPS is set' if refused else ''}: {why}")
    sys.exit(1 if refused else 77)


def over_budget(rows, column):
    return [f"{row['kernel']}: {row['registers']} registers, at most {BUDGET[row['kernel']][column]}" for row in rows
            if row["kernel"] in BUDGET and row["registers"] > BUDGET[row["kernel"]][column]]


def crowded_out(rows, least):
    """Passes of which fewer warps than `least` % fit, by registers and by what they put aside (48 KB a group, 228 KB a multiprocessor)."""
    found = []
    for row in rows:
        if row["kernel"] in BUDGET:
            by_room = 100 * (228 * 1024 // row["shared_bytes"]) * gpu_kernels.GROUP[row["precision"]] // 2048 if row["shared_bytes"] else 100
            if min(row["occupancy_percent"], by_room) < least or row["shared_bytes"] > 48 * 1024:
                found.append(f"{row['kernel']}: {row['occupancy_percent']} % of the warps by registers, {by_room} % by {row['shared_bytes']} bytes aside")
    return found


def spilling(rows):
    return [f"{row['kernel']}: {row['spill_stores_bytes']} bytes spilled" for row in rows if row["spill_stores_bytes"] and row["kernel"] not in ARRAYS]


def main():
    missing = gpu_kernels.missing_for_ptx()
    if missing:
        skip(f"no PTX without {missing}")
    row = {"kernel": "dlsm_force", "registers": 255, "spill_stores_bytes": 8, "occupancy_percent": 12, "shared_bytes": 0, "precision": "double"}
    assert over_budget([row], 0) and spilling([row]) and crowded_out([row], 25), "the budgets cannot fail"
    assert crowded_out([dict(row, occupancy_percent=100, shared_bytes=120 * 1024)], 25)
    assert [gpu_kernels.occupancy(n, p) for p in ("double", "mixed") for n in (254, 128, 32)] == 2 * [12, 25, 100]
    failures = []
    ptxas = gpu_kernels.find_ptxas()
    with tempfile.TemporaryDirectory() as folder:
        for column, precision in enumerate(("double", "mixed")):
            ptx = gpu_kernels.ptx_of(precision, 0, folder)
            arrays = gpu_kernels.local_arrays(ptx)
            assert set(BUDGET) <= set(arrays), f"kernels without budget check: {set(BUDGET) - set(arrays)}"
            failures += [f"{precision}: {name} keeps {size} bytes in local memory, at most {ARRAYS.get(name, 0)}" for name, size in sorted(arrays.items())
                         if size > ARRAYS.get(name, 0)]
            if ptxas:
                rows = gpu_kernels.table_of(ptxas, precision, 0, ["sm_90"], folder)
                assert len(rows) == len(arrays), f"ptxas names {len(rows)} of {len(arrays)} kernels"
                failures += [f"{precision}: {found}" for found in over_budget(rows, column) + spilling(rows) + crowded_out(rows, (25, 37)[column])]
            print(f"{precision}: {len(arrays)} kernels")
    for failure in failures:
        print("gpu kernels:", failure)
    if failures:
        sys.exit(1)
    if not ptxas:
        skip("PTX holds; registers and spills want ptxas (pip install nvidia-cuda-nvcc), which no Debian package brings", excused=True)


if __name__ == "__main__":
    main()
