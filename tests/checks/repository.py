"""What the checks of the repository share: its files, their code without comments, and how a check reports.

A check is a function from {path: text} to a list of sentences (empty: all is well), so that it can be tried on made-up
input: run(check, files, should_fail) first shows that each bad example is found, then looks at the repository.
"""
import os
import re
import sys

ROOT = os.environ.get("BRC_SOURCE_DIR") or os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SKIPPED = re.compile(r"^(build[^/]*|results|\.git|\.cache|.*/__pycache__)$")


def paths():
    """Every file of the working tree that is not built, relative to the root."""
    found = []
    for folder, folders, files in os.walk(ROOT):
        relative = os.path.relpath(folder, ROOT)
        prefix = "" if relative == "." else relative + "/"
        folders[:] = sorted(f for f in folders if not SKIPPED.match(prefix + f) and f != "__pycache__")
        found += [prefix + f for f in sorted(files)]
    return found


def read(wanted):
    """{path: text} of the files whose path matches the pattern."""
    texts = {}
    for path in paths():
        if re.search(wanted, path):
            with open(os.path.join(ROOT, path), encoding="utf-8") as file:
                texts[path] = file.read()
    return texts


def code_of(text):
    """C without comments and without the insides of strings; line numbers are kept."""
    pattern = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', re.S)

    def blank(match):
        piece = match.group(0)
        if piece[0] in "\"'":
            return piece[0] * 2
        return " " + "\n" * piece.count("\n")

    return pattern.sub(blank, text)


def report(name, check, files, bad_examples):
    """True when the check finds something in each bad example and nothing in the repository."""
    good = True
    for what, example in bad_examples.items():
        if not check(example):
            print(f"{name}: cannot fail: nothing found in the example '{what}'")
            good = False
    if not files:
        print(f"{name}: no file to look at")
        good = False
    findings = check(files)
    for finding in findings:
        print(f"{name}: {finding}")
    if good and not findings:
        print(f"{name}: {len(files)} files, all well")
    return good and not findings


def finish(results):
    sys.exit(0 if all(results) else 1)
