"""Builds libbreccia.so and the program breccia from the repository around this folder with the system's cmake, and puts both into the wheel.

BRECCIA_BUILD: a build folder of the repository to take the library from, or to build it in (default: build/wheel of the repository).
CMAKE_ARGS: more arguments for cmake, e.g. -DBRC_ISA_LEVELS=v3.
"""
import os
import re
import shlex
import shutil
import subprocess
import sys

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
if not os.path.exists(os.path.join(ROOT, "host", "include", "breccia.h")):
    sys.exit("breccia's Python package is built from its repository: clone it, and run `pip install ./python` there")

with open(os.path.join(ROOT, "CMakeLists.txt"), encoding="utf-8") as file:
    VERSION = re.search(r"^project\(breccia VERSION (\S+)", file.read(), re.M).group(1)
with open(os.path.join(ROOT, "host", "include", "breccia.h"), encoding="utf-8") as file:
    INTERFACE = re.search(r"^#define BRECCIA_INTERFACE (\d+)$", file.read(), re.M).group(1)

try:
    from wheel.bdist_wheel import bdist_wheel
except ImportError:  # newer setuptools has it itself
    from setuptools.command.bdist_wheel import bdist_wheel


class PlatformWheel(bdist_wheel):
    """A library of this machine's kind, for any Python 3."""

    def finalize_options(self):
        super().finalize_options()
        self.root_is_pure = False

    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


class BinaryDistribution(Distribution):
    def has_ext_modules(self):
        return True


def build_library():
    """The folder in which the library was built."""
    build = os.environ.get("BRECCIA_BUILD") or os.path.join(ROOT, "build", "wheel")
    if not os.path.exists(os.path.join(build, "CMakeCache.txt")):
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        subprocess.run(["cmake", *generator, "-S", ROOT, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DBRC_TESTS=OFF",
                        *shlex.split(os.environ.get("CMAKE_ARGS", ""))], check=True)
    subprocess.run(["cmake", "--build", build, "--target", "brc_program"], check=True)
    return build


class BuildWithLibrary(build_py):
    def run(self):
        super().run()
        if getattr(self, "editable_mode", False):
            sys.exit("an editable install has no library: set PYTHONPATH to python/src and BRECCIA_LIBRARY to libbreccia.so instead")
        build = build_library()
        target = os.path.join(self.build_lib, "breccia", "lib")
        os.makedirs(os.path.join(target, "breccia"), exist_ok=True)
        shutil.copy(os.path.join(build, "lib", "libbreccia.so." + INTERFACE), target)
        shutil.copy(os.path.join(ROOT, "LICENSE"), os.path.dirname(target))
        program = os.path.join(self.build_lib, "breccia", "bin")
        os.makedirs(program, exist_ok=True)
        shutil.copy(os.path.join(build, "bin", "breccia"), program)
        plugin = os.path.join(build, "libbreccia_target.so")
        if os.path.exists(plugin):
            shutil.copy(plugin, os.path.join(target, "breccia"))


OWN = os.path.join(ROOT, "build", "python")  # nothing is left among the sources
os.makedirs(OWN, exist_ok=True)
setup(version=VERSION, options={"build": {"build_base": OWN}, "egg_info": {"egg_base": OWN}}, cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": PlatformWheel}, distclass=BinaryDistribution)
