#!/usr/bin/env python3
"""References of the case `agh19-brazilian`: stresses on the loaded diameter of a disc (plane stress) under a line load, under an even pressure on two arcs and under two smooth jaws
that move as one, and the loads at which the tension at the centre reaches the strength.

Line loads on the rim that are in equilibrium, in any directions: each leaves a simple radial field sigma_r = -2 F cos(theta) / (pi t r) (Flamant), and together they need the even
stress -sum(n.F) / (pi D t) for a rim without load (J. H. Michell, Proc. London Math. Soc. 32 (1900) 35; S. P. Timoshenko, J. N. Goodier, Theory of Elasticity, the disc under two forces).
With the displacement along the force, -F (2 ln r + (1 + nu) sin^2 theta) / (pi E t), jaws that give all of |phi| < a the same motion along z, and no force across it, press with the q(phi) of
    int q(phi) K(phi, phi_0) dphi = 1,   K = -2 ln|sin((phi - phi_0)/2)| + 2 ln cos((phi + phi_0)/2) - (1 + nu) [cos^2((phi + phi_0)/2) - sin^2((phi - phi_0)/2)] - (1 - nu) cos phi cos phi_0
and q sqrt(a^2 - phi^2) is a short sum of even Chebyshev polynomials, of which int T_n(s) ln|s - s_0| / sqrt(1 - s^2) ds = -pi T_n(s_0) / n (n = 0: -pi ln 2).
Stresses are over 2 P / (pi D t), tension positive. Prints what test_agh19_brazilian.sh looks for in case.yaml: loads of a line,
an even arc, jaws over the arc, over 10 degrees and over 10 mm, and the means over the stretches of the diameter for the jaws over the arc."""
import os
import sys
from math import acos, asin, atan2, cos, log, pi, radians, sin

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from gauss import solve  # noqa: E402 (beside the cases)

NU, RADIUS, THICKNESS, STRENGTH = 0.2, 0.1, 0.02, 10e6
TERMS, POINTS = 8, 64
STRETCHES, INSIDE = 25, 0.7  # of the rows of `with: hondros`


def smooth_part(p, p0):
    """The kernel without -2 ln|p - p0|."""
    d, s = (p - p0) / 2, (p + p0) / 2
    chord = sin(d) / d / 2 if d else 0.5
    return -2 * log(chord) + 2 * log(cos(s)) - (1 + NU) * (cos(s) ** 2 - sin(d) ** 2) - (1 - NU) * cos(p) * cos(p0)


def jaws(a):
    """Line loads (angle, direction of the force from the inward -z, share of P) of jaws that reach a to either side."""
    nodes = [a * cos((2 * j + 1) * pi / (2 * POINTS)) for j in range(POINTS)]
    rows = []
    for i in range(TERMS):
        s0 = cos((2 * i + 1) * pi / (4 * TERMS))
        row = []
        for n in range(0, 2 * TERMS, 2):
            singular = log(2 / a) if n == 0 else cos(n * acos(s0)) / n
            row.append(2 * pi * singular + sum(cos(n * acos(p / a)) * smooth_part(p, a * s0) for p in nodes) * pi / POINTS)
        rows.append(row + [1.0])
    terms = solve(rows)
    shares = [sum(c * cos(2 * n * acos(p / a)) for n, c in enumerate(terms)) for p in nodes]
    return [(p, 0.0, g / sum(shares)) for p, g in zip(nodes, shares)]


def even(a):
    """Those of an even pressure, which pushes towards the centre; P is the sum along z."""
    nodes = [a * (2 * (j + 0.5) / 2000 - 1) for j in range(2000)]
    total = sum(cos(p) for p in nodes)
    return [(p, p, 1 / total) for p in nodes]


def stress(loads, rho):
    """Across and along the diameter at rho."""
    out = [0.0, 0.0]
    for p, turn, share in loads:
        f = (-sin(turn), -cos(turn))  # of the upper one; the lower one is its mirror image
        for up in (1, -1):
            x, z = -sin(p), rho - up * cos(p)
            square = x * x + z * z
            radial = -2 * share * (f[0] * x + up * f[1] * z) / square
            out[0] += radial * x * x / square
            out[1] += radial * z * z / square
        evenly = share * -(f[0] * sin(p) + f[1] * cos(p))
        out = [v + evenly for v in out]
    return out


def hondros(a, rho):
    s, gap = rho * rho, 1 - rho * rho
    radial, angle = gap * sin(2 * a) / (1 - 2 * s * cos(2 * a) + s * s), atan2((1 + s) * sin(a), gap * cos(a))
    return [(radial - angle) / sin(a), -(radial + angle) / sin(a)]


def stretch(loads, k, points=16):
    """Mean over one of the equal stretches of the diameter that `with: hondros` averages elements over."""
    values = [stress(loads, -1 + 2 * (k + (i + 0.5) / points) / STRETCHES) for i in range(points)]
    return [sum(v[c] for v in values) / points for c in range(2)]


def load(centre):
    """[kN] at which the tension at the centre is the strength."""
    return pi * RADIUS * THICKNESS * STRENGTH / centre / 1000


if __name__ == "__main__":
    arc = radians(10)
    assert all(abs(p - q) < 1e-6 for rho in (0, 0.4, 0.7) for p, q in zip(stress(even(arc), rho), hondros(arc, rho)))
    for centre in (1, hondros(arc, 0)[0], stress(jaws(arc), 0)[0], stress(jaws(radians(5)), 0)[0], stress(jaws(asin(0.05)), 0)[0]):
        print("reference: %.3f kN" % load(centre))
    pressed = jaws(arc)
    for k in range(STRETCHES):
        if max(abs(2 * k / STRETCHES - 1), abs(2 * (k + 1) / STRETCHES - 1)) <= INSIDE:
            for name, value in zip(("across", "along"), stretch(pressed, k)):
                print("%s_%02d: {reference: %.4f," % (name, k, value))
