"""Modules that Debian's packages bring, whatever Python `python3` is: that of Debian takes over where this one lacks them."""
import importlib
import os
import subprocess
import sys

DEBIAN = "/usr/bin/python3"


def need(packages, *modules):
    """The modules; or the script goes on with Debian's Python, or is skipped (77; a failure where BRC_NO_SKIPS is set)."""
    try:
        return [importlib.import_module(name) for name in modules]
    except ImportError:
        pass
    if os.path.realpath(sys.executable) != os.path.realpath(DEBIAN) and os.path.exists(DEBIAN):
        if subprocess.run([DEBIAN, "-c", "import " + ", ".join(modules)], stderr=subprocess.DEVNULL, check=False).returncode == 0:
            os.execv(DEBIAN, [DEBIAN, "-B", *sys.argv])
    print(f"SKIPPED: no Python with {', '.join(modules)}; apt-get install {packages}")
    sys.exit(1 if os.environ.get("BRC_NO_SKIPS") else 77)
