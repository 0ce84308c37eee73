#!/bin/sh
# Bars of 250 and 2000 cells, sixteen draws of their strengths each; three sizes are in docs/notebook/papers.md.
. "$(dirname "$0")/quick.sh"
quick weibull-size --threads 1
