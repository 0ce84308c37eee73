"""Pages of docs/reference that follow from program and package: commands (`breccia help`) and the Python API."""

import ast
import os
import re
import subprocess

SOURCE = os.environ["BRC_SOURCE_DIR"]
PACKAGE = os.path.join(SOURCE, "python", "src", "breccia")


def said(*arguments):
    return subprocess.run([os.environ["BRC_PROGRAM"], *arguments], capture_output=True, text=True, check=True).stdout


def commands():
    """The text of commands.md."""

    def tidy(text):
        return re.sub(r" +$", "", text.replace("\n  -h, --help                   this text", "").strip(), flags=re.M)

    overview = said("help")
    names = re.findall(r"^  (\w+)", overview.split("usage:")[1], re.M)
    page = [
        "# Commands",
        "",
        "What `breccia help COMMAND` prints; the same texts make the manual page (`breccia help --man`).",
        "",
        "```text",
        tidy(overview[overview.index("usage:") :]),
        "```",
        "",
    ]
    options = {}  # of the commands so far, each said once
    for name in names:
        if name == "help":
            continue
        lines, known = [], []
        for line in tidy(said("help", name)).split("\n"):
            if line.startswith("  ") and options.setdefault(line, name) != name:
                known.append(re.search(r"--\w+", line).group(0) + " (" + options[line] + ")")
            else:
                lines.append(line)
        page += [
            f"## {name}",
            "",
            "```text",
            *lines,
            *(["", "  as above: " + ", ".join(known)] if known else []),
            "```",
            "",
        ]
    return "\n".join(page)


def signature(function):
    """`name(a, b=1)` without types and without self."""
    arguments = function.args
    plain = [argument.arg for argument in arguments.args]
    first = len(plain) - len(arguments.defaults)
    shown = [
        name if k < first else f"{name}={ast.unparse(arguments.defaults[k - first])}" for k, name in enumerate(plain)
    ]
    if arguments.vararg:
        shown.append("*" + arguments.vararg.arg)
    elif arguments.kwonlyargs:
        shown.append("*")
    shown += [
        a.arg if d is None else f"{a.arg}={ast.unparse(d)}" for a, d in zip(arguments.kwonlyargs, arguments.kw_defaults)
    ]
    return ", ".join(name for name in shown if name not in ("self", "cls"))


def plain(text):
    """A docstring's first paragraph as Markdown in one line."""
    text = " ".join((text or "").strip().split("\n\n")[0].split()).removesuffix("::")
    return re.sub(r":\w+:`\.?([^`]*)`", r"`\1`", text.replace("``", "`"))


def decorated(function):
    return {ast.unparse(decorator) for decorator in function.decorator_list}


def class_lines(node):
    """Fields, properties and methods that are documented."""
    lines = []
    for member in node.body:
        if isinstance(member, ast.AnnAssign) and not member.target.id.startswith("_"):
            lines.append(f"- `{member.target.id}`")
        elif isinstance(member, ast.FunctionDef) and not member.name.startswith("_") and ast.get_docstring(member):
            call = member.name if "property" in decorated(member) else f"{member.name}({signature(member)})"
            lines.append(f"- `{call}`: {plain(ast.get_docstring(member))}")
    fields = [line[2:] for line in lines if ":" not in line]
    return ([", ".join(fields) + "."] if fields else []) + [""] * bool(fields) + [line for line in lines if ":" in line]


def python_api():
    """The text of python_api.md."""
    with open(os.path.join(PACKAGE, "__init__.py"), encoding="utf-8") as file:
        tree = ast.parse(file.read())
    public = next(
        ast.literal_eval(n.value)
        for n in tree.body
        if isinstance(n, ast.Assign) and ast.unparse(n.targets[0]) == "__all__"
    )
    found = {}
    for name in sorted(os.listdir(PACKAGE)):
        if name.endswith(".py"):
            with open(os.path.join(PACKAGE, name), encoding="utf-8") as file:
                found.update(
                    {
                        n.name: n
                        for n in ast.parse(file.read()).body
                        if isinstance(n, (ast.ClassDef, ast.FunctionDef)) and n.name in public
                    }
                )
    page = [
        "# Python API",
        "",
        "Names of the package `breccia`, from its source; how they go together is in [the package](python.md).",
        "",
    ]
    for name in sorted(found, key=str.lower):
        node = found[name]
        start = next(
            (m for m in getattr(node, "body", []) if isinstance(m, ast.FunctionDef) and m.name == "__init__"), None
        )
        call = signature(node) if isinstance(node, ast.FunctionDef) else signature(start) if start else ""
        bases = ", ".join(f"`{ast.unparse(b)}`" for b in getattr(node, "bases", []))
        page += [
            f"## {name}",
            "",
            f"`breccia.{name}{f'({call})' if call else ''}`" + (f", a {bases}" if bases else ""),
            "",
            plain(ast.get_docstring(node)),
            "",
        ]
        members = class_lines(node) if isinstance(node, ast.ClassDef) else []
        page += members + [""] * bool(members)
    return re.sub(r"\n{3,}", "\n\n", "\n".join(page))


PAGES = {"commands.md": commands, "python_api.md": python_api}
