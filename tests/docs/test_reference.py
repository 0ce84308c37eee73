"""docs/reference/commands.md and python_api.md are what program and package say; if not, the right ones are left in the
build's tests/."""

import os
import sys

import reference_pages

wrong = 0
for name, made in reference_pages.PAGES.items():
    path = os.path.join(reference_pages.SOURCE, "docs", "reference", name)
    text = made()
    if len(text.split()) < 300:
        sys.exit(f"{name}: hardly anything was found to write")
    kept = None
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            kept = file.read()
    if kept != text:
        fresh = os.path.join(os.environ["BRC_BUILD_DIR"], "tests", name)
        with open(fresh, "w", encoding="utf-8") as file:
            file.write(text)
        print(f"docs/reference/{name} is out of date: cp {fresh} {path}")
        wrong += 1
sys.exit(min(wrong, 1))
