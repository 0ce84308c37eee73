#!/usr/bin/env python3
"""References of the notched beam of the case `platens` (beam.yaml): load and deflection while a crack runs up the middle of a beam on three rollers, opening against a cohesion that falls linearly
(plane stress, no weight), by plane finite elements of half the beam: four-node elements with their two modes of bending (E. L. Wilson and others 1973, R. L. Taylor and others 1976), the ligament's
stiffness condensed onto the openings of its nodes, and from node to node the load at which the next one reaches the strength. Rollers are points. Beside it the peak by weight functions
(../notched/cohesive.py), and linear elastic fracture mechanics, K of G. V. Guinea and others (there).

    cohesive_beam.py            peak load [N], deflection there [mm], opening of the mouth [mm], work until parted over G times the ligament, and the others' loads
    cohesive_beam.py --curve    deflection [mm], opening of the mouth [mm], load [N], tip of the opened stretch [mm]
    cohesive_beam.py --check    coarser elements (80: 1129.6 N, two minutes); K of a sharp crack by its energy, which opens node by node and is a quarter of an element short
Deflection: of the ligament's middle, (225, 75) mm, against the points at half height over the supports, so without what is pressed in at the rollers."""
import argparse
import os
import sys
from math import log, pi, sqrt

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, ".."))
sys.path.insert(0, os.path.join(HERE, "..", "notched"))
from gauss import solve  # noqa: E402 (beside the cases)
import cohesive  # noqa: E402

LENGTH, HEIGHT, THICK, SPAN, NOTCH = 0.45, 0.1, 0.05, 0.4, 0.05
YOUNG, NU, STRENGTH, ENERGY = 30e9, 0.2, 3e6, 100.0


def columns(fine):
    """x of the columns of nodes, from the middle: steps that grow to 8 times the first, one at the support."""
    xs, step = [0.0], fine
    while xs[-1] < SPAN / 2:
        xs.append(xs[-1] + step)
        step = min(step * 1.12, 8 * fine)
    xs = [x * (SPAN / 2) / xs[-1] for x in xs]
    n = max(2, int((LENGTH - SPAN) / 2 / (8 * fine)))
    return xs + [SPAN / 2 + (LENGTH - SPAN) / 2 * (k + 1) / n for k in range(n)]


def element(a, b):
    """Stiffness of a rectangle a by b (per thickness), nodes (0,0), (a,0), (a,b), (0,b), bending modes condensed."""
    d = YOUNG / (1 - NU * NU)
    law = ((d, d * NU, 0), (d * NU, d, 0), (0, 0, d * (1 - NU) / 2))
    full = [[0.0] * 12 for _ in range(12)]
    root = 1 / sqrt(3)
    for r in (-root, root):
        for s in (-root, root):
            rows = [[0.0] * 12 for _ in range(3)]
            gradients = [((-(1 - s)) / (2 * a), (-(1 - r)) / (2 * b)), ((1 - s) / (2 * a), (-(1 + r)) / (2 * b)), ((1 + s) / (2 * a), (1 + r) / (2 * b)), ((-(1 + s)) / (2 * a), (1 - r) / (2 * b)),
                         (-2 * r * 2 / a, 0.0), (0.0, -2 * s * 2 / b)]
            for k, (gx, gy) in enumerate(gradients):
                rows[0][2 * k], rows[1][2 * k + 1] = gx, gy
                rows[2][2 * k], rows[2][2 * k + 1] = gy, gx
            stress = [[sum(law[i][m] * rows[m][j] for m in range(3)) for j in range(12)] for i in range(3)]
            for i in range(12):
                for j in range(12):
                    full[i][j] += a * b / 4 * sum(rows[m][i] * stress[m][j] for m in range(3))
    for c in range(11, 7, -1):
        for i in range(c):
            f = full[i][c] / full[c][c]
            for j in range(c):
                full[i][j] -= f * full[c][j]
    return [row[:8] for row in full[:8]]


class Half:
    """Half of the beam with its ligament shut: what openings and the load do to the forces on the ligament and to the deflection."""

    def __init__(self, per_ligament, notch=NOTCH):
        self.dy = (HEIGHT - NOTCH) / per_ligament
        self.rows = int(round(HEIGHT / self.dy)) + 1
        self.first = int(round(notch / self.dy))  # node at the notch's tip
        xs = columns(self.dy)
        nodes = self.rows * len(xs)
        self.n, self.band = 2 * nodes, 2 * self.rows + 4
        lower = [[0.0] * (self.band + 1) for _ in range(self.n)]  # row i: columns i - band .. i
        kept = {}
        for c in range(len(xs) - 1):
            width = xs[c + 1] - xs[c]
            k = kept.setdefault(round(width, 12), element(width, self.dy))
            for r in range(self.rows - 1):
                at = [c * self.rows + r, (c + 1) * self.rows + r, (c + 1) * self.rows + r + 1, c * self.rows + r + 1]
                dofs = [2 * p + q for p in at for q in (0, 1)]
                for i, di in enumerate(dofs):
                    row = lower[di]
                    for j, dj in enumerate(dofs):
                        if dj <= di:
                            row[self.band + dj - di] += k[i][j]
        support = xs.index(min(xs, key=lambda x: abs(x - SPAN / 2)))
        self.ligament = [2 * r for r in range(self.first, self.rows)]  # x of the nodes at x = 0
        held = set(self.ligament) | {2 * support * self.rows + 1}
        self.held_rows = [self.full_row(lower, d) for d in self.ligament]
        for d in held:
            for j in range(max(0, d - self.band), d):
                lower[d][self.band + j - d] = 0.0
            for i in range(d + 1, min(self.n, d + self.band + 1)):
                lower[i][self.band + d - i] = 0.0
            lower[d][self.band] = 1.0
        self.held = held
        self.factor(lower)
        top = 2 * (self.rows - 1) + 1
        middle, over = 2 * ((self.rows - 1) * 3 // 4) + 1, 2 * (support * self.rows + (self.rows - 1) // 2) + 1
        solutions = []
        for row in self.held_rows:
            right = [0.0] * self.n
            d = self.ligament[len(solutions)]
            for j, v in row.items():
                if j not in held:
                    right[j] -= v
            right[d] = 1.0
            solutions.append(self.answer(right))
        loaded = [0.0] * self.n
        loaded[top] = -1 / (2 * THICK)  # half of a load of 1 N, per thickness
        solutions.append(self.answer(loaded))
        forces = [[sum(v * u[j] for j, v in row.items()) for row in self.held_rows] for u in solutions]
        self.stiff = [list(f) for f in zip(*forces[:-1])]  # force on node i (per thickness) by an opening of node j on this side
        self.pull = forces[-1]
        self.sink = [u[over] - u[middle] for u in solutions]
        self.mouth = [2 * u[0] for u in solutions]
        self.under = [-u[top] for u in solutions]
        share = [self.dy] * len(self.ligament)
        share[0] = share[-1] = self.dy / 2
        self.share = share

    def full_row(self, lower, d):
        row = {j: lower[d][self.band + j - d] for j in range(max(0, d - self.band), d + 1)}
        for i in range(d + 1, min(self.n, d + self.band + 1)):
            row[i] = lower[i][self.band + d - i]
        return {j: v for j, v in row.items() if v}

    def factor(self, lower):
        band = self.band
        for i in range(self.n):
            row = lower[i]
            start = max(0, i - band)
            for j in range(start, i + 1):
                other = lower[j]
                low = max(start, j - band)
                a, b = band + low - i, band + low - j
                value = row[band + j - i] - sum(map(float.__mul__, row[a : band + j - i], other[b:band]))
                if j < i:
                    row[band + j - i] = value / other[band]
                else:
                    row[band] = sqrt(value)
        self.lower = lower

    def answer(self, right):
        band, lower, x = self.band, self.lower, list(right)
        for i in range(self.n):
            start = max(0, i - band)
            x[i] = (x[i] - sum(map(float.__mul__, lower[i][band + start - i : band], x[start:i]))) / lower[i][band]
        for i in range(self.n - 1, -1, -1):
            x[i] /= lower[i][band]
            v, start = x[i], max(0, i - band)
            if v:
                x[start:i] = [p - v * q for p, q in zip(x[start:i], lower[i][band + start - i : band])]
        return x

    def curve(self, strength=STRENGTH, energy=ENERGY):
        """A row a node that is about to open: load, deflection, mouth, height of the tip. u: half the opening; stiff u + P pull = -(force of the cohesion on the node)."""
        whole = energy / strength  # half of w_c
        out = []
        for m in range(1, len(self.ligament)):
            free = [False] * m
            for _ in range(40):
                rows = []
                for i in range(m + 1):
                    row = [-v for v in self.stiff[i][:m]] + [-self.pull[i]]
                    if i < m and not free[i]:
                        row[i] += self.share[i] * strength / whole
                    rows.append(row + [0.0 if i < m and free[i] else self.share[i] * strength])
                answer = solve(rows)
                now = [u >= whole for u in answer[:m]]
                if now == free:
                    break
                free = now
            u, p = answer[:m], answer[m]
            out.append((p, p * self.sink[-1] + sum(map(float.__mul__, u, self.sink)), p * self.mouth[-1] + sum(map(float.__mul__, u, self.mouth)), (self.first + m) * self.dy))
        return out

    def free_compliance(self, m):
        """Deflection under the load itself per newton with the first m nodes open and nothing that holds them."""
        rows = [[-v for v in self.stiff[i][:m]] + [self.pull[i]] for i in range(m)]
        u = solve(rows) if m else []
        return self.under[-1] + sum(map(float.__mul__, u, self.under))


def work_of(curve):
    """Up to the last load above zero, falling as a power of the deflection between rows, and from there on as the inverse square, as halves that hang on a hinge do: what it comes to and the share of that end."""
    total, p0, d0 = 0.0, 0.0, 0.0
    for p, d, _, _ in curve:
        if p <= 0:
            break
        if p0 > p:
            n = log(p0 / p) / log(d / d0)
            total += (p * d - p0 * d0) / (1 - n) if abs(n - 1) > 1e-9 else p * d * log(d / d0)
        else:
            total += (p + p0) / 2 * (d - d0)
        p0, d0 = p, d
    return total + p0 * d0, p0 * d0


def brittle():
    """Peak by linear elastic fracture mechanics."""
    return sqrt(YOUNG * ENERGY) / (cohesive.three_points(NOTCH / HEIGHT, SPAN / HEIGHT) * sqrt(pi * NOTCH)) * 2 * THICK * HEIGHT**2 / (3 * SPAN)


def by_weights(nodes=20, step=0.01):
    """The same cohesive crack by weight functions, which are good while its end is well inside the beam."""
    best = (0.0, 0.0)
    for k in range(1, int(0.9 / step)):
        zone = step * k * (HEIGHT - NOTCH)
        load = cohesive.load_of(lambda c: cohesive.three_points(c, SPAN / HEIGHT), NOTCH, HEIGHT, zone, YOUNG, STRENGTH, ENERGY)
        if load < best[0]:
            break
        best = (load, zone)
    return best[0] * 2 * THICK * HEIGHT**2 / (3 * SPAN), best[1]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--curve", action="store_true")
    parser.add_argument("--nodes", type=int, default=40)
    options = parser.parse_args()
    half = Half(options.nodes)
    curve = half.curve()
    if options.curve:
        for p, d, mouth, tip in curve:
            print("%.6f %.6f %.3f %.3f" % (d * 1e3, mouth * 1e3, p, tip * 1e3))
        return
    best = max(curve)
    total, end = work_of(curve)
    load, zone = by_weights()
    print("peak %.1f N at %.4f mm, mouth %.4f mm, opened to %.1f mm; work until parted %.4f of G times the ligament (%.4f of it an assumed end)" % (best[0], best[1] * 1e3, best[2] * 1e3, best[3] * 1e3, total / (ENERGY * THICK * (HEIGHT - NOTCH)), end / (ENERGY * THICK * (HEIGHT - NOTCH))))
    print("by weight functions %.1f N, opened to %.1f mm; linear elastic fracture mechanics %.1f N; stiffness %.1f N/mm" % (load, (NOTCH + zone) * 1e3, brittle(), 1e-3 * curve[0][0] / curve[0][1]))
    if options.check:
        for nodes in (10, 20):
            print("%d elements in the ligament: peak %.1f N" % (nodes, max(Half(nodes).curve())[0]))
        print("K by the change of compliance, over the handbook's:", ", ".join("%.4f" % r for r in stress_intensity(half)))


def stress_intensity(half, over=4):
    """K by half the change of the load's compliance over the area that `over` more open nodes add, over the handbook's in the middle of it; at 0.55 and 0.65 of the height."""
    out = []
    for c in (0.55, 0.65):
        m = int(round((c * HEIGHT - NOTCH) / half.dy)) - over // 2
        rate = (half.free_compliance(m + over) - half.free_compliance(m)) / (over * half.dy * THICK)
        a = NOTCH + (m + over / 2) * half.dy
        told = cohesive.three_points(a / HEIGHT, SPAN / HEIGHT) * sqrt(pi * a) * 3 * SPAN / (2 * THICK * HEIGHT**2)
        out.append(sqrt(YOUNG * rate / 2) / told)
    return out


if __name__ == "__main__":
    main()
