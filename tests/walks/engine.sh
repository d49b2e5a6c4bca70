#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A building engineer has a model, a weather file, and a table of sunlit fractions that an engine wrote: is
# it right, and where not?
set -eu
gnomon=$1
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cp "$here/house.idf" .
printf 'LOCATION,Phoenix,AZ,USA,made up,1,33.45,-111.98,-7.0,337.0\nDESIGN CONDITIONS,0\n' > phoenix.epw

sun=(--epw phoenix.epw --sun-model energyplus)
"$gnomon" year house.idf "${sun[@]}" --from 12-20 --to 12-22 --eplus-shading engine.csv
"$gnomon" certify house.idf "${sun[@]}" --candidate engine.csv > agrees.txt
cat agrees.txt

# One digit of the pane at two in the afternoon of the 21st.
python3 - engine.csv > wrong.csv <<'PY' || exit 77
import csv, sys
rows = list(csv.reader(open(sys.argv[1])))
column = rows[0].index("Pane")
row = next(r for r in rows if r[0] == "12/21 14:00")
row[column] = "%.8f" % (float(row[column]) - 0.001)
csv.writer(sys.stdout, lineterminator="\n").writerows(rows)
PY
status=0
"$gnomon" certify house.idf "${sun[@]}" --candidate wrong.csv > told.txt || status=$?
cat told.txt
[ "$status" -eq 1 ]
grep -q Pane told.txt
grep -q '12/21 14:00' told.txt
