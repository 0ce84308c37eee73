#!/usr/bin/env python3
"""References of the case `platens`: the load at which a Brazilian disc (plane) splits along its loaded diameter when the crack opens against a cohesion that falls linearly from f to nothing at
w_c = 2 G / f. `cohesive_disc.py` prints the particular discs of the case, `--table` the nominal strength 2 P / (pi D t) / f over D / l_ch, l_ch = E' G / f^2 (E' = E in plane stress, E / (1 - nu^2) in
plane strain), `--check` what it was checked against.

Not finite elements: the crack is a row of edge dislocations of a disc whose rim is free. With the diameter along x, a dislocation that opens at s has on it, for R = 1, g = E' / (8 pi) and q = s x,
    sigma_yy = 2 g / (x - s) + 2 F + x F' + H,   F / g = s - x (2 - q) / (1 - q)^2 + s (1 / (1 - q)^2 + 1 / (1 - q) - 2),
    H / g = s / (1 - q) - sum over k >= 2 of (1 - k) ((k + 1) s^(k-1) - (k + 2) s^(k+1)) x^(k-2)    (Muskhelishvili's potentials F, H of what frees the rim, N. I. Muskhelishvili, Some Basic Problems)
and their density, odd, over sqrt(1 - (x/c)^2), is found at Chebyshev's points (F. Erdogan, G. D. Gupta, Q. Appl. Math. 29 (1972) 525). The loads are pairs of opposite line loads towards the centre:
Flamant's radial stress for each, and 2 F / (pi D) on all sides. For every half length c of the opened stretch the load is that at which the crack closes smoothly at its ends (no root there); the peak
is the first maximum over c. Nothing unloads up to it: openings grow with c (checked)."""
import argparse
import os
import sys
from math import asin, atan2, cos, log, pi, sin, sqrt

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from gauss import solve  # noqa: E402 (beside the cases)

POINTS = 48  # of the whole crack


def freed(x, s):
    """Stress across the diameter at x of what frees the rim from a dislocation at s, over g."""
    q = s * x
    u = 1 / (1 - q)
    f = s - x * (2 - q) * u * u + s * (u * u + u - 2)
    # derivative by x
    df = -((2 - 2 * q) * u * u + 2 * s * x * (2 - q) * u**3) + s * (2 * s * u**3 + s * u * u)
    # sum over j = k - 2 >= 0 of (1 + j) ((j + 3) s^(j+1) - (j + 4) s^(j+3)) x^j
    one, two = u * u, 2 * q * u**3  # sums of (j + 1) q^j and of (j + 1) j q^j
    h = s * u + s * (two + 3 * one) - s**3 * (two + 4 * one)
    return 2 * f + x * df + h


def line(angle, x):
    """Stress across the diameter at x of two opposite unit line loads towards the centre, `angle` off the diameter, R = 1."""
    out = 0.0
    for side in (1, -1):
        for up in (1, -1):
            a, b = x - side * cos(angle), -side * up * sin(angle)  # from the load
            square = a * a + b * b
            radial = -2 * (-side * (cos(angle) * a + up * sin(angle) * b)) / (pi * square)
            out += radial * b * b / square / 2
    return out + 2 * 1 / (2 * pi)


def even(half):
    """Shares of line loads that are an even pressure on arcs of this half angle (Hondros), of a load P = 1 along the diameter."""
    n = 200
    angles = [half * (i + 0.5) / n for i in range(n)]
    total = sum(cos(a) for a in angles)
    return [(a, 1 / total) for a in angles]


def hertz(half):
    """The same for the elliptic pressure of an elastic contact."""
    n = 60
    angles = [asin(sin(half) * sin(pi / 2 * (i + 0.5) / n)) for i in range(n)]
    shares = [cos(pi / 2 * (i + 0.5) / n) ** 2 for i in range(n)]
    total = sum(s * cos(a) for a, s in zip(angles, shares))
    return [(a, s / total) for a, s in zip(angles, shares)]


def across(loads, x):
    """Stress across the diameter, of 2 P / (pi D t)."""
    return pi * sum(share * line(angle, x) for angle, share in loads)


def hondros(half, x):
    s, gap = x * x, 1 - x * x
    return (gap * sin(2 * half) / (1 - 2 * s * cos(2 * half) + s * s) - atan2((1 + s) * sin(half), gap * cos(half))) / sin(half)


class Opened:
    """What the stretch -c..c of the diameter, opened, makes of the stress on it. Length R, stress E'/(4 pi), so that a dislocation is 1 / (x - s)."""

    def __init__(self, c):
        n = POINTS
        self.c = c
        self.thetas = [pi * (2 * k - 1) / (2 * n) for k in range(1, n // 2 + 1)]  # of densities, the right half
        self.at = [pi * r / n for r in range(1, n // 2 + 1)]  # of stresses, from the end to the middle
        self.x = [c * cos(t) for t in self.at]
        self.x[-1] = 0.0
        # stress by the density b = -d(opening)/ds = g / sqrt(c^2 - s^2), which is odd
        self.stress = []
        for x in self.x:
            row = []
            for t in self.thetas:
                s = c * cos(t)
                row.append(pi / n * (1 / (x - s) - 1 / (x + s) + (freed(x, s) - freed(x, -s)) / 2))
            self.stress.append(row)
        # opening at x_r: g is a sum of T_m, m odd, and int_x^c T_m / sqrt(c^2 - s^2) ds = sin(m theta) / m
        self.opening = []
        for t in self.at:
            self.opening.append([sum(4 / n * cos(m * k) * sin(m * t) / m for m in range(1, n, 2)) for k in self.thetas])
        # the root at the end: g(c)
        self.root = [sum(4 / n * cos(m * k) for m in range(1, n, 2)) for k in self.thetas]


def load_of(opened, field, length, most=30):
    """2 P / (pi D t) / f at which the stretch is open and closes smoothly, and the openings over w_c. length: l_ch / R; field: stress on the stretch of 2 P / (pi D t) = 1.
    Unknowns: densities of W = w E' / (f R), and the load; w / w_c = W / (2 l_ch / R). What is wider than w_c holds nothing."""
    n = len(opened.x)
    free = [False] * n
    for _ in range(most):
        rows = []
        for r in range(n):
            row = [k / (4 * pi) for k in opened.stress[r]]
            if not free[r]:
                row = [a + b / (2 * length) for a, b in zip(row, opened.opening[r])]
            rows.append(row + [field[r], 0.0 if free[r] else 1.0])
        rows.append(list(opened.root) + [0.0, 0.0])
        answer = solve(rows)
        wide = [sum(a * b for a, b in zip(opened.opening[r], answer)) / (2 * length) for r in range(n)]
        now = [w > 1 for w in wide]
        if now == free:
            break
        free = now
    return answer[n], wide


CRACKS = {}


def opened_to(c):
    if c not in CRACKS:
        CRACKS[c] = Opened(c)
    return CRACKS[c]


def peak(loads, length):
    """The first maximum over c: 2 P / (pi D t) / f, half length of the opened stretch over R, opening in the middle over w_c there, and whether openings grew up to it. None: the load rises up to 0.98 R."""
    step = min(0.01, 0.03 * length)
    last, grew = [], True
    for k in range(1, int(0.98 / step) + 1):
        opened = opened_to(step * k)
        load, wide = load_of(opened, [across_at(loads, x) for x in opened.x], length)
        last = last[-2:] + [(load, wide[-1], opened.c)]
        if len(last) == 3 and last[1][0] > last[2][0] and last[1][0] >= last[0][0]:
            (p0, w0, _), (p1, w1, c), (p2, w2, _) = last
            shift = 0.5 * (p0 - p2) / (p0 - 2 * p1 + p2)
            return p1 - 0.25 * (p0 - p2) * shift, c + shift * step, w1 + 0.5 * shift * (w2 - w0), grew
        grew = grew and (len(last) < 2 or last[-1][1] > last[-2][1])
    return None


FIELDS = {}


def across_at(loads, x):
    key = (loads[0], loads[-1], x)
    if key not in FIELDS:
        FIELDS[key] = across(loads, x)
    return FIELDS[key]


def width_of(load, radius, jaw, stiff):
    """Half width of the contact (Hertz, two cylinders) under a load per thickness; jaw: radius of a hollow one, None: flat. 1 / stiff: sum of (1 - nu^2) / E."""
    curve = 1 / radius - (1 / jaw if jaw else 0)
    return sqrt(4 * load / (pi * stiff * curve))


def pressed(diameter, young, nu, strength, energy, jaw, stiff, plane_strain):
    """Load per thickness at the peak, its contact half width, half length of the opened stretch over R, opening in the middle."""
    prime = young / (1 - nu * nu) if plane_strain else young
    length = prime * energy / strength**2 / (diameter / 2)
    load = pi * diameter / 2 * strength
    for _ in range(12):
        half = asin(width_of(load, diameter / 2, jaw, stiff) / (diameter / 2))
        found = peak(hertz(half), length)
        if found is None:
            return None
        new = pi * diameter / 2 * strength * found[0]
        if abs(new - load) < 1e-4 * load:
            break
        load = new
    return new, width_of(new, diameter / 2, jaw, stiff), found[1], found[2]


def table():
    """Nominal strength over f; in brackets c / R at the peak. Beside: that of a brittle disc whose centre breaks (Hondros), and 1 / (1 - (b / D)^2)^(3/2), as is published for flat jaws."""
    widths = (0.02, 0.05, 0.08, 0.16)
    print("D / l_ch   " + "".join("b/D = %-10.2f" % b for b in widths))
    for size in (0.1, 0.2, 0.5, 0.64, 1, 1.28, 2, 3.2, 5, 10, 20):
        row = [peak(even(asin(b)), 2 / size) for b in widths]
        print("%-11g" % size + "".join("%.4f (%.2f)   " % r[:2] if r else "rises          " for r in row))
    print("centre     " + "".join("%-16.4f" % (1 / hondros(asin(b), 0)) for b in widths))
    print("published  " + "".join("%-16.4f" % (1 - b * b) ** -1.5 for b in widths))


def granite():
    """The discs of case.yaml: peak load [N], contact half width there [mm], nominal strength over f, opened half length over R, opening in the middle over w_c; and the load at which the centre reaches f.
    Jaws: steel, or rigid as strikers are (the surfaces of cells give way in their place, docs/notebook/contact.md)."""
    diameter, thick, young, nu, strength = 0.05, 0.01, 50e9, 0.25, 8e6
    for plane in ("stress", "strain"):
        for jaw, name in ((None, "flat"), (0.0375, "curved")):
            for steel in (True, False):
                if not steel and plane == "strain":
                    continue
                stiff = 1 / ((1 - nu * nu) / young + ((1 - 0.3 * 0.3) / 210e9 if steel else 0))
                if plane == "stress":
                    load = pi * diameter / 2 * strength
                    for _ in range(4):
                        half = width_of(load, diameter / 2, jaw, stiff)
                        load = pi * diameter / 2 * strength / across(hertz(asin(half / (diameter / 2))), 0)
                    print("centre %-6s %-5s brittle %.1f N, half width %.3f mm" % (name, "steel" if steel else "rigid", load * thick, half * 1e3))
                for energy in (20, 50, 100) if jaw else (6.4, 20, 50, 100):
                    load, half, c, w = pressed(diameter, young, nu, strength, energy, jaw, stiff, plane == "strain")
                    nominal = 2 * load / (pi * diameter * strength)
                    print("%-6s %-6s %-5s G %-4g %.1f N, half width %.3f mm, nominal %.4f, c/R %.2f, w/w_c %.3f" % (plane, name, "steel" if steel else "rigid", energy, load * thick, half * 1e3, nominal, c, w))


def check():
    worst = max(abs(across(even(a), x) - hondros(a, x)) for a in (0.05, 0.1745) for x in (0, 0.3, 0.6, 0.8))
    print("Hondros, four places, two arcs: largest difference of 2 P / (pi D t): %.1e" % worst)
    s = 0.4
    total, n = 0.0, 20000
    for i in range(n):
        x = -1 + 2 * (i + 0.5) / n
        total += freed(x, s) * 2 / n
    total += 2 * log((1 - s) / (1 + s))
    print("resultant of a dislocation's stress on the diameter over g (0): %.1e" % total)
    # K of a central crack under two line loads: C. Atkinson, R. E. Smelser, J. Sanchez, Int. J. Fracture 18 (1982) 279: 1.060049, 1.243134, 1.578258 at 0.2, 0.4, 0.6
    for c, told in ((0.2, 1.060049), (0.4, 1.243134), (0.6, 1.578258)):
        o = opened_to(c)
        n = len(o.x)
        rows = [[k / (4 * pi) for k in o.stress[r]] + [-across([(1e-9, 1.0)], o.x[r])] for r in range(n)]
        g = solve(rows)
        # density -> g(c) / sqrt(c^2 - s^2): K = sqrt(pi c) E'/(4 c) |g|, in units of 2 P / (pi D t) sqrt(pi c)
        k = abs(sum(a * b for a, b in zip(o.root, g))) / (4 * c)
        print("K of a central crack, c/R %.1f: %.6f, Atkinson %.6f" % (c, k, told))
    # small zone in a large disc: the zone at the peak is 0.579 l_ch long (K. Uenishi, J. R. Rice, J. Geophys. Res. 108 (2003) 2042) to either side, whatever the field
    for length in (0.05, 0.1):
        p, c, _, _ = peak(even(0.08), length)
        print("l_ch / R %.2f: zone at the peak over l_ch %.3f (0.579 in an even field), load over that of the first opening %.5f" % (length, c / length, p * hondros(0.08, 0)))
    global POINTS
    a = peak(even(0.08), 0.5)
    kept, POINTS = POINTS, 72
    CRACKS.clear()
    b = peak(even(0.08), 0.5)
    POINTS = kept
    CRACKS.clear()
    print("48 and 72 points: %.6f, %.6f; openings grow: %s" % (a[0], b[0], a[3]))


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--table", action="store_true")
    options = parser.parse_args()
    if options.check:
        check()
    elif options.table:
        table()
    else:
        granite()
