#!/bin/sh
# 1e5 steps of 216 spheres joined by beams whose sections turn by 60 degrees.
. "$(dirname "$0")/quick.sh"
quick cbm-drift --threads 1
