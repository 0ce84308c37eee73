"""The site of docs/, built with the pinned tools of docs/requirements.txt in an environment of the build folder."""

import filecmp
import os
import shutil
import subprocess
import sys

SOURCE = os.environ["BRC_SOURCE_DIR"]
BUILD = os.environ["BRC_BUILD_DIR"]


def skip(why):
    refused = bool(os.environ.get("BRC_NO_SKIPS"))
    print(f"SKIPPED{', but BRC_NO_SKIPS is set' if refused else ''}: {why}")
    sys.exit(1 if refused else 77)


def tools():
    """The folder of the tools' programs; skips where PyPI cannot be reached."""
    wanted = os.path.join(SOURCE, "docs", "requirements.txt")
    folder = os.path.join(BUILD, "site-tools")
    kept = os.path.join(folder, "requirements.txt")
    if not (os.path.exists(kept) and filecmp.cmp(wanted, kept, shallow=False)):
        shutil.rmtree(folder, ignore_errors=True)
        made = subprocess.run([sys.executable, "-m", "venv", folder], capture_output=True, text=True)
        if made.returncode:
            skip(
                "python3 cannot make virtual environments (Debian: python3-venv): " + made.stdout.strip().split("\n")[0]
            )
        pip = subprocess.run(
            [folder + "/bin/pip", "install", "--disable-pip-version-check", "-q", "-r", wanted],
            capture_output=True,
            text=True,
        )
        if pip.returncode:
            if "No matching distribution" in pip.stderr and "connection" not in pip.stderr.lower():
                sys.exit(pip.stderr)
            skip("the tools of the site cannot be installed from PyPI: " + pip.stderr.strip().split("\n")[-1])
        shutil.copy(wanted, kept)
    return folder + "/bin"


def build(pages, out):
    """Builds strictly: the exit code of sphinx-build and what it said."""
    done = subprocess.run(
        [tools() + "/sphinx-build", "-q", "-W", "--keep-going", "-E", "-b", "html", pages, out],
        capture_output=True,
        text=True,
    )
    return done.returncode, done.stdout + done.stderr
