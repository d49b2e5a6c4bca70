#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# One who wrote a ray caster (examples/embree_samples.cc) asks which of its settings is right.
set -eu
gnomon=$1
rays=$2
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
# A lone polygon, all of it lit, whose coordinates single precision rounds.
cat > lone.json <<'JSON'
{ "format": "gnomon-scene", "version": 1, "name": "lone", "numbers": "decimal",
  "vertices": [[0.1,0.2,0.3],[4.1,0.2,1.7],[4.1,3.2,1.7],[0.1,3.2,0.3]],
  "polygons": [{"id": "quad", "loop": [0,1,2,3]}],
  "lights": [{"id": "lamp", "type": "point", "position": [1,2,7]}] }
JSON
# judged STATUS SCENE "GRID OFFSET [robust]" OPTIONS...: what certify says, in verdict.txt.
judged() {
  local expected=$1 scene=$2 settings=$3 status=0
  shift 3
  # shellcheck disable=SC2086
  "$rays" "$scene" $settings > rays.csv
  "$gnomon" certify "$scene" --samples rays.csv "$@" > verdict.txt || status=$?
  if [ "$status" -ne "$expected" ]; then
    cat verdict.txt
    echo "$scene, $settings $*: status $status, expected $expected"
    exit 1
  fi
}
for robust in "" robust; do
  judged 1 lone.json "16 0 $robust"
  grep -q "hint: .* a ray that starts on a polygon may meet that" verdict.txt
  judged 0 lone.json "16 1e-3 $robust"
done
# Whole numbers: without the flag a ray's own beginning does not count, with it it does.
scenes=$here/../../examples
judged 0 "$scenes/solids.json" "16 0"
judged 1 "$scenes/solids.json" "16 0 robust"
judged 0 "$scenes/solids.json" "16 1e-3 robust"
# At the foot of a wall no offset helps with the flag.
judged 0 "$scenes/room.json" "16 1e-3 robust"
judged 1 "$scenes/room.json" "16 1e-3 robust" --strict
grep -q "found 0, true 1; it touches room.back" verdict.txt
# 64 rays tell the share of an area light to a tenth.
judged 0 "$scenes/room1992.json" "8 1e-3 robust" --tolerance 0.1
judged 1 "$scenes/room1992.json" "8 1e-3 robust" --tolerance 0.001
