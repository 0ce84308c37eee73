#!/bin/sh
# The hard cases in continuous integration's size, in double, mixed and single precision, and the published law beside them.
. "$(dirname "$0")/../validation/quick.sh"
quick stability --threads 1
