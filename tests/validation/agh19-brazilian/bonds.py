#!/usr/bin/env python3
"""How far the stress of bonds is from the exact one under jaws that move as one; needs Debian's python3-h5py, no test does.

    breccia run elastic.yaml --set output.frames=0 -o DIR; breccia build elastic.yaml -o DOMAIN     (with the same --set of the sets and of the cells)
    bonds.py DIR DOMAIN HALF_WIDTH     half width of the jaws [mm]: 17.36, or 5 with the sets' boxes from -5 mm to 5 mm

So for eighth.yaml, with --set sets.top.faces.box.to.0="5 mm" --set stages.0.solver.static="{finite_strain: false, tolerance: 1e-6}" and, as one word,
    --set stages.0.loads="[{face_displacement: {set: top, z: -90 um}}, {face_displacement: {set: disc_y-, y: 0}}, {face_displacement: {set: cut_x-, x: 0}}, {face_displacement: {set: cut_z-, z: 0}}]"

Stress as kernels/models/dlsm/cell_normal.h has it, for small strains: the mean stress of the two cells along the bond, with the bond's own elongation in place of theirs. Bonds within 3 mm of the loaded
diameter whose direction is within 37 degrees of across; depth: below the nearer jaw. Differences are over the exact compression along the load there, stresses over 2 P / (pi D t)."""
import json
import os
import sys
from math import asin, pi

import h5py
import numpy as np

from disc import NU, RADIUS, THICKNESS, jaws
from sheet import exact

YOUNG = 20e9
DEPTHS = (3, 6, 9, 12, 16, 20, 25, 30, 40, 60, 100)


def bonds(folder, domain):
    """Mean width of cells [mm]; middles, directions and normal stresses of all bonds."""
    with h5py.File(os.path.join(folder, "frames", "000001.vtkhdf")) as file:
        data = file["VTKHDF/CellData"]
        order = np.argsort(data["element_id"][()])
        moved = data["displacement"][()][order]
        stress = data["stress"][()][order][:, [[0, 3, 5], [3, 1, 4], [5, 4, 2]]]
    with h5py.File(domain) as file:
        at, area = file["elements/position"][()], np.linalg.norm(file["half_edges/area_vector"][()], axis=1)
        size = 1000 * np.mean(file["elements/volume"][()]) ** (1 / 3)
        other, start = (file["half_edges/" + name][()] for name in ("neighbour", "row_start"))
    one = np.repeat(np.arange(len(at)), np.diff(start))
    branch, jump = at[other] - at[one], moved[other] - moved[one]
    length = np.linalg.norm(branch, axis=1)
    axis = branch / length[:, None]
    shape, gradient = np.zeros((len(at), 3, 3)), np.zeros((len(at), 3, 3))
    weighted = (area / length)[:, None, None] * branch[:, None, :]
    np.add.at(shape, one, branch[:, :, None] * weighted)
    np.add.at(gradient, one, jump[:, :, None] * weighted)
    gradient = gradient @ np.linalg.inv(shape)

    def along(tensors):
        return np.einsum("bi,bij,bj->b", axis, tensors, axis)

    modulus = YOUNG * (1 - NU) / ((1 + NU) * (1 - 2 * NU))
    elongation = np.sum(axis * jump, axis=1) / length
    halves = [along(stress[side]) + modulus * (elongation - along(gradient[side])) for side in (one, other)]
    once = one < other
    return size, (at[one] + at[other])[once] / 2, axis[once], (sum(halves) / 2)[once]


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    folder, domain, half_width = sys.argv[1], sys.argv[2], float(sys.argv[3]) / 1000
    with open(os.path.join(folder, "summary.json")) as file:
        nominal = json.load(file)["measures"]["force"]["value"] / (pi * RADIUS * THICKNESS)
    size, middle, axis, stress = bonds(folder, domain)
    near = (np.abs(middle[:, 0]) < 0.003) & (np.abs(axis[:, 0]) > 0.8)
    middle, axis, stress = middle[near], axis[near], stress[near] / nominal
    there = exact(jaws(asin(half_width / RADIUS)), middle[:, 0] / RADIUS, middle[:, 2] / RADIUS)
    wanted = axis[:, 0] ** 2 * there[:, 0] + axis[:, 2] ** 2 * there[:, 1] + 2 * axis[:, 0] * axis[:, 2] * there[:, 2]
    off, depth = (stress - wanted) / -there[:, 1], 1000 * (RADIUS - np.abs(middle[:, 2]))
    print("depth [mm]  [cells]  bonds  along  difference, its scatter, the largest  largest stress")
    for low, high in zip(DEPTHS, DEPTHS[1:]):
        k = (depth >= low) & (depth < high)
        if np.any(k):
            print("%3d to %3d  %7.1f  %5d  %5.1f  %+9.3f  %9.3f  %+9.3f  %14.2f"
                  % (low, high, (low + high) / 2 / size, k.sum(), there[k, 1].mean(), off[k].mean(), off[k].std(), off[k].max(), stress[k].max()))


if __name__ == "__main__":
    main()
