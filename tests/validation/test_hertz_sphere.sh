#!/bin/sh
# A ball of 1000 cells on a wall.
. "$(dirname "$0")/quick.sh"
quick hertz-sphere --threads 1
