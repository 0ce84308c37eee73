"""Two halves of a rod of uneven cells, joined by a weak plane, twisted apart: the plane slides from the rim inward, by a slide that is nowhere the
same. Its moment is compared with that of the smooth plane between elastic halves, found here by finite differences."""
import math
import sys
import tempfile

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


def solved(rows, right):
    """x of rows x = right, a list of columns each, by elimination."""
    n = len(rows)
    work = [list(row) + list(more) for row, more in zip(rows, right)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(work[k][i]))
        work[i], work[pivot] = work[pivot], work[i]
        one = work[i] = [value / work[i][i] for value in work[i]]
        for k in range(n):
            if k != i and work[k][i] != 0:
                part = work[k][i]
                work[k] = [value - part * other for value, other in zip(work[k], one)]
    return [row[n:] for row in work]


def compliance(n_r=25, n_z=20):
    """Of a half whose far end is held: radii [m], turns of its near end over the shear stress there [1/Pa], and the moment of a unit stress at a
    radius [m^3]. Turns phi(r, z) of least energy G pi sum of r^3 |grad phi|^2, layer by layer from the far end."""
    r, z = [RADIUS * i / n_r for i in range(n_r + 1)], [LENGTH * (j / n_z) ** 1.6 for j in range(n_z + 1)]
    edge = [0.0] + [(a + b) / 2 for a, b in zip(r, r[1:])] + [RADIUS]
    stiff = 2 * math.pi * SHEAR
    below = [[0.0] * (n_r + 1) for _ in r]  # what the layers beyond one add to its stiffness
    for j in range(n_z - 1, -1, -1):
        along = [stiff * (b**4 - a**4) / 4 / (z[j + 1] - z[j]) for a, b in zip(edge, edge[1:])]
        height = (z[j + 1] - (z[j - 1] if j > 0 else z[0])) / 2
        if j == n_z - 1:
            below = [[along[i] * (i == k) for k in range(n_r + 1)] for i in range(n_r + 1)]
        else:
            series = solved([[below[i][k] + along[i] * (i == k) for k in range(n_r + 1)] for i in range(n_r + 1)], below)
            below = [[along[i] * series[i][k] for k in range(n_r + 1)] for i in range(n_r + 1)]
        for i in range(n_r):
            spring = stiff * ((r[i] + r[i + 1]) / 2) ** 3 * height / (r[i + 1] - r[i])
            for a, b, sign in ((i, i, 1), (i + 1, i + 1, 1), (i, i + 1, -1), (i + 1, i, -1)):
                below[a][b] += sign * spring
    weight = [2 * math.pi * (b**3 - a**3) / 3 for a, b in zip(edge, edge[1:])]
    return r, solved(below, [[weight[k] * (i == k) for k in range(n_r + 1)] for i in range(n_r + 1)]), weight


def largest_moment(step=2.5e-5):
    """Of the smooth plane [N m]: the far ends turn on; where the stress has reached the strength it falls linearly with the slide 2 r phi."""
    r, gives, weight = compliance()
    soft = [2 * STRENGTH * a / (2 * ENERGY / STRENGTH) for a in r]
    sticks, most, turn, n = [True] * len(r), 0.0, 0.0, len(r)
    while turn < 3e-3:
        turn += step
        while True:
            rows = [gives[i] if sticks[i] else [(i == k) - soft[i] * gives[i][k] for k in range(n)] for i in range(n)]
            stress = [row[0] for row in solved(rows, [[turn if sticks[i] else STRENGTH - soft[i] * turn] for i in range(n)])]
            beyond = [sticks[i] and stress[i] > STRENGTH for i in range(n)]
            if not any(beyond):
                break
            sticks = [sticks[i] and not beyond[i] for i in range(n)]
        if any(not sticks[i] and sum(g * s for g, s in zip(gives[i], stress)) > turn + 1e-12 for i in range(n)):
            break  # past the largest one it snaps
        most = max(most, sum(s * w for s, w in zip(stress, weight)))
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
