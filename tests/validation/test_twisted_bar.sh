#!/bin/sh
# Energy of torsion at two resolutions.
. "$(dirname "$0")/quick.sh"
quick twisted-bar --threads 1
