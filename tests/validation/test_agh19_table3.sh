#!/bin/sh
# E and nu of a small cube at the hardest nu of the table, and no growth of energy there.
. "$(dirname "$0")/quick.sh"
quick agh19-table3 --threads 1
