"""python3 tests/tutorials/run.py [--renew [--long]] NAME...: runs tutorials as their pages print them (README.md)."""

import argparse
import contextlib
import os
import re
import shutil
import subprocess
import sys
import tempfile

import page

SECONDS = 1800  # of one block


def scene_faults(name, pieces):
    """The yaml blocks of a page are its scenes, piece by piece."""
    faults, blocks = [], {}
    for piece in pieces:
        if piece.kind == "yaml":
            blocks.setdefault(piece.info[len("scene ") :] or name + ".yaml", []).append(piece.body)
    for file, shown in blocks.items():
        with open(os.path.join(page.FOLDER, file), encoding="utf-8") as scene:
            text = scene.read().split("\n", 1)[1]
        if re.sub(r"\n+", "\n", "\n" + "\n".join(shown)) != re.sub(r"\n+", "\n", "\n" + text):
            wrong = [block.split("\n")[0] for block in shown if block.strip() not in text]
            faults.append(
                f"{file} is not what the page shows of it"
                + (f"; blocks that differ begin with {wrong}" if wrong else "; a part is missing")
            )
    return faults


def first_word(line):
    """What a line begins with. The decimals of a line of CSV, which has no spaces, differ in their last digits between
    processors: a mark stands for them here, the page's figures hold them to their bounds."""
    return re.sub(r"-?\d+\.\d+(e[-+]?\d+)?", "#", line).split()[0]


class Tutorial:
    """One page in an empty folder."""

    def __init__(self, name, folder, program, long, renewed):
        self.name, self.folder, self.long, self.renewed = name, folder, long, renewed
        self.text = page.read(name)
        self.pieces = page.pieces(self.text)
        self.results = page.Results(folder)
        self.space = {}  # names of the page's own Python
        self.environment = dict(os.environ, PATH=os.path.dirname(program) + os.pathsep + os.environ["PATH"])
        self.outputs = {}  # of a piece, by its place
        self.rows = {}  # of figures, by their place
        self.faults = scene_faults(name, self.pieces)

    def skipped(self, piece):
        return piece.info.startswith("long") and not self.long

    def run_shell(self, piece):
        ran = subprocess.run(
            ["sh", "-e", "-c", piece.body],
            cwd=self.folder,
            env=self.environment,
            capture_output=True,
            text=True,
            timeout=SECONDS,
            check=False,
        )
        if ran.returncode != 0:
            raise SystemExit(f"{self.name}: exit code {ran.returncode} of\n{piece.body}{ran.stdout}{ran.stderr}")
        return ran.stdout

    def run_python(self, piece):
        before = os.getcwd()
        os.chdir(self.folder)
        try:
            with contextlib.redirect_stdout(sys.stderr):
                exec(
                    compile(piece.body, f"{self.name}.md", "exec"), self.space
                )  # the page's own code is what is tested
        finally:
            os.chdir(before)

    def run(self):
        last = None
        for piece in self.pieces:
            if piece.kind == "sh":
                last = None if self.skipped(piece) else self.run_shell(piece)
            elif piece.kind == "output" and last is not None:
                self.compare_output(piece, last)
            elif piece.kind == "python":
                self.run_python(piece)
            elif piece.kind == "figures" and not self.skipped(piece):
                self.measure(piece)
            elif piece.kind == "picture" and not os.path.exists(os.path.join(self.folder, piece.info)):
                self.faults.append(f"no picture {piece.info}")

    def compare_output(self, piece, output):
        self.outputs[piece.begin] = output
        words = [[first_word(line) for line in text.splitlines() if line.strip()] for text in (piece.body, output)]
        if not self.renewed and words[0] != words[1]:
            self.faults.append(f"the page prints lines that begin with {words[0]}, the program {words[1]}")

    def measure(self, piece):
        rows = []
        printed = page.printed_values(self.text, piece)
        for figure in page.figures(piece):
            space = {**self.results.space(), **self.space}
            value = float(eval(figure.value, space))
            reference = float(eval(figure.reference, space)) if figure.reference else None
            rows.append((figure, value, reference))
            if reference is not None and not abs(value - reference) <= figure.bound * abs(reference):
                self.faults.append(
                    f"{figure.name}: {value:.6g}, the reference is {reference:.6g}, the bound {100 * figure.bound:g} %"
                )
            old = printed.get(figure.name)
            if not self.renewed and (old is None or not abs(value - old) <= figure.repeats * abs(old)):
                self.faults.append(
                    f"{figure.name}: {value:.6g}, the page prints {old}; it should repeat to {100 * figure.repeats:g} %"
                )
        self.rows[piece.begin] = rows
        print(page.table(rows), end="")

    def renew(self):
        """The page with what this run found, and its pictures."""
        out, place = [], 0
        for piece in self.pieces:
            if piece.begin in self.outputs:
                new = f"```text\n{self.outputs[piece.begin]}```\n"
            elif piece.begin in self.rows:
                new = f"<!-- {piece.info}\n{piece.body}-->\n\n{page.table(self.rows[piece.begin])}"
            else:
                continue
            out += [self.text[place : piece.begin], new]
            place = piece.end
        with open(os.path.join(page.FOLDER, self.name + ".md"), "w", encoding="utf-8") as file:
            file.write("".join(out) + self.text[place:])
        for piece in self.pieces:
            if piece.kind == "picture":
                shutil.copy(os.path.join(self.folder, piece.info), os.path.join(page.FOLDER, piece.body))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--renew", action="store_true")
    parser.add_argument("--long", action="store_true")
    parser.add_argument("names", nargs="*", default=page.names(), metavar="NAME")
    asked = parser.parse_args()
    program = os.path.abspath(os.environ.get("BRC_PROGRAM", "build/release/bin/breccia"))
    faults = []
    for name in asked.names:
        with tempfile.TemporaryDirectory() as folder:
            tutorial = Tutorial(name, folder, program, asked.long, asked.renew)
            tutorial.run()
            if asked.renew:
                tutorial.renew()
        faults += [f"{name}: {fault}" for fault in tutorial.faults]
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
