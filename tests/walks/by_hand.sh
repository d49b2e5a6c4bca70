#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# One who does not believe it works three hours out by hand, as rationals: a south window 4 m wide and 1 m
# high under a ledge 0.75 m deep, 0.5 m above it and as wide as the wall.
set -eu
gnomon=$1
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$gnomon" year "$here/house.idf" -o house.csv
python3 - <<'PY' || exit $?
import csv
from fractions import Fraction
rows = list(csv.DictReader(open("house.csv")))
checked = 0
for time in ("2025-03-20T11:30:00-07:00", "2025-10-05T13:30:00-07:00", "2025-02-20T12:30:00-07:00"):
    row = next(r for r in rows if r["time"] == time)
    x, y, z = (Fraction(row["sun_" + axis]) for axis in "xyz")
    # The ledge's outer edge throws its shadow 0.75 z / -y below the ledge, which begins 0.5 above the
    # window, and moves it sideways by 0.75 x / -y. The pane reaches from 2 to 6 along the wall of 8 and
    # from 1 to 2 up, the ledge is at 2.5: at depth d below it the shadow runs from
    # -x / z d to 8 - x / z d.
    depth = Fraction(3, 4) * z / -y
    shaded_height = min(max(depth - Fraction(1, 2), 0), 1)
    # So near to noon the shadow's ends do not come as far as the pane.
    assert abs(x / z) * depth < 2
    expected = 1 - shaded_height
    assert 0 < expected < 1
    assert abs(Fraction(float(row["Pane"])) - expected) < Fraction(1, 10**14), (time, row["Pane"])
    print(time, "pane", expected, row["Pane"])
    checked += 1
assert checked == 3
PY
