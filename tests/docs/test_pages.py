"""README and the guide's pages: each command as printed, in an empty folder; what they show is what is printed."""

import glob
import os
import sys

import run_pages

source = os.environ["BRC_SOURCE_DIR"]
pages = [source + "/README.md"] + sorted(glob.glob(os.path.join(source, "docs", "guide", "*.md")))
sys.exit("no page to run" if len(pages) < 3 else min(run_pages.main(pages), 1))
