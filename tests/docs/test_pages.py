"""The guide's pages: each command as printed, in an empty folder; what they show is what is printed."""
import glob
import os
import sys

import run_pages

pages = sorted(glob.glob(os.path.join(os.environ["BRC_SOURCE_DIR"], "docs", "guide", "*.md")))
sys.exit("no page to run" if len(pages) < 2 else min(run_pages.main(pages), 1))
