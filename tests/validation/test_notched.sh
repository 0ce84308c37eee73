#!/bin/sh
# The references are those that cohesive.py computes; a small notched plate.
here=$(dirname "$0")
. "$here/quick.sh"
wanted=$(mktemp)
python3 -B "$here/notched/cohesive.py" >"$wanted" && [ -s "$wanted" ] || exit 1
while read -r name cohesive lefm zone; do
    load=$cohesive
    [ "$(echo "$zone" | awk '{print ($1 < 0.1)}')" = 1 ] && load=$lefm
    grep -q "reference: $load Pa" "$here/notched/case.yaml" || { echo "case.yaml has no reference of $load Pa for $name"; exit 1; }
done <"$wanted"
rm -f "$wanted"
quick notched --threads 1
