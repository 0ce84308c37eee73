"""Weak planes between spheres, pulled, twisted and slid: beams of an interface bear its strength and cost its energy however they stand to it, and
the sides of a broken one slide on each other by their friction."""
import math
import sys
import tempfile

import test_twisted_interface as twisted
from histories import run

FAILURES = []

# A plane of 1 cm^2 that bears 20 MPa, 2000 N, and costs 100 J/m^2, 10 mJ.
PULL = """materials:
  stone: {{E: 70 GPa, nu: 0.2, density: 2500 kg/m^3, strength: {{tension: 200 MPa{tough}}}}}
  twin: {{E: 70 GPa, nu: 0.2, density: 2500 kg/m^3, strength: {{tension: 200 MPa{tough}}}}}
model: cbm
fracture: {{friction: {friction}}}
interactions: {{interfaces: [{{materials: {{first: stone, second: twin, tension: 20 MPa{cohesion}}}}}]}}
bodies:
  - shape: {{box: {{size: [10 mm, 10 mm, 10 mm]}}}}
    fill: {{packing: {{elements: 2000, seed: 1}}}}
    beams: 8
    material: stone
    regions: [{{where: {{half_space: {{point: [5 mm, 0, 0], normal: [1, 0, 0]}}}}, material: twin}}]
stages:
  - name: pull
    solver: {{dynamic: {{duration: 400 us, mass_damping: 30000 1/s}}}}
    loads:
      - element_velocity: {{set: x-_layer, x: {press} mm/s, y: 0, z: 0, table: [[0, 1], [60 us, 1], [80 us, 0]]}}
      - element_velocity: {{set: x+_layer, x: {pull} mm/s, y: {slide} mm/s, z: 0, table: [[0, 0], [20 us, 1]]}}
sensors:
  force: {{reaction: {{set: x+_layer, component: x}}}}
  shear: {{reaction: {{set: x+_layer, component: y}}}}
  spent: {{energy: fracture}}
  rubbed: {{energy: friction}}
"""
BRITTLE = {"tough": "", "cohesion": "", "friction": 0, "press": 0, "pull": 40, "slide": 0}
TOUGH = BRITTLE | {"tough": ", fracture_energy: 5 kJ/m^2", "cohesion": ", fracture_energy: 100 J/m^2"}
# The rod of test_twisted_interface, of spheres.
TWIST = (twisted.SCENE.replace("fracture: {", "model: cbm\nfracture: {").replace("{noisy_grid: {elements: 1500, spread: 60 %, seed: 2}}", "{packing: {elements: 6000, seed: 1}}\n    beams: 8")
         .replace("face_velocity: {set: x-,", "element_velocity: {set: x-_layer, x: 0,").replace("face_velocity: {set: x+,", "element_velocity: {set: x+_layer,").replace("moment: {set: x+,", "moment: {set: x+_layer,"))


def expect(condition, sentence):
    if not condition:
        FAILURES.append(sentence)


def pulled_apart(folder):
    """The force within 5 % of strength times area, as the beams across one plane of 2000 spheres have its area within some 4 %; the energy within
    6 %. Judged by the |cos| of a beam, where an element's weakest place decides, the plane bore 1.38 of its strength. Brittle beams go by the limit
    of solids, which few elements along a plane reach a little late: within 8 % (1.17 before)."""
    value, _ = run(folder, "tough", PULL.format(**TOUGH))
    most, spent = max(value["force"]), value["spent"][-1]
    print(f"pulled: {most:.0f} N at most, {1e3 * spent:.3f} mJ")
    expect(abs(most / 2000 - 1) < 0.05, f"2000 N, not {most:.0f}")
    expect(abs(spent / 10e-3 - 1) < 0.06, f"10 mJ, not {1e3 * spent:.3f}")
    expect(abs(value["force"][-1]) < 40, f"parted, not {value['force'][-1]:.1f} N")
    value, _ = run(folder, "brittle", PULL.format(**BRITTLE))
    most = max(value["force"])
    print(f"brittle: {most:.0f} N at most")
    expect(abs(most / 2000 - 1) < 0.08, f"2000 N, not {most:.0f}")
    expect(abs(value["force"][-1]) < 40, f"parted, not {value['force'][-1]:.1f} N")


def slid(folder):
    """Sides kept at their distance: cells with a fracture energy bear 1668 N there, which is what the stress along the plane does to it when all of
    it has the strength as its largest principal value; within 6 %, 8 spheres along the plane. It held 3226 N and rose: broken beams leaned on each
    other along their axes, and the last whole ones turned the stress of their elements along themselves. Then with some 1000 N across the plane: what
    the sides bear as they slide is their friction times the push, beside a few percent since normals of a plane of spheres are askew by some 4
    degrees."""
    value, _ = run(folder, "free", PULL.format(**BRITTLE | {"pull": 0, "slide": 40}))
    most, left = max(value["shear"]), sum(value["shear"][-20:]) / 20
    print(f"slid: {most:.0f} N at most, {left:.0f} left")
    expect(abs(most / 1668 - 1) < 0.06, f"1668 N, not {most:.0f}")
    expect(abs(left) < 0.05 * most, f"slid free, not {left:.1f} N")
    share = {}
    for friction in (0, 0.6):
        value, _ = run(folder, f"pressed-{friction}", PULL.format(**BRITTLE | {"friction": friction, "press": 18, "pull": 0, "slide": 80}))
        n = len(value["shear"]) // 4
        push, shear = -sum(value["force"][-n:]) / n, sum(value["shear"][-n:]) / n
        share[friction] = shear / push
        print(f"friction {friction}: pushed by {push:.0f} N, slides at {shear:.0f} N, {share[friction]:.3f}; friction took {1e3 * value['rubbed'][-1]:.3f} mJ")
        expect(push > 600, f"pressed, not {push:.0f} N")
    expect(abs(share[0]) < 0.1, f"free of friction, not {share[0]:.3f}")
    expect(abs(share[0.6] - share[0] - 0.6) < 0.05, f"0.6 of the push, not {share[0.6] - share[0]:.3f}")
    expect(value["rubbed"][-1] > 0, "friction takes energy")


def twisted_apart(folder):
    """The moment within 6 % of a smooth plane between elastic halves; eight spheres lie along a radius. It was 13 % too large, and 20 %
    with 20 000 spheres. The energy within 10 % of G_c times the section, as of cells."""
    exact, section = twisted.largest_moment(), math.pi * twisted.RADIUS**2
    value, _ = run(folder, "rod", TWIST)
    most, spent = max(value["moment"]), value["spent"][-1]
    print(f"twisted: {most:.3f} N m at most, {exact:.3f} of a smooth plane; {1e3 * spent:.3f} mJ of {1e3 * twisted.ENERGY * section:.3f}")
    expect(abs(most / exact - 1) < 0.06, f"{exact:.3f} N m, not {most:.3f}")
    expect(0.9 < spent / (twisted.ENERGY * section) < 1.1, f"{1e3 * twisted.ENERGY * section:.3f} mJ, not {1e3 * spent:.3f}")


def main():
    with tempfile.TemporaryDirectory() as folder:
        pulled_apart(folder)
        slid(folder)
        twisted_apart(folder)
    for failure in FAILURES:
        print("FAILED:", failure)
    sys.exit(1 if FAILURES else 0)


if __name__ == "__main__":
    main()
