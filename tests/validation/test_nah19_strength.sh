#!/bin/sh
# Strength in tension of two cubes of 2000 spheres at coordination number 10.
. "$(dirname "$0")/quick.sh"
quick nah19-strength --threads 1
