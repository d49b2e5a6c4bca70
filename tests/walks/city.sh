#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Somebody with a city model wants the hours of sun of every roof and facade in Python.
set -eu
gnomon=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat > two.city.json <<'JSON'
{"type": "CityJSON", "version": "2.0",
 "transform": {"scale": [0.001, 0.001, 0.001], "translate": [85000.0, 446000.0, 0.0]},
 "CityObjects": {
  "low": {"type": "Building", "geometry": [{"type": "MultiSurface", "lod": "2",
    "boundaries": [[[0, 1, 2, 3]], [[4, 5, 1, 0]]],
    "semantics": {"surfaces": [{"type": "RoofSurface"}, {"type": "WallSurface"}], "values": [0, 1]}}]},
  "tall": {"type": "Building", "geometry": [{"type": "MultiSurface", "lod": "2",
    "boundaries": [[[6, 7, 8, 9]], [[9, 8, 10, 11]]]}]}},
 "vertices": [[0, 0, 5000], [10000, 0, 5000], [10000, 8000, 5000], [0, 8000, 5000],
              [0, 0, 0], [10000, 0, 0],
              [0, -12000, 20000], [10000, -12000, 20000], [10000, -6000, 20000], [0, -6000, 20000],
              [10000, -6000, 0], [0, -6000, 0]]}
JSON
"$gnomon" year two.city.json --at=51.99,4.35 --tz 1 --year 2026 -o two.nc --hours hours.csv
"$gnomon" year two.city.json --at=51.99,4.35 --tz 1 --year 2026 -o two.csv
head -3 hours.csv
grep -q '^low/0,' hours.csv
# Read back as people do, where their libraries are installed.
for python in python3 /usr/bin/python3; do
  "$python" -c 'import numpy, pandas, xarray' 2> no.txt || continue
  exec "$python" - <<'PY'
import numpy, pandas, xarray
year = xarray.open_dataset("two.nc")
table = pandas.read_csv("two.csv", index_col=0, parse_dates=True)
assert year.sizes["time"] == 8760 and len(table) == 8760
sides = [str(name) for name in year.side.values]
assert sides == list(table.columns[3:])
assert numpy.abs(year.lit.transpose("time", "side").values - table[sides].values).max() < 1e-7
hours = pandas.read_csv("hours.csv", index_col=0)
assert numpy.allclose(table[sides].sum().values, hours.loc[sides, "all"].values, rtol=1e-8)
june = year.lit.sel(time=slice("2026-06-01", "2026-06-30"), side="low/0")
assert 100 < float(june.sum()) < 500
print(year)
PY
done
