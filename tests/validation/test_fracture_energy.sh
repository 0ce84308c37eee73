#!/bin/sh
# What a crack costs in bars of 432 cells, two seeds of two preparations and regular cells.
. "$(dirname "$0")/quick.sh"
quick fracture-energy --threads 1
