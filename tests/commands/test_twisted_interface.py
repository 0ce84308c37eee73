"""Two halves of a rod of uneven cells, joined by a weak plane, twisted apart: the plane slides from the rim inward, by a slide that is nowhere the
same. Its moment is compared with that of the smooth plane between elastic halves, found here by finite differences."""
import math
import sys
import tempfile

import numpy as np

from histories import run

RADIUS, LENGTH, SHEAR, STRENGTH, ENERGY = 5e-3, 10e-3, 70e9 / 2.4, 20e6, 100.0  # of a half: m, m, Pa, Pa, J/m^2
SCENE = """materials:
  left: {E: 70 GPa, nu: 0.2, density: 2500 kg/m^3, strength: {tension: 300 MPa, fracture_energy: 5 kJ/m^2}}
  right: {E: 70 GPa, nu: 0.2, density: 2500 kg/m^3, strength: {tension: 300 MPa, fracture_energy: 5 kJ/m^2}}
fracture: {friction: 0}
interactions: {interfaces: [{materials: {first: left, second: right, tension: 20 MPa, fracture_energy: 100 J/m^2}}]}
bodies:
  - shape: {cylinder: {axis: x, origin: [-10 mm, 0, 0], length: 20 mm, radius: 5 mm}}
    fill: {noisy_grid: {elements: 1500, spread: 60 %, seed: 2}}
    material: left
    regions: [{material: right, where: {half_space: {point: [0, 0, 0], normal: [-1, 0, 0]}}}]
stages:
  - name: twist
    solver: {dynamic: {duration: 0.9 ms, mass_damping: 3000 1/s}}
    loads:
      - face_velocity: {set: x-, gradient: {y: [0, 0, 4 1/s], z: [0, -4 1/s, 0]}, table: [[0, 0], [0.2 ms, 1]]}
      - face_velocity: {set: x+, gradient: {y: [0, 0, -4 1/s], z: [0, 4 1/s, 0]}, table: [[0, 0], [0.2 ms, 1]]}
sensors:
  moment: {moment: {set: x+, component: x, point: [10 mm, 0, 0]}}
  spent: {energy: fracture}
"""
FAILURES = []


def expect(condition, sentence):
    if not condition:
        FAILURES.append(sentence)


def compliance(n_r=30, n_z=36):
    """Of a half whose far end is held: radii [m], turns of its near end over the shear stress there [1/Pa], and the moment of a unit stress at a
    radius [m^3]. Turns phi(r, z) of least energy G pi sum of r^3 |grad phi|^2."""
    r, z = np.linspace(0, RADIUS, n_r + 1), LENGTH * np.linspace(0, 1, n_z + 1) ** 1.6
    edge = np.concatenate([[0], (r[1:] + r[:-1]) / 2, [RADIUS]])
    cube, square = np.diff(edge**4) / 4, np.diff(edge**3) / 3
    height = np.concatenate([[0], (z[1:] + z[:-1]) / 2, [LENGTH]])
    k = np.zeros(((n_r + 1) * (n_z + 1),) * 2)

    def join(a, b, spring):
        k[a, a] += spring
        k[b, b] += spring
        k[a, b] -= spring
        k[b, a] -= spring

    for i in range(n_r + 1):
        for j in range(n_z + 1):
            here = i * (n_z + 1) + j
            if j < n_z:
                join(here, here + 1, 2 * math.pi * SHEAR * cube[i] / (z[j + 1] - z[j]))
            if i < n_r:
                join(here, here + n_z + 1, 2 * math.pi * SHEAR * ((r[i] + r[i + 1]) / 2) ** 3 * (height[j + 1] - height[j]) / (r[i + 1] - r[i]))
    free = np.array([i * (n_z + 1) + j for i in range(n_r + 1) for j in range(n_z)])
    near = np.arange(n_r + 1) * n_z
    weight = 2 * math.pi * square
    return r, np.linalg.inv(k[np.ix_(free, free)])[np.ix_(near, near)] * weight, weight


def largest_moment():
    """Of the smooth plane [N m]: the far ends turn on; where the stress has reached the strength it falls linearly with the slide 2 r phi."""
    r, gives, weight = compliance()
    soft = 2 * STRENGTH * r / (2 * ENERGY / STRENGTH)
    sticks, most = np.ones(len(r), bool), 0.0
    for turn in np.linspace(1e-5, 3e-3, 600):
        for _ in range(len(r)):
            rows = np.where(sticks[:, None], gives, np.eye(len(r)) - soft[:, None] * gives)
            stress = np.linalg.solve(rows, np.where(sticks, turn, STRENGTH - soft * turn))
            beyond = sticks & (stress > STRENGTH)
            if not beyond.any():
                break
            sticks &= ~beyond
        if (turn - gives @ stress)[~sticks].min(initial=0) < -1e-12:
            break  # past the largest one it snaps
        most = max(most, float(stress @ weight))
    return most


def main():
    """The moment within 4 %, as four cells lie along a radius; the energy within 10 % of G_c times the section, as in a straight slide. Before
    faces across the way of a slide gave way in time the moment was 5 % too large, of 6000 cells 15 %."""
    exact, section = largest_moment(), math.pi * RADIUS**2
    expect(0.5 * section * RADIUS * STRENGTH < exact < 2 / 3 * section * RADIUS * STRENGTH, f"between first yield and all of it: {exact:.3f} N m")
    with tempfile.TemporaryDirectory() as folder:
        value, _ = run(folder, "rod", SCENE)
    most, spent = max(value["moment"]), value["spent"][-1]
    print(f"{most:.3f} N m at most, {exact:.3f} of a smooth plane; {1e3 * spent:.3f} mJ of {1e3 * ENERGY * section:.3f}")
    expect(abs(most / exact - 1) < 0.04, f"{exact:.3f} N m, not {most:.3f}")
    expect(0.9 < spent / (ENERGY * section) < 1.1, f"{1e3 * ENERGY * section:.3f} mJ, not {1e3 * spent:.3f}")
    last = value["moment"][-len(value["moment"]) // 5:]
    expect(abs(sum(last) / len(last)) < 0.15 * exact, f"little left, not {sum(last) / len(last):.3f} N m")
    for failure in FAILURES:
        print("FAILED:", failure)
    sys.exit(1 if FAILURES else 0)


if __name__ == "__main__":
    main()
