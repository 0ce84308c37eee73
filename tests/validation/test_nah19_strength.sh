#!/bin/sh
# Strength in tension by the laws: a cube of 10 000 spheres of glass at coordination number 10 and of alumina at 6, two of 2000 spheres of glass.
. "$(dirname "$0")/quick.sh"
quick nah19-strength --threads 1
