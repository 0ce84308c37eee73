"""Runs the commands of pages as a reader would paste them, and compares what they print with what the page shows.

    BRC_PROGRAM=... BRC_SOURCE_DIR=... python3 run_pages.py PAGE.md ...

Blocks of a page run in order, in one empty folder of its own, with `breccia` in PATH and BRECCIA_SOURCE naming the repository:
- ```sh: commands; each must end with 0, or with the code in `# exits N` at the end of its line.
- ```text behind them: lines that they print, in this order. `...` stands for anything; numbers may differ by one in the last digit shown.
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


def alike(shown, printed):
    """Does a printed line read like a shown one? Numbers to one in the last digit shown."""
    if NUMBER.sub("0", shown) != NUMBER.sub("0", printed):
        return False
    for left, right in zip(NUMBER.findall(shown), NUMBER.findall(printed)):
        digits, _, power = left.partition("e")
        step = 10.0 ** (int(power or 0) - len(digits.partition(".")[2]))
        if abs(float(left) - float(right)) > 1.5 * step and left != right:
            return False
    return True


def line_matches(shown, printed):
    """The same with `...` for anything."""
    pieces = [piece.split() for piece in shown.split("...")]
    words = printed.split()
    if len(pieces) == 1:
        return alike(" ".join(pieces[0]), " ".join(words))
    first, last = pieces[0], pieces[-1]
    if not alike(" ".join(first), " ".join(words[:len(first)])) or (last and not alike(" ".join(last), " ".join(words[-len(last):]))):
        return False
    at = len(first)
    for piece in pieces[1:-1]:
        while at + len(piece) <= len(words) and not alike(" ".join(piece), " ".join(words[at:at + len(piece)])):
            at += 1
        at += len(piece)
    return at + len(last) <= len(words)


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
    """Commands of a block: lines, with those that a backslash or a here-document goes on in."""
    commands, open_until = [], None
    for line in text.split("\n"):
        if commands and (open_until or commands[-1].endswith("\\")):
            commands[-1] += "\n" + line
            if open_until and line == open_until:
                open_until = None
        elif line.strip() and not line.startswith("#"):
            commands.append(line)
            here = re.search(r"<<-?'?(\w+)'?", line)
            open_until = here.group(1) if here else None
    return commands


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
                done = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, text=True, errors="replace", stdin=subprocess.DEVNULL,
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
                printed, ran = printed + done.stdout, ran + 1
                if done.returncode != int(wanted.group(1) if wanted else 0):
                    return [f"line {line}: '{command}' ended with {done.returncode}:\n{done.stdout}"]
        elif kind == "text" and printed is not None:
            line_missing = missing_line(body, printed)
            if line_missing is not None:
                return [f"line {line}: the page shows '{line_missing}', which was not printed (in this order):\n{printed}"]
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
    bad = ["```sh\nfalse\n```\n", good.replace("72.05", "72.07"), good.replace("in ...", "on ..."), "```sh\ntrue # exits 2\n```\n",
           "```yaml\n# a.yaml\nb\n```\n\n```sh\ncat c.yaml\n```\n", "```sh\nprintf 'b\\na\\n'\n```\n\n```text\na\nb\n```\n"]
    assert not run_page(good, dict(os.environ), quiet), run_page(good, dict(os.environ), quiet)
    assert not run_page("```yaml\n# a.yaml\nb\n```\n\n```sh\ncat a.yaml\n```\n\n```text\nb\n```\n", dict(os.environ), quiet)
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
