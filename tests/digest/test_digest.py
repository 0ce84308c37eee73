"""Digests: every example made small and the scenes of this folder, run, and the bits of its numbers hashed (tests/README.md, "Digests").

    test_digest.py                          what ctest runs: all in double, some in mixed and single, some on PoCL, against the reference
    test_digest.py --all [NAME ...]         these examples, or all, in every way this machine has, against the reference
    test_digest.py --renew [NAME ...]       the same, written into the reference: for a change that moves numbers on purpose
    test_digest.py --against PROGRAM [--all [NAME ...]]   against another program on this machine; needs no reference

A way is an instruction set of the cpu (v2, v3, v4), opencl, opencl-exact or target; a digest of a run is five hashes:
state (the checkpoint at the end), fields (the cells of the last frame), summary (ledger, counts, measures, sensors,
steps of summary.json), histories (histories.csv), cracks (cracks.csv, fragments.csv); or the exit code of a run that failed.
"""
import argparse
import concurrent.futures
import glob
import hashlib
import json
import os
import platform
import re
import subprocess
import sys
import tempfile

SOURCE = os.path.abspath(os.environ.get("BRC_SOURCE_DIR", os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")))
BUILD = os.path.abspath(os.environ.get("BRC_BUILD_DIR", os.path.join(SOURCE, "build", "release")))
PROGRAM = os.path.abspath(os.environ.get("BRC_PROGRAM", os.path.join(BUILD, "bin", "breccia")))
SCENES = os.path.join(SOURCE, "tests", "digest", "scenes")  # what no example has; small as they are
REFERENCE = os.path.join(SOURCE, "tests", "digest", "reference")
H5_NUMBERS = os.path.join(BUILD, "tests", "h5_numbers")
os.environ.update(BRC_SOURCE_DIR=SOURCE, BRC_PROGRAM=PROGRAM)
sys.path.insert(0, os.path.join(SOURCE, "tests", "commands"))
import test_resume as small  # noqa: E402  what makes each example small

PRECISIONS = ("double", "mixed", "single")
LEVELS = ("v2", "v3", "v4")
# What rounds by itself and in order gives the bits of v2 on every device (docs/notebook/devices.md, "The same bits").
REFERENCE_OF = {"v2": "v2", "v3": "v3", "v4": "v4", "opencl-exact": "v2", "target": "v2"}
FEW = ("ball-breaks+softening", "beams-fracture", "cells-two-materials", "published-breaks", "tension", "two-models")
SUMMARY_KEYS = ("counts", "ledger", "measures", "sensors", "steps", "frames", "time_step")
HASHES = ("state", "fields", "summary", "histories", "cracks")
# BLAS and the mathematical library may choose by the processor what they run: here always the same.
PINNED = {"OPENBLAS_NUM_THREADS": "1", "OPENBLAS_CORETYPE": "Nehalem", "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F",
          "OMP_WAIT_POLICY": "passive"}
NO_END = ("beams-events", "cells-events")  # their stage ends by a condition that leaves no checkpoint: one wherever there can be one
OUTPUT = ["output.checkpoint.every=1e9 s", "output.picture=false", "output.frame_numbers=double"]  # a checkpoint at the end of each stage, no pictures, all digits


class Way:
    """How an example is run: on what, by which selector."""

    def __init__(self, name, device="cpu", exact=False):
        self.name, self.device, self.exact = name, device, exact

    def environment(self):
        return dict(os.environ, **PINNED, **({"BRECCIA_ISA": self.name} if self.name in LEVELS else {}))


def text_of(*line, environment=None):
    return subprocess.run(line, capture_output=True, text=True, env=environment, check=False)


def ways_of(program):
    """Every way that this machine and this program have."""
    scene, ways = os.path.join(SOURCE, "examples", "tension", "scene.yaml"), []
    with tempfile.TemporaryDirectory(prefix="digest-", dir=".") as folder:
        for level in LEVELS:
            way = Way(level)
            line = (program, "run", scene, "-o", folder, "--device", "cpu", "--set", "bodies.0.fill.noisy_grid.elements=100")
            if text_of(*line, environment=way.environment()).returncode == 0:
                ways.append(way)
    there = re.split(r"\n(?=[* ] \w)", text_of(program, "devices").stdout)
    for kind in ("opencl", "target"):
        found = [re.match(r"[* ] (\S+)", part).group(1) for part in there if re.match(rf"[* ] {kind}:", part) and "not usable" not in part]
        ways += [Way(kind, found[0])] if found else []
        ways += [Way("opencl-exact", found[0], exact=True)] if found and kind == "opencl" else []
    return ways


def toolchain(program):
    """What the bits depend on beside the source and the instruction set: compiler and libraries of mathematics."""
    compiler = re.search(r", ([^,)]+)\)\s*$", text_of(program, "--version").stdout.strip())
    libraries = re.findall(r"=> (\S*/lib(?:blas|lapack|voro\+\+)\.\S+)", text_of("ldd", program).stdout)
    real = sorted({re.sub(r"^lib|\.so.*$", "", os.path.basename(os.path.realpath(path))) + re.search(r"\.so.*$", os.path.realpath(path)).group(0)[3:] for path in libraries})
    return ", ".join([compiler.group(1) if compiler else "unknown compiler", " ".join(platform.libc_ver()), *real])


def hash_of(text):
    return hashlib.sha256(text.encode()).hexdigest()[:12]


def numbers_of(path, group):
    done = text_of(H5_NUMBERS, path, group)
    if done.returncode:
        raise AssertionError(f"{H5_NUMBERS} {path} {group}: {done.stderr or done.returncode}")
    return done.stdout


def content(folder):
    """What is hashed, by name of the hash."""
    newest = (sorted(glob.glob(f"{folder}/checkpoints/*.h5")) or [None])[-1]
    frame = (sorted(glob.glob(f"{folder}/frames/*.vtkhdf")) or [None])[-1]
    with open(f"{folder}/summary.json", encoding="utf-8") as file:
        summary = json.load(file)
    read = lambda name: open(f"{folder}/{name}", encoding="utf-8").read() if os.path.exists(f"{folder}/{name}") else ""
    return {"state": numbers_of(newest, "moment") + numbers_of(newest, "parts") if newest else "",
            "fields": numbers_of(frame, "VTKHDF/CellData") if frame else "",
            "summary": "".join(f"{key} {json.dumps(summary[key])}\n" for key in SUMMARY_KEYS),
            "histories": read("histories.csv"), "cracks": read("cracks.csv") + read("fragments.csv")}


def content_of(program, scene, sets, way, precision, folder):
    """The texts to hash, or {'exit': code}; None where the program was built without this precision."""
    line = [program, "run", scene, "-o", folder, "--device", way.device, "--precision", precision, "--threads", "1"]
    line += (["--exact"] if way.exact else []) + [word for one in sets + OUTPUT for word in ("--set", one)]
    done = subprocess.run(line, capture_output=True, text=True, timeout=900, env=way.environment())
    if "this build has no kernels for" in done.stderr:
        return None
    return content(folder) if done.returncode == 0 else {"exit": f"{done.returncode}"}


def run(program, name, way, precision, folder):
    own = f"{SCENES}/{name}.yaml"
    if os.path.exists(own):
        return content_of(program, own, [], way, precision, folder)
    sets = small.overrides(name) + (small.SINGLE.get(name, []) if precision != "double" else []) + ([small.ALWAYS] if name in NO_END else [])
    return content_of(program, small.scene_of(name), sets, way, precision, folder)


def digest(texts):
    return "exit " + texts["exit"] if "exit" in texts else " ".join(hash_of(texts[key]) if texts[key] else "-" for key in HASHES)


def both(case, against):
    """(case, digest, sentence of what differs from the other program); digest None: not in this build."""
    name, way, precision = case
    with tempfile.TemporaryDirectory(prefix="digest-", dir=".") as folder:
        own = run(PROGRAM, name, way, precision, f"{folder}/own")
        if own is None or not against:
            return case, own and digest(own), ""
        other = run(against, name, way, precision, f"{folder}/other")
    if other is None:
        return case, None, ""
    if digest(own) == digest(other):
        return case, digest(own), ""
    lines = [{line for key in texts for line in texts[key].splitlines()} for texts in (own, other)]
    first = [line for key in own for line in own[key].splitlines() if line not in lines[1]] or sorted(lines[1] - lines[0])
    return case, digest(own), f"{digest(own)} instead of {digest(other)}; first: {first[0] if first else 'the order'}"


def read_reference(way):
    """Toolchain and digests {(name, precision): digest} of a file, or (None, {})."""
    path = os.path.join(REFERENCE, f"{REFERENCE_OF.get(way, way)}.txt")
    if not os.path.exists(path):
        return None, {}
    with open(path, encoding="utf-8") as file:
        head, *lines = file.read().splitlines()
    return head.removeprefix("# "), {tuple(line.split()[:2]): line.split(maxsplit=2)[2] for line in lines}


def write_reference(way, key, digests):
    os.makedirs(REFERENCE, exist_ok=True)
    there_key, there = read_reference(way)
    there = {**(there if there_key == key else {}), **digests}
    with open(os.path.join(REFERENCE, f"{way}.txt"), "w", encoding="utf-8") as file:
        file.write(f"# {key}\n" + "".join(f"{name} {precision} {there[name, precision]}\n" for name, precision in sorted(there)))


def names_of(asked):
    there = sorted(name for name in os.listdir(f"{SOURCE}/examples") if os.path.exists(small.scene_of(name))) + sorted(small.MORE)
    there += sorted(name.removesuffix(".yaml") for name in os.listdir(SCENES) if name.endswith(".yaml"))
    for name in asked:
        if name not in there:
            raise SystemExit(f"{name} is no example; there are {', '.join(there)}")
    return asked or there


def cases_of(options, ways):
    """(name, way, precision) to run."""
    if options.all is None and options.renew is None:
        levels = [way for way in ways if way.name in LEVELS][-1:]
        few = [way for way in ways if way.name == "opencl-exact" or (way.name in LEVELS and way not in levels)]
        return ([(name, way, "double") for way in levels for name in names_of([])] + [(name, way, "double") for way in few for name in FEW]
                + [(name, way, precision) for way in levels for precision in PRECISIONS[1:] for name in FEW])
    names = names_of((options.all or []) + (options.renew or []))
    precisions = options.precision or PRECISIONS
    return [(name, way, precision) for way in ways for precision in precisions for name in names]


def comparable(ways, options, key):
    """The ways that have something to be compared with, or whose reference is to be written; the others are named."""
    kept = []
    for way in ways:
        its_key = read_reference(way.name)[0]
        why_not = ""
        if options.renew is not None and way.name not in LEVELS:
            why_not = "its reference is that of v2" if way.name in REFERENCE_OF else "its compiler works as the program runs: no reference"
        elif options.renew is None and not options.against:
            if way.name not in REFERENCE_OF:
                why_not = "its compiler works as the program runs: no reference, compare with a program by --against"
            elif os.environ.get("BRC_BUILD_TYPE", "Release") != "Release" and REFERENCE_OF[way.name] != "v2":
                why_not = "products and sums are joined as the optimiser finds them, and the reference is of a Release build"
            elif its_key != key:
                why_not = f"the reference is of {its_key or 'nothing'}, this is {key}"
        if why_not:
            print(f"skipped: {way.name}: {why_not}", flush=True)
        else:
            kept.append(way)
    return kept


def judge(case, own, differs, against, references):
    """(verdict, sentence): same, differs, skipped, none (nothing to compare with)."""
    name, way, precision = case
    if own is None:
        return "skipped", "this build has no kernels for it"
    if against:
        return ("differs", differs) if differs else ("same", own)
    digests = references[way.name][1]
    if (name, precision) not in digests:
        return "none", "not in the reference; write it with --renew"
    return ("same", own) if digests[name, precision] == own else ("differs", f"{own} instead of {digests[name, precision]}")


def can_fail(folder):
    """The last digit of one modulus changes every hash but that of the cracks; or the digests are blind."""
    way, name, changed = Way("cpu"), "beams-two-materials", f"{folder}/changed.yaml"
    with open(f"{SCENES}/{name}.yaml", encoding="utf-8") as file:
        text = file.read()
    with open(changed, "w", encoding="utf-8") as file:
        file.write(text.replace("E: 20 GPa", "E: 20.000000000000004 GPa"))
    texts = [content_of(PROGRAM, scene, [], way, "double", f"{folder}/{k}") for k, scene in enumerate((f"{SCENES}/{name}.yaml", changed))]
    blind = [key for key in HASHES if key != "cracks" and texts[0][key] == texts[1][key]]
    if blind:
        print(f"differs: {', '.join(blind)} of {name} stayed as they were when the last digit of a modulus changed")
    return not blind


def options_of():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--all", nargs="*", metavar="NAME", help="every way and precision, every example, or these")
    parser.add_argument("--renew", nargs="*", metavar="NAME", help="the same, and write the reference")
    parser.add_argument("--against", metavar="PROGRAM", type=os.path.abspath, help="compare with this program")
    parser.add_argument("--way", action="append", metavar="WAY", help="only this one; may be repeated")
    parser.add_argument("--precision", action="append", choices=PRECISIONS, help="only this one, with --all or --renew; may be repeated")
    parser.add_argument("--jobs", type=int, default=2, help="runs at once (2), of one thread each")
    return parser.parse_args()


def main():
    options = options_of()
    key, renewed = toolchain(PROGRAM), {}
    ways = comparable([way for way in ways_of(PROGRAM) if not options.way or way.name in options.way], options, key)
    references = {way.name: read_reference(way.name) for way in ways}
    counts = dict.fromkeys(("same", "differs", "none", "skipped", "written"), 0)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for case, own, differs in pool.map(lambda case: both(case, options.against), cases_of(options, ways)):
            name, way, precision = case
            if options.renew is not None and own:
                renewed.setdefault(way.name, {})[name, precision] = own
                verdict, sentence = "written", own
            else:
                verdict, sentence = judge(case, own, differs, options.against, references)
            counts[verdict] += 1
            print(f"{verdict}: {name} {precision} on {way.name}: {sentence}", flush=True)
    if options.all is None and options.renew is None:
        with tempfile.TemporaryDirectory(prefix="digest-", dir=".") as folder:
            counts["differs"] += not can_fail(folder)
    for way, digests in renewed.items():
        write_reference(way, key, digests)
    print(", ".join(f"{n} {verdict}" for verdict, n in counts.items() if n))
    if counts["differs"] or counts["none"]:
        return 1
    if counts["same"] + counts["written"]:
        return 0
    print("SKIPPED: nothing here can be compared: no way and precision of this build has a reference of this toolchain")
    return 1 if os.environ.get("BRC_NO_SKIPS") else 77


if __name__ == "__main__":
    sys.exit(main())
