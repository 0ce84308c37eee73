"""Scenes on several ranks have the bytes of one: state, fields of frames, ledger, histories, cracks (tests/digest).

    test_scenes.py                      what ctest runs: a few scenes that have everything between them
    test_scenes.py --all [NAME ...]     every example made small and every scene of tests/digest, on 2, 3 and 4 ranks

Also: a checkpoint of three ranks goes on with one and with two, and more ranks than there are rows of a slice.
"""
import filecmp
import glob
import os
import shutil
import stat
import subprocess
import sys
import tempfile
import under

PROGRAM = under.need("bin/breccia-mpi")
sys.path.insert(0, os.path.join(os.environ["BRC_SOURCE_DIR"], "tests", "digest"))
import test_digest as digests  # noqa: E402

PLAIN = os.environ["BRC_PROGRAM"]
FEW = {"plate-impact": 3, "cells-shear": 2, "ball-breaks+softening": 3, "beams-two-materials": 2, "cells-two-materials": 4, "published-breaks": 3, "cube-modes": 2, "two-models": 4,
       "tension-dynamic": 8}
FAILURES = []


def launcher(folder, n):
    """A program that is breccia-mpi on n ranks."""
    path = os.path.join(folder, f"on-{n}")
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"#!/bin/sh\nexec {' '.join(under.LAUNCH)} -n {n} {PROGRAM} \"$@\"\n")
    os.chmod(path, os.stat(path).st_mode | stat.S_IXUSR)
    return path


def same(folder, name, counts, precision="double"):
    way = digests.Way("cpu")
    alone = digests.run(PLAIN, name, way, precision, os.path.join(folder, f"{name}-1"))
    if alone and "exit" in alone:
        FAILURES.append(f"{name} on one rank: exit {alone['exit']}")
    for n in counts if alone else []:
        several = digests.run(launcher(folder, n), name, way, precision, os.path.join(folder, f"{name}-{n}"))
        differs = [key for key in alone if several.get(key) != alone[key]]
        if differs:
            FAILURES.append(f"{name} on {n} ranks: other {', '.join(differs)}{': exit ' + several['exit'] if 'exit' in several else ''}")
        print(f"{'differs' if differs else 'same'}: {name} {precision} on {n} ranks", flush=True)


def goes_on(folder):
    """The checkpoint that three ranks leave halfway is that of one; one and two go on from it as one that never stopped."""
    scene = os.path.join(digests.SCENES, "cells-two-materials.yaml")
    more = ["--set", "output.checkpoint.every=1e9 s", "--set", "output.picture=false", "--set", "output.frames=none", "--threads", "1"]
    line = lambda n, *arguments: [launcher(folder, n) if n > 1 else PLAIN, *arguments]
    whole, cut = os.path.join(folder, "whole"), os.path.join(folder, "cut")
    subprocess.run(line(1, "run", scene, "-o", whole, *more), check=True, capture_output=True)
    subprocess.run(line(3, "run", scene, "-o", cut, *more), check=True, capture_output=True)
    for n in (1, 2):
        after = os.path.join(folder, f"after-{n}")
        shutil.copytree(cut, after)
        left = sorted(glob.glob(f"{after}/checkpoints/*.h5"))
        assert len(left) > 1, left
        os.unlink(left[-1])
        done = subprocess.run(line(n, "run", scene, "-o", after, "--resume", *more), capture_output=True, text=True, check=False)
        if done.returncode or not filecmp.cmp(f"{whole}/histories.csv", f"{after}/histories.csv", shallow=False):
            FAILURES.append(f"a checkpoint of 3 ranks does not go on with {n}: exit {done.returncode} {done.stderr[-300:]}")


with tempfile.TemporaryDirectory() as temporary:
    if "--all" in sys.argv:
        for one in digests.names_of(sys.argv[sys.argv.index("--all") + 1:]):
            same(temporary, one, (2, 3, 4))
    else:
        for one, n_ranks in FEW.items():
            same(temporary, one, (n_ranks,))
        same(temporary, "two-models", (3,), "mixed")
    goes_on(temporary)
for failure in FAILURES:
    print("scenes: " + failure)
sys.exit(1 if FAILURES else 0)
