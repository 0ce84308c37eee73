"""Bytes of the frames of examples, made small as in tests/commands/test_resume.py or as they are, beside those of another program, mostly an older one.

bench/frame_sizes.py --before OLD/bin/breccia [--as-is] [NAME ...]      BRC_PROGRAM: the program of now

Prints a line of CSV an example. An example that the other program does not know or ends otherwise is said so. Where the programs write different numbers of frames, bytes a frame are compared.
"""
import argparse
import glob
import json
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../tests/commands"))
import test_resume as small


def written(program, name, folder, sets):
    """Frames and their bytes, elements, broken bonds; None where the program ends otherwise than done."""
    line = [program] + small.command(name, folder, sets)[1:]
    if subprocess.run(line, capture_output=True, check=False).returncode != 0:
        return None
    frames = glob.glob(f"{folder}/frames/*.vtkhdf")
    counts = json.load(open(f"{folder}/summary.json", encoding="utf-8"))["counts"]
    return len(frames), sum(map(os.path.getsize, frames)), counts["elements"], counts["broken"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--before", required=True, metavar="PROGRAM")
    parser.add_argument("--as-is", action="store_true", help="not made small")
    parser.add_argument("names", nargs="*")
    asked = parser.parse_args()
    everything = sorted(os.path.basename(os.path.dirname(path)) for path in glob.glob(f"{small.SOURCE}/examples/*/scene.yaml"))
    print("example,elements,broken,frames before,bytes before,frames,bytes,share of the bytes a frame")
    for name in asked.names or everything:
        with tempfile.TemporaryDirectory(prefix="frame-sizes-") as folder:
            sets = [] if asked.as_is else small.overrides(name)
            now = written(small.PROGRAM, name, f"{folder}/now", sets)
            old = written(asked.before, name, f"{folder}/before", sets)
        if not now or not now[0] or not old or not old[0]:
            print(f"{name},{'' if not now else now[2]},,,,,,{'no frames' if now and not now[0] else 'does not run' if not now else 'not read by the older program'}", flush=True)
            continue
        share = now[1] / now[0] / (old[1] / old[0])
        print(f"{name},{now[2]},{now[3]},{old[0]},{old[1]},{now[0]},{now[1]},{share:.3f}", flush=True)


if __name__ == "__main__":
    main()
