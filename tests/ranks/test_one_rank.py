"""One rank of breccia-mpi does what the plain program does, with at most 2 % more: instructions of a step, which do not depend on what else
the machine does, as the difference of a longer and a shorter run. Cubes of 216 cells: what ranks would add to a launch weighs most there."""
import concurrent.futures
import os
import re
import shutil
import subprocess
import sys
import tempfile
import under

PROGRAMS = {"plain": os.environ["BRC_PROGRAM"], "one rank": under.need("bin/breccia-mpi")}
SCENES = os.path.join(os.environ["BRC_SOURCE_DIR"], "tests", "stability")
STEPS = (20, 100)
WHAT = {"free": "elastic", "dust": "every bond breaks", "impact": "contact with a wall"}
BOUND = 0.02


def instructions(program, scene, steps):
    """All that the process executes; v2: valgrind knows no AVX-512."""
    environment = dict(os.environ, BRECCIA_ISA="v2", OMP_NUM_THREADS="1", OMP_WAIT_POLICY="passive", OPENBLAS_NUM_THREADS="1")
    with tempfile.TemporaryDirectory() as folder:
        line = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", program, "run", f"{SCENES}/{scene}.yaml", "-o", folder,
                "--device", "cpu", "--threads", "1", "--set", f"stages.0.solver.dynamic.steps={steps}"]
        done = subprocess.run(line, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return int(re.search(r"Collected : (\d+)", done.stderr).group(1))


if not shutil.which("valgrind"):
    print("SKIPPED: valgrind is missing: Debian package valgrind")
    sys.exit(1 if os.environ.get("BRC_NO_SKIPS") else 77)
cases = [(name, scene, steps) for scene in WHAT for name in PROGRAMS for steps in STEPS]
with concurrent.futures.ThreadPoolExecutor(2) as pool:
    counts = dict(zip(cases, pool.map(lambda case: instructions(PROGRAMS[case[0]], *case[1:]), cases)))
failures = 0
for scene, what in WHAT.items():
    plain, one = ((counts[name, scene, STEPS[1]] - counts[name, scene, STEPS[0]]) / (STEPS[1] - STEPS[0]) for name in PROGRAMS)
    print(f"{what}: {plain:.0f} instructions a step, one rank of breccia-mpi {one / plain - 1:+.2%} (at most {BOUND:.0%})")
    failures += one > (1 + BOUND) * plain
sys.exit(1 if failures else 0)
