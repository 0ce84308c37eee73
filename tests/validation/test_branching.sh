#!/bin/sh
# A notched plate of 3000 cells; one crack and branches are in docs/notebook/papers.md.
. "$(dirname "$0")/quick.sh"
quick branching --threads 1
