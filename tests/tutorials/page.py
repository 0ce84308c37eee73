"""A page of docs/guide/tutorials in pieces: text, fenced blocks, figures, pictures, cells of the notebook (README.md)."""

import csv
import json
import math
import os
import re
from collections import namedtuple

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FOLDER = os.path.join(ROOT, "docs", "guide", "tutorials")

#: kind: text, sh, output, yaml, python, figures, picture, notebook; info: the mark before it, or its words;
#: body: without its marks.
Piece = namedtuple("Piece", "kind info body begin end")
Figure = namedtuple("Figure", "name unit value reference bound repeats")

PIECE = re.compile(
    r"^(?:<!-- (?P<mark>long|scene \S+) -->\n)?```(?P<info>\w*)\n(?P<fenced>.*?)^```\n"
    r"|^<!-- (?P<figures>(?:long )?figures)\n(?P<lines>.*?)^-->\n(?P<table>(?:\n?(?:\|[^\n]*\n)+)?)"
    r"|^<!-- picture (?P<picture>\S+) -->\n!\[[^\]]*\]\((?P<image>[^)]+)\)\n"
    r"|^<!-- notebook\n(?P<notebook>.*?)^-->\n",
    re.M | re.S,
)
KINDS = {"sh": "sh", "text": "output", "yaml": "yaml", "python": "python"}


def names():
    return sorted(file[:-3] for file in os.listdir(FOLDER) if file.endswith(".md") and file != "README.md")


def read(name):
    with open(os.path.join(FOLDER, name + ".md"), encoding="utf-8") as file:
        return file.read()


def pieces(text):
    """The page in order; begin and end are places in the text."""
    found, place = [], 0
    for match in PIECE.finditer(text):
        if match.start() > place:
            found.append(Piece("text", "", text[place : match.start()], place, match.start()))
        place = match.end()
        if match["info"] is not None:
            if match["info"] not in KINDS:
                raise SystemExit(f"a block of kind '{match['info']}': expected one of {', '.join(KINDS)}")
            found.append(Piece(KINDS[match["info"]], match["mark"] or "", match["fenced"], match.start(), match.end()))
        elif match["figures"]:
            found.append(Piece("figures", match["figures"], match["lines"], match.start(), match.end()))
        elif match["picture"]:
            found.append(Piece("picture", match["picture"], match["image"], match.start(), match.end()))
        else:
            found.append(Piece("notebook", "", match["notebook"], match.start(), match.end()))
    if place < len(text):
        found.append(Piece("text", "", text[place:], place, len(text)))
    return found


def share(text):
    return float(text.rstrip("% ")) / (100 if "%" in text else 1) if text else None


def figures(piece):
    """The lines of a `figures` mark."""
    found = []
    for line in piece.body.splitlines():
        cells = [cell.strip() for cell in line.split("|")]
        if len(cells) != 6:
            raise SystemExit(f"figure '{line}': expected name | unit | value | reference | bound | repeats")
        found.append(Figure(*cells[:4], share(cells[4]), share(cells[5])))
    return found


def printed_table(text, piece):
    """The table after a `figures` mark."""
    return text[piece.begin : piece.end].split("-->\n", 1)[1].strip()


def printed_values(text, piece):
    """{name: value} of that table."""
    rows = [
        [cell.strip() for cell in line.strip("|").split("|")] for line in printed_table(text, piece).splitlines()[2:]
    ]
    return {row[0]: float(row[1].split()[0]) for row in rows}


def number(value):
    return f"{value:.4g}"


def table(rows):
    """The table of [(figure, value, reference or None)]."""
    lines = ["| figure | breccia | reference | difference |", "| --- | --- | --- | --- |"]
    for figure, value, reference in rows:
        unit = " " + figure.unit if figure.unit else ""
        if reference is None:
            lines.append(f"| {figure.name} | {number(value)}{unit} | | |")
        else:
            off = 100 * (value / reference - 1)
            lines.append(f"| {figure.name} | {number(value)}{unit} | {number(reference)}{unit} | {off:+.1f} % |")
    return "\n".join(lines) + "\n"


class Results:
    """What expressions of figures may ask of the folders of runs below `folder`."""

    def __init__(self, folder):
        self.folder = folder

    def ended(self, run, *keys):
        """A value of summary.json."""
        with open(os.path.join(self.folder, run, "summary.json"), encoding="utf-8") as file:
            value = json.load(file)
        for key in keys:
            value = value[key]
        return value

    def measure(self, run, name):
        return self.ended(run, "measures", name, "value")

    def fit(self, study, number=0):
        """Exponent (or modulus) of a fit of a study."""
        with open(os.path.join(self.folder, study, "fits.csv"), encoding="utf-8", newline="") as file:
            rows = [row for row in csv.DictReader(file) if row["parameter"] in ("exponent", "modulus")]
        return float(rows[number]["value"])

    def space(self):
        return {"math": math, "ended": self.ended, "measure": self.measure, "fit": self.fit}
