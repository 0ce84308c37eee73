"""A domain that machines have between them: none holds more than its part beside what all have, and a block that is torn apart has the bytes
of one rank, in every file. Its strengths ask for the volumes of bonds, a load for parts of faces, and it stands turned. A checkpoint of
three machines goes on with one and the other way round. The same of bodies that touch, stand apart, come from a file or have models of
their own, of cracks from the start, of static stages and modes; bodies that overlap are refused alike."""
import filecmp
import os
import re
import shutil
import subprocess
import sys
import tempfile
import under

PROGRAM = under.need("bin/breccia-mpi")
PLAIN = os.environ["BRC_PROGRAM"]
SCENE = """
version: 1
title: A block torn apart
materials:
  stone: {E: 50 GPa, nu: 0.2, density: 2500 kg/m^3, strength: {tension: 40 MPa, fracture_energy: 20 J/m^2, scatter: {weibull: {modulus: 12, volume: 1 mm^3}}}}
model: dlsm
bodies:
  - name: block
    shape: {box: {size: [20 mm, 12 mm, 12 mm]}}
    fill: {noisy_grid: {elements: 8000, spread: 90 %, lloyd: 1, seed: 1}}
    material: stone
    pose: {rotation: [10 deg, 20 deg, 30 deg], translation: [1 mm, 2 mm, 3 mm]}
fracture: {criterion: bond-normal}
sets:
  part: {faces: {wall: x+, box: {from: [-1 m, -1 m, -1 m], to: [1 m, 1 m, -0.3 mm]}}}
stages:
  - name: tear
    solver: {dynamic: {duration: 4 us}}
    loads:
      - face_displacement: {set: x-, x: 0}
      - pressure: {set: part, value: -200 MPa}
sensors:
  broken: {fracture: broken}
  area: {fracture: crack_area}
  closure: {energy: closure}
output: {frames: 2, history_every: 4, picture: {colour: damage}}
"""
# A block under a lid that touches it and slides, a chip from a file beside them.
BODIES = """
version: 1
title: A block, a lid and a chip
materials:
  stone: {E: 50 GPa, nu: 0.2, density: 2500 kg/m^3, strength: {tension: 40 MPa, scatter: {weibull: {modulus: 12, volume: 1 mm^3}}}}
  glass: {E: 70 GPa, nu: 0.22, density: 2500 kg/m^3, strength: {tension: 60 MPa}}
model: dlsm
bodies:
  - name: block
    shape: {box: {size: [20 mm, 12 mm, 10 mm]}}
    fill: {noisy_grid: {elements: 3000, spread: 90 %, lloyd: 1, seed: 1}}
    material: stone
  - name: lid
    shape: {box: {origin: [1 mm, 1 mm, LID], size: [18 mm, 10 mm, 4 mm]}}
    fill: {noisy_grid: {elements: 1500, spread: 50 %, seed: 2}}
    material: glass
  - name: chip
    domain: chip.h5
    material: glass
    pose: {translation: [24 mm, 0, 0], rotation: [0, 0, 10 deg]}
fracture: {}
interactions: {contact: {friction: 0.2}}
sets:
  end: {faces: {wall: x-, body: block}}
  cover: {faces: {wall: z+, body: lid, box: {from: [-1 m, -1 m, -1 m], to: [7 mm, 1 m, 1 m]}}}
stages:
  - name: press
    solver: {dynamic: {duration: 2 us}}
    initial: [velocity: {velocity: [-10 m/s, 0, 0]}]
    loads:
      - face_displacement: {set: end, x: 0}
      - pressure: {set: cover, value: 300 MPa}
sensors:
  broken: {fracture: broken}
  closure: {energy: closure}
output: {frames: 2, history_every: 4, picture: {colour: damage}}
"""
CHIP = """
version: 1
materials: {glass: {E: 70 GPa, nu: 0.22, density: 2500 kg/m^3}}
bodies:
  - name: chip
    shape: {box: {size: [6 mm, 6 mm, 6 mm]}}
    fill: {noisy_grid: {elements: 500, spread: 90 %, seed: 3}}
    material: glass
stages: [{name: none, solver: {dynamic: {steps: 1}}}]
"""
# Two cracks from the start, one of them in a plane of faces.
CRACKS = """
version: 1
title: A cracked block
materials:
  stone: {E: 50 GPa, nu: 0.2, density: 2500 kg/m^3, strength: {tension: 20 MPa, fracture_energy: 20 J/m^2}}
model: dlsm
bodies:
  - name: block
    shape: {box: {size: [20 mm, 12 mm, 12 mm]}}
    fill: {noisy_grid: {elements: 5000, spread: 90 %, lloyd: 1, seed: 1}}
    material: stone
    pose: {rotation: [10 deg, 0, 0]}
    cracks:
      - {name: notch, patch: {rectangle: {corner: [10 mm, -20 mm, -20 mm], edge: [0, 40 mm, 0], other_edge: [0, 0, 24 mm]}}}
      - {name: penny, patch: {disc: {centre: [12 mm, 6 mm, 6 mm], normal: [1, 0.2, 0.3], radius: 3 mm}}, flat: false}
quality:
  anisotropy_fabric: {warn: 1e-6}
  support: {warn: 10}
fracture: {criterion: bond-normal}
stages:
  - name: tear
    solver: {dynamic: {duration: 4 us}}
    loads:
      - face_displacement: {set: x-, x: 0}
      - pressure: {set: x+, value: -100 MPa}
sensors:
  broken: {fracture: broken}
  closure: {energy: closure}
  mouth: {face_mean: {set: notch, component: x}}
output: {frames: 2, history_every: 4, picture: {colour: damage}}
"""
# Pulled without time, with levels; bonds break one after another; then it goes on in time.
STATIC = """
version: 1
title: A bar with a crack, pulled slowly
materials:
  stone: {E: 50 GPa, nu: 0.2, density: 2500 kg/m^3, strength: {tension: 20 MPa, scatter: {weibull: {modulus: 20}}}}
model: dlsm
bodies:
  - name: bar
    shape: {box: {size: [20 mm, 12 mm, 12 mm]}}
    fill: {noisy_grid: {elements: 4000, spread: 90 %, lloyd: 1, seed: 1}}
    material: stone
    cracks: [{name: notch, patch: {rectangle: {corner: [10 mm, -1 mm, -1 mm], edge: [0, 14 mm, 0], other_edge: [0, 0, 4 mm]}}}]
fracture: {}
stages:
  - name: load
    solver: {static: {increments: 2, preconditioner: multigrid}}
    loads:
      - face_displacement: {set: x-, x: 0, y: 0, z: 0}
      - face_displacement: {set: x+, x: 1 um}
  - name: crack
    solver: {static: {events: {most: 6}, finite_strain: false, tolerance: 1e-6, preconditioner: blocks}}
    loads:
      - face_displacement: {set: x-, x: 0, y: 0, z: 0}
      - face_displacement: {set: x+, x: 10 um}
  - name: release
    solver: {dynamic: {steps: 20}}
    loads: [{face_displacement: {set: x-, x: 0}}]
sensors:
  force: {reaction: {set: x+, component: x}}
  broken: {fracture: broken}
  closure: {energy: closure}
output: {frames: 2, history_every: 4, picture: {colour: damage}}
"""
# Fewer cells than one machine computes at a time: another has none of them.
MODES = """
version: 1
title: A cube that rings
materials: {stone: {E: 20 GPa, nu: 0.2, density: 1000 kg/m^3}}
model: dlsm
bodies:
  - name: cube
    shape: {box: {size: [1 m, 1 m, 1 m]}}
    fill: {noisy_grid: {elements: 700, spread: 90 %, lloyd: 1, seed: 1}}
    material: stone
stages: [{name: ring, solver: {modes: {count: 3}}}]
sensors: {low: {mode: 0}, high: {mode: 2}}
output: {frames: 1, picture: {colour: displacement}}
"""
FILES = """
version: 1
title: Two chips of one file
materials: {glass: {E: 70 GPa, nu: 0.22, density: 2500 kg/m^3}}
model: dlsm
bodies:
  - {name: one, domain: chip.h5, material: glass}
  - {name: other, domain: chip.h5, material: glass, pose: {translation: [6.01 mm, 0, 0], rotation: [10 deg, 0, 0]}}
interactions: {contact: {friction: 0.2}}
sets: {push: {faces: {wall: x+, body: other}}}
stages:
  - name: meet
    solver: {dynamic: {duration: 2 us}}
    loads: [{pressure: {set: push, value: 100 MPa}}]
sensors: {closure: {energy: closure}}
output: {frames: 1, history_every: 4, picture: {colour: displacement}}
"""
CHECKPOINTS = ["--set", "output.checkpoint.every=2 us"]
FAILURES = []


def expect(condition, sentence):
    print(sentence, flush=True)
    if not condition:
        FAILURES.append(sentence)


def start(n, machines, *words):
    """A run on several ranks, of as many machines."""
    command = [PLAIN] if n == 1 else under.LAUNCH + ["-n", str(n), PROGRAM]
    return subprocess.run([*command, "run", *words], capture_output=True, text=True, check=False,
                          env=dict(os.environ, OMP_NUM_THREADS="1", BRECCIA_RANKS_MACHINES=str(machines)))


def run(n, machines, folder, *words, scene="scene.yaml"):
    """What it says."""
    done = start(n, machines, scene, "-o", folder, *words)
    expect(done.returncode == 0, f"{folder}: {n} ranks of {machines} machines end with {done.returncode} {done.stderr[-400:] if done.returncode else ''}")
    return done.stderr


def warnings(said):
    return re.findall(r"^warning: .*", said, re.M)


def alike(name, scene, n, machines):
    """A scene on one rank, and with its domains in parts on n of as many machines each."""
    write(f"{name}.yaml", scene)
    alone = run(1, 1, f"{name}-alone", scene=f"{name}.yaml")
    told = run(n, machines, f"{name}-apart", scene=f"{name}.yaml")
    same(f"{name}-alone", f"{name}-apart")
    expect("has the whole domain" not in told and parts(told), f"{name}: {n} ranks of {machines} machines have it in parts")
    expect(warnings(told) == warnings(alone), f"{name}: {len(warnings(told))} warnings of {n} ranks are those of one")


def breaks(folder, least):
    with open(f"{folder}/cracks.csv", encoding="utf-8") as file:
        n = len(file.readlines())
    expect(n > least, f"{folder}: {n} lines of cracks, more than {least} asked")


def write(name, text):
    with open(name, "w", encoding="utf-8") as file:
        file.write(text)


def files_of(folder):
    return sorted(os.path.relpath(os.path.join(where, name), folder) for where, _, names in os.walk(folder) for name in names
                  if name not in ("summary.json", "prediction.json") and "checkpoints" not in where)


def same(one, other):
    names = files_of(one)
    _, different, missing = filecmp.cmpfiles(one, other, names, shallow=False)
    differs = different + missing + [name for name in files_of(other) if name not in names]
    expect(not differs, f"{other}: other bytes than {one}: {differs}" if differs else f"{other}: the {len(names)} files of {one}")


def parts(said):
    """MB of the domain, of it on a machine at most, and of that what all have."""
    found = re.search(r"of a domain of ([\d.]+) MB a machine has ([\d.]+) MB at most, ([\d.]+) MB", said)
    return [float(word) for word in found.groups()] if found else None


def go_on(n, machines, folder):
    """Without the last checkpoint, from the one before."""
    shutil.copytree(folder, f"{folder}-{n}")
    left = sorted(os.listdir(f"{folder}-{n}/checkpoints"))
    expect(len(left) > 1, f"{folder} leaves {len(left)} checkpoints")
    os.unlink(f"{folder}-{n}/checkpoints/{left[-1]}")
    run(n, machines, f"{folder}-{n}", "--resume", *CHECKPOINTS)
    same("left-alone", f"{folder}-{n}")


with tempfile.TemporaryDirectory() as temporary:
    os.chdir(temporary)
    write("scene.yaml", SCENE)
    run(1, 1, "alone")
    breaks("alone", 100)
    for n_ranks, n_machines in ((2, 2), (4, 3), (4, 4)):
        told = run(n_ranks, n_machines, f"ranks-{n_ranks}-{n_machines}")
        same("alone", f"ranks-{n_ranks}-{n_machines}")
        size = parts(told)
        expect(size is not None, "the log says what a machine has")
        if size:
            whole, most, common = size
            share = (most - common) / (whole - common)
            expect(common <= 0.22 * whole and share <= 1.1 / n_machines + 0.15,
                   f"{n_machines} machines: {share:.2f} of what is had in parts on one (0.15 + 1.1 / {n_machines} asked), {common / whole:.2f} on all (0.22)")
    run(1, 1, "left-alone", *CHECKPOINTS)
    run(3, 3, "left", *CHECKPOINTS)
    go_on(3, 3, "left-alone")
    go_on(1, 1, "left")
    write("chip.yaml", CHIP)
    subprocess.run([PLAIN, "build", "chip.yaml", "-o", "chip.h5"], capture_output=True, check=True)
    alike("bodies", BODIES.replace("LID", "10 mm"), 3, 3)
    breaks("bodies-alone", 100)
    models = BODIES
    for was, becomes in (("LID", "10.5 mm"), ("interactions:", "#"), ("fracture: {}", "#"), ("    material: glass\n", "    material: glass\n    model: dlsm-published\n"),
                         ("broken: {fracture: broken}", "out: {face_mean: {set: end, component: x}}"), ("colour: damage", "colour: displacement")):
        models = models.replace(was, becomes)
    alike("models", models, 2, 2)
    alike("cracks", CRACKS, 4, 3)
    breaks("cracks-alone", 100)
    alike("static", STATIC, 3, 2)
    breaks("static-alone", 6)
    alike("modes", MODES, 2, 2)
    alike("files", FILES, 2, 2)
    for place in ("9.92 mm", "7 mm"):
        write("overlap.yaml", BODIES.replace("LID", place))
        said = [re.search(r"bodies 'block' and 'lid' overlap.*", start(n, n, "overlap.yaml", "-o", f"overlap-{n}").stderr) for n in (1, 3)]
        expect(all(said) and said[0].group() == said[1].group(), f"overlap is told alike: {said[0] and said[0].group()}")
    refused = under.start(2, [PROGRAM, "run", "scene.yaml"], BRECCIA_RANKS_MACHINES="two")
    errors = refused.communicate(timeout=60)[1]
    expect(refused.returncode == 2 and "is 'two', must be a number of machines" in errors and errors.count("\n") == 1, f"machines that are no number: {errors.strip()}")
for failure in FAILURES:
    print("apart: " + failure)
sys.exit(1 if FAILURES else 0)
