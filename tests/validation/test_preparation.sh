#!/bin/sh
# E and nu from a noisy grid and a packing of 1000 cells; bars of 2000 from a grid, a packing and an STL file.
. "$(dirname "$0")/quick.sh"
quick preparation --threads 1
