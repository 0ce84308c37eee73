"""Every C, C++ and OpenCL source is as clang-format 14 writes it from .clang-format; no line is longer than 120 columns.

The version is pinned, since each formats differently: Debian's clang-format-14, or clang-format==14.0.6 of PyPI.
`python3 tests/checks/test_format.py --write` formats what differs.
"""
import concurrent.futures
import os
import re
import shutil
import subprocess
import sys
import repository

VERSION = "14."
LONGEST = 120
CODE = r"^(host|kernels|preprocess|bench|tests|python|examples)/.*\.(c|h|cl|cc)$"


def formatter():
    for name in ("clang-format-14", "clang-format"):
        path = shutil.which(name)
        if path and re.search(r"version " + re.escape(VERSION),
                              subprocess.run([path, "--version"], capture_output=True, text=True, check=True).stdout):
            return path
    sys.exit("test_format: no clang-format 14 here; install clang-format-14 (Debian) or clang-format==14.0.6 (PyPI)")


def formatted(path, text):
    return subprocess.run([PROGRAM, "--assume-filename=" + os.path.join(repository.ROOT, path)], input=text,
                          capture_output=True, text=True, check=True, cwd=repository.ROOT).stdout


def different(files):
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        results = pool.map(formatted, files.keys(), files.values())
    findings = []
    for (path, text), result in zip(files.items(), results):
        if text != result:
            lines = zip(text.split("\n"), result.split("\n") + [""])
            number = next((n for n, (a, b) in enumerate(lines, 1) if a != b), text.count("\n") + 1)
            findings.append(f"{path}:{number}: not as clang-format 14 writes it; run tests/checks/test_format.py --write")
    return findings


def long_lines(files):
    return [f"{path}:{number}: {len(line)} columns; {LONGEST} at most" for path, text in files.items()
            for number, line in enumerate(text.split("\n"), 1) if len(line) > LONGEST]


PROGRAM = formatter()
sources = repository.read(CODE)
if "--write" in sys.argv:
    for name, source in sources.items():
        new = formatted(name, source)
        if new != source:
            with open(os.path.join(repository.ROOT, name), "w", encoding="utf-8") as file:
                file.write(new)
            print(name)
    sys.exit(0)
repository.finish([
    repository.report("format", different, sources, {"two statements": {"host/base/a.c": "int a;  int b;\n"}}),
    repository.report("columns", long_lines, sources, {"121 columns": {"host/base/a.c": "/*" + "a" * 117 + "*/\n"}}),
])
