"""Solids of spheres that break at once part: beams that bridge a crack do not hold its sides together, with contact and without, beside a push,
and where a wave tears a piece off."""
import csv
import os
import sys
import tempfile

from histories import run

FAILURES = []

# A block of 4 cm^2 that bears 8 MPa, 3200 N, pulled to 3.7 times the stretch at which it breaks.
BLOCK = """materials:
  granite: {{E: 50 GPa, nu: 0.25, density: 2650 kg/m^3, strength: {{tension: 8 MPa}}}}
model: cbm
fracture: {fracture}
interactions: {contact}
bodies:
  - shape: {{box: {{size: [20 mm, 20 mm, 20 mm]}}}}
    fill: {{packing: {{elements: 2000, seed: {seed}}}}}
    beams: 8
    material: granite
stages:
{press}  - name: pull
    solver: {{dynamic: {{duration: {duration} us, mass_damping: 20000 1/s}}}}
    loads:
{held}      - element_velocity: {{set: x+, x: {pull} mm/s}}
sensors:
  force: {{reaction: {{set: x+, component: x}}}}
  push: {{reaction: {{set: y-, component: y}}}}
  broken: {{fracture: broken}}
  ledger: {{energy: closure}}
"""
HELD = "".join(f"      - element_displacement: {{set: {axis}-, {axis}: 0}}\n" for axis in "xyz")
PULLED = {"fracture": "{}", "contact": "{}", "seed": 1, "press": "", "held": HELD, "duration": 300, "pull": 40}
SQUEEZED = HELD + "      - element_displacement: {set: y+, y: -9.6 um}\n" # 24 MPa
PRESSED = PULLED | {"press": "  - name: press\n    solver: static\n    loads:\n" + SQUEEZED, "held": SQUEEZED, "duration": 600, "pull": 20}

# A bar of 150 x 10 x 10 mm, struck by a pulse that falls from 10 MPa to nothing within 20 us.
STRUCK = """materials:
  rock: {E: 40 GPa, nu: 0.2, density: 2400 kg/m^3, strength: {tension: 4 MPa}}
model: cbm
fracture: {}
bodies:
  - shape: {box: {size: [150 mm, 10 mm, 10 mm]}}
    fill: {packing: {elements: 3000, seed: 1}}
    beams: 8
    material: rock
stages:
  - name: pulse
    solver: {dynamic: {duration: 80 us}}
    loads:
      - element_force: {set: x-, x: 1000 N, table: [[0, 0], [1 us, 1], [21 us, 0], [1 ms, 0]]}
sensors:
  broken: {fracture: broken}
"""


def expect(condition, sentence):
    if not condition:
        FAILURES.append(sentence)


def loaded(folder, name, settings):
    """The largest pull, what is left of it in the end, what is left of the first push, and the ledger."""
    value, _ = run(folder, name, BLOCK.format(**settings))
    n = len(value["force"])
    most, left = max(value["force"]), sum(value["force"][-n // 5:]) / len(value["force"][-n // 5:])
    first, last = max(value["push"]), sum(value["push"][-n // 5:]) / len(value["push"][-n // 5:])
    print(f"{name}: {most:.0f} N at most, {left:.0f} left; push {first:.0f}, then {last:.0f} N; {value['broken'][-1]:.0f} broken, ledger {value['ledger'][-1]:.4f}")
    return most, left, last / first, value["ledger"][-1]


def pulled(folder):
    """The strength within 5 % (as it was: the beams before the first break are those of the law), and nothing left: some beams that the crack
    has just come to still bear, 4 to 6 % of it here. It kept 22 to 35 %, in one piece."""
    for name, settings in (("alone", {}), ("another", {"seed": 2}), ("contact", {"contact": "{contact: {friction: 0.3}}"})):
        most, left, _, ledger = loaded(folder, name, PULLED | settings)
        expect(abs(most / 3200 - 1) < 0.05, f"{name}: 3200 N, not {most:.0f}")
        expect(abs(left) < 0.1 * most, f"{name}: parted, not {left:.0f} N")
        expect(abs(ledger) < 0.05, f"{name}: ledger within 5 %, not {ledger}")
    most, left, *_ = loaded(folder, "paper", PULLED | {"fracture": "{closure: false}"})
    expect(left > 0.15 * most, f"the paper's law holds its sides together: {left:.0f} N")


def pressed(folder):
    """Held along y at 3 sigma_f. Elements that are pressed let their beams go later. 30 % of the pull is left here, 48 % was and 75 % of the push."""
    most, left, kept, _ = loaded(folder, "pressed", PRESSED)
    expect(left < 0.35 * most, f"pressed: parted, not {left:.0f} of {most:.0f} N")
    expect(kept > 0.74, f"pressed: the push is carried on, not {kept}")


def struck(folder):
    """The pulse comes back from the free end as tension, and tears off what lies where front and tail differ by the strength: c 20 us / 2 times 4 of
    10 MPa, 16.3 mm or 3.92 g (c = 4082 m/s). Within 30 %: the pulse is long 45 spheres and rises within two, the crack is as rough. It broke 724
    beams, and all stayed in one piece."""
    run(folder, "struck", STRUCK)
    with open(os.path.join(folder, "struck", "fragments.csv"), encoding="utf-8") as file:
        pieces = [row for row in csv.DictReader(file) if row["frame"] == "-1"]
    torn = max(pieces, key=lambda row: (float(row["mass [kg]"]) > 1e-3) * float(row["centre_x [m]"]))
    mass, speed = float(torn["mass [kg]"]), float(torn["velocity_x [m/s]"])
    print(f"struck: {1e3 * mass:.2f} g torn off at {speed:.2f} m/s")
    expect(abs(mass / 3.92e-3 - 1) < 0.3, f"struck: 3.92 g, not {1e3 * mass:.2f}")
    expect(speed > 0.5, f"struck: it flies off, not at {speed:.2f} m/s")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        pulled(folder)
        pressed(folder)
        struck(folder)
    for failure in FAILURES:
        print("FAILED:", failure)
    sys.exit(1 if FAILURES else 0)
