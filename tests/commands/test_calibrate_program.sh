#!/bin/sh
# breccia calibrate end to end on small samples: 25 solves and 12 tests to failure, every file, the commit in the laws, and nothing left to do the second time.
program=${BRC_PROGRAM:-breccia}
folder=calibrate-$$
"$program" calibrate -o "$folder" --what elastic --samples 1 --elements 1200 --coordination 6,7.5,9,10.5,12 || exit 1
for file in solves.csv laws.json laws.csv errors.csv law.h rows.json rows.csv; do
    [ -s "$folder/$file" ] || { echo "$folder/$file is missing"; exit 1; }
done
[ "$(wc -l <"$folder/solves.csv")" = 26 ] || { echo "expected 25 solves"; exit 1; }
cp "$folder/laws.csv" "$folder/before.csv"
"$program" calibrate -o "$folder" --what fracture --samples 1 --elements 600 --coordination 6,8,10,12 --radii 0.3,0.5,0.8 --passages 10 || exit 1
for file in tests.csv laws.json laws.csv errors.csv law.h rows.json rows.csv; do
    [ -s "$folder/strength/$file" ] || { echo "$folder/strength/$file is missing"; exit 1; }
done
[ "$(wc -l <"$folder/strength/tests.csv")" = 13 ] || { echo "expected 12 tests"; exit 1; }
commit=$("$program" --version | sed 's/.*(commit \([^,]*\),.*/\1/')
for laws in laws.json strength/laws.json; do
    grep -q "\"commit\": \"$commit\"" "$folder/$laws" || { echo "$folder/$laws does not name the commit $commit of the program"; exit 1; }
done
"$program" calibrate -o "$folder" --what elastic --samples 1 --elements 1200 --coordination 6,7.5,9,10.5,12 --resume || exit 1
cmp "$folder/laws.csv" "$folder/before.csv" || exit 1
"$program" calibrate -o "$folder" 2>"$folder/message" && { echo "a second campaign in one folder was not refused"; exit 1; }
grep -q -- '--resume' "$folder/message" || { cat "$folder/message"; exit 1; }
"$program" calibrate --what bending 2>"$folder/message" && { echo "an unknown campaign was not refused"; exit 1; }
grep -q 'expected elastic, fracture or all' "$folder/message" || { cat "$folder/message"; exit 1; }
rm -rf "$folder"
