#!/bin/sh
# Two cubes of 2000 spheres pushed to failure; the full campaign is in docs/notebook/beams-tests.md.
. "$(dirname "$0")/quick.sh"
quick nah19-compression --threads 1
