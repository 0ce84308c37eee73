"""The installed program runs from a folder it was not built for and names no path of the build."""
import os
import re
import shutil
import subprocess
import sys
import tempfile

BUILD = os.environ["BRC_BUILD_DIR"]
PROGRAM = os.environ["BRC_PROGRAM"]
if not os.path.exists(PROGRAM):
    print("install: the program is not built; skipped")
    sys.exit(77)

failures = []
with tempfile.TemporaryDirectory() as folder:
    first, moved = os.path.join(folder, "first"), os.path.join(folder, "moved")
    installed = subprocess.run(["cmake", "--install", BUILD, "--prefix", first], capture_output=True, text=True)
    if installed.returncode:
        sys.exit("install: cmake --install failed: " + installed.stderr)
    shutil.move(first, moved)
    for name in ("bin/breccia", "include/breccia.h", "share/breccia/examples"):
        if not os.path.exists(os.path.join(moved, name)):
            failures.append(f"{name} is not installed")
    program = os.path.join(moved, "bin/breccia")
    dynamic = subprocess.run(["readelf", "-d", program], capture_output=True, text=True, check=True).stdout
    if re.search(r"\((RPATH|RUNPATH)\)", dynamic):
        failures.append("the program carries a library path")
    with open(program, "rb") as file:
        content = file.read()
    # Sanitizer and debug builds name their sources on purpose.
    if b".debug_info" not in content and os.environ["BRC_SOURCE_DIR"].encode() + b"/" in content:
        failures.append("the program names the folder of its sources")
    environment = dict(os.environ, POCL_CACHE_DIR=os.path.join(folder, "cache"))
    devices = subprocess.run([program, "devices"], capture_output=True, text=True, cwd=folder, env=environment)
    if devices.returncode or "cpu" not in devices.stdout:
        failures.append(f"breccia devices: exit code {devices.returncode}: {devices.stdout}{devices.stderr}")
for failure in failures:
    print("install: " + failure)
sys.exit(1 if failures else 0)
