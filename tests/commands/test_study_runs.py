"""`breccia study`: killed twice and taken up, it ends with the bytes of one that was left alone; one run that fails leaves the others."""
import csv
import glob
import os
import signal
import subprocess
import sys
import tempfile
import time

PROGRAM = os.path.abspath(os.environ.get("BRC_PROGRAM", "build/bin/breccia"))
SCENE = """version: 1
materials:
  glass: {density: 1 kg/m^3, E: 1 Pa, nu: 0.2, strength: {tension: 6e-4 Pa}}
model: dlsm
fracture: {}
bodies:
  - name: block
    shape: {box: {size: [1 m, 1 m, 1 m]}}
    fill: {noisy_grid: {cells: [6, 6, 6], spread: 90 %, seed: 1}}
    material: glass
stages:
  - name: burst
    solver: {dynamic: {steps: 1500}}
    initial: [velocity: {gradient: {x: [2e-3 1/s, 5e-4 1/s, 0]}}]
sensors:
  elastic: {energy: elastic}
measure:
  most: {peak: {of: elastic}}
output: {frames: none, picture: false}
"""
STUDY = """scene: scene.yaml
vary:
  - {key: materials.glass.nu, values: [0.1, 0.3, 7]}
  - {key: bodies.0.fill.noisy_grid.seed, from: 1, to: 4, average: true}
fit:
  - {weibull: most}
  - {power: most, by: materials.glass.nu}
"""
FAILURES = []


def expect(condition, sentence):
    if not condition:
        FAILURES.append(sentence)


def command(folder, out):
    return [PROGRAM, "study", os.path.join(folder, "study.yaml"), "-o", os.path.join(folder, out), "--jobs", "2", "--device", "cpu"]


def done(folder):
    """Runs that have come to their end."""
    return sum('"status": "done"' in open(path, encoding="utf-8").read() for path in glob.glob(os.path.join(folder, "*/summary.json")))


def kill_after(line, folder, n):
    child = subprocess.Popen(line + ["--now"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while child.poll() is None and done(folder) < n:
        time.sleep(0.005)
    expect(child.poll() is None, f"the study ended before it could be killed, with {child.returncode}")
    child.send_signal(signal.SIGKILL)
    child.wait()


with tempfile.TemporaryDirectory() as folder:
    for name, text in (("scene.yaml", SCENE), ("study.yaml", STUDY)):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    whole = subprocess.run(command(folder, "whole"), capture_output=True, text=True)
    expect(whole.returncode == 0 and "study: 12 runs, 0 of them done, 4 refused" in whole.stdout and "budget: 8 runs of about" in whole.stdout
           and "8 of 12 runs are done" in whole.stdout, f"exit code {whole.returncode}: {whole.stdout}{whole.stderr}")
    left = os.path.join(folder, "left")
    for n in (1, 4):
        kill_after(command(folder, "left"), left, n)
    before = {path: os.stat(path).st_mtime_ns for path in glob.glob(os.path.join(left, "*/summary.json")) if '"status": "done"' in open(path, encoding="utf-8").read()}
    expect(4 <= len(before) < 8, f"{len(before)} runs were done when it was killed")
    again = subprocess.run(command(folder, "left") + ["--now"], capture_output=True, text=True)
    expect(again.returncode == 0 and f"{len(before)} of them done" in again.stdout, f"taken up: {again.stdout}{again.stderr}")
    expect(all(os.stat(path).st_mtime_ns == stamp for path, stamp in before.items()), "runs that were done were done again")
    for name in ("table.csv", "means.csv", "fits.csv"):
        texts = [open(os.path.join(folder, out, name), "rb").read() for out in ("whole", "left")]
        expect(texts[0] == texts[1], f"{name} differs from that of a study that was left alone")
    with open(os.path.join(left, "table.csv"), encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    expect([row["status"] for row in rows] == ["done"] * 8 + ["bad_input"] * 4 and "nu" in rows[8]["reason"], f"outcomes: {[row['status'] for row in rows]}")
    with open(os.path.join(left, "means.csv"), encoding="utf-8", newline="") as file:
        means = list(csv.DictReader(file))
    values = [float(row["most"]) for row in rows[:4]]
    mean = sum(values) / 4
    deviation = (sum((value - mean) ** 2 for value in values) / 3) ** 0.5
    expect(len(means) == 2 and means[0]["n"] == "4" and abs(float(means[0]["mean"]) / mean - 1) < 1e-12
           and abs(float(means[0]["deviation"]) / deviation - 1) < 1e-6 and abs(float(means[0]["confidence"]) / (3.182 * deviation / 2) - 1) < 1e-6, f"means: {means}")
    with open(os.path.join(folder, "scene.yaml"), "w", encoding="utf-8") as file:
        file.write(SCENE.replace("1500", "1400"))
    other = subprocess.run(command(folder, "left") + ["--now"], capture_output=True, text=True)
    expect("study: 12 runs, 0 of them done" in other.stdout, "runs of another scene were taken for those of this one")
for failure in FAILURES:
    print("study: " + failure)
sys.exit(1 if FAILURES else 0)
