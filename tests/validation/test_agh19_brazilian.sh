#!/bin/sh
# A disc of 1500 cells pressed to failure over arcs of 20 degrees, and Hondros; the full table is in docs/papers.md.
. "$(dirname "$0")/quick.sh"
quick agh19-brazilian --threads 1
