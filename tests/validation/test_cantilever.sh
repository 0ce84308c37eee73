#!/bin/sh
# Tip deflection at two resolutions.
. "$(dirname "$0")/quick.sh"
quick cantilever --threads 1
