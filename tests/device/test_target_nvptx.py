"""The OpenMP target plug-in for NVIDIA cards where there is none: it says so, and the host in its place gives the bits of the cpu.

Wants libbreccia_target_nvptx.so in the build folder (cmake --build FOLDER --target brc_target_nvptx; docs/notebook/devices.md), else it is a skip.
"""
import filecmp
import glob
import json
import os
import subprocess
import sys

SOURCE, BUILD = os.environ["BRC_SOURCE_DIR"], os.environ["BRC_BUILD_DIR"]
sys.path.insert(0, f"{SOURCE}/tests/commands")
import test_resume as resume  # noqa: E402

LIBRARY = f"{BUILD}/libbreccia_target_nvptx.so"
NO_CARD = dict(os.environ, BRECCIA_TARGET_LIBRARY=LIBRARY, CUDA_VISIBLE_DEVICES="")
# Dynamic, with given time steps: sums over the body are taken in the order of the storage, which slices of 32 have differently.
EXAMPLES = ["tension-dynamic", "ball-breaks"]


def run(name, folder, sets, device, precision):
    done = subprocess.run(resume.command(name, folder, sets, device, precision, ["--exact"]), capture_output=True, text=True, timeout=900, env=NO_CARD)
    assert done.returncode == 0, f"{name} on {device}: {done.stderr}"
    return done.stderr


def compared(name, folder, precision):
    """One line on what was the same; AssertionError where something differs."""
    sets = resume.overrides(name)
    run(name, f"{folder}/probe", sets, "cpu", precision)
    with open(f"{folder}/probe/summary.json", encoding="utf-8") as file:
        step = json.load(file)["time_step"]["value_s"]
    sets = sets + [f"stages.0.solver.dynamic.time_step={0.98 * step:.2e} s"]
    run(name, f"{folder}/cpu", sets, "cpu", precision)
    said = run(name, f"{folder}/target", sets, "target:0", precision)
    assert "its kernels run on the host" in said, f"{name}: nothing says that the host stands in: {said}"
    frames = sorted(os.path.basename(path) for path in glob.glob(f"{folder}/cpu/frames/*.vtkhdf"))
    assert frames, f"{name}: no frames"
    for frame in frames:
        assert filecmp.cmp(f"{folder}/cpu/frames/{frame}", f"{folder}/target/frames/{frame}", shallow=False), f"{name} in {precision}: {frame} differs"
    return f"{name} in {precision}: {len(frames)} frames of the same bytes"


def main():
    if not os.path.exists(LIBRARY):  # even where BRC_NO_SKIPS is set: quickstart leaves this compiler out, 57 MB and minutes of a core
        print(f"SKIPPED: no {LIBRARY} (Debian: gcc-12-offload-nvptx; cmake --build {BUILD} --target brc_target_nvptx)")
        sys.exit(77)
    told = subprocess.run([resume.PROGRAM, "devices"], capture_output=True, text=True, check=True, env=NO_CARD).stdout
    assert "OpenMP target device (nvptx, sm_" in told and "there is none, the host stands in" in told, told
    cases = subprocess.run([f"{BUILD}/tests/test_device_target"], capture_output=True, text=True, env=NO_CARD)
    assert cases.returncode == 0, cases.stdout + cases.stderr
    sys.exit(1 if resume.all_compared("target-nvptx-", EXAMPLES, os.environ.get("BRC_PRECISIONS", "double,mixed,single").split(","), compared) else 0)


if __name__ == "__main__":
    main()
