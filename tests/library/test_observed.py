"""Examples, made small, run by the program, looked at from Python every few steps, and stepped by hand: the same bytes.

    test_observed.py              what ctest runs: contact, several models, events
    test_observed.py --all        every example
"""
import filecmp
import glob
import os
import subprocess
import sys
import tempfile

SOURCE, BUILD = os.path.abspath(os.environ.get("BRC_SOURCE_DIR", ".")), os.path.abspath(os.environ.get("BRC_BUILD_DIR", "build/release"))
FEW = ["sphere-on-wall", "sliding-blocks", "two-models", "cells-events"]
NEEDED = "import numpy"


def files_of(folder):
    patterns = ("histories.csv", "cracks.csv", "fragments.csv", "frames/*", "result.h5")
    return sorted(os.path.relpath(path, folder) for pattern in patterns for path in glob.glob(os.path.join(folder, pattern)))


def differing(one, other):
    """Files of two results that are not the same bytes."""
    names = files_of(one)
    if names != files_of(other):
        return sorted(set(names) ^ set(files_of(other)))
    return [name for name in names if not filecmp.cmp(os.path.join(one, name), os.path.join(other, name), shallow=False)]


def look(run):
    for part in range(run.n_parts):
        run.array("stress", part)
        run.array("velocity", part)
    run.sensors()
    run.bonds


def observed(path, sets, folder):
    import breccia
    looks = []
    scene = breccia.Scene.load(path, set=sets)
    scene.run(folder, observers=[breccia.Observer(lambda run: looks.append(look(run)), steps=7)], device="cpu", threads=1, progress=lambda moment: None)
    return len(looks)


def by_hand(path, sets, folder):
    import breccia
    calls = 0
    with breccia.Scene.load(path, set=sets).start(folder, device="cpu", threads=1) as run:
        while run.step(13):
            look(run)
            calls += 1
    return calls


def main():
    sys.path[:0] = [os.path.join(SOURCE, "tests", "commands"), os.path.join(SOURCE, "python", "src")]
    import test_resume
    program = os.environ.get("BRC_PROGRAM", os.path.join(BUILD, "bin", "breccia"))
    names = FEW if "--all" not in sys.argv else sorted(os.path.basename(os.path.dirname(path)) for path in glob.glob(f"{SOURCE}/examples/*/scene.yaml"))
    failures = []
    for name in names:
        lines = [*test_resume.overrides(name), "output.history_every=60"]  # samples end batches: there shall be steps between
        sets = {line.split("=", 1)[0]: value_of(line.split("=", 1)[1]) for line in lines}
        path = test_resume.scene_of(name)
        with tempfile.TemporaryDirectory() as folder:
            alone, watched, stepped = (os.path.join(folder, kind) for kind in ("alone", "watched", "stepped"))
            subprocess.run([program, "run", path, "-o", alone, "--device", "cpu", "--threads", "1", *(word for line in lines for word in ("--set", line))],
                           check=True, capture_output=True)
            counts = observed(path, sets, watched), by_hand(path, sets, stepped)
            found = [f"{kind}: {differing(alone, os.path.join(folder, kind))}" for kind in ("watched", "stepped") if differing(alone, os.path.join(folder, kind))]
            print(f"{name}: {len(files_of(alone))} files, {counts[0]} looks, {counts[1]} times by hand: {'; '.join(found) or 'the same bytes'}", flush=True)
            failures += [name] if found or len(files_of(alone)) < 2 or not all(counts) else []
    return 1 if failures else 0


def value_of(text):
    """Of an override: a list, or a word."""
    return [float(one) if "." in one else int(one) for one in text.strip("[]").split(",")] if text.startswith("[") else text


if __name__ == "__main__":
    os.environ.setdefault("BRECCIA_LIBRARY", os.path.join(BUILD, "lib", "libbreccia.so"))
    with open(os.path.join(BUILD, "CMakeCache.txt"), encoding="utf-8") as cache:
        if "BRC_SANITIZE:BOOL=ON" in cache.read():
            print("observed: the sanitizer's runtime must come first in a program, and Python is not built with it")
            sys.exit(0)
    try:
        import numpy  # noqa: F401
    except ImportError:
        if sys.executable != "/usr/bin/python3" and subprocess.run(["/usr/bin/python3", "-c", NEEDED], capture_output=True).returncode == 0:
            os.execv("/usr/bin/python3", ["/usr/bin/python3", "-B", *sys.argv])
        print("observed: NumPy is missing (Debian: python3-numpy)")
        sys.exit(1 if os.environ.get("BRC_NO_SKIPS") else 77)
    sys.exit(main())
