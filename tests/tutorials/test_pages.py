"""What a page is held to, shown on pages that are wrong; what `breccia new` writes is accepted and runs, made small."""

import os
import subprocess
import sys
import tempfile

import page
import run

PROGRAM = os.environ["BRC_PROGRAM"]
#: Replacements that make a scene run in a second.
SMALL = {
    "bend": ["stages.1.solver.dynamic.duration=20 us"],
    "brazilian": ["bodies.0.fill.noisy_grid.spacing=5 mm", "stages.0.solver.dynamic.duration=100 us"],
    "compression": ["bodies.0.fill.packing.elements=500"],
    "fragmentation": ["bodies.0.fill.packing.elements=500"],
    "impact": ["bodies.0.fill.noisy_grid.cells=[12, 12, 2]"],
    "polycrystal": ["bodies.0.fill.noisy_grid.elements=1000", "bodies.0.grains.number=8"],
    "tension": ["bodies.0.fill.noisy_grid.elements=500"],
    "weakest-link": [],
}
faults = []


def program(folder, *words):
    return subprocess.run([PROGRAM, *words], cwd=folder, capture_output=True, text=True, check=False)


def expect(true, what):
    if not true:
        faults.append(what)


def scenes_run():
    listed = [line.split()[0] for line in program(".", "new").stdout.split("\n\n")[0].splitlines()]
    files = sorted(file[:-5] for file in os.listdir(page.FOLDER) if file.endswith(".yaml"))
    expect(listed == files, f"breccia new lists {listed}, the folder has {files}")
    expect(
        sorted(SMALL) + ["study"] == sorted(files, key=lambda name: (name == "study", name)),
        f"a scene without a small form: {files}",
    )
    with tempfile.TemporaryDirectory() as folder:
        for name in files:
            expect(program(folder, "new", name).returncode == 0, f"breccia new {name}")
            with open(os.path.join(folder, name + ".yaml"), "rb") as written, open(
                os.path.join(page.FOLDER, name + ".yaml"), "rb"
            ) as own:
                expect(written.read() == own.read(), f"breccia new {name} writes other bytes")
            expect(program(folder, "new", name).returncode == 2, f"breccia new {name} writes over a file")
        for name, sets in SMALL.items():
            options = [word for one in sets for word in ("--set", one)]
            for words in (
                ("check", name + ".yaml"),
                ("run", name + ".yaml", "-o", name, "--set", "output.picture=false"),
            ):
                ran = program(folder, *words, *options)
                expect(ran.returncode == 0, f"breccia {' '.join(words)}: {ran.stderr[-500:]}")


def tutorial(text, folder):
    """A page that is not in the repository."""
    one = run.Tutorial.__new__(run.Tutorial)
    one.name, one.folder, one.long, one.renewed, one.text = "made-up", folder, False, False, text
    one.pieces, one.results, one.space, one.outputs, one.rows = page.pieces(text), page.Results(folder), {}, {}, {}
    one.environment = dict(os.environ)
    one.faults = run.scene_faults("tension", [piece for piece in one.pieces])
    one.run()
    return one.faults


FIGURE = (
    "<!-- figures\nx | m | x | {reference} | 1 % | 1 %\n-->\n\n"
    "| figure | breccia | reference | difference |\n| --- | --- | --- | --- |\n| x | {printed} m | | |\n"
)


def pages_can_fail():
    with tempfile.TemporaryDirectory() as folder:
        good = "```python\nx = 2.0\n```\n" + FIGURE.format(reference="2.01", printed="2.0")
        expect(tutorial(good, folder) == [], "a page that is right has faults")
        expect(len(tutorial(good.replace("2.01", "2.1"), folder)) == 1, "a figure off its reference passes")
        expect(len(tutorial(good.replace("| 2.0 m", "| 2.2 m"), folder)) == 1, "a figure that does not repeat passes")
        expect(
            len(tutorial("```sh\necho words\n```\n\n```text\nother\n```\n", folder)) == 1,
            "an output that is not the page's passes",
        )
        expect(
            tutorial("```sh\necho words 3\n```\n\n```text\nwords 4\n```\n", folder) == [],
            "numbers of outputs are compared",
        )
        expect(
            len(tutorial("<!-- picture none.png -->\n![none](none.png)\n", folder)) == 1,
            "a picture that is not there passes",
        )
        expect(len(tutorial("```yaml\nversion: 2\n```\n", folder)) == 1, "a scene that is not the page's passes")
        try:
            tutorial("```sh\nfalse\ntrue\n```\n", folder)
            faults.append("a command that fails passes")
        except SystemExit:
            pass


scenes_run()
pages_can_fail()
sys.exit("\n".join(faults) if faults else 0)
