"""A scene run by the program, and what its sensors read."""
import csv
import os
import subprocess

PROGRAM = os.path.abspath(os.environ.get("BRC_PROGRAM", "build/bin/breccia"))


def run(folder, name, scene):
    """Columns of histories.csv by sensor, and what the program said."""
    path, out = os.path.join(folder, name + ".yaml"), os.path.join(folder, name)
    with open(path, "w", encoding="utf-8") as file:
        file.write("version: 1\noutput: {frames: none, picture: false, history_every: 50}\n" + scene)
    done = subprocess.run([PROGRAM, "run", path, "-o", out, "--device", "cpu"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        print(done.stdout)
        raise SystemExit(f"{name}: breccia run ended with {done.returncode}")
    with open(os.path.join(out, "histories.csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {key.split(" [")[0]: [float(row[key]) for row in rows] for key in rows[0] if key != "stage"}, done.stdout
