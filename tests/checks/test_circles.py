"""No circle of files by calls: of two files one is the lower, and calls what is beside or below it. Who is to hear from below hooks in
(host/solver/effects/effect.h, models/model.h) or is given as a function; such calls are no arrows here."""
import collections
import re
import repository

ROOMS = ("host/base/", "host/device/", "host/solver/", "host/commands/")
CALL = re.compile(r"\b([a-z]\w+)\s*\(")


def definitions(text):
    """(name, static) of the functions at the left margin, and of those that BRC_READ and BRC_OF_WANTS make."""
    for name in re.findall(r"^BRC_(?:READ|OF_WANTS)\([^,]+, (\w+),", text, re.M):
        yield name, False
    lines = text.split("\n")
    for number, line in enumerate(lines):
        if line == "{":
            head = number - 1
            while head > 0 and not re.match(r"\w", lines[head]):
                head -= 1
            name = re.search(r"(\w+)\(", lines[head])
            if name:
                yield name.group(1), lines[head].startswith("static")


def arrows(files):
    """{file: {file that it calls: names}}; of names that several files define, as one for each choice of the build, those elsewhere."""
    code = {path: repository.code_of(text) for path, text in files.items()}
    shared, own = collections.defaultdict(set), collections.defaultdict(set)
    for path, text in code.items():
        for name, static in definitions(text):
            own[path].add(name)
            if not static:
                shared[name].add(path)
    found = {path: collections.defaultdict(set) for path in files}
    for path, text in code.items():
        for name in set(CALL.findall(text)) - own[path]:
            for other in shared.get(name, ()):
                found[path][other].add(name)
    return found


def circles(files):
    """One sentence a circle: a way from a file back to itself."""
    called = arrows(files)
    findings, state = [], {}

    def visit(path, trail):
        state[path] = "open"
        for other in sorted(called[path]):
            if state.get(other) == "open":
                way = trail[trail.index(other):] + [other]
                findings.append("; ".join(f"{a} calls {min(called[a][b])} of {b}" for a, b in zip(way, way[1:])))
            elif other not in state:
                visit(other, trail + [other])
        state[path] = "done"

    for path in sorted(files):
        if path not in state:
            visit(path, [path])
    return findings


results = []
for room in ROOMS:
    results.append(repository.report(f"circles of {room}", circles, repository.read(r"^%s.*\.c$" % room),
                                     {"two files": {room + "a.c": "void first(void)\n{\n    second();\n}\n", room + "b.c": "void second(void)\n{\n    first();\n}\n"},
                                      "a value that is read": {room + "a.c": "void first(void)\n{\n    second(s);\n}\nBRC_READ(int, third, s->n)\n",
                                                               room + "b.c": "void second(int s)\n{\n    third(s);\n}\n"}}))
repository.finish(results)
