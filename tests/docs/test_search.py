"""The site's search answers from file:// in headless Chromium: words of pages are found, others not."""

import os
import re
import shutil
import subprocess
import sys
import tempfile

import built_site

browser = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
if not browser:
    built_site.skip("no Chromium here (Debian: chromium)")
with tempfile.TemporaryDirectory() as folder:
    code, said = built_site.build(os.path.join(built_site.SOURCE, "docs"), folder + "/site")
    if code:
        sys.exit(said)

    def results(word):
        shown = subprocess.run(
            [
                browser,
                "--headless",
                "--no-sandbox",
                "--disable-gpu",
                f"--user-data-dir={folder}/profile",
                "--virtual-time-budget=10000",
                "--dump-dom",
                f"file://{folder}/site/search.html?q={word}",
            ],
            capture_output=True,
            text=True,
            timeout=300,
        )
        found = re.search(r'<ul[^>]*class="search[^"]*".*?</ul>', shown.stdout, re.S)
        return re.findall(r'href="([^"]*\.html)', found.group(0)) if found else []

    for word, page in (("cohesive", "notebook/fracture.html"), ("checkpoint", "reference/checkpoint.html")):
        if page not in " ".join(results(word)):
            sys.exit(f"the search for '{word}' does not find {page}: {results(word)}")
    if results("zyxwvutsr"):
        sys.exit("the search finds a word that no page has")
print("the search answers from the disk")
