"""The wheel of this build in a virtual environment that has nothing else of breccia: a run, a table of pandas, a cut drawn by pyvista, views that share memory; types by
mypy --strict; and VTK's newest release, which comes with pyvista, on frames of every example (tests/commands/test_frames.py)."""
import glob
import os
import subprocess
import sys

SOURCE, BUILD = os.environ["BRC_SOURCE_DIR"], os.environ["BRC_BUILD_DIR"]
HOLDER = os.path.join(BUILD, "wheel-environment")  # kept between calls, the wheel is not
PYTHON = os.path.join(HOLDER, "bin", "python")
TESTS = ["extras", "test_results.py", "test_run.py::test_views_share_memory_with_the_library"]


def skipped(why):
    print("SKIPPED:", why)
    sys.exit(1 if os.environ.get("BRC_NO_SKIPS") else 77)


def run(*words, environment=None):
    return subprocess.run(words, capture_output=True, text=True, check=False, env=environment, cwd=HOLDER)


def need(ran):
    if ran.returncode != 0:
        sys.exit(" ".join(ran.args) + "\n" + ran.stdout[-3000:] + ran.stderr[-3000:])


def prepare():
    """The environment with the wheel and what its extra `all` names; the text of the wheel's name."""
    if subprocess.run([sys.executable, "-m", "venv", HOLDER], capture_output=True, check=False).returncode != 0:
        skipped("python3 -m venv fails; apt-get install python3-venv")
    pip = (PYTHON, "-m", "pip", "-q", "--disable-pip-version-check")
    ran = run(*pip, "install", "setuptools", "wheel", "pytest", "mypy", "pandas-stubs")
    if ran.returncode != 0:
        skipped("PyPI cannot be reached: " + (ran.stderr.strip().splitlines() or ["no message"])[-1])
    for old in glob.glob(os.path.join(HOLDER, "breccia-*.whl")):
        os.remove(old)
    need(run(*pip, "wheel", "--no-deps", "--no-build-isolation", "-w", HOLDER, os.path.join(SOURCE, "python"), environment=dict(os.environ, BRECCIA_BUILD=BUILD)))
    wheel, = glob.glob(os.path.join(HOLDER, "breccia-*.whl"))
    need(run(*pip, "install", "--force-reinstall", "--no-deps", wheel))
    need(run(*pip, "install", wheel + "[all]"))
    return os.path.basename(wheel)


with open(os.path.join(BUILD, "CMakeCache.txt"), encoding="utf-8") as file:
    if "BRC_SANITIZE:BOOL=ON" in file.read():
        print("wheel: the sanitizer's runtime must come first in a program, and Python is not built with it")
        sys.exit(0)
print(prepare(), flush=True)
own = {key: value for key, value in os.environ.items() if key not in ("BRECCIA_LIBRARY", "BRECCIA_PROGRAM", "PYTHONPATH")}
tests = os.path.join(SOURCE, "python", "tests")
failed = subprocess.run([PYTHON, "-B", "-m", "pytest", "-q", "-p", "no:cacheprovider", *(os.path.join(tests, name) for name in TESTS)], env=own, cwd=HOLDER).returncode
failed |= subprocess.run([PYTHON, "-m", "mypy", "--strict", "--cache-dir", os.devnull, os.path.join(SOURCE, "python", "src")], cwd=HOLDER).returncode
failed |= subprocess.run([PYTHON, "-B", os.path.join(SOURCE, "tests", "commands", "test_frames.py"), "--all"], cwd=HOLDER).returncode
sys.exit(1 if failed else 0)
