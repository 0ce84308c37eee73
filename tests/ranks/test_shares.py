"""What each rank has and sends, of a plate that a ball strikes: on two ranks the bytes of one, at most 0.6 of its memory, and no more
numbers than the surface between their rows has.

Sizes: sums are of blocks that belong to one rank each where there are 4 blocks a rank or more (host/device/shares_rows.c): 8192 rows
of any instruction set, 16 384 where groups of two rows are summed up. Memory: the plate of 1e5 cells, whose libraries and code (60 MB) are
a tenth of what two ranks have. Memory that ranks share counts once (proportional set size)."""
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
SCENE = os.path.join(os.environ["BRC_SOURCE_DIR"], "examples/plate-impact/scene.yaml")
FAILURES = []


def expect(condition, sentence):
    print(sentence)
    if not condition:
        FAILURES.append(sentence)


def line(folder, n_cells, duration):
    sets = [f"bodies.plate.fill.noisy_grid.elements={n_cells}", f"stages.hit.solver.dynamic.duration={duration}", "output.frames=1",
            "output.picture=false", "output.checkpoint.every=1e9 s"]
    return ["run", SCENE, "-o", folder, *[word for one in sets for word in ("--set", one)]]


def run(n, *arguments, environment=None, each=None):
    """Most memory of a rank [byte], or of each, most first, by a name of smaps_rollup; the run must end well."""
    command = [PLAIN, *arguments] if n == 1 else under.LAUNCH + ["-n", str(n), PROGRAM, *arguments]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                               env=dict(os.environ, OMP_NUM_THREADS=str(max(1, 3 - n)), **(environment or {})))
    most = under.watch_each(process, each) if each else under.watch(process, ["Pss"])["Pss"]
    assert process.returncode == 0, process.stderr.read()
    return most


def same(folder, n_cells, environment):
    for n in (1, 2):
        run(n, *line(f"{folder}/{n}", n_cells, "1 us"), environment=environment)
    files = ["histories.csv", "cracks.csv", "fragments.csv"]
    _, different, missing = filecmp.cmpfiles(f"{folder}/1", f"{folder}/2", files, shallow=False)
    with open(f"{folder}/1/summary.json", encoding="utf-8") as file:
        broken = json.load(file)["counts"]["broken"]
    expect(not different and not missing, f"{n_cells} cells, {environment or 'all sets'}: other {different + missing}" if different or missing
           else f"{n_cells} cells on 2 ranks: same bytes, {broken} bonds broken")


def of_others(folder):
    """What a rank holds for itself that writes no files: no polyhedra of contact, no outlines of cells, and of what is made ready or kept for
    a checkpoint its own rows."""
    alone, four = (run(n, *line(f"{folder}/others-{n}", 100000, "0.05 us"), each="Anonymous") for n in (1, 4))
    expect(four[1] <= 0.25 * alone[0], f"a rank of four that writes no files: {four[1] / alone[0]:.2f} of {alone[0] / 1e6:.0f} MB (0.25 asked)")


def memory(folder):
    one, two = (run(n, *line(f"{folder}/memory-{n}", 100000, "0.05 us")) for n in (1, 2))
    expect(two <= 0.6 * one, f"memory of a rank of two: {two / one:.2f} of {one / 1e6:.0f} MB (0.6 asked)")
    check = ["check", *line(f"{folder}/priced", 100000, "0.05 us")[1:2], *line("", 100000, "0.05 us")[4:], "--ranks", "2"]
    done = subprocess.run([PLAIN, *check], capture_output=True, text=True, check=True)
    own, once = (1e6 * float(word) for word in re.search(r"memory: ([\d.]+) MB a rank .* and ([\d.]+) MB once", done.stdout).groups())
    expect(two <= own + once / 2 < one, f"memory of a rank of two: {two / 1e6:.0f} MB, told before: {(own + once / 2) / 1e6:.0f} MB")


def sent():
    """Bytes of a step against the rows that the cut gives."""
    surface = subprocess.run([PLAIN, "bench", "ranks", "--problems", "surface", "--sizes", "20000"], capture_output=True, text=True, check=True)
    process = under.start(2, [PROGRAM, "bench", "ranks", "--problems", "step", "--sizes", "20000", "--steps", "20", "--threads", "1"])
    output, errors = process.communicate(timeout=300)
    assert process.returncode == 0, errors
    ghosts = int(re.search(r"surface +2 ranks.*?most +(\d+)\)", surface.stdout).group(1))
    sends = float(re.search(r"messages +(\d+) bytes", output).group(1))
    expect(abs(sends / (240 * ghosts) - 1) <= 0.2, f"a step sends {sends:.0f} bytes, {sends / (240 * ghosts):.3f} of what {ghosts} rows have (0.2 asked)")


def hidden():
    """Between ranks far from each other messages of 50 us fly while the inside is computed; the surface of half a cube leaves that much."""
    process = under.start(2, [PROGRAM, "bench", "ranks", "--problems", "step", "--sizes", "20000", "--steps", "20", "--threads", "1"], "0,50")
    output, errors = process.communicate(timeout=300)
    assert process.returncode == 0, errors
    messages, flight = (float(re.search(pattern, output).group(1)) for pattern in (r"([\d.]+) messages", r"in flight ([\d.e-]+) s"))
    expect(flight >= messages * 50e-6, f"{messages:.0f} messages a step fly {1e6 * flight:.0f} us while rows inside are computed")


with tempfile.TemporaryDirectory() as temporary:
    os.chdir(temporary)
    for k, (cells, chosen) in enumerate(((9000, {}), (17000, {"BRECCIA_ISA": "v2"}))):
        same(f"{temporary}/{k}", cells, chosen)
    memory(temporary)
    of_others(temporary)
    sent()
    hidden()
for failure in FAILURES:
    print("shares: " + failure)
sys.exit(1 if FAILURES else 0)
