#!/bin/sh
# Modes of cubes of 216 and 1000 cells against Rayleigh-Ritz.
. "$(dirname "$0")/quick.sh"
quick cube-vibration --threads 1
