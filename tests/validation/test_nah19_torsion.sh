#!/bin/sh
# A short rod of 1500 spheres twisted to failure; the full campaign is in docs/notebook/beams-tests.md. both_sides is also taken from histories.csv by awk; the file has all digits, so that
# only the rounding of one sum is left between them.
program=${BRC_PROGRAM:-breccia}
folder=validation-nah19-torsion-$$
OMP_WAIT_POLICY=passive "$program" reproduce nah19-torsion --threads 1 --quick -o "$folder" || exit 1
mean=$(awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) { if ($k ~ /^moment/) m = k; if ($k ~ /^other_moment/) o = k } next }
                $1 == 2 && ($m - $o) / 2 > largest { largest = ($m - $o) / 2 } END { printf "%.15g", 7.957747e7 * largest }' "$folder/runs/quick-glass/histories.csv")
awk -F, -v mean="$mean" 'NR == 1 { for (k = 1; k <= NF; ++k) { if ($k == "quantity") q = k; if ($k == "ours") v = k } next }
                         $q == "\"both_sides\"" { found = 1; if (mean <= 0 || ($v / mean - 1) ^ 2 > 1e-24) { print "both_sides", $v, "expected", mean; exit 1 } } END { if (!found) exit 1 }' "$folder/rows.csv" || exit 1
rm -rf "$folder"
