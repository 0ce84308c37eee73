"""python3 tests/tutorials/notebook.py [--check]: writes python/notebooks/*.ipynb from the pages of docs/guide/tutorials,
or says which are not the same."""

import json
import os
import re
import shlex
import sys

import page

FOLDER = os.path.join(page.ROOT, "python", "notebooks")
SITE = "../../docs/guide/tutorials/"

SETUP = '''import csv
import math

import breccia
import pandas
from IPython.display import Image


def ended(run, *keys):
    """A value of summary.json of a run."""
    value = breccia.Results(run).summary
    for key in keys:
        value = value[key]
    return value


def measure(run, name):
    return breccia.Results(run).measures[name]


def fit(study, number=0):
    """Exponent (or modulus) of a fit of a study."""
    with open(f"{study}/fits.csv", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["parameter"] in ("exponent", "modulus")]
    return float(rows[number]["value"])


def compare(*figures):
    """(name, unit, value, reference or None, bound): a table; an error where a value is off by more than its bound."""
    for name, unit, value, reference, bound in figures:
        assert reference is None or abs(value - reference) <= bound * abs(reference), (name, value, reference)
    return pandas.DataFrame([row[:4] for row in figures], columns=["figure", "unit", "breccia", "reference"])
'''


def call_of(line):
    """A command of the program as the same call of the package; None where there is none."""
    words = shlex.split(line, comments=True)
    if not words or words[0] != "breccia" or "$" in line or "--exact" in words:
        return None
    command, operands, options, sets = words[1], [], {}, {}
    rest = iter(words[2:])
    for word in rest:
        if word == "--set":
            key, value = next(rest).split("=", 1)
            if value[:1] in "[{":
                return None
            sets[key] = value
        elif word.startswith("-"):
            options[{"-o": "out"}.get(word, word.lstrip("-"))] = next(rest)
        else:
            operands.append(word)
    out = options.pop("out", None)
    more = "".join(f", {name}={json.dumps(value)}" for name, value in options.items())
    of = (
        f'breccia.Scene.load({json.dumps(operands[0])}{", set=" + json.dumps(sets) if sets else ""})'
        if operands
        else ""
    )
    calls = {
        "new": f"breccia.new({json.dumps(operands[0])})" if operands else "print(breccia.new())",
        "devices": "breccia.devices()",
        "check": f"{of}.check({more[2:]})",
        "run": f"{of}.run({json.dumps(out)}, progress=True{more}).measures",
        "study": f"breccia.study({json.dumps(operands[0]) if operands else ''}, {json.dumps(out)}{more}).table()",
    }
    return calls.get(command)


def shell_cells(body):
    lines = body.replace("\\\n", " ").splitlines()
    calls = [call_of(line) for line in lines]
    if None in calls:
        return [("code", "%%sh -e\n" + body.rstrip("\n"))]
    return [("code", call) for call in calls]


def figure_cell(piece):
    rows = [
        f'    ("{figure.name}", "{figure.unit}", {figure.value}, {figure.reference or None}, {figure.bound or 0:g}),'
        for figure in page.figures(piece)
    ]
    return ("code", "compare(\n" + "\n".join(rows) + "\n)")


def linked(text):
    """Text of the page whose relative links lead from the notebook's folder."""
    return re.sub(r"\]\((?!https?:|#)([^)]+)\)", lambda match: "](" + os.path.normpath(SITE + match[1]) + ")", text)


def cells_of(name):
    cells, is_long = [], False
    for piece in page.pieces(page.read(name)):
        if piece.kind == "text" and piece.body.strip():
            cells.append(("markdown", linked(piece.body.strip())))
        elif piece.kind == "yaml":
            cells.append(("markdown", "```yaml\n" + piece.body + "```"))
        elif piece.kind == "sh" and piece.info == "long":
            is_long = True
            cells.append(("markdown", "Longer runs, in a shell:\n\n```sh\n" + piece.body + "```"))
        elif piece.kind == "sh":
            cells += shell_cells(piece.body)
        elif piece.kind in ("python", "notebook"):
            cells.append(("code", piece.body.rstrip("\n")))
        elif piece.kind == "picture":
            cells.append(("code", f"Image({json.dumps(piece.info)}, width=700)"))
        elif piece.kind == "figures" and piece.info == "figures":
            cells.append(figure_cell(piece))
        elif piece.kind == "figures" and is_long:
            cells.append(("markdown", "They gave:\n\n" + page.printed_table(page.read(name), piece)))
    cells.insert(1, ("code", SETUP.rstrip("\n")))
    return cells


def notebook(name):
    cells = []
    for k, (kind, source) in enumerate(cells_of(name)):
        cell = {"cell_type": kind, "id": f"{name}-{k}", "metadata": {}, "source": source.splitlines(keepends=True)}
        if kind == "code":
            cell.update(execution_count=None, outputs=[])
        cells.append(cell)
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    return (
        json.dumps(
            {
                "cells": cells,
                "metadata": {"kernelspec": kernel, "language_info": {"name": "python"}},
                "nbformat": 4,
                "nbformat_minor": 5,
            },
            indent=1,
            ensure_ascii=False,
        )
        + "\n"
    )


def path_of(name):
    return os.path.join(FOLDER, name + ".ipynb")


def faults():
    """What differs between the notebooks that are there and those of the pages."""
    found = [
        f"{file}: no page of this name"
        for file in sorted(os.listdir(FOLDER))
        if file.endswith(".ipynb") and file[:-6] not in page.names()
    ]
    for name in page.names():
        if not os.path.exists(path_of(name)) or open(path_of(name), encoding="utf-8").read() != notebook(name):
            found.append(f"{name}.ipynb is not that of its page; python3 tests/tutorials/notebook.py")
    return found


def main():
    if "--check" in sys.argv[1:]:
        found = faults()
        print("\n".join(found))
        return 1 if found else 0
    for name in page.names():
        text = notebook(name)
        with open(path_of(name), "w", encoding="utf-8") as file:
            file.write(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
