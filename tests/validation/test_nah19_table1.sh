#!/bin/sh
# Virial stresses of a cube of 4000 spheres against force over section.
. "$(dirname "$0")/quick.sh"
quick nah19-table1 --threads 1
