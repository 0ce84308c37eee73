"""The program `breccia`, which does what is a command and no call of the library: studies and scenes to begin with."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from typing import List, Optional, Union

from .errors import FileError, error_of

#: Exit codes of the program as statuses of the library: stopped physics, input, device or file.
_STATUS = {1: 1, 2: 2, 3: 5}


def program() -> str:
    """BRECCIA_PROGRAM alone if it is set, else the one in the package, beside BRECCIA_LIBRARY, or that of the shell."""
    named = os.environ.get("BRECCIA_PROGRAM")
    if named:
        return named
    beside = os.environ.get("BRECCIA_LIBRARY")
    folders = [os.path.join(os.path.dirname(os.path.abspath(__file__)), "bin")]
    folders += [os.path.join(os.path.dirname(os.path.abspath(beside)), "..", "bin")] if beside else []
    for folder in folders:
        path = os.path.normpath(os.path.join(folder, "breccia"))
        if os.access(path, os.X_OK):
            return path
    found = shutil.which("breccia")
    if not found:
        raise FileError(
            "the program breccia is not in the package, beside BRECCIA_LIBRARY or in PATH; set BRECCIA_PROGRAM to it"
        )
    return found


def call(arguments: List[str], progress: bool = False) -> str:
    """Run the program; its standard output. A failure is raised. ``progress``: its messages go to the terminal."""
    ran = subprocess.Popen(
        [program(), *arguments], stdout=subprocess.PIPE, stderr=None if progress else subprocess.PIPE, text=True
    )
    try:
        out, messages = ran.communicate()
    except BaseException:  # Ctrl-C reaches the program too
        ran.terminate()
        ran.wait()
        raise
    if ran.returncode != 0:
        raise error_of(
            _STATUS.get(ran.returncode, 7),
            (messages or out).strip() or f"breccia {arguments[0]} ended with {ran.returncode}",
        )
    return out


def new(name: Optional[str] = None, path: Optional[Union[str, "os.PathLike[str]"]] = None) -> str:
    """Write a commented scene to begin with, as `breccia new` does, and return its path (default: NAME.yaml).

    Without a name: the list of them as text.
    """
    if name is None:
        return call(["new"])
    target = os.fspath(path) if path is not None else name + ".yaml"
    call(["new", name, "--output", target])
    return target


def main() -> None:
    """The command `breccia` of an environment that the package is installed in."""
    path = program()
    os.execv(path, [path, *sys.argv[1:]])
