"""Links of the repository's texts, as a plain Git view follows them: files, pictures and headings exist, as does each
page that a file names."""

import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "checks"))
import repository  # noqa: E402

FENCE = re.compile(r"^(```|~~~).*?^\1[ ]*$", re.M | re.S)
LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\]]*\])*\]\(([^()\s]+)\)")


def anchors(text):
    """Anchors of the headings, as Git servers make them."""
    found = {}
    names = set()
    for heading in re.findall(r"^#+ (.*)$", FENCE.sub("", text), re.M):
        heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
        slug = re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")
        found[slug] = found.get(slug, -1) + 1
        names.add(f"{slug}-{found[slug]}" if found[slug] else slug)
    return names


def dead_links(files):
    """files: {path: text} of all texts, None for a file that is not a text."""
    findings = []
    for path, text in files.items():
        if text is None:
            continue
        for target in LINK.findall(re.sub(r"`[^`\n]*`", "", FENCE.sub("", text))):
            if re.match(r"[a-z]+:", target):
                continue
            file, _, anchor = target.partition("#")
            there = os.path.normpath(os.path.join(os.path.dirname(path), file)) if file else path
            folder = any(other.startswith(there + "/") for other in files)
            if there not in files and not folder:
                findings.append(f"{path}: links to {target}, which is not there")
            elif anchor and files.get(there) and anchor not in anchors(files[there]):
                findings.append(f"{path}: links to {target}; {there} has no such heading")
    return findings


def dead_names(files):
    """Pages of docs/ that any file names as docs/....md."""
    return [
        f"{path}: names {page}, which is not there"
        for path, text in files.items()
        if text
        for page in sorted(set(re.findall(r"(?<![\w./-])docs/[\w/.-]*\.md\b", text)))
        if page not in files
    ]


if __name__ == "__main__":
    every = {path: None for path in repository.paths()}
    every.update(repository.read(r"\.md$"))
    named = dict(every)
    named.update(repository.read(r"\.(c|h|cc|cl|py|sh|cmake|yaml|toml)$|CMakeLists\.txt$|^quickstart$"))
    named.pop("tests/docs/test_links.py")
    for path in named:
        if path == "CHANGELOG.md" or path.startswith("bench/results/notes/"):
            named[path] = None  # tells what was true then
    repository.finish(
        [
            repository.report(
                "dead links",
                dead_links,
                every,
                {
                    "no file": {"a/b.md": "[x](c.md)"},
                    "no heading": {"a.md": "# A b\n[x](#a)"},
                    "no picture": {"a.md": "![x](images/x.png)"},
                },
            ),
            repository.report(
                "dead names",
                dead_names,
                named,
                {"moved": {"host/a.c": "/* docs/theory.md */", "docs/notebook/theory.md": ""}},
            ),
        ]
    )
