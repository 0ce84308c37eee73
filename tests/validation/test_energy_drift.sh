#!/bin/sh
# 1e5 steps of 216 cells, and the order of the closure of the ledger.
. "$(dirname "$0")/quick.sh"
quick energy-drift --threads 1
