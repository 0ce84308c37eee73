#!/usr/bin/env python3
"""Registers of the kernels on an NVIDIA card, without one: clang compiles the kernel text as a GPU gets it (one element a
work-item, slices of 32) to PTX, and ptxas assembles that for a card (docs/notebook/devices.md, "Compiled for a card").

    bench/gpu_kernels.py                         the table of sm_80 and sm_90 in three precisions, as CSV
    bench/gpu_kernels.py --arch sm_90 --precision double --many 0 1 -o FILE

clang 14 and libclc come from Debian (clang-14 libclc-14), ptxas from PyPI (pip install nvidia-cuda-nvcc) or a CUDA toolkit; PTXAS
names it where it lies elsewhere. This is not the vendor's OpenCL compiler, which chooses for itself: a measure of the kernels.
"""
import argparse
import csv
import glob
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PRECISIONS = ("double", "mixed", "single")
LIBRARY = "/usr/lib/clc/nvptx64--nvidiacl.bc"
GROUP = {"double": 128, "mixed": 256, "single": 256}  # work-items a group on a GPU (host/device/gpu_layout.h)
# A streaming multiprocessor of sm_80 and sm_90: registers, given out to warps of 32 in steps of 256; warps at most.
REGISTERS, REGISTER_STEP, WARPS, WARP = 65536, 256, 64, 32
COLUMNS = ["kernel", "arch", "precision", "many_materials", "registers", "occupancy_percent", "spill_stores_bytes", "spill_loads_bytes",
           "stack_bytes", "shared_bytes", "arguments", "argument_bytes"]


def find_ptxas():
    """Path of ptxas, or None."""
    named = os.environ.get("PTXAS")
    if named:
        return named
    places = [sysconfig.get_paths()["purelib"], sysconfig.get_paths(f"{os.name}_user")["purelib"]]
    wheels = [path for place in places for path in sorted(glob.glob(f"{place}/nvidia/*/bin/ptxas"))]
    return shutil.which("ptxas") or next(iter(wheels + glob.glob("/usr/local/cuda*/bin/ptxas")), None)


def missing_for_ptx():
    """What is missing to make PTX, in words; empty where nothing is."""
    if not shutil.which("clang-14"):
        return "clang-14 (Debian package clang-14)"
    return "" if os.path.exists(LIBRARY) else f"{LIBRARY} (Debian package libclc-14)"


def ptx_of(precision, many, folder):
    """Path of the PTX of all kernels in one variant."""
    source, ptx = os.path.join(folder, "kernels.cl"), os.path.join(folder, f"{precision}-{many}.ptx")
    with open(source, "w", encoding="utf-8") as file:
        file.write('#include "kernels.h"\n')
    resources = subprocess.run(["clang-14", "-print-resource-dir"], capture_output=True, text=True, check=True).stdout.strip()
    subprocess.run(["clang-14", "-cc1", "-x", "cl", "-cl-std=CL1.2", "-triple", "nvptx64-unknown-nvcl", "-finclude-default-header",
                    "-resource-dir", resources, "-internal-isystem", f"{resources}/include", "-I", f"{ROOT}/kernels",
                    "-D", "__OPENCL_VERSION__=120", "-D", "BRC_LANES=1", "-D", "BRC_SLICE=32", "-D", f"BRC_GROUP={GROUP[precision]}",
                    "-D", f"BRC_PRECISION={PRECISIONS.index(precision)}", "-D", f"BRC_MANY_MATERIALS={many}",
                    "-O2", "-ffp-contract=on", "-fdenormal-fp-math-f32=preserve-sign", "-target-cpu", "sm_80", "-target-feature", "+ptx72",
                    "-Wno-linker-warnings", "-Wpedantic", "-Werror", "-mlink-builtin-bitcode", LIBRARY, "-S", "-o", ptx, source], check=True)
    return ptx


def arguments_of(ptx):
    """{kernel: (number of arguments, their bytes)}, each at a multiple of its size."""
    with open(ptx, encoding="utf-8") as file:
        text = file.read()
    found = {}
    for name, parameters in re.findall(r"\.entry (\w+)\(\n(.*?)\n\)", text, re.S):
        end = 0
        sizes = [int(bits) // 8 for bits in re.findall(r"\.param \.[a-z](\d+)", parameters)]
        for size in sizes:
            end = (end + size - 1) // size * size + size
        found[name] = (len(sizes), end)
    return found


def local_arrays(ptx):
    """{kernel: bytes of its local arrays in PTX, those of the functions it calls with them}: what the compiler could not keep in
    registers whatever the card."""
    with open(ptx, encoding="utf-8") as file:
        text = file.read()
    pieces = re.split(r"^\s*(?:\.visible )?\.(entry|func)\s+(?:\([^)]*\)\s*)?(\w+)\s*\(", text, flags=re.M)
    kinds, bodies = dict(zip(pieces[2::3], pieces[1::3])), {}
    for name, body in zip(pieces[2::3], pieces[3::3]):
        bodies[name] = bodies.get(name, "") + body  # of a function: its declaration and its body

    def bytes_of(name, seen):
        if name in seen:
            return 0
        seen.add(name)
        called = re.findall(r"call\.uni\s+(?:\([^)]*\),\s*)?(\w+)", bodies[name])
        return sum(map(int, re.findall(r"\.local[^;]*\[(\d+)\];", bodies[name]))) + sum(bytes_of(other, seen) for other in called if other in bodies)

    return {name: bytes_of(name, set()) for name in bodies if kinds[name] == "entry"}


def occupancy(registers, precision):
    """Warps that fit a multiprocessor over those it can hold [%], by registers alone, in whole groups."""
    a_warp = -(-registers * WARP // REGISTER_STEP) * REGISTER_STEP
    warps = GROUP[precision] // WARP
    return 100 * min(WARPS, REGISTERS // a_warp // warps * warps) // WARPS


def table_of(ptxas, precision, many, archs, folder):
    """Rows of COLUMNS, as ptxas says."""
    ptx = ptx_of(precision, many, folder)
    arguments = arguments_of(ptx)
    rows = []
    for arch in archs:
        said = subprocess.run([ptxas, f"-arch={arch}", "-v", "-o", os.devnull, ptx], capture_output=True, text=True, check=True).stderr
        pattern = (r"Compiling entry function '(\w+)'.*?\n.*?Function properties.*?\n\s*(\d+) bytes stack frame, (\d+) bytes spill stores, "
                   r"(\d+) bytes spill loads\n.*?Used (\d+) registers([^\n]*)")
        for name, stack, stores, loads, registers, more in re.findall(pattern, said):
            shared = re.search(r"(\d+) bytes smem", more)
            rows.append(dict(zip(COLUMNS, (name, arch, precision, many, int(registers), occupancy(int(registers), precision), int(stores), int(loads), int(stack),
                                           int(shared.group(1)) if shared else 0, *arguments[name]))))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--arch", nargs="+", default=["sm_80", "sm_90"])
    parser.add_argument("--precision", nargs="+", default=PRECISIONS, choices=PRECISIONS)
    parser.add_argument("--many", nargs="+", type=int, default=[0], choices=(0, 1), help="kernels for one (0) or many materials (1)")
    parser.add_argument("-o", "--output", metavar="FILE", help="instead of standard output")
    options = parser.parse_args()
    ptxas = find_ptxas()
    missing = missing_for_ptx() or ("" if ptxas else "ptxas (pip install nvidia-cuda-nvcc, or PTXAS=its path)")
    if missing:
        sys.exit(f"gpu_kernels: missing: {missing}")
    with tempfile.TemporaryDirectory() as folder:
        rows = [row for precision in options.precision for many in options.many for row in table_of(ptxas, precision, many, options.arch, folder)]
    with open(options.output, "w", encoding="utf-8", newline="") if options.output else sys.stdout as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(sorted(rows, key=lambda row: [row[key] for key in ("arch", "precision", "many_materials", "kernel")]))


if __name__ == "__main__":
    main()
