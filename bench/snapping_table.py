#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much of real files means something else than it says: the table of docs/intent.md.

usage: snapping_table.py GNOMON FOLDER...

For every scene file of the folders: what `gnomon info` finds, and the share of polygons whose class (lit, in shadow or
divided) under one of eight suns is another one after `gnomon convert --snap`, at 1e-6 and at 1e-3 scene units.
Exit status: 0, or 1 if a file could not be measured.
"""
import json
import math
import os
import subprocess
import sys
import tempfile

DISTANCES = ["1e-6", "1e-3"]
SUNS = [
    (round(math.sin(math.radians(20 + 45 * k)), 3), round(math.cos(math.radians(20 + 45 * k)), 3), 0.6)
    for k in range(8)
]


def run(*arguments):
    done = subprocess.run(arguments, capture_output=True, text=True, timeout=600)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip().splitlines()[-1])
    return done


def classes(gnomon, scene):
    """(light, polygon, side) -> lit, shadow or divided."""
    suns = [f"--sun={x},{y},{z}" for x, y, z in SUNS]
    ids = [word for k in range(len(SUNS)) for word in ("--light", f"sun{k}")]
    result = json.loads(run(gnomon, "shadows", scene, "--skip-bad", "--exact-fractions", *suns, *ids).stdout)
    found = {}
    for light in result["lights"]:
        for side in light["polygons"]:
            lit = side["lit"]["fraction"]
            name = "lit" if lit in ("1", 1) else "shadow" if lit in ("0", 0) else "divided"
            found[light["id"], side["id"], side["side"]] = name
    return found


def measure(gnomon, scene, folder):
    intent = json.loads(run(gnomon, "info", scene, "--skip-bad", "--json", "-").stdout)["intent"]
    before = classes(gnomon, scene)
    polygons = {polygon for _, polygon, _ in before}
    row = [str(len(polygons)), str(len(intent["nearly_coplanar"])), str(len(intent["nearly_shared_vertices"])),
           str(len(intent["bent"]))]
    for distance in DISTANCES:
        snapped = os.path.join(folder, "snapped.json")
        run(gnomon, "convert", scene, snapped, "--skip-bad", "--snap", distance)
        after = classes(gnomon, snapped)
        changed = {key[1] for key, name in after.items() if before.get(key, name) != name}
        row.append(f"{100 * len(changed) / max(1, len(polygons)):.1f} %")
    return row


def main():
    gnomon, folders = sys.argv[1], sys.argv[2:]
    failed = False
    print("| file | polygons | pairs | vertices | bent | at 1e-6 | at 1e-3 |")
    print("|---|---:|---:|---:|---:|---:|---:|")
    for folder in folders:
        for name in sorted(os.listdir(folder)):
            if os.path.splitext(name)[1] not in (".json", ".obj", ".off", ".ply"):
                continue
            with tempfile.TemporaryDirectory() as place:
                try:
                    row = measure(gnomon, os.path.join(folder, name), place)
                except (RuntimeError, subprocess.TimeoutExpired) as problem:
                    print(f"{name}: {problem}", file=sys.stderr)
                    failed = True
                    continue
            print(f"| {name} | " + " | ".join(row) + " |", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
