#!/bin/sh
# K along a dynamic test of a sphere of 15 000 spheres.
. "$(dirname "$0")/quick.sh"
quick nah19-bulk --threads 1
