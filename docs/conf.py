"""The site of docs/ (Sphinx): `./quickstart docs` writes it to build/site, to be read from the disk or a server."""

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
