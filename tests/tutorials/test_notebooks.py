"""python/notebooks: they are those of the pages, and every cell runs in an environment with the wheel of this build."""

import os
import subprocess
import sys
import tempfile
import time

import notebook
import page

SOURCE, BUILD = os.environ["BRC_SOURCE_DIR"], os.environ["BRC_BUILD_DIR"]
NEEDED = ["setuptools", "wheel", "nbclient", "nbformat", "ipykernel", "numpy", "pandas", "h5py", "matplotlib"]
HOLDER = os.path.join(BUILD, "notebooks")  # of the environment, kept between calls
EXECUTE = """
import sys, nbformat, nbclient
for path in sys.argv[1:]:
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3").execute()
    print(path, sum(cell.cell_type == "code" for cell in notebook.cells), "cells")
"""


def skipped(why):
    print("SKIPPED:", why)
    sys.exit(1 if os.environ.get("BRC_NO_SKIPS") else 77)


def pip(*words, **more):
    return subprocess.run(
        [os.path.join(HOLDER, "bin", "python"), "-m", "pip", "-q", "--disable-pip-version-check", "install", *words],
        capture_output=True,
        text=True,
        check=False,
        **more,
    )


def prepare():
    """The environment, with the package of this build."""
    if subprocess.run([sys.executable, "-m", "venv", HOLDER], capture_output=True, check=False).returncode != 0:
        skipped("python3 -m venv fails; apt-get install python3-venv")
    ran = pip(*NEEDED)
    if ran.returncode != 0:
        skipped("PyPI cannot be reached: " + (ran.stderr.strip().splitlines() or ["no message"])[-1])
    ran = pip(
        "--no-deps",
        "--no-build-isolation",
        "--force-reinstall",
        os.path.join(SOURCE, "python"),
        env=dict(os.environ, BRECCIA_BUILD=BUILD),
    )
    if ran.returncode != 0:
        sys.exit(ran.stdout + ran.stderr)


with open(os.path.join(BUILD, "CMakeCache.txt"), encoding="utf-8") as cache:
    if "BRC_SANITIZE:BOOL=ON" in cache.read():
        print("notebooks: the sanitizer's runtime must come first in a program, and Python is not built with it")
        sys.exit(0)
found = notebook.faults()
if found:
    sys.exit("\n".join(found))
prepare()
names = sys.argv[1:] or page.names()
environment = {
    key: value for key, value in os.environ.items() if key not in ("BRECCIA_LIBRARY", "BRECCIA_PROGRAM", "PYTHONPATH")
}
environment["PATH"] = os.path.join(HOLDER, "bin") + os.pathsep + environment["PATH"]
failed = []
for name in names:
    began = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        ran = subprocess.run(
            [os.path.join(HOLDER, "bin", "python"), "-c", EXECUTE, notebook.path_of(name)],
            cwd=folder,
            env=environment,
            capture_output=True,
            text=True,
            check=False,
        )
    print(f"{name}: {'runs' if ran.returncode == 0 else 'fails'}, {time.monotonic() - began:.0f} s", flush=True)
    if ran.returncode != 0:
        failed.append(f"{name}: {ran.stderr[-3000:]}")
sys.exit("\n".join(failed) if failed else 0)
