"""`cpack -G DEB` makes a package whose program runs where the package was unpacked, which names what it depends on and holds what is installed;
the Containerfile installs what CMake asks for."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import repository

BUILD = os.environ["BRC_BUILD_DIR"]
FAILURES = []


def expect(condition, sentence):
    if not condition:
        FAILURES.append(sentence)


def told(*line, **more):
    done = subprocess.run(line, capture_output=True, text=True, check=False, **more)
    if done.returncode:
        sys.exit(f"package: {' '.join(line)} ended with {done.returncode}: {done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


def package(folder):
    told("cpack", "-G", "DEB", "-B", folder, cwd=BUILD)
    found = [name for name in os.listdir(folder) if name.endswith(".deb")]
    if len(found) != 1:
        sys.exit(f"package: {len(found)} packages were made: {found}")
    expect(re.fullmatch(r"breccia_[0-9.]+_[a-z0-9]+\.deb", found[0]), f"the package is called {found[0]}")
    return os.path.join(folder, found[0])


def look_inside(deb, folder):
    field = {name: told("dpkg-deb", "-f", deb, name).strip() for name in ("Package", "Version", "Depends", "Recommends", "Description", "Maintainer")}
    for name, words in field.items():
        expect(words, f"the package has no {name}")
    for library in ("libc6", "libhdf5", "libyaml", "libcairo", "libgomp1", "ocl-icd-libopencl1"):
        expect(library in field["Depends"], f"the package does not depend on {library}: {field['Depends']}")
    expect("-dev" not in field["Depends"], f"the package depends on what only building takes: {field['Depends']}")
    root = os.path.join(folder, "root")
    told("dpkg-deb", "-x", deb, root)
    for name in ("bin/breccia", "lib/libbreccia.so.1", "include/breccia.h", "lib/pkgconfig/breccia.pc", "lib/cmake/breccia/breccia-config.cmake", "share/man/man1/breccia.1",
                 "share/bash-completion/completions/breccia", "share/breccia/scene.schema.json", "share/breccia/summary.schema.json", "share/doc/breccia/LICENSE",
                 "share/breccia/examples/tension/scene.yaml"):
        path = os.path.join(root, "usr", name)
        expect(os.path.exists(path) and os.path.getsize(path) > 0, f"the package lacks usr/{name}")
    for place, folders, files in os.walk(root):
        for name in folders + files:
            path = os.path.join(place, name)
            expect(os.path.islink(path) or os.stat(path).st_mode & 0o022 == 0, f"{os.path.relpath(path, root)} may be changed by anybody")
    expect(sorted(os.listdir(root)) == ["usr"], f"the package has files outside /usr: {os.listdir(root)}")
    program = os.path.join(root, "usr/bin/breccia")
    environment = dict(os.environ, POCL_CACHE_DIR=os.path.join(folder, "cache"))
    version = told(program, "-V", cwd=folder, env=environment)
    expect(field["Version"] in version, f"breccia -V says {version.strip()} in package {field['Version']}")
    devices = told(program, "devices", cwd=folder, env=environment)
    expect("cpu" in devices, f"breccia devices says {devices}")


def look_at_container_file():
    texts = repository.read(r"^(Containerfile|cmake/dependencies\.cmake)$")
    asked = set(re.findall(r"\b((?:lib[\w.+-]*|voro\+\+|opencl|ocl-icd-opencl)-(?:dev|headers))\b", texts["cmake/dependencies.cmake"]))
    asked -= {"libcmocka-dev", "libccd-dev", "libopenmpi-dev"}  # of the tests, and of breccia-mpi
    installed = set(texts["Containerfile"].split())
    expect(len(asked) >= 8 and asked <= installed, f"the Containerfile does not install {sorted(asked - installed)}")


missing = [tool for tool in ("cpack", "dpkg-deb", "dpkg-shlibdeps") if not shutil.which(tool)]
look_at_container_file()
if missing:
    print(f"SKIPPED: no {', '.join(missing)}; apt-get install cmake dpkg-dev")
    sys.exit(1 if os.environ.get("BRC_NO_SKIPS") or FAILURES else 77)
with tempfile.TemporaryDirectory() as scratch:
    look_inside(package(scratch), scratch)
for failure in FAILURES:
    print("package: " + failure)
sys.exit(1 if FAILURES else 0)
