"""Scenes on several ranks have the bytes of one: state, fields of frames, ledger, histories, cracks (tests/digest).

    test_scenes.py                      what ctest runs: a few scenes that have everything between them
    test_scenes.py --all [NAME ...]     every example made small, every scene of tests/digest, and those of tests/stability with fewer steps
          --precision P --ranks N,N     in these precisions (all), on these numbers of ranks (2,3,4)

Also: a checkpoint of three ranks goes on with one and with two, and more ranks than there are rows of a slice.
"""
import argparse
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
STABILITY = os.path.join(os.environ["BRC_SOURCE_DIR"], "tests", "stability")
# Stages of the scenes of tests/stability, made short: some reach what they are about in these steps, none is long.
SHORT = {"release": "stages.1.solver.dynamic.steps=300", "resonance": "stages.0.solver.dynamic.duration=4 ms"}
# Left halfway: contact, strikers and loads; the same and breaks, with rotations; breaks that soften, of cells and of beams.
GO_ON = {"cells-two-materials": [], "published-breaks": ["output.checkpoint.every=13 us"],
         "ball-breaks+softening": digests.small.overrides("ball-breaks+softening") + ["output.checkpoint.every=40 us"],
         "beams-fracture": digests.small.overrides("beams-fracture") + ["output.checkpoint.wall=1 us"]}
FAILURES = []


def launcher(folder, n):
    """A program that is breccia-mpi on n ranks. An odd number is of two machines, as they take it: messages fly while the inside is computed."""
    far = "BRECCIA_RANKS_DELAY_US=0,1 BRECCIA_RANKS_MACHINES=2 " if n % 2 else ""
    path = os.path.join(folder, f"on-{n}")
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"#!/bin/sh\n{far}exec {' '.join(under.LAUNCH)} -n {n} {PROGRAM} \"$@\"\n")
    os.chmod(path, os.stat(path).st_mode | stat.S_IXUSR)
    return path


def names_of(asked):
    """Names that digests know, and `stability/NAME`."""
    ours = [name for name in asked if name.startswith("stability/")]
    theirs = [name for name in asked if name not in ours]
    if asked:
        return (digests.names_of(theirs) if theirs else []) + ours
    scenes = sorted(os.path.basename(path).removesuffix(".yaml") for path in glob.glob(f"{STABILITY}/*.yaml"))
    return digests.names_of([]) + [f"stability/{name}" for name in scenes if name != "case"]


def texts_of(program, name, precision, folder):
    """What tests/digest hashes, of one run."""
    way = digests.Way("cpu")
    if not name.startswith("stability/"):
        return digests.run(program, name, way, precision, folder)
    name = name.removeprefix("stability/")
    short = SHORT.get(name, "stages.0.solver.dynamic.steps=300")
    return digests.content_of(program, f"{STABILITY}/{name}.yaml", [short, "output.frames=2"], way, precision, folder)


def same(folder, name, counts, precision="double"):
    short = name.replace("/", "-")
    alone = texts_of(PLAIN, name, precision, os.path.join(folder, f"{short}-1"))
    known = {digests.read_reference(level)[1].get((name, precision)) for level in digests.LEVELS}  # no equilibrium in less than double
    if alone and "exit" in alone and digests.digest(alone) not in known:
        FAILURES.append(f"{name} {precision} on one rank: exit {alone['exit']}")
    for n in counts if alone else []:
        several = texts_of(launcher(folder, n), name, precision, os.path.join(folder, f"{short}-{n}"))
        differs = [key for key in alone if several.get(key) != alone[key]]
        if differs:
            FAILURES.append(f"{name} {precision} on {n} ranks: other {', '.join(differs)}{': exit ' + several['exit'] if 'exit' in several else ''}")
        print(f"{'differs' if differs else 'same'}: {name} {precision} on {n} ranks", flush=True)


def goes_on(folder, name, sets, precision):
    """The checkpoint that three ranks leave halfway is that of one; one and two go on from it as one that never stopped."""
    way, folder = digests.Way("cpu"), os.path.join(folder, f"goes-on-{name}-{precision}")
    own = os.path.join(digests.SCENES, f"{name}.yaml")
    scene = own if os.path.exists(own) else digests.small.scene_of(name)
    line = lambda n, *words: [launcher(folder, n) if n > 1 else PLAIN, "run", scene, "-o", *words, "--device", "cpu", "--precision", precision,
                              "--threads", "1", *[word for one in digests.OUTPUT + sets for word in ("--set", one)]]
    run = lambda words: subprocess.run(words, capture_output=True, text=True, env=way.environment(), check=False)
    left = lambda where: sorted(glob.glob(f"{folder}/{where}/checkpoints/*.h5"))
    os.mkdir(folder)
    for n, where in ((1, "whole"), (3, "cut")):
        done = run(line(n, f"{folder}/{where}"))
        assert done.returncode == 0 and len(left(where)) > 1, f"{name} {precision}: {done.stderr}"
    wanted = digests.content(f"{folder}/whole")
    halfway = [digests.numbers_of(left(where)[-2], "moment") + digests.numbers_of(left(where)[-2], "parts") for where in ("whole", "cut")]
    if halfway[0] != halfway[1]:
        FAILURES.append(f"{name} {precision}: three ranks leave another checkpoint than one")
    for n in (1, 2):
        shutil.copytree(f"{folder}/cut", f"{folder}/after-{n}")
        os.unlink(left(f"after-{n}")[-1])
        done = run(line(n, f"{folder}/after-{n}", "--resume"))
        got = digests.content(f"{folder}/after-{n}") if done.returncode == 0 else {}
        differs = [key for key in wanted if got.get(key) != wanted[key]]
        if differs:
            FAILURES.append(f"{name} {precision}: a checkpoint of 3 ranks goes on with {n} to other {', '.join(differs)}: exit {done.returncode} {done.stderr[-300:]}")
        print(f"{'differs' if differs else 'same'}: {name} {precision} from 3 ranks on {n}", flush=True)


def options_of():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--all", nargs="*", metavar="NAME")
    parser.add_argument("--precision", action="append", choices=digests.PRECISIONS)
    parser.add_argument("--ranks", default="2,3,4", type=lambda text: tuple(int(n) for n in text.split(",")))
    return parser.parse_args()


options = options_of()
with tempfile.TemporaryDirectory() as temporary:
    if options.all is not None:
        for precise in options.precision or digests.PRECISIONS:
            for one in names_of(options.all):
                same(temporary, one, options.ranks, precise)
    else:
        for one, n_ranks in FEW.items():
            same(temporary, one, (n_ranks,))
        same(temporary, "two-models", (3,), "mixed")
    for one, more in GO_ON.items() if not options.all else ():
        all_of_it = options.all is not None or one == "published-breaks"
        for precise in options.precision or digests.PRECISIONS if all_of_it else ("double",):
            goes_on(temporary, one, more, precise)
for failure in FAILURES:
    print("scenes: " + failure)
sys.exit(1 if FAILURES else 0)
