"""`breccia study`: killed twice and taken up, and done by the tasks of an array job, it ends with the bytes of one that was
left alone; one run that fails leaves the others."""

import csv
import glob
import math
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
    fill: {noisy_grid: {cells: [5, 5, 5], spread: 90 %, seed: 1}}
    material: glass
stages:
  - name: burst
    solver: {dynamic: {steps: 250}}
    initial: [velocity: {gradient: {x: [2e-3 1/s, 5e-4 1/s, 0]}}]
sensors:
  elastic: {energy: elastic}
measure:
  most: {peak: {of: elastic}}
output: {frames: 1, picture: false}
"""
STUDY = """scene: scene.yaml
vary:
  - {key: materials.glass.nu, values: [0.1, 0.3, 7]}
  - {key: bodies.0.fill.noisy_grid.seed, from: 1, to: 20, average: true}
fit:
  - {weibull: most}
  - {power: most, by: materials.glass.nu}
  - {fragments: power, elements: 1, above: 1e-3}
"""
FAILURES = []


def expect(condition, sentence):
    if not condition:
        FAILURES.append(sentence)


def command(folder, out):
    return [
        PROGRAM,
        "study",
        os.path.join(folder, "study.yaml"),
        "-o",
        os.path.join(folder, out),
        "--jobs",
        "2",
        "--device",
        "cpu",
    ]


def is_done(path):
    """A run that is taken up again removes its summary, maybe between our finding and opening it."""
    try:
        with open(path, encoding="utf-8") as file:
            return '"status": "done"' in file.read()
    except FileNotFoundError:
        return False


def done(folder):
    """Runs that have come to their end."""
    return sum(is_done(path) for path in glob.glob(os.path.join(folder, "*/summary.json")))


def kill_after(line, folder, n):
    child = subprocess.Popen(line + ["--now"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while child.poll() is None and done(folder) < n:
        time.sleep(0.005)
    expect(child.poll() is None, f"the study ended before it could be killed, with {child.returncode}")
    child.send_signal(signal.SIGKILL)
    child.wait()


TABLES = ("table.csv", "means.csv", "fits.csv")
RUNS, REFUSED = 40, 20


def read(path):
    with open(path, "rb") as file:
        return file.read()


def rows_of(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def killed_twice(folder):
    left = os.path.join(folder, "left")
    for n in (8, 20):
        kill_after(command(folder, "left"), left, n)
    before = {
        path: os.stat(path).st_mtime_ns
        for path in glob.glob(os.path.join(left, "*/summary.json"))
        if b'"status": "done"' in read(path)
    }
    expect(20 <= len(before) < RUNS, f"{len(before)} runs were done when it was killed")
    again = subprocess.run(command(folder, "left") + ["--now"], capture_output=True, text=True)
    expect(
        again.returncode == 0 and f"{len(before)} of them done" in again.stdout,
        f"taken up: {again.stdout}{again.stderr}",
    )
    expect(
        all(os.stat(path).st_mtime_ns == stamp for path, stamp in before.items()), "runs that were done were done again"
    )
    for name in TABLES:
        expect(
            read(os.path.join(left, name)) == read(os.path.join(folder, "whole", name)),
            f"{name} differs from that of a study that was left alone",
        )


SBATCH = """#!/bin/sh
# Stands in for Slurm's: a copy of the script as Slurm makes one, a process a task with its number in the environment, so
# many at once as the script says, the last number first, then the first ten again: a task is not run beside itself.
for script; do :; done
cp "$script" "$TMPDIR/copy.sh"
last=$(sed -n 's/^#SBATCH --array=0-\\([0-9]*\\)%.*/\\1/p' "$script")
at_once=$(sed -n 's/^#SBATCH --array=.*%//p' "$script")
log=$(sed -n 's/^#SBATCH --output="\\(.*\\)%a.txt"$/\\1/p' "$script")
[ "$1" = --wait ] && [ -n "$last" ] && [ -n "$at_once" ] && [ -n "$log" ] || exit 1
for tasks in "$last -1 0" "0 9"; do
    seq $tasks | xargs -P "$at_once" -I @ sh -c \\
        "SLURM_ARRAY_TASK_ID=@ sh '$TMPDIR/copy.sh' >'${log}@.txt' 2>&1 || exit 255" || exit 1
done
"""


def array_job(folder):
    """The line that `--slurm` prints, pasted into a shell whose `sbatch` is the one above."""
    out = os.path.join(folder, "array")
    wrote = subprocess.run(command(folder, "array") + ["--slurm"], capture_output=True, text=True)
    script = os.path.join(out, "slurm.sh")
    directives = [line for line in read(script).decode().splitlines() if line.startswith("#SBATCH")]
    expect(
        wrote.returncode == 0 and "sbatch --wait" in wrote.stdout and len(os.listdir(out)) == 1,
        f"--slurm: {wrote.stdout}{wrote.stderr}{os.listdir(out)}",
    )
    expect(
        f"#SBATCH --array=0-{RUNS + REFUSED - 1}%2" in directives and "#SBATCH --cpus-per-task=1" in directives,
        f"directives: {directives}",
    )
    for k in range(30, 34):
        one = {**os.environ, "SLURM_ARRAY_TASK_ID": str(k)}
        task = subprocess.run(["sh", script], capture_output=True, text=True, env=one)
        expect(task.returncode == 0, f"task {k}: {task.stdout}{task.stderr}")
    expect(not glob.glob(os.path.join(out, "*.csv")), "a task wrote tables")
    early = subprocess.run(command(folder, "array") + ["--collect"], capture_output=True, text=True)
    states = [row["status"] for row in rows_of(os.path.join(out, "table.csv"))]
    expect(
        early.returncode == 0 and states[:30] == ["missing"] * 30 and states[30:34] == ["done"] * 4,
        f"collected early: {states}",
    )
    programs = os.path.join(folder, "bin")
    os.mkdir(programs)
    with open(os.path.join(programs, "sbatch"), "w", encoding="utf-8") as file:
        file.write(SBATCH)
    os.chmod(os.path.join(programs, "sbatch"), 0o755)
    path = os.pathsep.join((programs, os.path.dirname(PROGRAM), os.environ["PATH"]))
    printed = wrote.stdout.strip().splitlines()[-1].split(": ", 1)[1]
    environment = {**os.environ, "PATH": path, "TMPDIR": folder}
    collected = subprocess.run(
        printed.replace("; ", " && "), shell=True, capture_output=True, text=True, env=environment
    )
    logs = glob.glob(os.path.join(out, "slurm-*.txt"))
    expect(len(logs) == RUNS + REFUSED, f"{len(logs)} tasks left a log")
    expect(
        collected.returncode == 0 and f"{RUNS} of {RUNS + REFUSED} runs are done" in collected.stdout,
        f"collected: {collected.stdout}{collected.stderr}",
    )
    for name in TABLES:
        expect(
            read(os.path.join(out, name)) == read(os.path.join(folder, "whole", name)),
            f"{name} differs from that of a study without an array job",
        )
    alone = subprocess.run(
        ["sh", script],
        capture_output=True,
        text=True,
        env={key: value for key, value in os.environ.items() if key != "SLURM_ARRAY_TASK_ID"},
    )
    expect(alone.returncode != 0 and "SLURM_ARRAY_TASK_ID" in alone.stderr, "the script ran without a task's number")
    for wrong in ("3", "4/4", "-1/4", "1/2x"):
        refused = subprocess.run(command(folder, "array") + [f"--task={wrong}"], capture_output=True, text=True)
        expect(
            refused.returncode == 2 and "expected K/N" in refused.stderr,
            f"--task {wrong}: {refused.returncode} {refused.stderr}",
        )


def tables(folder):
    rows = rows_of(os.path.join(folder, "whole", "table.csv"))
    expect(
        [row["status"] for row in rows] == ["done"] * RUNS + ["bad_input"] * REFUSED and "nu" in rows[RUNS]["reason"],
        f"outcomes: {[row['status'] for row in rows]}",
    )
    means = rows_of(os.path.join(folder, "whole", "means.csv"))
    values = [float(row["most"]) for row in rows[:20]]
    mean = sum(values) / 20
    deviation = (sum((value - mean) ** 2 for value in values) / 19) ** 0.5
    expect(
        len(means) == 2
        and means[0]["n"] == "20"
        and abs(float(means[0]["mean"]) / mean - 1) < 1e-12
        and abs(float(means[0]["deviation"]) / deviation - 1) < 1e-6
        and abs(float(means[0]["confidence"]) / (2.093 * deviation / 20**0.5) - 1) < 1e-6,
        f"means: {means}",
    )
    fits = rows_of(os.path.join(folder, "whole", "fits.csv"))
    found = [(row["law"], row["materials.glass.nu"], row["parameter"]) for row in fits]
    weibull = [
        ("weibull", nu, name)
        for nu in ("0.1", "0.3", "7")
        for name in (("modulus", "unbiased_modulus", "scale") if nu != "7" else ("no fit",))
    ]
    expect(
        found[:7] == weibull and found[7:9] == [("power", "", "exponent"), ("power", "", "factor")], f"fits: {found}"
    )
    pieces = [row for row in fits if row["law"] == "fragments power" and row["materials.glass.nu"] == "0.1"]
    expect([row["parameter"] for row in pieces] == ["exponent", "lower_cut", "distance"], f"fragments: {pieces}")
    shares = []
    for run in range(20):
        fragments = rows_of(os.path.join(folder, "whole", f"{run:05d}", "fragments.csv"))
        masses = [float(row["mass [kg]"]) for row in fragments if row["frame"] == fragments[-1]["frame"]]
        shares += [mass / sum(masses) for mass in masses]
    tail = [math.log(share / 1e-3) for share in shares if share >= 1e-3]
    expect(
        int(pieces[0]["n"]) == len(tail) and abs(float(pieces[0]["value"]) - 1 - len(tail) / sum(tail)) < 1e-6,
        f"fragments: {pieces}, not {1 + len(tail) / sum(tail)} of {len(tail)}",
    )


with tempfile.TemporaryDirectory() as folder:
    for name, text in (("scene.yaml", SCENE), ("study.yaml", STUDY)):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    whole = subprocess.run(command(folder, "whole"), capture_output=True, text=True)
    expect(
        whole.returncode == 0
        and f"study: {RUNS + REFUSED} runs, 0 of them done, {REFUSED} refused" in whole.stdout
        and f"budget: {RUNS} runs of about" in whole.stdout
        and f"{RUNS} of {RUNS + REFUSED} runs are done" in whole.stdout,
        f"exit code {whole.returncode}: {whole.stdout}{whole.stderr}",
    )
    with open(os.path.join(folder, "whole", "most.png"), "rb") as file:
        expect(file.read(8) == b"\x89PNG\r\n\x1a\n", "most.png is no picture")
    tables(folder)
    killed_twice(folder)
    array_job(folder)
    with open(os.path.join(folder, "scene.yaml"), "w", encoding="utf-8") as file:
        file.write(SCENE.replace("steps: 250", "steps: 200"))
    other = subprocess.run(command(folder, "left") + ["--collect"], capture_output=True, text=True)
    expect("0 of them done" in other.stdout, "runs of another scene were taken for those of this one")
for failure in FAILURES:
    print("study: " + failure)
sys.exit(1 if FAILURES else 0)
