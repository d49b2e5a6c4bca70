#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A test of polygon Booleans as a shadow: areas of A and B, of their union, intersection and so on, exactly.

    union.py CASES.json [--gnomon PROGRAM]      # [{"name": .., "a": [[ring, hole, ..], ..], "b": [..]}, ..]
    union.py --example

A ring is a list of [x, y]; a polygon is its ring and then its holes; A and B are lists of polygons. All of A lie on
one height over a ground, all of B on another one above, under a sun overhead. Then the shadow on the ground is the
union, the lit share of A is A without B, and so on. Prints a line a case with exact fractions.
"""
import argparse
import json
import subprocess
import sys
import tempfile
from fractions import Fraction


def scene_of(case):
    """The scene of a case, and the area of its ground."""
    vertices, polygons = [], []

    def ring_of(ring, height):
        first = len(vertices)
        vertices.extend([x, y, height] for x, y in ring)
        return list(range(first, len(vertices)))

    for name, height in (("a", 1), ("b", 2)):
        for i, (ring, *holes) in enumerate(case[name]):
            polygons.append({"id": f"{name}{i}", "loop": ring_of(ring, height),
                             "holes": [ring_of(hole, height) for hole in holes]})
    xs = [v[0] for v in vertices]
    ys = [v[1] for v in vertices]
    low_x, high_x, low_y, high_y = min(xs) - 1, max(xs) + 1, min(ys) - 1, max(ys) + 1
    ground = [[low_x, low_y], [high_x, low_y], [high_x, high_y], [low_x, high_y]]
    polygons.append({"id": "ground", "loop": ring_of(ground, 0), "casts": False})
    scene = {"format": "gnomon-scene", "version": 1, "name": case["name"], "two_sided": True,
             "vertices": vertices, "polygons": polygons,
             "lights": [{"id": "sun", "type": "directional", "to_light": [0, 0, 1]}]}
    return scene, (Fraction(high_x) - Fraction(low_x)) * (Fraction(high_y) - Fraction(low_y))


def area_of(polygon):
    """Of a ring less its holes, exactly."""
    def ring_area(ring):
        pairs = zip(ring, ring[1:] + ring[:1])
        return abs(sum(Fraction(p[0]) * Fraction(q[1]) - Fraction(q[0]) * Fraction(p[1]) for p, q in pairs)) / 2
    return ring_area(polygon[0]) - sum(ring_area(hole) for hole in polygon[1:])


def booleans(case, program):
    """Areas of the union, the intersection, A without B and the symmetric difference. Requires: the polygons of A
    do not overlap each other."""
    scene, ground = scene_of(case)
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(scene, file)
        file.flush()
        run = subprocess.run([program, "shadows", file.name, "--exact-fractions"], capture_output=True, text=True)
    if run.returncode != 0:
        return None, run.stderr.strip()
    sides = {p["id"]: p for p in json.loads(run.stdout)["lights"][0]["polygons"]}
    union = Fraction(sides["ground"]["shadow"]["fraction"]) * ground
    without = sum(Fraction(sides[f"a{i}"]["lit"]["fraction"]) * area_of(polygon)
                  for i, polygon in enumerate(case["a"]) if f"a{i}" in sides)
    whole = sum(area_of(polygon) for i, polygon in enumerate(case["a"]) if f"a{i}" in sides)
    intersection = whole - without
    return {"union": union, "intersection": intersection, "difference": without, "xor": union - intersection}, ""


EXAMPLE = [{"name": "two squares and a window", "a": [[[[0, 0], [4, 0], [4, 4], [0, 4]], [[1, 1], [2, 1], [2, 2], [1, 2]]]],
            "b": [[[[1.5, 1.5], [6, 1.5], [6, 6], [1.5, 6]]]]}]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cases", nargs="?", help="a JSON file of cases")
    parser.add_argument("--gnomon", default="gnomon", help="the program [gnomon]")
    parser.add_argument("--example", action="store_true", help="a case of its own")
    options = parser.parse_args()
    if not options.example and options.cases is None:
        parser.error("a file of cases, or --example")
    if options.example:
        cases = EXAMPLE
    else:
        with open(options.cases, encoding="utf-8") as file:
            cases = json.load(file)
    refused = 0
    for case in cases:
        areas, error = booleans(case, options.gnomon)
        if areas is None:
            refused += 1
            print(f"{case['name']}: refused: {error}")
        else:
            print(f"{case['name']}: " + ", ".join(f"{name} {area}" for name, area in areas.items()))
    return 1 if refused else 0


if __name__ == "__main__":
    sys.exit(main())
