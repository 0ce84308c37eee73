"""What a Python observer costs a run: the same scene without one and with one that looks at the velocities every so many steps and would stop the run.

PYTHONPATH=python/src BRECCIA_LIBRARY=build/release/lib/libbreccia.so python3 bench/python_observer.py [--elements 10000] [--steps 400] [--every 20] [--pairs 7]

--count: instructions by valgrind in place of seconds, which a busy machine does not change. Valgrind knows no AVX-512: the steps are those of a lesser instruction set.
"""
import argparse
import os
import re
import subprocess
import sys
import time

import numpy as np

import breccia

SCENE = {
    "version": 1,
    "materials": {"glass": {"E": "72 GPa", "nu": 0.2, "density": "2500 kg/m^3"}},
    "model": "dlsm",
    "bodies": [{"name": "block", "shape": {"box": {"size": ["10 mm", "10 mm", "10 mm"]}}, "fill": {"noisy_grid": {"elements": 10000, "spread": "50 %"}}, "material": "glass"}],
    "stages": [{"name": "swing", "solver": {"dynamic": {"steps": 400}}, "initial": [{"velocity": {"gradient": {"x": ["1 1/s", 0, 0]}}}]}],
    "output": {"frames": "none", "picture": False, "history_every": 1000000},
}


def stop_when_fast(run):
    """The largest speed, read where the device keeps the velocities; 1 km/s is never reached."""
    velocity = run.view("velocity")
    return breccia.STOP if np.einsum("ij,ij->i", velocity, velocity).max() > 1e6 else None


def processor_seconds(scene, every):
    """Of the steps alone: building and setting up are over when the run stands at step 0."""
    with scene.start(device="cpu", threads=1) as run:
        looks = [0]

        def look(run):
            looks[0] += 1
            return stop_when_fast(run)

        if every:
            run.observe(look, steps=every)
        run.step(0)
        start = time.process_time()
        while run.step(10**9):
            pass
        return time.process_time() - start, looks[0]


def instructions(asked, steps, every):
    """Of a whole process that does so many steps, by valgrind."""
    line = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null", sys.executable, "-B", __file__, "--once",
            "--elements", str(asked.elements), "--steps", str(steps), "--every", str(every)]
    ran = subprocess.run(line, capture_output=True, text=True, check=True, env={**os.environ, "PYTHONHASHSEED": "0", "OMP_NUM_THREADS": "1"})
    return int(re.findall(r"I\s+refs:\s+([\d,]+)", ran.stderr)[0].replace(",", ""))


def count(asked):
    one, plain, observed = instructions(asked, 1, 0), instructions(asked, asked.steps, 0), instructions(asked, asked.steps, asked.every)
    step, looks = (plain - one) / (asked.steps - 1), asked.steps // asked.every + 1
    print(f"{asked.elements} elements, {asked.steps} steps of {step:.3e} instructions, {looks} looks: {1 + (observed - plain) / (plain - one):.4f} times the instructions of the steps without; "
          f"a look takes {(observed - plain) / looks / step:.4f} of a step")


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    for name, value in (("elements", 10000), ("steps", 400), ("every", 20), ("pairs", 7)):
        options.add_argument("--" + name, type=int, default=value)
    options.add_argument("--count", action="store_true", help="instructions by valgrind")
    options.add_argument("--once", action="store_true", help="one run and no figure: what --count counts")
    asked = options.parse_args()
    if asked.count:
        return count(asked)
    scene = breccia.Scene(SCENE, set={"bodies.0.fill.noisy_grid.elements": asked.elements, "stages.0.solver.dynamic.steps": asked.steps})
    if asked.once:
        return processor_seconds(scene, asked.every)
    processor_seconds(scene, 0)
    plain, observed = [], []
    for _ in range(asked.pairs):
        plain.append(processor_seconds(scene, 0)[0])
        seconds, looks = processor_seconds(scene, asked.every)
        observed.append(seconds)
    ratios = sorted(other / one for one, other in zip(plain, observed))
    steps = (min(observed) - min(plain)) / looks / (min(plain) / asked.steps)
    print(f"{asked.elements} elements, {asked.steps} steps of {min(plain) / asked.steps:.2e} s, {looks} looks: {min(observed) / min(plain):.4f} times the processor time of the steps without "
          f"(least of {asked.pairs} runs each; pairs {ratios[0]:.4f} to {ratios[-1]:.4f}); a look takes {steps:.3f} of a step")


if __name__ == "__main__":
    main()
