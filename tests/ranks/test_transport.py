"""What ranks.h promises, on 1 to 8 ranks of two cores: answers, late messages, failures, killed ranks, signals."""
import os
import random
import signal
import subprocess
import sys
import time
import under

TRANSPORT = under.need("tests/transport_mpi")
KILLS = 20
FAILURES = []


def expect(condition, sentence):
    if not condition:
        FAILURES.append(sentence)


def ended(what, process, within=60):
    """(exit code, output, sentences, seconds) of a process that ends; sentences: lines of stderr that are no pid
    and none of Open MPI's own, which name a host or a library in brackets."""
    began = time.monotonic()
    try:
        output, errors = process.communicate(timeout=within)
    except subprocess.TimeoutExpired:
        process.kill()
        output, errors = process.communicate()
        FAILURES.append(f"{what}: has not ended after {within} s; said {errors!r}")
    lines = [line for line in errors.splitlines() if not line.startswith(("pid ", "["))]
    return process.returncode, output, lines, time.monotonic() - began


def answers():
    alone = subprocess.run([os.path.join(under.BUILD, "tests/transport_one"), "check"], capture_output=True, text=True)
    expect(alone.returncode == 0 and "1 ranks of one rank" in alone.stdout, f"one rank: {alone.stdout} {alone.stderr}")
    for n, delay, machines in [(1, 0, 1), (2, 0, 1), (3, 2000, 1), (4, 0, 1), (5, 1000, 1), (8, 500, 1), (2, 0, 2), (5, 1000, 3)]:
        command = [TRANSPORT, "check", str(machines)]
        code, output, lines, _ = ended("check", under.start(n, command, delay, BRECCIA_RANKS_MACHINES=str(machines)))
        expect(code == 0 and f"{n} ranks of" in output and not lines, f"check on {n}, {machines} machines: {code} {output} {lines}")
        expect(output.count("\n") == 1, f"check on {n}: other ranks than 0 print: {output!r}")


def one_sentence(what, n, arguments, code, sentence, delay=0):
    got, output, lines, seconds = ended(what, under.start(n, [TRANSPORT] + arguments, delay))
    expect(got == code and lines == [sentence] and seconds < 10, f"{what}: {got} {lines} {seconds:.1f} s {output!r}")


def failures():
    for n, rank, delay in [(2, 0, 0), (2, 1, 1000), (5, 3, 0), (8, 7, 500)]:
        one_sentence(f"rank {rank} of {n} fails", n, ["fail", str(rank)], 3, f"rank {rank}: no room in round 20", delay)
    for rank in (0, 2):
        one_sentence(f"ranks from {rank} refuse", 4, ["refuse", str(rank)], 2, f"rank {rank}: not with me")
    got, _, lines, _ = ended("all fail", under.start(4, [TRANSPORT, "fail-all"]))
    expect(got == 3 and len(lines) == 1 and lines[0].endswith(": no room in round 20"), f"all fail: {got} {lines}")


def pids(process, n):
    """Process of each rank, from what they say at their start."""
    found = {}
    while len(found) < n:
        word, rank, pid = process.stderr.readline().split()
        found[int(rank)] = int(pid)
    return found


def is_gone(pid):
    """No process, or one that only waits to be reaped."""
    try:
        with open(f"/proc/{pid}/stat", encoding="utf-8") as file:
            return file.read().rsplit(")", 1)[1].split()[0] == "Z"
    except FileNotFoundError:
        return True


def killed_ranks():
    chance = random.Random(24)
    for k in range(KILLS):
        n = 2 + k % 4
        process = under.start(n, [TRANSPORT, "loop", "60"], 300 * (k % 2))
        of = pids(process, n)
        rank, pause = chance.randrange(n), chance.random()
        time.sleep(pause)
        os.kill(of[rank], signal.SIGKILL)
        code, _, lines, seconds = ended("killed", process)
        said = f"rank {rank} is gone without a word (killed, or out of memory); a run with checkpoints goes on with --resume"
        expect(code == 128 + signal.SIGKILL and lines == [said] and seconds < 10,
               f"rank {rank} of {n} killed after {pause:.3f} s: {code} {lines} {seconds:.1f} s")
        while seconds < 10 and not all(is_gone(pid) for pid in of.values()):  # mpirun may be first
            time.sleep(0.1)
            seconds += 0.1
        for pid in of.values():
            expect(is_gone(pid), f"rank {rank} of {n} killed: process {pid} is still there")


def signals():
    for number in (signal.SIGUSR2, signal.SIGINT, signal.SIGTERM):
        process = under.start(3, [TRANSPORT, "loop", "60"])
        pids(process, 3)
        time.sleep(0.3)
        process.send_signal(number)
        code, _, lines, seconds = ended("a signal", process)
        expect(lines == ["rank 0: interrupted"] and seconds < 10 and code != 0, f"{number}: {code} {lines} {seconds:.1f} s")
        expect(number != signal.SIGUSR2 or code == 3, f"exit code {code} of an interrupted run")


for part in (answers, failures, killed_ranks, signals):
    began = time.monotonic()
    part()
    print(f"{part.__name__}: {time.monotonic() - began:.1f} s")
for failure in FAILURES:
    print("transport: " + failure)
sys.exit(1 if FAILURES else 0)
