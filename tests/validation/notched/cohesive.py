#!/usr/bin/env python3
"""References of the case `notched`: peak load of a straight edge crack whose tip opens against a cohesion that falls linearly, by weight functions, and that
of linear elastic fracture mechanics. Prints a line a specimen: name, nominal stress at the peak [Pa], the same by LEFM [Pa], zone at the peak over the crack [-].

K of a strip under tension and under bending: H. Tada, P. C. Paris, G. R. Irwin, The Stress Analysis of Cracks Handbook (single edge notch); three-point
bending of span S: G. V. Guinea, J. Y. Pastor, J. Planas, M. Elices, Int. J. Fracture 89 (1998) 103. Weight function
m(x, a) = 2 / sqrt(2 pi (a - x)) (1 + M1 y^1/2 + M2 y + M3 y^3/2), y = 1 - x / a, M2 = 3, M1 and M3 from the two K of the strip: G. Shen, G. Glinka,
Eng. Fract. Mech. 40 (1991) 1135. Plane stress. For a crack of length a (with its cohesive end, from a_0 on), nominal stress P and cohesion s(x):
    0 = P k(a) - int s m(x, a) dx,    opening(x) = 2/E int_x^a [P k(b) - int s m(x', b) dx'] m(x, b) db = (2 G / f) (1 - s(x) / f)
which is linear in P and s at nodes; the peak is the largest P over a."""
import os
import sys
from math import cos, pi, sin, sqrt, tan

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from gauss import solve  # noqa: E402 (beside the cases)

NODES = 20


def gauss(n):
    """Points and weights of Gauss and Legendre on [0, 1]."""
    points = []
    for i in range(n):
        x = cos(pi * (i + 0.75) / (n + 0.5))
        for _ in range(60):
            before, p = 1.0, x
            for k in range(2, n + 1):
                before, p = p, ((2 * k - 1) * x * p - (k - 1) * before) / k
            slope = n * (x * p - before) / (x * x - 1)
            x -= p / slope
        points.append(((1 + x) / 2, 1 / ((1 - x * x) * slope * slope)))
    return points


POINTS = gauss(12)


def tension(c):
    """K / (stress sqrt(pi a)) of a strip, c = a / W."""
    return sqrt(2 / (pi * c) * tan(pi * c / 2)) / cos(pi * c / 2) * (0.752 + 2.02 * c + 0.37 * (1 - sin(pi * c / 2)) ** 3)


def bending(c):
    """The same for the stress of pure bending at the notched edge."""
    return sqrt(2 / (pi * c) * tan(pi * c / 2)) / cos(pi * c / 2) * (0.923 + 0.199 * (1 - sin(pi * c / 2)) ** 4)


def three_points(c, span):
    """The same for 3 P S / (2 B W^2); span: S / W, at least 2.5."""
    short = 1.900 - c * (-0.089 + 0.603 * (1 - c) - 0.441 * (1 - c) ** 2 + 1.223 * (1 - c) ** 3)
    slender = 1.989 - c * (1 - c) * (0.448 - 0.458 * (1 - c) + 1.226 * (1 - c) ** 2)
    return (slender + 4 / span * (short - slender)) / ((1 - c) ** 1.5 * (1 + 2 * c)) / sqrt(pi)


def weights(c):
    """M1 and M3: K of even stress and of 1 - 2 x / W, over sqrt(pi a), are sqrt(2)/pi int y^-1/2 (1 + ...) stress dy."""

    def moments(even, rising):
        return [even / (p + 1) + rising / (p + 2) for p in (-0.5, 0, 0.5, 1)]

    first, second = moments(1, 0), moments(1 - 2 * c, 2 * c)
    r = tension(c) * pi / sqrt(2) - first[0] - 3 * first[2]
    s = bending(c) * pi / sqrt(2) - second[0] - 3 * second[2]
    det = first[1] * second[3] - first[3] * second[1]
    return (r * second[3] - first[3] * s) / det, (first[1] * s - r * second[1]) / det


def weight(x, a, m):
    y = 1 - x / a
    return 2 / sqrt(2 * pi * a * y) * (1 + m[0] * sqrt(y) + 3 * y + m[1] * y * sqrt(y))


def hats(nodes, a, m):
    """K of a stress that is 1 at a node and falls linearly to its neighbours, up to a; x = a - s^2 takes the root out."""
    out = [0.0] * len(nodes)
    for i in range(len(nodes) - 1):
        if nodes[i] >= a:
            break
        s1, s0 = sqrt(a - nodes[i]), sqrt(max(0, a - nodes[i + 1]))
        for q, w in POINTS:
            s = s0 + (s1 - s0) * q
            share = (a - s * s - nodes[i]) / (nodes[i + 1] - nodes[i])
            k = w * (s1 - s0) * 2 * s * weight(a - s * s, a, m)
            out[i] += k * (1 - share)
            out[i + 1] += k * share
    return out


def load_of(factor, start, width, zone, young, strength, energy):
    """Nominal stress at which the cohesive end has this length."""
    a = start + zone
    nodes = [start + zone * i / NODES for i in range(NODES + 1)]
    full = 2 * energy / strength
    rows = []
    for i in range(NODES):
        row, side = [0.0] * (NODES + 1), sqrt(a - nodes[i])
        by_load = 0.0
        for q, w in POINTS:
            b = nodes[i] + (side * q) ** 2
            m = weights(b / width)
            f = w * side * 2 * side * q * weight(nodes[i], b, m) * 2 / young
            by_load += f * factor(b / width) * sqrt(pi * b)
            row = [r - f * k for r, k in zip(row, hats(nodes, b, m))]
        row[i] += full / strength
        rows.append([by_load] + row + [full])
    rows.append([0.0] * (NODES + 1) + [1.0, strength])
    rows.append([factor(a / width) * sqrt(pi * a)] + [-k for k in hats(nodes, a, weights(a / width))] + [0.0])
    return solve(rows)[0]


def peak(factor, start, width, young, strength, energy):
    length = young * energy / strength**2
    best, at = 0.0, 0.0
    for k in range(1, 60):
        load = load_of(factor, start, width, 0.05 * k * length, young, strength, energy)
        if load < best:
            break
        best, at = load, 0.05 * k * length
    return best, sqrt(young * energy) / (factor(start / width) * sqrt(pi * start)), at / start


if __name__ == "__main__":
    for name, factor, start, width, energy in (
        ("tension", tension, 0.030, 0.075, 40),
        ("tension-long", tension, 0.042, 0.084, 20),
        ("tension-quick", tension, 0.020, 0.050, 40),
        ("bending", lambda c: three_points(c, 2.5), 0.030, 0.060, 40),
        ("bending-long", lambda c: three_points(c, 2.5), 0.042, 0.070, 20),
    ):
        print("%-14s %.5g %.5g %.3f" % ((name,) + peak(factor, start, width, 20e9, 10e6, energy)))
