"""Scenes as one who is new to the program gets them wrong: each error names file, line and column, what was found, what is expected, and the cure. One wrong thing a scene."""
import os
import subprocess
import sys
import tempfile

PROGRAM = os.path.abspath(os.environ.get("BRC_PROGRAM", "build/bin/breccia"))
RIGHT = """version: 1
materials:
  glass: {E: 72 GPa, nu: 0.2, density: 2500 kg/m^3, strength: 50 MPa}
model: dlsm
fracture: true
bodies:
  - name: bar
    shape: {box: {size: [20 mm, 10 mm, 10 mm]}}
    fill: {noisy_grid: {elements: 300}}
    material: glass
stages:
  - name: pull
    solver: {dynamic: {duration: 20 us}}
    loads:
      - face_displacement: {set: x-, x: 0}
      - face_velocity: {set: x+, x: 1 m/s}
sensors:
  force: {reaction: {set: x+, component: x}}
output: {frames: 2}
"""
# What is written, in place of what, and for each error: place, what was found, and the words of what is expected and of the cure.
WRONG = [
    ("E: 72e9", "E: 72 GPa", [("3:14", "'72e9' has no unit", "expected a quantity in Pa > 0 such as 72 GPa")]),
    ("E: 72 gpa", "E: 72 GPa", [("3:14", "'72 gpa'", "did you mean '72 GPa'?")]),
    ("E: 72 kg", "E: 72 GPa", [("3:14", "'72 kg' has a unit of another kind", "expected a quantity in Pa > 0 such as 72 GPa")]),
    ("2.5 g/cm3", "2500 kg/m^3", [("3:40", "'2.5 g/cm3'", "kg/m^3 > 0 such as 2500 kg/m^3; did you mean '2.5 g/cm^3'?")]),
    ("noisygrid", "noisy_grid", [("9:12", "unknown key 'noisygrid'", "did you mean 'noisy_grid'?")]),
    ("poisson: 0.2", "nu: 0.2", [("3:10", "'nu' is missing", "as in nu: 0.23"), ("3:22", "unknown key 'poisson'", "did you mean 'nu'?")]),
    ("nu: 0,2", "nu: 0.2", [("3:28", "unknown key '2'", "decimals have a point")]),
    ("nu: 0.5", "nu: 0.2", [("3:26", "'0.5' is out of range", "must be in (-1, 0.5)")]),
    ("", ", strength: 50 MPa", [("5:1", "no material of a body has a strength", "give one `strength: {tension: 50 MPa}`, or leave fracture out")]),
    ("strength: {tensile: 50 MPa}", "strength: 50 MPa", [("3:63", "found none", "expected at least one of tension, compression"), ("3:64", "'tensile'", "did you mean 'tension'?")]),
    ("set: right, x: 1", "set: x+, x: 1", [("16:30", "'right'", "known: x-, x+, y-, y+, z-, z+, bar; define it under sets, as in `sets: {NAME: {faces: {wall: x+}}}`")]),
    ("set: end, component", "set: x+, component", [("18:27", "'end'", "define it under sets, as in")]),
    ("model: cbm", "model: dlsm", [("4:8", "body 'bar' is made of cells", "add `beams: 8` and a fill with radii to it, or use model: dlsm")]),
    ("sphere: {radius: 5 mm, diameter: 10 mm}", "box: {size: [20 mm, 10 mm, 10 mm]}", [("8:36", "found 2 of them", "expected only one of radius, diameter")]),
    ("material: glas", "material: glass", [("10:15", "no material 'glas'", "did you mean 'glass'?; known: glass; define it under materials")]),
    ("material: steel", "material: glass", [("10:15", "no material 'steel'", "known: glass; define it under materials")]),
    ("", "version: 1\n", [("1:1", "'version' is missing", "as in version: 1")]),
    ("\t- name: bar", "  - name: bar", [("7:1", "not YAML", "indent with blanks, not with tabs")]),
    ("[20 mm, 10 mm, 10 mm}}", "[20 mm, 10 mm, 10 mm]}}", [("8:45", "not YAML", "close every [ with ]")]),
    ("[20 mm, 10 mm]", "[20 mm, 10 mm, 10 mm]", [("8:25", "a list of 2", "expected a list of 3 quantities in m > 0 such as [1 m, 1 m, 1 m]")]),
    ("-20 us", "20 us", [("13:34", "'-20 us' is out of range", "must be > 0")]),
    ("time: 20 us", "duration: 20 us", [("13:23", "found none", "expected exactly one of duration, steps"), ("13:24", "'time'", "did you mean 'duration'?")]),
    ("face_velocity: {set: x-, x: 1 m/s}", "face_velocity: {set: x+, x: 1 m/s}", [("16:30", "prescribed by an earlier load of this stage too", "keep one")]),
    ("traction: {set: x+, x: 10 kN}", "face_velocity: {set: x+, x: 1 m/s}", [("16:32", "'10 kN' has a unit of another kind", "expected a quantity in Pa such as 1 kPa")]),
    ("static", "dynamic: {duration: 20 us}", [("13:20", "found nothing", "as in static: {increments: 1}"), ("16:9", "a static stage has no velocities", "prescribe a displacement")]),
    ("component: w", "component: x", [("18:42", "'w' is none of the words", "expected one of x, y, z")]),
    ("model: dlsm\nmodel: cbm", "model: dlsm", [("5:1", "duplicate key 'model', given before at 4:1", "keep one")]),
    ("fracture: true\ncontact: {friction: 0.3}", "fracture: true", [("6:1", "unknown key 'contact'", "as in interactions: {contact: ...}")]),
    # seen while the domain is built, and once it is
    ("elements: 1", "elements: 300", [("9:11", "fill: 1 cells across", "a thicker body")]),
    ("noisy_grid: {elements: 300}}\n    grains: {number: 1000}", "noisy_grid: {elements: 300}}", [("9:11", "1000 grains", "ask for at most")]),
    ("component: y, sign: compression", "component: x", [("18:27", "\"x+\" looks neither way along y", "leave `sign` out, or name the set of one side")]),
    ("output: {frames: 2}\nsets:\n  far: {faces: {box: {from: [1 m, 0, 0], to: [2 m, 1 m, 1 m]}}}\n  near: {elements: {box: {from: [-2 m, 0, 0], to: [-1 m, 1 m, 1 m]}}}", "output: {frames: 2}",
     [("21:8", "set 'far' is empty", "widen the region"), ("22:9", "set 'near' is empty", "widen the region")]),
    ("frames: many", "frames: 2", [("19:18", "'many' is not a decimal number", "expected a whole number in [0, 1000000] such as 10, or the word none")]),
]


def check(text, folder):
    path = os.path.join(folder, "scene.yaml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    done = subprocess.run([PROGRAM, "check", "scene.yaml"], capture_output=True, text=True, cwd=folder, check=False)
    return done.returncode, [line for line in done.stderr.splitlines() if ": error: " in line]


failures = 0
with tempfile.TemporaryDirectory() as place:
    assert check(RIGHT, place) == (0, []), "the scene that the wrong ones are made of is refused"
    for written, instead, expected in WRONG:
        assert RIGHT.count(instead) == 1, instead
        code, lines = check(RIGHT.replace(instead, written), place)
        good = code == 2 and len(lines) == len(expected) and all(
            line.startswith(f"scene.yaml:{where}: error: ") and found in line and cure in line for line, (where, found, cure) in zip(lines, expected))
        if not good:
            failures += 1
            print(f"{written!r} in place of {instead!r}: exit code {code}", *lines, sep="\n    ")
sys.exit(1 if failures else 0)
