"""A file includes only from its own folder or from floors below it, and no includes run in a circle."""
import os
import re
import repository

FLOORS = {
    "kernels": 0, "host/base": 1, "preprocess": 2, "host/device": 2, "host/scene": 3,
    "host/solver": 4, "host/output": 5, "bench": 6, "host/commands": 6,
    "host/include": 7, "host/library": 8,
}
# The table of commands names those of bench/; bench/ knows nothing of the table.
ALLOWED_BESIDE = {("host/commands", "bench")}
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]+"([^"]+)"', re.M)
COMMENT = re.compile(r"/\*.*?\*/", re.S)


def room(path):
    """The folder of FLOORS that a file lives in; None outside the floors (tests)."""
    inside = [folder for folder in FLOORS if path.startswith(folder + "/")]
    return max(inside, key=len) if inside else None


def includes(path, files):
    """(line, included path, as written) of each quoted include."""
    text = COMMENT.sub(lambda m: "\n" * m.group(0).count("\n"), files[path])
    for match in INCLUDE.finditer(text):
        line = text.count("\n", 0, match.start()) + 1
        yield line, os.path.normpath(os.path.join(os.path.dirname(path), match.group(1))), match.group(1)


def floors(files):
    findings = []
    for path in files:
        if room(path) is None or path.endswith((".txt", ".cmake")):
            continue
        for line, target, written in includes(path, files):
            where = f"{path}:{line}: includes {written}: "
            other = room(target)
            if target not in files and "/" not in written and any(
                    written in text for file, text in files.items() if file.endswith(("CMakeLists.txt", ".cmake"))):
                continue  # made by the build
            if target not in files:
                findings.append(where + "no such file; includes are written relative to the including file")
            elif other is None:
                findings.append(where + "outside the floors")
            elif other != room(path) and (room(path), other) not in ALLOWED_BESIDE:
                if FLOORS[other] == FLOORS[room(path)]:
                    findings.append(where + f"{room(path)} and {other} are on one floor and may not know each other")
                elif FLOORS[other] > FLOORS[room(path)]:
                    findings.append(where + f"{other} is above {room(path)}")
    return findings


def circles(files):
    findings = []
    state = {}

    def visit(path, trail):
        state[path] = "open"
        for _, target, _ in includes(path, files):
            if target not in files:
                continue
            if state.get(target) == "open":
                circle = trail[trail.index(target):] + [target]
                findings.append("includes run in a circle: " + " -> ".join(circle))
            elif target not in state:
                visit(target, trail + [target])
        state[path] = "done"

    for path in files:
        if path not in state:
            visit(path, [path])
    return findings


bad = {
    "upward": {"host/base/a.h": '#include "../solver/b.h"\n', "host/solver/b.h": ""},
    "beside": {"preprocess/a.cc": '#include "../host/device/b.h"\n', "host/device/b.h": ""},
    "bench knows the commands": {"bench/a.c": '#include "../host/commands/b.h"\n', "host/commands/b.h": ""},
    "missing": {"host/base/a.h": '# include "nowhere.h"\n'},
    "tests": {"host/base/a.h": '#include "../../tests/b.h"\n', "tests/b.h": ""},
}
circle = {"a circle of three": {"host/base/a.h": '#include "b.h"\n', "host/base/b.h": '#include "c.h"\n',
                                "host/base/c.h": '#include "a.h"\n'}}
sources = repository.read(r"^(host|kernels|preprocess|bench|cmake)/.*(\.(c|h|cc|cl|cmake|def)|CMakeLists\.txt)$")
repository.finish([repository.report("floors", floors, sources, bad),
                   repository.report("circles", circles, sources, circle)])
