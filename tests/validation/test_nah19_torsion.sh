#!/bin/sh
# A short rod of 1500 spheres twisted to failure; the full campaign is in docs/beams-tests.md.
. "$(dirname "$0")/quick.sh"
quick nah19-torsion --threads 1
