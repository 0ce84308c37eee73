#!/bin/sh
# The error class that check tells of three scenes, against their runs.
. "$(dirname "$0")/quick.sh"
quick error-class --threads 1 --device cpu
