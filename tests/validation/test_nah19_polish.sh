#!/bin/sh
# Four samples polished, four fresh ones and four axes that the polish did not see.
. "$(dirname "$0")/quick.sh"
quick nah19-polish --threads 1
