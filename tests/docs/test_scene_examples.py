"""The whole scenes of docs/reference/scene: each is accepted without a warning and runs to its end."""

import glob
import os
import subprocess
import sys
import tempfile

failures = 0
scenes = sorted(glob.glob(os.path.join(os.environ["BRC_SOURCE_DIR"], "docs", "reference", "scene", "*.yaml")))
for scene in scenes:
    with tempfile.TemporaryDirectory() as out:
        done = subprocess.run(
            [os.environ["BRC_PROGRAM"], "run", scene, "-o", out],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        if done.returncode or "warning:" in done.stdout:
            failures += 1
            print(f"{os.path.basename(scene)}: exit code {done.returncode}\n{done.stdout}")
sys.exit("no scene" if len(scenes) < 10 else min(failures, 1))
