"""Files of several ranks have the bytes of one rank's; a disk that is full ends all of them with one sentence."""
import filecmp
import os
import subprocess
import sys
import tempfile
import under

OUTPUT = under.need("tests/output_mpi")
ALONE = os.path.join(under.BUILD, "tests/output_one")
FILES = ["rows.h5", "text.csv", "whole.txt"]
FAILURES = []


def expect(condition, sentence):
    if not condition:
        FAILURES.append(sentence)


def on_ranks(n, *arguments):
    process = under.start(n, list(arguments), delay_us=200)
    _, errors = process.communicate(timeout=120)
    return process.returncode, errors


def same_bytes(folder, rows):
    alone = os.path.join(folder, f"alone-{rows}")
    subprocess.run([ALONE, alone, str(rows)], check=True)
    for n in (1, 2, 3, 5, 8):
        several = os.path.join(folder, f"{n}-{rows}")
        code, errors = on_ranks(n, OUTPUT, several, str(rows))
        expect(code == 0 and not errors, f"{rows} rows on {n} ranks: {code} {errors}")
        if code == 0:
            expect(sorted(os.listdir(several)) == sorted(FILES), f"{n} ranks left {os.listdir(several)}")
            same, _, _ = filecmp.cmpfiles(alone, several, FILES, shallow=False)
            expect(len(same) == 3, f"{rows} rows: {n} ranks wrote other bytes than one; equal are {same}")


def full_disk(folder):
    small = os.path.join(folder, "small")
    code, errors = on_ranks(3, "sh", "-c", f"ulimit -f 1000; exec {OUTPUT} {small} 1500000")
    lines = [line for line in errors.splitlines() if not line.startswith("[")]
    expect(code == 3 and len(lines) == 1 and lines[0].startswith("rank 0: ") and "File too large" in lines[0],
           f"a full disk: {code} {errors}")
    expect(os.listdir(small) == [], f"a full disk: {os.listdir(small)} is left")


def places():
    for selector in ("cpu", "opencl:auto"):
        code, errors = on_ranks(3, OUTPUT, "places", selector)
        for rank in range(3):
            expect(f"rank {rank} on {os.uname().nodename}: {selector.split(':')[0]}" in errors, f"places on {selector}: {errors}")
        expect(code == 0 and errors.count("\n") == 3, f"places on {selector}: {code} {errors}")


with tempfile.TemporaryDirectory() as temporary:
    for count in (1, 5, 40000, 1500000):  # the last one: more than one piece
        same_bytes(temporary, count)
    full_disk(temporary)
places()
for failure in FAILURES:
    print("output: " + failure)
sys.exit(1 if FAILURES else 0)
