"""The site builds without a warning; no link in it is dead; its pages fetch nothing from elsewhere; the page of scenes lists
all keys."""

import html.parser
import json
import os
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

import built_site


class Page(html.parser.HTMLParser):
    """ids of a page, what it links to, what a browser would fetch for it."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.links, self.fetched = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.ids.update(given[key] for key in ("id", "name") if given.get(key))
        if tag == "a" and given.get("href"):
            self.links.append(given["href"])
        if given.get("src"):
            self.fetched.append(given["src"])
        if (
            tag == "link"
            and given.get("href")
            and given.get("rel") not in ("canonical", "next", "prev", "index", "search")
        ):
            self.fetched.append(given["href"])


def findings_of(folder):
    pages = {}
    for at, _, files in os.walk(folder):
        for name in files:
            if name.endswith(".html"):
                with open(os.path.join(at, name), encoding="utf-8") as file:
                    pages[os.path.join(at, name)] = Page(file.read())
    findings = []
    for path, page in pages.items():
        where = os.path.relpath(path, folder)
        for target in page.fetched + page.links:
            parts = urllib.parse.urlsplit(target)
            if parts.scheme or parts.netloc:
                if target in page.fetched and parts.scheme != "data":
                    findings.append(f"{where}: fetches {target}")
                continue
            there = (
                os.path.normpath(os.path.join(os.path.dirname(path), urllib.parse.unquote(parts.path)))
                if parts.path
                else path
            )
            if not os.path.exists(there):
                findings.append(f"{where}: dead link {target}")
            elif parts.fragment and there in pages and urllib.parse.unquote(parts.fragment) not in pages[there].ids:
                findings.append(f"{where}: dead anchor {target}")
    return findings


def keys_of(schema):
    """Names of all properties within a part of a JSON Schema."""
    for name, part in schema.items() if isinstance(schema, dict) else ((None, part) for part in schema):
        if name == "properties":
            yield from part
        if isinstance(part, (dict, list)):
            yield from keys_of(part)


def made_up(text):
    """The findings in a folder of one page."""
    with tempfile.TemporaryDirectory() as folder:
        with open(folder + "/a.html", "w", encoding="utf-8") as file:
            file.write(text)
        return findings_of(folder)


for bad in (
    '<a href="b.html">',
    '<a href="#b">',
    '<script src="https://elsewhere.org/a.js"></script>',
    '<img src="b.png">',
):
    if not made_up(bad):
        sys.exit(f"this test cannot fail: nothing found in {bad}")

out = os.path.join(built_site.BUILD, "site-test")
shutil.rmtree(out, ignore_errors=True)
code, said = built_site.build(os.path.join(built_site.SOURCE, "docs"), out)
if code:
    sys.exit("the site does not build without warnings:\n" + said)
with tempfile.TemporaryDirectory() as broken:
    shutil.copytree(os.path.join(built_site.SOURCE, "docs"), broken + "/docs")
    with open(broken + "/docs/README.md", "a", encoding="utf-8") as file:
        file.write("\n[nowhere](nowhere.md)\n")
    code, said = built_site.build(broken + "/docs", broken + "/site")
    if code == 0 or "nowhere" not in said:
        sys.exit("a link to a page that is not there passes the build")
found = findings_of(out)
schema = subprocess.run([os.environ["BRC_PROGRAM"], "schema"], capture_output=True, text=True, check=True).stdout
keys = set(keys_of(json.loads(schema)["$defs"]))
with open(out + "/reference/scene/README.html", encoding="utf-8") as file:
    listed = file.read().partition('id="index-of-keys"')[2]
found += [f"no key {key} in the index" for key in sorted(keys) if f'<span class="pre">{key}</span></code>: <a' not in listed]
if len(keys) < 100:
    found.append(f"{len(keys)} keys in the schema")
print("\n".join(found) or f"{sum(len(files) for _, _, files in os.walk(out))} files, no dead link, nothing fetched")
sys.exit(bool(found))
