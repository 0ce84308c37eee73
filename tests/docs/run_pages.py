"""Runs the commands of pages as a reader would paste them, and compares what they print with what the page shows.

    BRC_PROGRAM=... BRC_SOURCE_DIR=... python3 run_pages.py PAGE.md ...

Blocks of a page run in order, in one empty folder, with `breccia` in PATH and BRECCIA_SOURCE naming the repository:
- ```sh: commands; each must end with 0, or with the code in `# exits N` at the end of its line.
- ```text behind them: lines that they print, in this order. `...` stands for anything; numbers may differ by one in
  the last digit shown.
- any other block whose first line is a comment that is a file's name alone (`# scene.yaml`): that file.
- `<!-- not run: REASON -->` before a block leaves it out, and says so.
A page may take 60 s of processor time.
"""

import os
import re
import resource
import subprocess
import sys
import tempfile

MOST_SECONDS = 60.0
BLOCK = re.compile(r"^(?P<note><!-- not run: (?P<why>[^\n]*) -->\n+)?```(?P<kind>\w+)\n(?P<text>.*?)^```$", re.M | re.S)
FILE = re.compile(r"^(?:#|//|/\*) *([\w-]+\.\w+)(?: \*/)?\n")
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def near(shown, printed):
    """Are two numbers equal, to one in the last digit shown?"""
    digits, _, power = shown.partition("e")
    step = 10.0 ** (int(power or 0) - len(digits.partition(".")[2]))
    return shown == printed or abs(float(shown) - float(printed)) <= 1.5 * step


def line_matches(shown, printed):
    """Does a printed line read like a shown one, where `...` stands for anything?"""
    shown = " ".join(shown.split())
    pattern = ".*?".join(
        f"({NUMBER.pattern})".join(re.escape(words) for words in NUMBER.split(piece)) for piece in shown.split("...")
    )
    match = re.fullmatch(pattern, " ".join(printed.split()))
    return bool(match) and all(near(*pair) for pair in zip(NUMBER.findall(shown.replace("...", " ")), match.groups()))


def missing_line(shown, printed):
    """The first line shown that is not printed behind the ones before it, or None."""
    printed, at = printed.split("\n"), 0
    for line in shown.split("\n"):
        if not line.strip() or line.strip() == "...":
            continue
        while at < len(printed) and not line_matches(line, printed[at]):
            at += 1
        if at == len(printed):
            return line
        at += 1
    return None


def commands_of(text):
    """Commands of a block: as many lines as a shell takes for one, with the lines of a here-document."""
    commands, command, here = [], "", None
    for line in text.split("\n"):
        if not command and (not line.strip() or line.startswith("#")):
            continue
        command += ("\n" if command else "") + line
        if here is None:
            opened = re.search(r"<<-?'?(\w+)'?", line)
            here = opened.group(1) if opened else None
        elif line == here:
            here = None
        if (
            here is None
            and not command.endswith("\\")
            and subprocess.run(["bash", "-n", "-c", command], capture_output=True).returncode == 0
        ):
            commands.append(command)
            command = ""
    return commands + ([command] if command else [])


def run_page(text, environment, say):
    """The faults of a page, as sentences; at most one."""
    with tempfile.TemporaryDirectory(prefix="page-") as folder:
        return run_blocks(text, folder, environment, say)


def run_blocks(text, folder, environment, say):
    printed, ran, began = "", 0, resource.getrusage(resource.RUSAGE_CHILDREN)
    for block in BLOCK.finditer(text):
        kind, body = block["kind"], block["text"]
        line = text.count("\n", 0, block.start()) + 1
        if block["note"]:
            say(f"  not run: {block['why']} (line {line})")
            printed = None
        elif kind == "sh":
            printed = ""
            for command in commands_of(body):
                wanted = re.search(r"# exits (\d+)$", command)
                done = subprocess.run(
                    ["bash", "-c", command],
                    cwd=folder,
                    env=environment,
                    text=True,
                    errors="replace",
                    stdin=subprocess.DEVNULL,
                    stdout=subprocess.PIPE,
                    stderr=subprocess.STDOUT,
                )
                printed, ran = printed + done.stdout, ran + 1
                if done.returncode != int(wanted.group(1) if wanted else 0):
                    return [f"line {line}: '{command}' ended with {done.returncode}:\n{done.stdout}"]
        elif kind == "text" and printed is not None:
            line_missing = missing_line(body, printed)
            if line_missing is not None:
                return [
                    f"line {line}: the page shows '{line_missing}', which was not printed (in this order):\n{printed}"
                ]
        elif FILE.match(body):
            with open(os.path.join(folder, FILE.match(body).group(1)), "w", encoding="utf-8") as file:
                file.write(body)
    ended = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = ended.ru_utime + ended.ru_stime - began.ru_utime - began.ru_stime
    say(f"  {ran} commands, {seconds:.1f} s of processor time")
    return [f"took {seconds:.0f} s of processor time ({MOST_SECONDS:.0f} at most)"] if seconds > MOST_SECONDS else []


def self_test():
    """Faults that must be found, on made-up pages."""
    quiet = lambda sentence: None  # noqa: E731
    good = "```sh\necho E 72.04 GPa in 3.2 s\n```\n\n```text\nE 72.05 GPa in ...\n```\n"
    bad = [
        "```sh\nfalse\n```\n",
        good.replace("72.05", "72.07"),
        good.replace("in ...", "on ..."),
        "```sh\ntrue # exits 2\n```\n",
        "```sh\nfor i in 1 2; do\n    false\ndone\n```\n",
        "```yaml\n# a.yaml\nb\n```\n\n```sh\ncat c.yaml\n```\n",
        "```sh\nprintf 'b\\na\\n'\n```\n\n```text\na\nb\n```\n",
    ]
    assert not run_page(good, dict(os.environ), quiet), run_page(good, dict(os.environ), quiet)
    assert not run_page(
        "```yaml\n# a.yaml\nb\n```\n\n```sh\ncat a.yaml\n```\n\n```text\nb\n```\n", dict(os.environ), quiet
    )
    for page in bad:
        assert run_page(page, dict(os.environ), quiet), "no fault found in\n" + page


def main(pages):
    """Runs the pages; the number of faults."""
    self_test()
    with tempfile.TemporaryDirectory(prefix="pages-") as programs:
        os.symlink(os.environ["BRC_PROGRAM"], programs + "/breccia")
        source = os.environ["BRC_SOURCE_DIR"]
        environment = dict(os.environ, PATH=programs + ":" + os.environ["PATH"], BRECCIA_SOURCE=source)
        faults = 0
        for page in pages:
            print(os.path.relpath(page, source), flush=True)
            with open(page, encoding="utf-8") as file:
                for fault in run_page(file.read(), environment, lambda sentence: print(sentence, flush=True)):
                    print("  " + fault)
                    faults += 1
    return faults


if __name__ == "__main__":
    sys.exit(min(main(sys.argv[1:]), 1))
