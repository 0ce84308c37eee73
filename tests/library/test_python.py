"""The Python package with pytest, against the library of this build: with the first interpreter here that has what its tests need."""
import os
import subprocess
import sys

SOURCE, BUILD = os.environ["BRC_SOURCE_DIR"], os.environ["BRC_BUILD_DIR"]
NEEDED = "import numpy, pandas, h5py, pytest"


def has_all(python):
    try:
        return subprocess.run([python, "-c", NEEDED], capture_output=True).returncode == 0
    except OSError:
        return False


with open(os.path.join(BUILD, "CMakeCache.txt"), encoding="utf-8") as file:
    if "BRC_SANITIZE:BOOL=ON" in file.read():
        print("python: the sanitizer's runtime must come first in a program, and Python is not built with it; the library is tested in C there")
        sys.exit(0)
library = os.path.join(BUILD, "lib", "libbreccia.so")
if not os.path.exists(library):
    sys.exit("python: libbreccia.so is not built")
pythons = [python for python in (sys.executable, "/usr/bin/python3") if has_all(python)]
if not pythons:
    print("python: no interpreter has numpy, pandas, h5py and pytest (Debian: python3-numpy python3-pandas python3-h5py python3-pytest)")
    sys.exit(1 if os.environ.get("BRC_NO_SKIPS") else 77)
environment = dict(os.environ, PYTHONPATH=os.path.join(SOURCE, "python", "src"), BRECCIA_LIBRARY=library, PYTHONDONTWRITEBYTECODE="1")
tests = os.path.join(SOURCE, "python", "tests")
ran = subprocess.run([pythons[0], "-m", "pytest", "-q", "-p", "no:cacheprovider", "--ignore", os.path.join(tests, "extras"), tests], env=environment)
sys.exit(ran.returncode)
