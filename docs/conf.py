"""The site of docs/ (Sphinx): `./quickstart docs` writes it to build/site, to be read from the disk or a server."""

import pathlib
import re

project = "breccia"
author = "the authors of breccia"
extensions = ["myst_parser", "sphinx_external_toc", "sphinx_copybutton"]
root_doc = "README"
exclude_patterns = ["images/README.md"]
external_toc_path = "toc.yml"
myst_heading_anchors = 4  # links like page.md#section, as Git servers make them
nitpicky = True
html_theme = "furo"  # brings its fonts and scripts along: a page fetches nothing
html_title = "breccia"
html_copy_source = False
html_show_sourcelink = False
suppress_warnings = [
    "etoc.glob"
]  # a folder of toc.yml may be empty; a page left out of toc.yml is an error all the same


def add_index_of_keys(app, page, text):
    """The page of scenes ends with all keys, each with links to the sections that have it."""
    if page != "reference/scene/README":
        return
    found = {}
    for path in sorted(pathlib.Path(app.srcdir, "reference", "scene").glob("*.md")):
        section = ""
        for line in path.read_text(encoding="utf-8").splitlines():
            section = line[3:] if line.startswith("## ") else section
            first = re.match(r"- (?:`([\w-]+)`|\[([\w-]+)\]\(#)", line)
            keys = re.findall(r"`([\w-]+)`", line) if line.startswith("Further keys") else []
            keys += [first[1] or first[2]] if first else []
            for key in keys if section else []:
                anchor = re.sub(r"[^\w -]", "", section.lower()).replace(" ", "-")
                found.setdefault(key, []).append(f"[{section}]({path.name}#{anchor})")
    lines = [f"- `{key}`: {', '.join(sections)}" for key, sections in sorted(found.items())]
    text[0] += "\n## Index of keys\n\n" + "\n".join(lines) + "\n"


def setup(app):
    app.connect("source-read", add_index_of_keys)
