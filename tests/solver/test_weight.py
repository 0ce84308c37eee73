"""Bodies weigh what their material does, for each model: thrown, two bodies have the kinetic energy rho V v^2 / 2 of their shapes, one of which is
filled more loosely by its spheres than the other; on a foot, a block rests with rho V g.
Cells of boxes fill them to rounding, those of a ball have exactly its volume; spheres share theirs out: 1e-12 of sums over some thousand numbers.
A solve to 1e-10 of the load leaves the reaction within 1e-9; dlsm-published balances torques in turn with forces, and is at 1e-8."""
import csv
import math
import os
import subprocess
import sys
import tempfile

PROGRAM = os.environ["BRC_PROGRAM"]
FILLS = {"dlsm": "fill: {noisy_grid: {elements: %d, spread: 60 %%, seed: 1}}", "cbm": "fill: {packing: {elements: %d, seed: 1}}, beams: 9"}
FILLS["dlsm-published"] = FILLS["dlsm"]
SCENE = "version: 1\nmodel: %s\nmaterials: {m: {E: 50 GPa, nu: 0.22, density: 2600 kg/m^3}}\n%soutput: {frames: none, picture: false}\n"
BLOCK = "  - {name: block, material: m, shape: {box: {size: [20 mm, 20 mm, 30 mm]}}, %s}\n"
BALL = "  - {name: ball, material: m, shape: {sphere: {centre: [60 mm, 10 mm, 10 mm], radius: 6 mm}}, %s}\n"
THROWN = "stages: [{name: fly, solver: {dynamic: {duration: 2 us}}, initial: [velocity: {velocity: [2 m/s, 0, 0]}]}]\nsensors: {out: {energy: kinetic}}\n"
STANDS = ("gravity: [0, 0, -9.81 m/s^2]\nsets: {foot: {elements: {wall: z-}}}\n"
          "stages: [{name: stand, solver: {static: {tolerance: 1e-10}}, loads: [element_displacement: {set: foot, x: 0, y: 0, z: 0}]}]\nsensors: {out: {reaction: {set: foot, component: z}}}\n")
FAILED = []


def last(folder, name, scene):
    path = os.path.join(folder, name + ".yaml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(scene)
    done = subprocess.run([PROGRAM, "run", path, "-t", "1", "-o", os.path.join(folder, name)], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{name}: exit {done.returncode}\n{done.stderr[-2000:]}")
    with open(os.path.join(folder, name, "histories.csv"), encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    return float(rows[-1][[k for k, title in enumerate(rows[0]) if title.startswith("out")][0]])


def expect(what, value, exact, most):
    print(f"{what}: {value:.12g} for {exact:.12g}")
    if not abs(value / exact - 1) <= most:
        FAILED.append(what)


with tempfile.TemporaryDirectory() as scratch:
    for model, fill in FILLS.items():
        bodies = "bodies:\n" + BLOCK % (fill % 1000) + BALL % (fill % 150)
        volume = 12e-6 + 4 / 3 * math.pi * 6e-3 ** 3
        expect(f"{model}, thrown", last(scratch, model + "-thrown", SCENE % (model, bodies + THROWN)), 0.5 * 2600 * volume * 4, 1e-12)
        expect(f"{model}, on its foot", last(scratch, model + "-stands", SCENE % (model, "bodies:\n" + BLOCK % (fill % 1000) + STANDS)), 2600 * 12e-6 * 9.81, 1e-7 if model == "dlsm-published" else 1e-9)
sys.exit(f"failed: {', '.join(FAILED)}" if FAILED else 0)
