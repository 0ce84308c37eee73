"""Lengths of files, READMEs of folders, leftovers, names of the house."""
import os
import re
import repository

LONGEST = 500
LONGEST_FUNCTION = 80  # lines from the signature to the closing brace
MOST_WORDS = 52880  # of docs/, as `wc -w` counts them: half of what they were in November 2026. Cut as many as you add.
# Files and functions that are longer, with the most they may have. The list only shrinks.
LONGER = {}
LONGER_FUNCTIONS = {}


def lengths(files):
    return [f"{path}: {text.count(chr(10))} lines; {LONGEST} is a hall, split it" for path, text in files.items()
            if text.count("\n") > LONGER.get(path, LONGEST)]


def function_lengths(files):
    """Functions at the left margin; the signature may take several lines."""
    findings = []
    for path, text in files.items():
        lines = repository.code_of(text).split("\n")
        opened = None
        for number, line in enumerate(lines):
            if line == "{":
                opened = number - 1
                while opened > 0 and not re.match(r"\w", lines[opened]):
                    opened -= 1
            elif line.startswith("}") and opened is not None:
                name = re.search(r"(\w+)\(", lines[opened])
                name = name.group(1) if name else "?"
                length = number - opened + 1
                if length > LONGER_FUNCTIONS.get((path, name), LONGEST_FUNCTION):
                    findings.append(f"{path}:{opened + 1}: {name} has {length} lines; {LONGEST_FUNCTION} at most, split it")
                opened = None
    return findings


def readmes(files):
    """Each folder that holds files, and each above it, says what lives there. Hidden folders are exempt, and those of tests/ that
    hold the tests of a folder of the same name."""
    folders = set()
    for path in files:
        folder = os.path.dirname(path)
        while folder:
            folders.add(folder)
            folder = os.path.dirname(folder)
    return [f"{folder}/: has no README.md saying what lives there and what never does" for folder in sorted(folders)
            if not folder.startswith(".") and folder + "/README.md" not in files and not mirror(folder, files)]


def mirror(folder, files):
    parts = folder.split("/")
    if len(parts) < 3 or parts[0] != "tests":
        return False
    inner = "/".join(parts[1:])
    return any(path.startswith((inner + "/", "host/" + inner + "/")) for path in files)


def leftovers(files):
    findings = []
    for path, text in files.items():
        for number, line in enumerate(text.split("\n"), 1):
            if re.search(r"\b(TO" r"DO|FIX" r"ME|XX" r"X)\b", line):
                findings.append(f"{path}:{number}: unfinished: {line.strip()}")
            if re.search(r"[ \t]+$", line):
                findings.append(f"{path}:{number}: blanks at the end of the line")
            if re.search(r"(?<![\w.])/(home|root|Users)/\w", line):
                findings.append(f"{path}:{number}: a path of somebody's machine: {line.strip()}")
        if text and not text.endswith("\n"):
            findings.append(f"{path}: the last line has no end")
    return findings


def words(files):
    number = sum(len(text.split()) for text in files.values())
    return [f"docs/: {number} words in all its pages; {MOST_WORDS} at most, cut some"] if number > MOST_WORDS else []


def guards(files):
    """Headers are guarded by their own name, so that no two guards can be equal."""
    findings = []
    seen = {}
    for path, text in files.items():
        match = re.search(r"^#ifndef (\w+)\n#define \1\n", text, re.M)
        if not match:
            if os.path.basename(path) != "kernels.h":  # read more than once on purpose
                findings.append(f"{path}: no include guard")
        elif match.group(1) in seen:
            findings.append(f"{path}: has the include guard of {seen[match.group(1)]}")
        else:
            seen[match.group(1)] = path
    return findings


def loose_skips(files):
    """A script that skips (exit 77) fails where nothing may be skipped (tests/skip.h)."""
    return [f"{path}: leaves with 77 and does not ask BRC_NO_SKIPS" for path, text in files.items()
            if re.search(r"\b(exit|return)\b[ (]*77\b", text) and "BRC_NO_SKIPS" not in text]


def quiet_skips(files):
    """ctest does not show a test that skips inside a passing program (tests/skip.h)."""
    return [f"{path}:{number}: a quiet skip; make it a program of its own that returns test_skip()"
            for path, text in files.items() for number, line in enumerate(repository.code_of(text).split("\n"), 1)
            if re.search(r"(?<![\w.])skip\(", line)]


code = r"\.(c|h|cc|cl)$"
repository.finish([
    repository.report("lengths", lengths, repository.read(r"^(host|kernels|preprocess|bench|tests)/.*" + code),
                      {"501 lines": {"host/base/a.c": "\n" * 501}}),
    repository.report("functions", function_lengths,
                      repository.read(r"^(host|kernels|preprocess|bench|tests)/.*" + code),
                      {"81 lines": {"host/base/a.c": "int f(int a,\n      int b)\n{\n" + "    a;\n" * 77 + "}\n"}}),
    repository.report("readmes", readmes, {path: "" for path in repository.paths()},
                      {"a folder without": {"host/base/README.md": "", "host/base/a.c": ""},
                       "no mirror": {"host/README.md": "", "host/base/README.md": "", "host/base/a.c": "", "tests/README.md": "",
                                     "tests/base/README.md": "", "tests/base/inner/test_a.c": ""}}),
    repository.report("leftovers", leftovers,
                      repository.read(code + r"|\.(py|sh|cmake|md|yaml)$|CMakeLists\.txt$|^quickstart$"),
                      {"unfinished": {"a.c": "/* TO" "DO later */\n"}, "blanks": {"a.c": "int a; \n"},
                       "path": {"a.c": "see /ho" "me/somebody/file\n"}, "no end": {"a.c": "int a;"}}),
    repository.report("words", words, repository.read(r"^docs/.*\.md$"), {"one too many": {"docs/README.md": "word " * (MOST_WORDS + 1)}}),
    repository.report("guards", guards, repository.read(r"^(host|kernels|preprocess|bench)/.*\.h$"),
                      {"none": {"a.h": "int a;\n"}, "twice": {"a.h": "#ifndef A\n#define A\n", "b.h": "#ifndef A\n#define A\n"}}),
    repository.report("quiet skips", quiet_skips, repository.read(r"^tests/.*" + code),
                      {"a skip": {"tests/base/test_a.c": "    if (!there) skip();\n"}}),
    repository.report("loose skips", loose_skips, repository.read(r"^tests/.*\.(sh|py)$"),
                      {"a shell": {"tests/base/test_a.sh": "exit 77\n"}, "a script": {"tests/base/test_a.py": "sys.exit(77)\n"}}),
])
