#!/bin/sh
# A ball of 400 cells, whole at 4 m/s and in pieces at 20 m/s; eight speeds are in docs/strikers.md.
. "$(dirname "$0")/quick.sh"
quick ball-impact --threads 1
