#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Somebody with a model of a program whose y axis points upwards wants shares by name, and to look at them in
# ParaView.
set -eu
gnomon=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
# A yard of 4 by 4 and a roof over its west half, 1 above it; up is y.
cat > model.obj <<'OBJ'
o yard
v 0 0 0
v 0 0 4
v 4 0 4
v 4 0 0
f 1 2 3 4
o roof
v 0 1 0
v 0 1 4
v 2 1 4
v 2 1 0
f 5 6 7 8
OBJ
# Without --up-axis the yard stands upright, and the sun at the zenith of z sees nothing of it.
"$gnomon" shadows model.obj --sun=0,0,1 --shares upright.csv
"$gnomon" shadows model.obj --up-axis y --sun=0,0,1 --shares shares.csv --export model.vtp 2> told.txt
cat shares.csv told.txt
"$gnomon" info model.obj --up-axis y > info.txt
grep -q '2 polygons' info.txt
python3 - <<'PY' || exit $?
import csv
def shares(file):
    rows = list(csv.reader(open(file)))
    return {name: value for name, value in zip(rows[0], rows[1])}
turned, upright = shares("shares.csv"), shares("upright.csv")
yard = next(name for name in turned if name.startswith("yard/0"))
roof = next(name for name in turned if name.startswith("roof/0"))
assert float(turned[yard]) == 0.5 and float(turned[roof]) == 1, turned
assert all(value in ("", "0", "sun0") or float(value) == 0 for value in list(upright.values())), upright
import xml.etree.ElementTree as xml
piece = xml.parse("model.vtp").getroot().find("PolyData/Piece")
arrays = {array.get("Name"): array.text.split() for array in piece.find("CellData")}
assert len(arrays["class"]) == int(piece.get("NumberOfPolys")) >= 3
assert {"0", "3"} == set(arrays["class"])
# Half of the yard is under the roof, which is polygon 1.
assert "1" in arrays["caster"]
print("as XML", {name: len(values) for name, values in arrays.items()})
PY
# How far off single precision is, polygon by polygon, to be looked at where it is.
"$gnomon" certify model.obj --up-axis y --sun=0.3,0.1,1 --kernel float --kernel double --json verdict.json \
    --export errors.vtp > verdict.txt || true
cat verdict.txt
# Read as people do, where VTK is installed.
reader=
for python in python3 /usr/bin/python3; do
  if "$python" -c 'import vtk' 2> no.txt; then reader=$python; break; fi
done
cat > wrong.py <<'PY'
import json
def told(run):
    """The greatest share of each polygon side that certify tells of a run, by id."""
    runs = json.load(open("verdict.json"))["runs"]
    wrong = next(one for one in runs if one["kernel"] == run)["wrong"]
    kinds = ("misclassified", "uncovered", "overlapping", "outside")
    def upper(share):
        fraction = share["fraction"]
        return fraction[1] if isinstance(fraction, list) else fraction
    return {side["polygon"]: max(upper(side[kind]) for kind in kinds) for side in wrong}
def check(ids, polygons, shares, kernel):
    assert len(polygons) == len(shares) > 0
    expected = told(kernel)
    for polygon, share in zip(polygons, shares):
        assert share == expected.get(ids[polygon], 0), (kernel, ids[polygon], share, expected)
    print("wrong by", kernel, {ids[polygon]: share for polygon, share in zip(polygons, shares)})
PY
python3 - <<'PY' || exit $?
import xml.etree.ElementTree as xml
from wrong import check, told
assert told("float") and max(told("float").values()) > max([0, *told("double").values()])
root = xml.parse("errors.vtp").getroot().find("PolyData")
def texts(name):
    array = next(one for one in root.find("FieldData") if one.get("Name") == name)
    return bytes(map(int, array.text.split())).decode().split("\0")[:-1]
assert texts("run_ids") == ["float", "double"] and texts("run_verdicts")[1] == "within tolerance"
cells = {array.get("Name"): [float(word) for word in array.text.split()] for array in root.find("Piece/CellData")}
for kernel in ("float", "double"):
    check(texts("polygon_ids"), [int(at) for at in cells["polygon"]], cells["wrong_share " + kernel], kernel)
PY
[ -n "$reader" ] || exit 0
"$reader" - <<'PY'
import vtk
def read(name):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(name)
    reader.Update()
    return reader.GetOutput()
data = read("model.vtp")
cells = data.GetCellData()
assert data.GetNumberOfCells() == cells.GetArray("class").GetNumberOfTuples() >= 3
names = data.GetFieldData().GetAbstractArray("polygon_ids")
ids = [names.GetValue(i) for i in range(names.GetNumberOfValues())]
assert ids == ["yard/0", "roof/0"]
sizes = vtk.vtkCellSizeFilter()
sizes.SetInputData(data)
sizes.Update()
areas = sizes.GetOutput().GetCellData().GetArray("Area")
area = {0: 0.0, 3: 0.0}
for i in range(data.GetNumberOfCells()):
    if cells.GetArray("polygon").GetValue(i) == 0:
        area[cells.GetArray("class").GetValue(i)] += areas.GetValue(i)
assert abs(area[0] - 8) < 1e-12 and abs(area[3] - 8) < 1e-12, area
print("in VTK", area)
from wrong import check
cells = read("errors.vtp").GetCellData()
def values(name):
    array = cells.GetArray(name)
    return [array.GetValue(i) for i in range(array.GetNumberOfTuples())]
for kernel in ("float", "double"):
    check(ids, values("polygon"), values("wrong_share " + kernel), kernel)
    assert all(width >= 0 for width in values("wrong_width " + kernel))
PY
