"""The installed program runs from a folder it was not built for and names no path of the build; the installed library and
header serve a C program."""
import os
import re
import shutil
import subprocess
import sys
import tempfile

BUILD = os.environ["BRC_BUILD_DIR"]
PROGRAM = os.environ["BRC_PROGRAM"]
if not os.path.exists(PROGRAM):
    sys.exit("install: the program is not built")

USER_OF_THE_LIBRARY = r"""
#include <breccia.h>
#include <stdio.h>
int main(void)
{
    brc_context *context = brc_context_create();
    brc_device_list *devices;
    if (brc_device_list_create(context, &devices) != BRC_OK) return 1;
    brc_run_request request = {.path = "missing.yaml"};
    brc_run_results results;
    const brc_status status = brc_run_scene(context, &request, &results);
    printf("%s %s %s\n", brc_version(), devices->items[0].selector, brc_context_message(context));
    brc_run_results_free(&results);
    brc_device_list_free(&devices);
    brc_context_free(&context);
    return status == BRC_BAD_INPUT ? 0 : 1;
}
"""


def use_library(prefix, folder):
    """Compile, link and run a program against the installed header and library; the sentence of a failure, or None."""
    with open(os.path.join(prefix, "lib/pkgconfig/breccia.pc"), encoding="utf-8") as file:
        package = file.read().replace("${prefix}", prefix)
    flags = {key: re.search(rf"^{key}: (.*)$", package, re.M).group(1).split() for key in ("Cflags", "Libs")}
    with open(os.path.join(BUILD, "CMakeCache.txt"), encoding="utf-8") as file:
        if "BRC_SANITIZE:BOOL=ON" in file.read():
            flags["Libs"].append("-fsanitize=address,undefined")
    source, user = os.path.join(folder, "user.c"), os.path.join(folder, "user")
    with open(source, "w", encoding="utf-8") as file:
        file.write(USER_OF_THE_LIBRARY)
    compiler = ["cc", "-std=c11", "-Wall", "-Wextra", "-Werror", *flags["Cflags"], source, "-o", user, *flags["Libs"]]
    built = subprocess.run(compiler, capture_output=True, text=True)
    if built.returncode:
        return "a program does not compile against the library: " + built.stderr
    ran = subprocess.run([user], capture_output=True, text=True, cwd=folder)
    if ran.returncode or "cpu" not in ran.stdout or "missing.yaml" not in ran.stdout:
        return f"a program using the library gave {ran.returncode}: {ran.stdout}{ran.stderr}"
    return None


failures = []
with tempfile.TemporaryDirectory() as folder:
    first, moved = os.path.join(folder, "first"), os.path.join(folder, "moved")
    installed = subprocess.run(["cmake", "--install", BUILD, "--prefix", first], capture_output=True, text=True)
    if installed.returncode:
        sys.exit("install: cmake --install failed: " + installed.stderr)
    shutil.move(first, moved)
    for name in ("bin/breccia", "include/breccia.h", "share/breccia/examples", "share/breccia/scene.schema.json", "share/man/man1/breccia.1",
                 "share/bash-completion/completions/breccia", "share/zsh/site-functions/_breccia"):
        if not os.path.exists(os.path.join(moved, name)):
            failures.append(f"{name} is not installed")
    complaint = use_library(moved, folder)
    if complaint:
        failures.append(complaint)
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
