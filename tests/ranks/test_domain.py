"""A domain file under ranks: the bytes of a run that builds the same, and nobody holds what is in the file: neither a rank, nor the plain
program, nor the memory that ranks share. A body that is moved is read; a file that is cut off ends the run with one sentence. The same
where the domain is built and memory spills to a disk (BRECCIA_SPILL)."""
import filecmp
import os
import subprocess
import sys
import tempfile
import under

PROGRAM = under.need("bin/breccia-mpi")
PLAIN = os.environ["BRC_PROGRAM"]
SCENE = os.path.join(os.environ["BRC_SOURCE_DIR"], "examples/plate-impact/scene.yaml")
CELLS = ["--set", "bodies.plate.fill.noisy_grid.elements=15000"]
SHORT = ["--set", "stages.hit.solver.dynamic.duration=0.05 us", "--set", "output.frames=1", "--set", "output.picture=false", "--set",
         "output.checkpoint.every=1e9 s"]
POLYHEDRON = 1500  # bytes a cell of contact's polyhedra, which ranks share, at most (docs/ranks.md: 1.4 kB)
FAILURES = []


def expect(condition, sentence):
    print(sentence)
    if not condition:
        FAILURES.append(sentence)


def start(command, **more):
    """Most bytes of a process: its own where it is the plain program, else what is shared in memory."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                               env=dict(os.environ, OMP_NUM_THREADS="1", **more))
    most = under.held(process) if command[0] == PLAIN else under.watch(process, ["Pss_Shmem"])["Pss_Shmem"]
    assert process.returncode == 0, process.stderr.read()
    return most


def run(n, folder, scene, *words, **more):
    command = [PLAIN] if n == 1 else under.LAUNCH + ["-n", str(n), PROGRAM]
    return start([*command, "run", scene, "-o", folder, *words, *SHORT], **more)


def same(one, other):
    _, different, missing = filecmp.cmpfiles(one, other, ["histories.csv", "cracks.csv", "fragments.csv"], shallow=False)
    expect(not different and not missing, f"{other}: {'same bytes as' if not different + missing else 'others than'} {one}")


def from_file(scene, more=""):
    """The scene with the plate from plate.h5."""
    before, rest = scene.split("    shape:\n      box", 1)
    return f"{before}    domain: plate.h5\n{more}    material: alumina" + rest.split("    material: alumina", 1)[1]


def quiet(scene):
    """The scene without the ball and contact, whose polyhedra the ranks of a machine share."""
    before, rest = scene.split("interactions:", 1)
    sensors, rest = rest.split("stages:", 1)[1].split("  force:\n", 1)
    return f"{before}stages:{sensors}  broken:{rest.split('  broken:', 1)[1]}"


def write(name, text):
    with open(name, "w", encoding="utf-8") as file:
        file.write(text)


with tempfile.TemporaryDirectory() as temporary:
    os.chdir(temporary)
    with open(SCENE, encoding="utf-8") as opened:
        text = opened.read()
    subprocess.run([PLAIN, "build", SCENE, "-o", "plate.h5", *CELLS], check=True, capture_output=True)
    whole = os.path.getsize("plate.h5")
    write("file.yaml", from_file(text))
    write("moved.yaml", from_file(text, "    pose: {translation: [0.1 mm, 0, 0]}\n"))
    built = run(1, "built", SCENE, *CELLS)
    read = run(1, "read", "file.yaml")
    same("built", "read")
    saved = (built - read) / whole
    expect(saved > 0.8, f"the plain program holds {saved:.2f} of the file less than where it builds (0.8 asked)")
    ranks = run(3, "read-3", "file.yaml")
    same("built", "read-3")
    most = 0.1 + POLYHEDRON * 15000 / 3 / whole
    expect(ranks < most * whole, f"3 ranks share {ranks / whole:.3f} of it beside polyhedra ({most:.3f} asked, 0.1 without them)")
    write("quiet.yaml", quiet(from_file(text)))
    ranks = run(3, "quiet-3", "quiet.yaml")
    expect(ranks < 0.1 * whole, f"3 ranks share {ranks / whole:.3f} of it in memory (0.1 asked)")
    run(3, "machines-3", SCENE, *CELLS, BRECCIA_RANKS_MACHINES="3")
    same("built", "machines-3")
    os.mkdir("spill")
    spills = {"BRECCIA_SPILL": os.path.abspath("spill")}
    build = start([PLAIN, "build", SCENE, "-o", "again.h5", *CELLS], **spills)
    expect(filecmp.cmp("plate.h5", "again.h5", shallow=False) and build < 0.5 * whole,
           f"a domain that spills while it is built: {build / whole:.2f} of the file is held (0.5 asked)")
    spilled = run(2, "spilled-2", SCENE, *CELLS, **spills)
    same("built", "spilled-2")
    expect(spilled < 0.1 * whole and not os.listdir("spill"), "ranks that build and spill share none of it in memory")
    run(1, "moved", "moved.yaml")
    run(2, "moved-2", "moved.yaml")
    same("moved", "moved-2")
    os.truncate("plate.h5", whole // 2)
    process = under.start(2, [PROGRAM, "run", "file.yaml", "-o", "cut"])
    errors = process.communicate(timeout=60)[1]
    expect(process.returncode == 2 and "plate.h5" in errors and errors.count("\n") <= 2, f"a file that is cut off: {errors.strip()}")
for failure in FAILURES:
    print("domain: " + failure)
sys.exit(1 if FAILURES else 0)
