#!/bin/sh
# The references are those that disc.py computes; a disc of 1500 cells pressed to failure over arcs of 20 degrees, and Hondros; the full table is in docs/notebook/papers.md.
here=$(dirname "$0")
. "$here/quick.sh"
wanted=$(mktemp)
python3 -B "$here/agh19-brazilian/disc.py" >"$wanted" && [ -s "$wanted" ] || exit 1
while read -r line; do
    grep -qF "$line" "$here/agh19-brazilian/case.yaml" || { echo "case.yaml has no '$line'"; exit 1; }
done <"$wanted"
rm -f "$wanted"
quick agh19-brazilian --threads 1
