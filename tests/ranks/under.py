"""Programs under mpirun, for the tests of this folder."""
import os
import shutil
import subprocess
import sys

BUILD = os.environ["BRC_BUILD_DIR"]
LAUNCH = ["mpirun", "--allow-run-as-root", "--quiet", "--oversubscribe", "--bind-to", "none"]


def need(program):
    """The path of a program of the build; without it the test is skipped, which is a failure where nothing may be."""
    path = os.path.join(BUILD, program)
    if not shutil.which("mpirun") or not os.path.exists(path):
        print(f"{program} or mpirun is missing: Debian packages libopenmpi-dev, openmpi-bin")
        sys.exit(1 if os.environ.get("BRC_NO_SKIPS") else 77)
    return path


def start(n, command, delay_us=0, **more):
    """Popen of a command on n ranks; more: variables of the environment."""
    environment = dict(os.environ, OMP_NUM_THREADS="1", BRECCIA_RANKS_DELAY_US=str(delay_us), **more)
    return subprocess.Popen(LAUNCH + ["-n", str(n)] + command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            text=True, env=environment)
