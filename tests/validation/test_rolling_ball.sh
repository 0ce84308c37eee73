#!/bin/sh
# The first bounce of 500 cells by both laws, two seeds each; all sizes are in examples/rolling-ball/README.md.
. "$(dirname "$0")/quick.sh"
quick rolling-ball --threads 1 --device cpu
