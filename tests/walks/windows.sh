#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A building physicist has an HBJSON whose windows are a hair before the wall: what does info say, and what
# does it take to make it clean?
set -eu
gnomon=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
# A south wall of 8 by 3 with a window 4 millimetres before it, under a ledge; and a wall to a neighbour.
cat > house.hbjson <<'JSON'
{"type": "Model", "identifier": "house", "units": "Meters", "tolerance": 0.01, "properties": {"type": "ModelProperties"},
 "rooms": [{"type": "Room", "identifier": "hall", "faces": [
  {"type": "Face", "identifier": "south", "face_type": "Wall", "boundary_condition": {"type": "Outdoors"},
   "geometry": {"type": "Face3D", "boundary": [[0,0,0],[8,0,0],[8,0,3],[0,0,3]]},
   "apertures": [{"type": "Aperture", "identifier": "pane", "boundary_condition": {"type": "Outdoors"},
    "geometry": {"type": "Face3D", "boundary": [[2,-0.004,1],[6,-0.004,1],[6,-0.004,2],[2,-0.004,2]]},
    "outdoor_shades": [{"type": "Shade", "identifier": "ledge",
     "geometry": {"type": "Face3D", "boundary": [[0,0,2.5],[8,0,2.5],[8,-0.75,2.5],[0,-0.75,2.5]]}}]}]},
  {"type": "Face", "identifier": "inner", "face_type": "Wall", "boundary_condition": {"type": "Surface"},
   "geometry": {"type": "Face3D", "boundary": [[0,6,0],[8,6,0],[8,6,3],[0,6,3]]}}]}]}
JSON
"$gnomon" info house.hbjson > info.txt 2> told.txt
cat told.txt
grep -q '1 of 1 aperture or door not exactly in the plane of the face, by up to 0.004 m' told.txt
grep -q 'interior surface left out' told.txt
# The warning says what to type.
command=$(grep -o "convert --snap 0.01 --parent" told.txt)
# shellcheck disable=SC2086
"$gnomon" ${command%% *} house.hbjson clean.json ${command#* } 2> changed.txt
cat changed.txt
grep -q 'pane in south' changed.txt
"$gnomon" info clean.json > clean.txt 2> none.txt
[ ! -s none.txt ]
"$gnomon" shadows clean.json --sun=0,-1,1 --kernel exact --exact-fractions --fragments -o result.json 2> none.txt
[ ! -s none.txt ]
"$gnomon" verify clean.json result.json --sun=0,-1,1
# The sun at 45 degrees: the ledge's shadow is 0.75 high, from 2.5 down to 1.75.
python3 - <<'PY' || exit $?
import json
sides = json.load(open("result.json"))["lights"][0]["polygons"]
lit = {side["id"]: side["lit"]["fraction"] for side in sides}
assert lit["pane"] == "3/4", lit
# The opaque part of the wall: 24 less the window's 4. In the dark: 8 by 0.75, less the 4 by 0.25 of the window.
assert lit["south"] == "3/4", lit
print(lit)
PY
