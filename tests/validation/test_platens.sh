#!/bin/sh
# The references are those that cohesive_disc.py and cohesive_beam.py compute; one disc, a block, a prism and a beam of large cells.
here=$(dirname "$0")
. "$here/quick.sh"
wanted=$(mktemp)
python3 -B "$here/platens/cohesive_disc.py" >"$wanted" && python3 -B "$here/platens/cohesive_beam.py" | sed -n 's/^peak/peak beam -/p' >>"$wanted" && [ -s "$wanted" ] || exit 1
# 'stress flat steel G 20 6288.0 N, ...', 'centre flat steel brittle 6287.3 N, ...', 'peak beam - 1129.5 N ...'; rigid jaws are for comparison
grep -v rigid "$wanted" | sed 's/ N[ ,].*//' | awk '{print $NF}' | while read -r load; do
    grep -q "reference: $load N" "$here/platens/case.yaml" || { echo "case.yaml has no reference of $load N"; exit 1; }
done || exit 1
rm -f "$wanted"
quick platens --threads 1
