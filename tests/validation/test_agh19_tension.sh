#!/bin/sh
# Random and regular cells pulled to failure, both models; the full table is in docs/notebook/papers.md.
. "$(dirname "$0")/quick.sh"
quick agh19-tension --threads 1
