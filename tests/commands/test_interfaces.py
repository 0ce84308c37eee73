"""Halves of a block slid along each other on a weak plane between uneven cells, or between spheres: they come free, at its cost."""
import sys
import tempfile

from histories import run

FAILURES = []

# The plane bears 10 MPa over 1 cm^2, 1000 N, and costs 50 J/m^2 of it, 5 mJ, until it has slid by 10 um. Its sides are kept at their distance.
SLIDE = """materials:
  stone: {{E: 50 GPa, nu: 0.2, density: 2500 kg/m^3, strength: {{tension: 100 MPa, fracture_energy: 2000 J/m^2}}}}
  twin: {{E: 50 GPa, nu: 0.2, density: 2500 kg/m^3, strength: {{tension: 100 MPa, fracture_energy: 2000 J/m^2}}}}
model: {model}
fracture: {{}}
interactions: {{interfaces: [{{materials: {{first: stone, second: twin, tension: 10 MPa, fracture_energy: 50 J/m^2}}}}]}}
bodies:
  - shape: {{box: {{size: [8 mm, 10 mm, 10 mm]}}}}
    fill: {fill}
    material: stone
    regions: [{{where: {{half_space: {{point: [4 mm, 0, 0], normal: [1, 0, 0]}}}}, material: twin}}]
stages:
  - name: slide
    solver: {{dynamic: {{duration: 250 us, mass_damping: 1e5 1/s}}}}
    initial: [{{velocity: {{gradient: {{y: [12.5 1/s, 0, 0]}}}}}}]
    loads:
      - {held}_displacement: {{set: x-{layer}, x: 0, y: 0, z: 0}}
      - {held}_velocity: {{set: x+{layer}, y: 100 mm/s, z: 0, x: 0}}
sensors:
  force: {{reaction: {{set: x+{layer}, component: y}}}}
  spent: {{energy: fracture}}
"""


def expect(condition, sentence):
    if not condition:
        FAILURES.append(sentence)


def slide(folder, name, **scene):
    """Largest force [N], mean force of the last fifth [N], energy of fracture [J]."""
    value, _ = run(folder, name, SLIDE.format(**scene))
    force = value["force"]
    last = force[-len(force) // 5:]
    figures = max(force), sum(last) / len(last), value["spent"][-1]
    print(f"{name}: {figures[0]:.0f} N at most, {figures[1]:.1f} N left, {1e3 * figures[2]:.3f} mJ")
    return figures


def uneven_cells_come_free(folder):
    """The energy within 10 % of G_c A, 1 % of even cells: a rough plane's mean normal stands 2 to 4 degrees askew, which holds the halves a
    little; before faces followed the slide around them they locked (1461 N left). The force is less than 1000 N by what the free sides of the
    block lack of shear; rough planes, which open cell by cell, bear within 3 % of what the even one does (969 of 898 N before). The plane goes
    through the middle of a layer: at 20 % it is a stair of whole cells, whose steps once gave it normals of their own (520 N left)."""
    even = None
    for spread in ("0", "20 %", "60 %", "90 %"):
        most, left, spent = slide(folder, "cells-" + spread.split()[0], model="dlsm", fill=f"{{noisy_grid: {{elements: 1200, seed: 1, spread: {spread}}}}}", held="face", layer="")
        even = even or most
        expect(850 < most < 1050, f"cells, {spread}: 1000 N, not {most:.0f}")
        expect(0.97 < most / even < 1.03, f"cells, {spread}: {even:.0f} N as of even cells, not {most:.0f}")
        expect(abs(left) < 50, f"cells, {spread}: nothing left, not {left:.1f} N")
        expect(0.99 < spent / 5e-3 < (1.01 if spread == "0" else 1.1), f"cells, {spread}: 5 mJ, not {1e3 * spent:.3f}")


def beams_come_free(folder):
    """The energy within 10 % of G_c A, the force within 15 %; the plane between spheres is rougher, and its sides rub. Before their cracks lay
    along the plane no beam parted (1489 N)."""
    most, left, spent = slide(folder, "beams", model="cbm", fill="{packing: {elements: 2000, seed: 1}}\n    beams: 8", held="element", layer="_layer")
    expect(850 < most < 1150, f"beams: 1000 N, not {most:.0f}")
    expect(abs(left) < 150, f"beams: nothing left, not {left:.1f} N")
    expect(0.9 < spent / 5e-3 < 1.1, f"beams: 5 mJ, not {1e3 * spent:.3f}")


def main():
    with tempfile.TemporaryDirectory() as folder:
        uneven_cells_come_free(folder)
        beams_come_free(folder)
    for failure in FAILURES:
        print("FAILED:", failure)
    sys.exit(1 if FAILURES else 0)


if __name__ == "__main__":
    main()
