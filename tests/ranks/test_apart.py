"""A domain that machines have between them: none holds more than its part beside what all have, and a block that is torn apart has the bytes
of one rank, in every file. Its strengths ask for the volumes of bonds, a load for parts of faces, and it stands turned. A checkpoint of
three machines goes on with one and the other way round."""
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
CHECKPOINTS = ["--set", "output.checkpoint.every=2 us"]
FAILURES = []


def expect(condition, sentence):
    print(sentence, flush=True)
    if not condition:
        FAILURES.append(sentence)


def run(n, machines, folder, *words):
    """What it says on several ranks, of as many machines."""
    command = [PLAIN] if n == 1 else under.LAUNCH + ["-n", str(n), PROGRAM]
    done = subprocess.run([*command, "run", "scene.yaml", "-o", folder, *words], capture_output=True, text=True, check=False,
                          env=dict(os.environ, OMP_NUM_THREADS="1", BRECCIA_RANKS_MACHINES=str(machines)))
    expect(done.returncode == 0, f"{folder}: {n} ranks of {machines} machines end with {done.returncode} {done.stderr[-400:] if done.returncode else ''}")
    return done.stderr


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
    with open("scene.yaml", "w", encoding="utf-8") as file:
        file.write(SCENE)
    run(1, 1, "alone")
    with open("alone/cracks.csv", encoding="utf-8") as file:
        expect(len(file.readlines()) > 100, "the block breaks")
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
    refused = under.start(2, [PROGRAM, "run", "scene.yaml"], BRECCIA_RANKS_MACHINES="two")
    errors = refused.communicate(timeout=60)[1]
    expect(refused.returncode == 2 and "is 'two', must be a number of machines" in errors and errors.count("\n") == 1, f"machines that are no number: {errors.strip()}")
for failure in FAILURES:
    print("apart: " + failure)
sys.exit(1 if FAILURES else 0)
