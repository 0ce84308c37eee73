#!/bin/sh
# Directions of faces at 1000 cells; the figures of the rows and the two pictures are in docs/notebook/isotropy.md.
. "$(dirname "$0")/quick.sh"
quick agh19-fig5 --threads 1
