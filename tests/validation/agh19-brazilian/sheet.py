#!/usr/bin/env python3
"""The disc as the solid sheet it is: 3D elastic stresses by finite elements, beside those of plane stress (disc.py). Needs Debian's python3-numpy; no test does.

    sheet.py [HALF_WIDTH] [--nu NU] [--step MM] [--fine N]     half width of smooth jaws that move as one [mm]; without it an even pressure on arcs of 20 degrees

An eighth of the disc (mirror planes x = 0, z = 0 and the middle of the sheet, y = 0) in bricks of eight nodes along radius, angle and thickness, finest (MM, by default 0.4) where the loaded
arc ends; every edge is cut into N. What lies within a fifth of the radius is replaced by tractions of plane stress. Conjugate gradients, residual 1e-7. Stresses are those in the middle of bricks, over 2 P / (pi D t).
Printed: the tension across the thickness (yy) on the rim beside the loaded arc and its largest value, with the load at which that is the strength; and the stress across the loaded diameter (xx) in the middle and at the faces of the sheet."""
import argparse
from math import asin, pi, radians

import numpy as np

import disc

R, HALF = disc.RADIUS, disc.THICKNESS / 2
CORNERS = np.array([(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)])


def exact(loads, x, z):
    """xx, zz, xz of plane stress at points (x, z) over the radius under line loads (disc.py)."""
    out = np.zeros((len(x), 3))
    for p, turn, share in loads:
        for up in (1, -1):
            dx, dz = x - np.sin(p), z - up * np.cos(p)
            force = -np.sin(turn), -up * np.cos(turn)
            radial = -2 * share * (force[0] * dx + force[1] * dz) / (dx * dx + dz * dz) ** 2
            out += np.stack([radial * dx * dx, radial * dz * dz, radial * dx * dz], axis=1)
        out[:, :2] += share * np.cos(p - turn)
    return out


def graded(length, first, growth=1.2, largest=np.inf):
    """Points from 0 to length, the first step about `first`, the others growing."""
    steps = [first]
    while sum(steps) < length:
        steps.append(min(steps[-1] * growth, largest))
    return np.concatenate([[0], np.cumsum(steps)]) * length / sum(steps)


def refined(points, n):
    return np.interp(np.linspace(0, len(points) - 1, n * (len(points) - 1) + 1), np.arange(len(points)), points)


class Sheet:
    def __init__(self, edge, nu, step, fine):
        inner = 0.2 * R
        radius = R - graded(R - inner, step, 1.2, 0.008)[::-1]
        angle = np.concatenate([edge - graded(edge, step / R)[::-1], edge + graded(pi / 2 - edge, step / R, 1.2, 0.08)[1:]])
        height = HALF - graded(HALF, min(step * 2, HALF / 8))[::-1]
        axes = [refined(a, fine) for a in (radius, angle, height)]
        self.shape = tuple(len(a) for a in axes)
        r, p, y = np.meshgrid(*axes, indexing="ij")
        self.radius, self.angle, self.height = r.ravel(), p.ravel(), y.ravel()
        self.at = np.stack([r * np.sin(p), y, r * np.cos(p)], axis=-1).reshape(-1, 3)
        ids = np.arange(r.size).reshape(self.shape)
        n = [s - 1 for s in self.shape]
        self.brick = np.stack([ids[i:i + n[0], j:j + n[1], k:k + n[2]].ravel() for i, j, k in CORNERS], axis=1)
        self.inner, self.rim = ids[0], ids[-1]
        self.middle = self.at[self.brick].mean(axis=1)
        lam, mu = nu / ((1 + nu) * (1 - 2 * nu)), 1 / (2 * (1 + nu))  # Young's modulus 1: stresses do not ask for it
        self.law = np.diag([2 * mu] * 3 + [mu] * 3)
        self.law[:3, :3] += lam
        gauss = [(np.array(c) * 2 - 1) / 3**0.5 for c in CORNERS]
        self.stiffness = 0
        for g in gauss:
            b, volume = self.strain(g)
            self.stiffness = self.stiffness + np.einsum("eai,ab,ebj->eij", b, self.law, b * volume[:, None, None], optimize=True)

    def strain(self, g):
        """Strain (xx yy zz yz xz xy, the last three twice) by displacements of a brick at g in [-1, 1]^3, and the volume that g stands for."""
        sign = CORNERS * 2 - 1
        factors = 1 + sign * g
        local = np.stack([sign[:, c] * np.prod(np.delete(factors, c, axis=1), axis=1) / 8 for c in range(3)], axis=1)
        jacobian = np.einsum("ac,eax->exc", local, self.at[self.brick])
        slope = np.einsum("ac,ecx->eax", local, np.linalg.inv(jacobian))
        b = np.zeros((len(self.brick), 6, 8, 3))
        for c in range(3):
            b[:, c, :, c] = slope[:, :, c]
        for row, (c, d) in enumerate(((1, 2), (0, 2), (0, 1))):
            b[:, 3 + row, :, c], b[:, 3 + row, :, d] = slope[:, :, d], slope[:, :, c]
        return b.reshape(len(self.brick), 6, 24), np.abs(np.linalg.det(jacobian))

    def faces(self, nodes):
        """Four nodes, and shape functions with area vectors at 2 x 2 points, of every face of a layer [angle, height]; areas point from nodes of small radius outwards."""
        quad = np.stack([nodes[:-1, :-1].ravel(), nodes[:-1, 1:].ravel(), nodes[1:, :-1].ravel(), nodes[1:, 1:].ravel()], axis=1)
        at, parts = self.at[quad], []
        for s in (0.5 - 0.75**0.5 / 3, 0.5 + 0.75**0.5 / 3):
            for t in (0.5 - 0.75**0.5 / 3, 0.5 + 0.75**0.5 / 3):
                shape = np.array([(1 - s) * (1 - t), (1 - s) * t, s * (1 - t), s * t])
                along = (at[:, 2] - at[:, 0]) * (1 - t) + (at[:, 3] - at[:, 1]) * t
                up = (at[:, 1] - at[:, 0]) * (1 - s) + (at[:, 3] - at[:, 2]) * s
                parts.append((shape, np.cross(along, up) / 4, np.einsum("a,eax->ex", shape, at)))
        return quad, parts

    def forces(self, loads, edge, pressed):
        """Of the tractions at the inner cut, and of an even pressure; 2 P / (pi D t) is 1."""
        force = np.zeros((len(self.at), 3))
        quad, parts = self.faces(self.inner)
        for shape, area, middle in parts:
            xx, zz, xz = exact(loads, middle[:, 0] / R, middle[:, 2] / R).T
            pull = -np.stack([xx * area[:, 0] + xz * area[:, 2], 0 * xx, xz * area[:, 0] + zz * area[:, 2]], axis=1)
            for a in range(4):
                np.add.at(force, quad[:, a], shape[a] * pull)
        if pressed:
            quad, parts = self.faces(self.rim)
            on = self.angle[quad].max(axis=1) < edge * (1 + 1e-9)
            for shape, area, _ in parts:
                for a in range(4):
                    np.add.at(force, quad[on, a], -pi / (2 * np.sin(edge)) * shape[a] * area[on])
        return force

    def solve(self, loads, edge, pressed):
        """Stress of every brick, xx yy zz yz xz xy; pressed: an even pressure, else smooth jaws that move as one."""
        force = self.forces(loads, edge, pressed)
        number = np.arange(force.size).reshape(-1, 3)
        if not pressed:
            under = self.rim[self.angle[self.rim] < edge * (1 + 1e-9)]
            number[under, 2] = number[under[0], 2]
            force[under[0], 2] -= pi * R * HALF / 2  # half of the arc, half of the sheet
        free = np.zeros(number.size, bool)
        free[number] = True
        for c, held in ((0, self.angle < 1e-9), (1, self.height < 1e-12), (2, self.angle > pi / 2 - 1e-9)):
            free[number[held, c]] = False
        dofs = number[self.brick].reshape(-1, 24)

        def add(v):
            return np.bincount(dofs.ravel(), v.ravel(), number.size) * free

        diagonal = add(np.einsum("eii->ei", self.stiffness))
        inverse = np.divide(1, diagonal, out=np.zeros_like(diagonal), where=diagonal > 0)
        u, r = np.zeros(number.size), np.bincount(number.ravel(), force.ravel(), number.size) * free
        d = z = inverse * r
        start = rz = r @ z
        while rz > 1e-14 * start:
            q = add(np.matmul(self.stiffness, d[dofs][:, :, None]))
            length = rz / (d @ q)
            u, r = u + length * d, r - length * q
            z = inverse * r
            rz, before = r @ z, rz
            d = z + rz / before * d
        b, self.volume = self.strain(np.zeros(3))
        return np.einsum("ab,ebi,ei->ea", self.law, b, u[dofs], optimize=True)


def beside(sheet, stress, edge):
    """The tension across the thickness beside the loaded arc."""
    x, y, z = sheet.middle.T
    depth, past, yy = 1000 * (R - np.hypot(x, z)), 1000 * R * (np.arctan2(x, z) - edge), stress[:, 1]
    at_rim = (depth < depth.min() + 0.01) & (y < y.min() + 1e-9)
    print("beyond the arc [mm]  yy on the rim, in the middle of the sheet")
    for distance in (0.5, 1, 2, 3, 4, 6):
        print("%19.1f  %6.3f" % (distance, np.interp(distance, past[at_rim], yy[at_rim])))
    k = np.argmax(yy)
    print("largest: %.3f, %.2f mm beyond the arc, %.2f mm deep, %.1f mm from the middle of the sheet: the strength at %.1f kN" % (yy[k], past[k], depth[k], 1000 * y[k], disc.load(yy[k])))


def diameter(sheet, stress, loads):
    x, y, z = sheet.middle.T
    near = np.arctan2(x, z) < np.arctan2(x, z).min() * (1 + 1e-6)
    depth = 1000 * (R - np.hypot(x, z))
    print("depth [mm]  xx in the middle  at the face  plane stress  along (zz)")
    for wanted in (10, 12, 14, 16, 18, 20, 22, 25, 30, 40, 60):
        found = []
        for layer in (y.min(), y.max()):
            line = near & (np.abs(y - layer) < 1e-9)
            found.append(np.interp(wanted, depth[line][::-1], (stress[line, 0] - exact(loads, x[line] / R, z[line] / R)[:, 0])[::-1]))
        plane = exact(loads, np.zeros(1), np.array([1 - wanted / (1000 * R)]))[0]
        print("%10d  %16.3f  %11.3f  %12.3f  %10.2f" % (wanted, plane[0] + found[0], plane[0] + found[1], plane[0], plane[1]))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("half_width", type=float, nargs="?")
    parser.add_argument("--nu", type=float, default=disc.NU)
    parser.add_argument("--step", type=float, default=0.4)
    parser.add_argument("--fine", type=int, default=1)
    asked = parser.parse_args()
    pressed = asked.half_width is None
    edge = radians(10) if pressed else asin(asked.half_width / 1000 / R)
    loads = disc.even(edge) if pressed else disc.jaws(edge)
    sheet = Sheet(edge, asked.nu, asked.step / 1000, asked.fine)
    stress = sheet.solve(loads, edge, pressed)
    print("%d bricks" % len(sheet.brick))
    beside(sheet, stress, edge)
    diameter(sheet, stress, loads)


if __name__ == "__main__":
    main()
