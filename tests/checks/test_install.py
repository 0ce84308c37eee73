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
static const char scene_text[] =
    "version: 1\nmaterials: {stone: {density: 1 kg/m^3, E: 1 Pa, nu: 0.2}}\n"
    "bodies: [{name: block, shape: {box: {size: [1 m, 1 m, 1 m]}}, fill: {noisy_grid: {cells: [3, 3, 3], spread: 90 %}}, material: stone}]\n"
    "stages: [{name: swing, solver: {dynamic: {steps: 20}}, initial: [velocity: {gradient: {x: [1e-3 1/s, 0, 0]}}]}]\n"
    "sensors: {kinetic: {energy: kinetic}}\noutput: {picture: false}\n";
int main(void)
{
    breccia_scene *scene = breccia_scene_text("user.yaml", scene_text, sizeof scene_text - 1, 0, NULL);
    breccia_options options = {0};
    options.device = "cpu";
    options.folder = "results";
    breccia_run *run = breccia_run_create(scene, &options);
    int64_t done = 0;
    breccia_array u = {0};
    breccia_status status = breccia_run_step(run, 20, &done);
    if (status == BRECCIA_OK) status = breccia_run_array(run, "displacement", 0, &u);
    if (status == BRECCIA_OK) status = breccia_run_end(run);
    printf("version %s steps %d rows %d %s\n", breccia_version(), (int)done, (int)u.n_rows, breccia_run_message(run));
    breccia_run_free(run);
    breccia_scene_free(scene);
    return breccia_interface() == BRECCIA_INTERFACE && status == BRECCIA_OK ? 0 : 1;
}
"""
FIND_PACKAGE = """cmake_minimum_required(VERSION 3.25)
project(user C CXX)
find_package(breccia 0.1 REQUIRED CONFIG)
add_executable(user user.c)
target_link_libraries(user PRIVATE breccia::breccia)
add_executable(user_cxx user_cxx.cc)
target_link_libraries(user_cxx PRIVATE breccia::breccia)
"""


def flags_of(prefix):
    """Compiler and linker flags as pkg-config gives them; of the file itself where pkg-config is missing."""
    folder = os.path.join(prefix, "lib/pkgconfig")
    if shutil.which("pkg-config"):
        asked = subprocess.run(["pkg-config", "--cflags", "--libs", "breccia"], capture_output=True, text=True, check=True,
                               env=dict(os.environ, PKG_CONFIG_PATH=folder))
        return asked.stdout.split()
    with open(os.path.join(folder, "breccia.pc"), encoding="utf-8") as file:
        package = file.read().replace("${prefix}", prefix)
    return " ".join(re.search(rf"^{key}: (.*)$", package, re.M).group(1) for key in ("Cflags", "Libs")).split()


def run_user(user, prefix, folder):
    """The sentence of a failure of a program that uses the library, or None."""
    here = tempfile.mkdtemp(dir=folder)
    ran = subprocess.run([user], capture_output=True, text=True, cwd=here, env=dict(os.environ, LD_LIBRARY_PATH=os.path.join(prefix, "lib")))
    if ran.returncode or not re.search(r"version [0-9.]+ steps 20 rows (2[7-9]|[3-9][0-9]) ", ran.stdout):
        return f"a program using the library gave {ran.returncode}: {ran.stdout}{ran.stderr}"
    with open(os.path.join(here, "results/histories.csv"), encoding="utf-8") as file:
        rows = file.read().splitlines()
    return None if rows[0].endswith("kinetic [J]") and len(rows) == 22 else f"its histories are {rows[:3]}, {len(rows)} rows"


def use_library(prefix, folder):
    """Compile, link and run programs against the installed header and library, by pkg-config and by find_package; sentences of failures."""
    source, user = os.path.join(folder, "user.c"), os.path.join(folder, "user")
    with open(source, "w", encoding="utf-8") as file:
        file.write(USER_OF_THE_LIBRARY)
    shutil.copy(source, os.path.join(folder, "user_cxx.cc"))
    with open(os.path.join(folder, "CMakeLists.txt"), "w", encoding="utf-8") as file:
        file.write(FIND_PACKAGE)
    built = subprocess.run(["cc", "-std=c11", "-Wall", "-Wextra", "-Werror", source, "-o", user, *flags_of(prefix)], capture_output=True, text=True)
    if built.returncode:
        return ["a program does not compile against the library: " + built.stderr]
    build = os.path.join(folder, "build")
    for command in (["cmake", "-S", folder, "-B", build, "-DCMAKE_PREFIX_PATH=" + prefix], ["cmake", "--build", build]):
        built = subprocess.run(command, capture_output=True, text=True)
        if built.returncode:
            return ["find_package(breccia): " + built.stdout + built.stderr]
    return [found for found in (run_user(os.path.join(where), prefix, folder)
                                for where in (user, os.path.join(build, "user"), os.path.join(build, "user_cxx"))) if found]


failures = []
with tempfile.TemporaryDirectory() as folder:
    first, moved = os.path.join(folder, "first"), os.path.join(folder, "moved")
    installed = subprocess.run(["cmake", "--install", BUILD, "--prefix", first], capture_output=True, text=True)
    if installed.returncode:
        sys.exit("install: cmake --install failed: " + installed.stderr)
    shutil.move(first, moved)
    for name in ("bin/breccia", "include/breccia.h", "lib/libbreccia.so.1", "share/breccia/examples", "share/breccia/scene.schema.json", "share/breccia/summary.schema.json", "share/breccia/rows.schema.json", "share/man/man1/breccia.1",
                 "share/bash-completion/completions/breccia", "share/zsh/site-functions/_breccia", "share/doc/breccia/LICENSE", "share/doc/breccia/docs/reference/scene/README.md"):
        if not os.path.exists(os.path.join(moved, name)):
            failures.append(f"{name} is not installed")
    stage = os.path.join(folder, "stage")  # as packages of distributions are made
    subprocess.run(["cmake", "--install", BUILD, "--prefix", "/usr"], capture_output=True, text=True, check=True, env=dict(os.environ, DESTDIR=stage))
    listed = [sorted(os.path.relpath(os.path.join(place, name), root) for place, _, names in os.walk(root) for name in names) for root in (moved, stage + "/usr")]
    if listed[0] != listed[1]:
        failures.append(f"with DESTDIR other files are installed: {sorted(set(listed[0]) ^ set(listed[1]))[:5]}")
    for place, _, names in os.walk(os.path.join(os.environ["BRC_SOURCE_DIR"], "examples")):
        for name in names:
            path = os.path.relpath(os.path.join(place, name), os.environ["BRC_SOURCE_DIR"])
            if not os.path.exists(os.path.join(moved, "share/breccia", path)):
                failures.append(f"{path} is not installed")
    with open(os.path.join(BUILD, "CMakeCache.txt"), encoding="utf-8") as file:
        sanitized = "BRC_SANITIZE:BOOL=ON" in file.read()
    if not sanitized:  # the sanitizer's runtime must come first in a program
        failures += use_library(moved, folder)
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
