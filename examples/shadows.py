#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What share of every polygon is lit, exactly and in few lines: a program to be judged.

    gnomon certify --corpus tests/regressions --candidate-command examples/shadows.py
    gnomon fuzz --candidate-command examples/shadows.py --count 100

Reads a scene (docs/formats.md), writes a result without fragments. It knows point and directional
lights and convex planar polygons, and rejects everything else: status 3 for what it cannot do,
1 for what is wrong with the file. Slow, and right: every number is a fraction.
"""
import json
import sys
from fractions import Fraction


class Unsupported(Exception):
    pass


def once(pairs):
    if len({key for key, _ in pairs}) != len(pairs):
        raise ValueError("a key stands twice")
    return dict(pairs)


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def area_vector(loop):
    total = [0, 0, 0]
    for a, b in zip(loop[1:], loop[2:]):
        total = [s + t for s, t in zip(total, cross(minus(a, loop[0]), minus(b, loop[0])))]
    return total


def clip(loop, side):
    """The part of a convex loop where side(point) > 0, up to its border; empty if it has no area."""
    values = [side(point) for point in loop]
    if max(values) <= 0:
        return []
    kept = []
    for i, (a, s) in enumerate(zip(loop, values)):
        b, t = loop[i - 1], values[i - 1]
        if s * t < 0:
            kept.append([x + (y - x) * s / (s - t) for x, y in zip(a, b)])
        if s >= 0:
            kept.append(a)
    return kept


class Polygon:
    def __init__(self, entry, index, scene, vertices):
        self.id = entry.get("id", str(index))
        self.two_sided = entry.get("two_sided", scene.get("two_sided", False))
        self.casts = entry.get("casts", True)
        indices = [int(i) for i in entry["loop"]]
        if min(indices) < 0 or len(indices) < 3 or not self.id or "#" in self.id:
            raise ValueError("no polygon")
        self.loop = [vertices[i] for i in indices]
        if entry.get("holes"):
            raise Unsupported("holes")
        self.normal = area_vector(self.loop)
        if not any(self.normal):
            if any(any(cross(minus(b, self.loop[0]), minus(c, self.loop[0])))
                   for b in self.loop for c in self.loop):
                raise ValueError("a loop that crosses itself")
            return  # all on one line: no area
        if any(self.height(point) for point in self.loop):
            raise Unsupported("a loop that is not planar")
        for i, c in enumerate(self.loop):
            a, b = self.loop[i - 2], self.loop[i - 1]
            # Left turns, and seen from the first vertex too: a spiral turns left everywhere.
            for turn in (cross(minus(b, a), minus(c, b)),
                         cross(minus(b, self.loop[0]), minus(c, self.loop[0]))):
                if dot(turn, self.normal) < 0:
                    raise Unsupported("a loop that is not convex")

    def height(self, point):
        return dot(self.normal, minus(point, self.loop[0]))

    def faces(self, light):
        """1: its front faces the light, -1: its back, 0: neither, or it has no such side."""
        position, direction = light
        sign = self.height(position) if position else dot(self.normal, direction)
        return (sign > 0) - (sign < 0 and self.two_sided)

    def shadow(self, light):
        """Half-spaces, all of which a point in its shadow is inside."""
        position, direction = light
        sign = self.faces(light)
        sides = [lambda p: -sign * self.height(p)]
        for i, b in enumerate(self.loop):
            a = self.loop[i - 1]
            normal = cross(minus(b, a), minus(position, a) if position else direction)
            inward = sum(dot(normal, minus(p, a)) for p in self.loop)
            if inward:  # not a vertex that is named twice
                sides.append(lambda p, n=normal, a=a, s=1 if inward > 0 else -1:
                             s * dot(n, minus(p, a)))
        return sides


def lit_share(polygon, casters, light):
    pieces = [polygon.loop]
    for sides in casters:
        left = []
        for piece in pieces:
            for side in sides:  # what is outside of one of them is lit, the rest is asked the next
                inside = clip(piece, side)
                if not inside:  # all of it: a coplanar caster's 0 is outside too
                    left.append(piece)
                    break
                left.append(clip(piece, lambda p: -side(p)))
                piece = inside
        pieces = [piece for piece in left if piece]
    k = max(range(3), key=lambda k: abs(polygon.normal[k]))
    return sum(area_vector(piece)[k] for piece in pieces) / Fraction(polygon.normal[k])


def solve(scene):
    if scene["format"] != "gnomon-scene" or scene["version"] != "1":
        raise ValueError("no scene of version 1")
    known = {"id", "loop", "holes", "two_sided", "casts", "extra"}
    if any(set(entry) - known for entry in scene["polygons"]):
        raise ValueError("an unknown key")
    decimal = scene.get("numbers", "double") == "decimal"

    def point(texts):
        x, y, z = texts
        if not all(isinstance(text, Text) for text in texts):
            raise ValueError("no number")
        return [Fraction(t) if decimal else Fraction(float(t)) for t in (x, y, z)]

    vertices = [point(vertex) for vertex in scene["vertices"]]
    polygons = [Polygon(entry, i, scene, vertices) for i, entry in enumerate(scene["polygons"])]
    ids = [polygon.id for polygon in polygons]
    polygons = [polygon for polygon in polygons if any(polygon.normal)]
    lights = []
    for index, entry in enumerate(scene.get("lights", [])):
        if entry["type"] == "area":
            raise Unsupported("an area light")
        light = (point(entry["position"]), None) if entry["type"] == "point" else \
                (None, point(entry["to_light"]))
        if light == (None, [0, 0, 0]):
            raise ValueError("no direction")
        sides = []
        for polygon in polygons:
            faces = polygon.faces(light)
            casters = [other.shadow(light) for other in polygons
                       if other is not polygon and other.casts and other.faces(light)]
            lit = lit_share(polygon, casters, light) if faces else 0
            sides.append({"id": polygon.id, "side": "back" if faces < 0 else "front",
                          "lit": str(lit), "shadow": str(1 - lit)})
        lights.append({"id": entry.get("id", str(index)), "polygons": sides})
    for names in (ids, [light["id"] for light in lights]):
        if len(set(names)) != len(names):
            raise ValueError("an id stands twice")
    return {"format": "gnomon-result", "version": 1, "lights": lights}


class Text(str):
    """A number as it stands in the file."""


def main():
    try:
        with open(sys.argv[1], encoding="utf-8") as file:
            scene = json.load(file, object_pairs_hook=once, parse_int=Text, parse_float=Text)
        print(json.dumps(solve(scene)))
    except Unsupported as error:
        print(f"{sys.argv[1]}: cannot do {error}", file=sys.stderr)
        sys.exit(3)
    except Exception as error:  # whatever is wrong with the file
        print(f"{sys.argv[1]}: {error!r}", file=sys.stderr)
        sys.exit(1)


if __name__ == "__main__":
    main()
