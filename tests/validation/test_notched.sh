#!/bin/sh
# The references are those that cohesive.py computes; a small notched plate.
here=$(dirname "$0")
. "$here/quick.sh"
if command -v python3 >/dev/null; then
    python3 "$here/notched/cohesive.py" | while read -r name cohesive lefm zone; do
        wanted=$cohesive
        [ "$(echo "$zone" | awk '{print ($1 < 0.1)}')" = 1 ] && wanted=$lefm
        grep -q "reference: $wanted Pa" "$here/notched/case.yaml" || { echo "case.yaml has no reference of $wanted Pa for $name"; exit 1; }
    done || exit 1
fi
quick notched --threads 1
