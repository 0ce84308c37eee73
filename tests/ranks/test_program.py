"""breccia-mpi: one rank has the bytes of the plain program, several answer once, and what cannot run on them is refused."""
import filecmp
import json
import os
import re
import subprocess
import sys
import tempfile
import under

PROGRAM = under.need("bin/breccia-mpi")
PLAIN = os.environ["BRC_PROGRAM"]
SCENE = os.path.join(os.environ["BRC_SOURCE_DIR"], "examples/beams-fracture/scene.yaml")
SMALL = ["--set", "bodies.0.fill.packing.elements=500", "--threads", "1"]
FAILURES = []


def expect(condition, sentence):
    if not condition:
        FAILURES.append(sentence)


def ranks(n, *arguments):
    process = under.start(n, [PROGRAM, *arguments])
    output, errors = process.communicate(timeout=300)
    return process.returncode, output, errors


def frames(folder):
    return sorted(os.path.join("frames", name) for name in os.listdir(os.path.join(folder, "frames")))


def one_rank(folder):
    plain, one = os.path.join(folder, "plain"), os.path.join(folder, "one")
    subprocess.run([PLAIN, "run", SCENE, "-o", plain, *SMALL], check=True, capture_output=True)
    code, _, errors = ranks(1, "run", SCENE, "-o", one, *SMALL)
    expect(code == 0, f"one rank: exit code {code}: {errors}")
    files = ["histories.csv", "cracks.csv", "fragments.csv"] + frames(plain)
    expect(frames(one) == frames(plain) and len(files) > 5, f"one rank wrote other frames: {frames(one)}")
    _, different, missing = filecmp.cmpfiles(plain, one, files, shallow=False)
    expect(not different and not missing, f"one rank: different {different}, missing {missing}")


def several(folder):
    code, output, errors = ranks(3, "--version")
    expect(code == 0 and output.count("breccia ") == 1 and not errors, f"version: {code} {output} {errors}")
    code, output, errors = ranks(3, "calibrate", SCENE)
    expect(code == 2 and not output and errors == "rank 0: breccia calibrate does not run on 3 ranks; start one\n",
           f"a command that does not run on ranks: {code} {output} {errors}")
    plain, two = os.path.join(folder, "plain"), os.path.join(folder, "two")
    code, output, errors = ranks(2, "run", SCENE, "-o", two, *SMALL)
    expect(code == 0 and output.count("result.h5") == 1, f"run: {code} {output} {errors}")
    expect(frames(two) == frames(plain), f"two ranks wrote other frames: {frames(two)}")
    _, different, missing = filecmp.cmpfiles(plain, two, ["histories.csv", "cracks.csv", "fragments.csv"] + frames(plain), shallow=False)
    expect(not different and not missing, f"two ranks: different {different}, missing {missing}")


def bench(folder):
    code, output, errors = ranks(2, "bench", "ranks", "-o", folder)
    with open(os.path.join(folder, "rows.json"), encoding="utf-8") as file:
        rows = json.load(file)
    kinds = [row["quantity"] for row in rows]
    expect(code == 0 and output.count("rows.json") == 1, f"bench ranks: {code} {output} {errors}")
    expect(kinds.count("exchange") == 6 and {"gather", "reduce", "barrier"} < set(kinds), f"bench ranks: rows {kinds}")
    expect(all(row["ranks"] == 2 and row["seconds"] > 0 and "MPI" in row["engine"] for row in rows), f"bench ranks: {rows}")
    code, _, errors = ranks(2, "bench", "ranks", "--problems", "surface", "-o", folder)
    expect(code == 2 and "one process" in errors, f"surfaces on two ranks: {code} {errors}")
    subprocess.run([PLAIN, "bench", "ranks", "--problems", "surface,step", "--sizes", "9000", "--steps", "2", "-o", folder],
                   check=True, capture_output=True)
    with open(os.path.join(folder, "rows.json"), encoding="utf-8") as file:
        rows = json.load(file)
    expect([row["ranks"] for row in rows] == [2, 4, 8, 1], f"surfaces: {rows}")
    for row in rows[:3]:  # ghosts of a rank are rows of others, at least those of one of its faces
        own, others = row["rows_per_rank"], row["elements"] - row["rows_per_rank"]
        expect(own ** (2 / 3) < row["ghosts_per_rank"] <= row["ghosts_most"] < others, f"ghosts: {row}")
        expect(1 <= row["neighbours_most"] < row["ranks"] and 0 < row["inside_least"] < 1 and 0 <= row["meanwhile_least"] <= row["inside_least"], f"neighbours: {row}")
        expect(row["exchanged_bytes_most"] == 240 * row["ghosts_most"], f"bytes: {row}")


def check():
    """What `check --ranks` tells: seconds of steps and memory fall, those of all ranks stay."""
    small = ["--brief", "--threads", "1"]
    scene = os.path.join(os.environ["BRC_SOURCE_DIR"], "examples/tension-dynamic/scene.yaml")
    told = {}
    for n in (2, 8):
        done = subprocess.run([PLAIN, "check", scene, *small, "--ranks", str(n)], capture_output=True, text=True, check=False)
        found = re.search(rf"on {n} ranks, each .*?: ([\d.e+-]+) s, of these ([\d.e+-]+) s in steps, and of these ([\d.e+-]+) s in messages.*\n"
                          rf"on {n} ranks, memory: ([\d.]+) MB a rank .* and ([\d.]+) MB once a machine.*: ([\d.]+) % of the bonds, (\d+) rows of (\d+) other", done.stdout)
        resident = re.search(r"([\d.]+) MB resident", done.stdout)
        expect(done.returncode == 0 and found and resident, f"check on {n} ranks: {done.returncode} {done.stdout} {done.stderr}")
        if found:
            told[n] = [float(word) for word in found.groups()]
            seconds, steps, messages, own, once, share, rows, others = told[n]
            expect(seconds > steps > messages > 0 and own + once < float(resident.group(1)), f"check on {n} ranks: {told[n]}")
            expect(abs(share * n / 100 - 1) < 0.05 and rows > 100 and 1 <= others < n, f"check on {n} ranks: {told[n]}")
    if len(told) == 2:
        expect(told[8][3] < told[2][3] and told[8][7] > told[2][7], f"check: {told}")
    for wrong, said in ((["--ranks", "0"], "from 1 to 4096"), (["--ranks", "5000"], "from 1 to 4096"), (["--ranks", "two"], "from 1 to 4096"),
                        (["--ranks", "2", "--estimate"], "leave out --estimate")):
        done = subprocess.run([PLAIN, "check", scene, *wrong], capture_output=True, text=True, check=False)
        expect(done.returncode == 2 and said in done.stderr, f"check {wrong}: {done.returncode} {done.stderr}")


with tempfile.TemporaryDirectory() as temporary:
    check()
    one_rank(temporary)
    several(temporary)
    bench(temporary)
for failure in FAILURES:
    print("program: " + failure)
sys.exit(1 if FAILURES else 0)
