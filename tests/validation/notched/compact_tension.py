#!/usr/bin/env python3
"""The largest load of examples/compact-tension: finite elements in plane stress (squares with incompatible modes) of the upper half of the specimen, whose
ligament opens against a cohesion that falls linearly, and the load by linear elastic fracture mechanics from the same elements and from ASTM E399. Needs
numpy and scipy (python3-scipy): /usr/bin/python3 compact_tension.py [SIDE OF AN ELEMENT, mm, that divides 20; default 0.5].

The body is linear: the forces A on the nodes of the ligament and on the load's line by their displacements, once. For each length of the zone that opens
its last node bears the strength, nodes behind it the cohesion of their opening, which is a linear system; the largest load over the lengths is looked for."""
import sys

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import splu

E, NU, STRENGTH, ENERGY = 30e9, 0.2, 12e6, 50.0
WIDTH, HALF, THICK, BEHIND, CRACK = 0.1, 0.06, 0.006, 0.025, 0.05  # from the load's line, half of the height, ..., behind the line [m]
PINS = (0.02, 0.035)  # ends of the line that is moved [m]
OPEN = 2 * ENERGY / STRENGTH  # at which nothing is left [m]


def element(side):
    """Stiffness of a square, its four bubbles condensed."""
    elastic = E / (1 - NU**2) * np.array([[1, NU, 0], [NU, 1, 0], [0, 0, (1 - NU) / 2]])
    whole = np.zeros((12, 12))
    for a in (-(3**-0.5), 3**-0.5):
        for b in (-(3**-0.5), 3**-0.5):
            slopes = [[b - 1, 1 - b, 1 + b, -1 - b, -8 * a, 0], [a - 1, -1 - a, 1 + a, 1 - a, 0, -8 * b]]
            x, y = np.array(slopes) / (2 * side)
            strain = np.zeros((3, 12))
            strain[0, 0::2], strain[1, 1::2], strain[2, 0::2], strain[2, 1::2] = x, y, y, x
            whole += strain.T @ elastic @ strain * THICK * side**2 / 4
    return whole[:8, :8] - whole[:8, 8:] @ np.linalg.solve(whole[8:, 8:], whole[8:, :8])


def reactions(side):
    """A, over the nodes of the ligament from the crack's tip on and, last, the load's line, where the others are held."""
    nx, ny = round((WIDTH + BEHIND) / side), round(HALF / side)
    node = np.arange((nx + 1) * (ny + 1)).reshape(nx + 1, ny + 1)
    corners = np.stack([node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]], axis=-1).reshape(-1, 4)
    of = np.stack([2 * corners, 2 * corners + 1], axis=-1).reshape(-1, 8)
    rows, columns = np.repeat(of, 8, axis=1).ravel(), np.tile(of, 8).ravel()
    stiffness = sparse.csc_matrix((np.tile(element(side).ravel(), len(of)), (rows, columns)), shape=2 * (2 * node.size,))
    ligament = [2 * n + 1 for n in node[round((BEHIND + CRACK) / side) :, 0]]
    line = [2 * n + 1 for n in node[round(BEHIND / side), round(PINS[0] / side) : round(PINS[1] / side) + 1]]
    held = np.array(ligament + line + [2 * node[nx, 0]])
    free = np.setdiff1d(np.arange(2 * node.size), held)
    solved = splu(stiffness[free][:, free])
    out = np.zeros(2 * (len(ligament) + 1,))
    for k, moved in enumerate([[n] for n in ligament] + [line]):
        u = np.zeros(2 * node.size)
        u[moved] = 1
        u[free] = -solved.solve(stiffness[free] @ u)
        force = stiffness @ u
        out[:, k] = np.append(force[ligament], force[line].sum())
    return out


def cohesive(a, side):
    """Largest load [N], opening of the line then, and length of the zone [m]."""
    area = np.full(len(a) - 1, side * THICK)
    area[0] /= 2
    best = (0.0, 0.0, 0.0)
    for n in range(1, len(a) - 3):
        of, gone = list(range(n)) + [-1], np.zeros(n, bool)
        while True:
            system, right = a[np.ix_(list(range(n + 1)), of)].copy(), -STRENGTH * area[: n + 1]
            right[:n][gone] = 0
            system[range(n), range(n)] -= np.where(gone, 0, 2 * STRENGTH / OPEN * area[:n])
            moved = np.linalg.solve(system, right)
            if np.array_equal(gone, 2 * moved[:n] >= OPEN):
                break
            gone = 2 * moved[:n] >= OPEN
        best = max(best, (a[-1, of] @ moved, 2 * moved[-1], n * side))
    return best


def elastic(a, side):
    """Load at which the crack would run, by compliances with the tip a node back and ahead [N]."""
    def compliance(n):
        free = list(range(n))
        u = np.linalg.solve(a[np.ix_(free, free)], -a[free, -1]) if n else np.zeros(0)
        return 2 / (a[-1, free] @ u + a[-1, -1])
    return (2 * ENERGY * THICK * 2 * side / (compliance(2) - compliance(0))) ** 0.5


def by_standard():
    c = CRACK / WIDTH
    shape = (2 + c) * (0.886 + 4.64 * c - 13.32 * c**2 + 14.72 * c**3 - 5.6 * c**4) / (1 - c) ** 1.5
    return (E * ENERGY * WIDTH) ** 0.5 * THICK / shape


def main():
    side = 1e-3 * float(sys.argv[1] if len(sys.argv) > 1 else 0.5)
    a = reactions(side)
    load, opening, zone = cohesive(a, side)
    print(f"elastic: ASTM E399 {by_standard():.1f} N, these elements {elastic(a, side):.1f} N")
    print(f"cohesive: {load:.1f} N at an opening of the line of {1e6 * opening:.1f} um, the zone {1e3 * zone:.1f} mm long")


main()
