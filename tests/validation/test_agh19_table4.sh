#!/bin/sh
# Frequencies of a coarse bar in a short record, with a bound of its own.
. "$(dirname "$0")/quick.sh"
quick agh19-table4 --threads 1
