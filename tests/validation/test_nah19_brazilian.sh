#!/bin/sh
# Two discs of 3000 spheres pressed to failure, and Hondros' stresses in two; the full campaign is in docs/notebook/beams-tests.md.
. "$(dirname "$0")/quick.sh"
quick nah19-brazilian --threads 1
