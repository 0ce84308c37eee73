"""Every dataset of every HDF5 file that a run writes has its unit and one line of meaning; and no entry of the tables is left over from
a dataset that is gone.

    test_meanings.py          runs of each model, made small: what ctest runs
    test_meanings.py --all    every example made small
"""
import glob
import os
import re
import subprocess
import sys
import tempfile
from debian import need

(h5py,) = need("python3-h5py", "h5py")
import test_resume  # its examples made small

UNIT = r"(1|-|SI|kg|m|s|N|J|Pa|Hz|rad|mm)"
ONE = rf"{UNIT}(\^\d)?( {UNIT}(\^\d)?)*(/{UNIT}(\^\d)?)?"
UNITS = re.compile(rf"{ONE}(, {ONE})*")
# Cells with contact, a striker, softening; beams with events; softening beams; two models; cells with tractions.
EXAMPLES = ["ball-breaks+softening", "beams-events", "beams-fracture+softening", "two-models", "cantilever"]
# A checkpoint at the end of each stage; of these also within static stages, which keep more.
KEPT = {"beams-events": test_resume.ALWAYS}
# The published model with breaks, and beams under loads that no example has.
PUBLISHED = """version: 1
materials: {glass: {E: 70 GPa, nu: 0.2, density: 2500 kg/m^3, strength: 100 Pa}}
model: dlsm-published
fracture: {criterion: bond-normal}
bodies: [{name: bar, shape: {box: {size: [3 m, 1 m, 1 m]}}, fill: {noisy_grid: {cells: [9, 3, 3], spread: 30 %}}}]
sets: {left: {elements: {box: {from: [0, 0, 0], to: [40 cm, 1 m, 1 m]}}}, right: {elements: {box: {from: [260 cm, 0, 0], to: [3 m, 1 m, 1 m]}}}}
stages:
  - name: pull
    solver: {dynamic: {steps: 300}}
    loads: [{element_velocity: {set: left, x: 0}}, {element_force: {set: right, x: 1 kN}}]
sensors: {kinetic: {energy: kinetic}}
measure: {most: {peak: {of: kinetic}}}
output: {picture: false, checkpoint: {wall: 1 h}}
"""
DAMPED = """version: 1
materials: {glass: {E: 70 GPa, nu: 0.2, density: 2500 kg/m^3, strength: 100 Pa}}
fracture: {criterion: virial-principal}
bodies: [{name: bar, shape: {box: {size: [3 m, 1 m, 1 m]}}, fill: {noisy_grid: {cells: [9, 3, 3], spread: 30 %}}}]
stages: [{name: pull, solver: {dynamic: {steps: 100, mass_damping: 10 1/s}}, loads: [{traction: {set: x+, x: 1 kPa}}]}]
output: {picture: false, checkpoint: {wall: 1 h}}
"""
TURNED = """version: 1
materials: {glass: {E: 70 GPa, nu: 0.2, density: 2500 kg/m^3}}
model: cbm
bodies: [{name: bar, shape: {box: {size: [3 m, 1 m, 1 m]}}, fill: {packing: {elements: 300}}, beams: 8}]
stages:
  - name: turn
    solver: {dynamic: {steps: 300}}
    loads: [{element_displacement: {set: x-, x: 0, y: 0, z: 0}}, {element_rotation: {set: x+, x: 1 mrad}}]
output: {picture: false, checkpoint: {wall: 1 h}}
"""
# Spheres on both sides of a plane that breaks at once.
JOINED = """version: 1
materials: {glass: {E: 70 GPa, nu: 0.2, density: 2500 kg/m^3, strength: 1 MPa}, film: {E: 70 GPa, nu: 0.2, density: 2500 kg/m^3, strength: 1 MPa}}
model: cbm
fracture: {}
interactions: {interfaces: [{materials: {first: glass, second: film, factor: 50 %}}]}
bodies:
  - {name: bar, shape: {box: {size: [3 m, 1 m, 1 m]}}, fill: {packing: {elements: 300}}, beams: 8, material: glass,
     regions: [{where: {half_space: {point: [150 cm, 0, 0], normal: [1, 0, 0]}}, material: film}]}
stages:
  - name: pull
    solver: {dynamic: {steps: 100}}
    loads: [{element_displacement: {set: x-, x: 0, y: 0, z: 0}}, {element_displacement: {set: x+, x: 1 mm}}]
output: {picture: false, checkpoint: {wall: 1 h}}
"""
PRESSED = """version: 1
materials: {glass: {E: 70 GPa, nu: 0.2, density: 2500 kg/m^3}}
bodies: [{name: cube, shape: {box: {size: [1 m, 1 m, 1 m]}}, fill: {noisy_grid: {cells: [2, 2, 2], spread: 30 %}}}]
platens: {axis: y, force: 1 kN}
stages: [{name: press, solver: {dynamic: {steps: 20}}}]
output: {picture: false, checkpoint: {wall: 1 h}}
"""
# Steps of the law around the cycle of multigrid (nu 0.49), within a static stage.
STIFF = """version: 1
materials: {glass: {E: 70 GPa, nu: 0.49, density: 2500 kg/m^3, strength: {tension: 50 MPa, scatter: {weibull: {modulus: 20}}}}}
fracture: {}
bodies: [{name: bar, shape: {box: {size: [2 m, 1 m, 1 m]}}, fill: {noisy_grid: {cells: [11, 7, 7], spread: 30 %}}}]
stages:
  - name: crack
    solver: {static: {events: 3, finite_strain: false, tolerance: 1e-6}}
    loads: [{face_displacement: {set: x-, x: 0}}, {face_displacement: {set: x+, x: 1 mm}}]
output: {picture: false, checkpoint: {wall: 1 us}}
"""
FAILURES = []


def expect(condition, sentence):
    if not condition:
        FAILURES.append(sentence)


def text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def walk(path, seen):
    """Look at each dataset of a file; what frames only link to is looked at where it is."""
    def visit(name, thing):
        if not isinstance(thing, h5py.Dataset):
            return
        unit, meaning = (text(thing.attrs.get(key, "")) for key in ("unit", "meaning"))
        what = f"{os.path.basename(path)}: {name}"
        expect(unit, f"{what} has no unit")
        expect(not unit or UNITS.fullmatch(unit), f"{what} has the unit '{unit}', which is none")
        expect(len(meaning) > 8 and "\n" not in meaning, f"{what} has no meaning: '{meaning}'")
        seen[name] = (unit, meaning)
    with h5py.File(path, "r") as file:
        file.visititems(visit)


def walk_run(folder, seen):
    frames = sorted(glob.glob(f"{folder}/frames/*.vtkhdf"))
    checkpoints = sorted(glob.glob(f"{folder}/checkpoints/*.h5"))
    expect(checkpoints and os.path.exists(f"{folder}/result.h5"), f"{folder} lacks checkpoints or result.h5")
    for path in [f"{folder}/result.h5", *frames, *checkpoints]:
        walk(path, seen)


def run(line):
    done = subprocess.run(line, capture_output=True, text=True, timeout=900, check=False)
    if done.returncode != 0:
        raise SystemExit(f"meanings: {' '.join(line)} ended with {done.returncode}:\n{done.stdout}{done.stderr}")


def patterns():
    """Of the tables of results, frames and checkpoints."""
    found = []
    for name in ("meaning.c", "meaning_state.c"):
        with open(f"{test_resume.SOURCE}/host/output/{name}", encoding="utf-8") as file:
            found += re.findall(r'^    \{"([^"]+)", "', file.read(), re.M)
    return found


def main():
    everything = "--all" in sys.argv[1:]
    names = sorted(os.path.basename(os.path.dirname(path)) for path in glob.glob(f"{test_resume.SOURCE}/examples/*/scene.yaml"))
    names = names + list(test_resume.MORE) if everything else EXAMPLES
    seen = {}
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            run(test_resume.command(name, f"{folder}/{name}", test_resume.overrides(name) + [KEPT.get(name, "output.checkpoint.wall=1 h")]))
            walk_run(f"{folder}/{name}", seen)
        for name, scene in (("published", PUBLISHED), ("damped", DAMPED), ("turned", TURNED), ("joined", JOINED), ("pressed", PRESSED), ("stiff", STIFF)):
            with open(f"{folder}/{name}.yaml", "w", encoding="utf-8") as file:
                file.write(scene)
            run([test_resume.PROGRAM, "run", f"{folder}/{name}.yaml", "-o", f"{folder}/{name}", "--device", "cpu"])
            walk_run(f"{folder}/{name}", seen)
        for name, example in (("cells", "cantilever"), ("spheres", "beams-events"), ("grains", "polycrystal")):
            sets = [word for one in test_resume.overrides(example) if not one.startswith("stages") for word in ("--set", one)]
            run([test_resume.PROGRAM, "build", test_resume.scene_of(example), "-o", f"{folder}/{name}.h5", *sets])
            walk(f"{folder}/{name}.h5", seen)
    for name, unit in {"VTKHDF/CellData/stress": "Pa", "cracks/position": "m", "parts/0/velocity": "m/s", "elements/inertia": "m^5", "ledger/work": "J"}.items():
        expect(seen.get(name, ("",))[0] == unit, f"{name} has the unit {seen.get(name)}, expected {unit}")
    wanted = patterns()
    expect(len(wanted) > 200, f"only {len(wanted)} entries are found in host/output/meaning*.c")
    for pattern in wanted:
        expression = re.compile(re.escape(pattern).replace(r"\*", "[^/]*"))
        expect(any(map(expression.fullmatch, seen)), f"no dataset is called {pattern}: an entry of host/output/meaning*.c for nothing")
    print(f"{len(seen)} datasets, {len(wanted)} entries of the tables")
    for failure in FAILURES:
        print("meanings: " + failure)
    return 1 if FAILURES else 0


if __name__ == "__main__":
    sys.exit(main())
