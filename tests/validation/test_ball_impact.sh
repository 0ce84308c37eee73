#!/bin/sh
# Balls of 600 spheres and of 400 cells, whole when slow and in pieces when fast; all speeds are in docs/notebook/strikers.md.
. "$(dirname "$0")/quick.sh"
quick ball-impact --threads 1
