#!/bin/sh
# Equal bytes on every number of threads, the bound between devices and precisions.
. "$(dirname "$0")/quick.sh"
quick backends
