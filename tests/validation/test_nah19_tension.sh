#!/bin/sh
# E and nu of glass and alumina by the laws, four samples of full size; the figures of the rows are in docs/notebook/beams-calibration.md.
. "$(dirname "$0")/quick.sh"
quick nah19-tension
