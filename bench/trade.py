#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the trade of speed for accuracy, and writes it into the documents.

usage: trade.py GNOMON FOLDER [--short] [--write]

Runs `gnomon tradeoff` on the examples and on generated scenes, `gnomon tradeoff --thickness` on the recorded regressions,
and `gnomon extremes` on every axis, axis-parallel and sheared. Each run is kept in FOLDER as soon as it is done, so that
the same command goes on where it was stopped; what was measured before by another build must be deleted by hand.
--write puts the tables between the marks `<!-- trade NAME -->` and `<!-- end of trade NAME -->` of docs/results.md,
docs/extremes.md and docs/tradeoff.md, and the pictures into docs/img; without it the tables are printed. --short takes a
few scenes and steps, and measures nothing that is worth writing down.
Exit status: 0; 1 if something could not be measured or kernels contradict each other.
"""
import argparse
import collections
import json
import pathlib
import re
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
KERNELS = ["float", "double", "double+identity", "longdouble", "epick", "plane", "epeck", "rational"]
EXACT = {"plane", "epeck", "rational"}
METHODS = ["sectors", "svbsp", "receiver", "merged"]
MAP_KERNELS = ["double", "longdouble", "epick", "plane"]
SHEARED_KERNELS = ["double", "plane"]
FAMILIES = ["city", "quads", "room", "terrain", "tetra", "coplanar-tiles", "near-coplanar"]
# All but "bits", each of whose steps takes minutes, and area lights, which other methods take.
AXES = ["offset", "scale-up", "scale-down", "slivers", "near-parallel", "far-lamp", "near-lamp", "low-lamp", "grazing-sun",
        "gap", "rotation", "detail", "mixed", "tiles", "nested", "fan", "lights"]
PICTURED = ["near-parallel", "gap", "mixed"]
RIGHT = {"identical", "within tolerance"}
THICKNESSES = [0, *(float(f"1e-{power}") for power in range(15, 2, -1))]


def options(name, values):
    return [word for value in values for word in (name, str(value))]


class Runs:
    """The runs of gnomon, each with its table and its log in the folder."""

    def __init__(self, gnomon, folder):
        self.gnomon, self.folder = gnomon, folder
        self.failed = []

    def json_of(self, name, *arguments):
        path = self.folder / f"{name}.json"
        command = [self.gnomon, *arguments, "--log", str(self.folder / f"{name}.log"), "--json", str(path)]
        print(f"{name}: gnomon {' '.join(arguments)}", file=sys.stderr)
        status = subprocess.run(command, stdout=subprocess.DEVNULL, cwd=ROOT, check=False).returncode
        if status != 0:
            self.failed.append(f"{name} ended with status {status}")
            if status != 4:
                raise SystemExit(f"trade.py: {self.failed[-1]}")
        return json.loads(path.read_text())


    def picture(self, path):
        """The curves of some axes, from what the map has measured."""
        command = [self.gnomon, "extremes", *PICTURED, "--repeat", "1", "--time", "10", "--plot", str(path),
                   *options("--algorithm", ["sectors", "svbsp"]), *options("--kernel", MAP_KERNELS),
                   "--log", str(self.folder / "map.log")]
        subprocess.run(command, stdout=subprocess.DEVNULL, cwd=ROOT, check=True)


def grouped(rows, *keys):
    groups = collections.defaultdict(list)
    for row in rows:
        groups[tuple(row[key] for key in keys)].append(row)
    return groups


def number(value):
    if value == 0:
        return "0"
    return f"{value:.1e}" if value < 0.01 else f"{value:.2g}"


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def by_kernel(names):
    return sorted(names, key=lambda name: KERNELS.index(name) if name in KERNELS else len(KERNELS))


def accuracy_table(rows):
    """What each kernel gets wrong, by method and thickness."""
    judged = [row for row in rows if row.get("verdict")]
    lines = []
    for (method, kernel, thickness), group in grouped(judged, "system", "kernel", "thickness").items():
        right = [row for row in group if row["verdict"] in RIGHT]
        wrong = [row for row in group if row["verdict"] not in RIGHT]
        shares = [row["worst_share"] for row in wrong if row["worst_share"] is not None]
        lines.append((METHODS.index(method), KERNELS.index(kernel), thickness or 0, [
            method, kernel, "" if thickness is None else f"{thickness:g}", f"{len(right)} of {len(group)}",
            number(statistics.median(shares)) if shares else "-", number(max(shares)) if shares else "-",
            str(sum(row["invented"] for row in group)), str(sum(row["lost"] for row in group))]))
    lines.sort(key=lambda line: line[:3])
    return table(["method", "kernel", "thickness", "right", "worst share where wrong, median", "greatest",
                  "regions invented", "lost"], [line[3] for line in lines])


def time_table(rows, least):
    """CPU time of each kernel as a ratio to double's by the same method on the same scene."""
    ratios = collections.defaultdict(list)
    scenes = collections.defaultdict(set)
    for (scene, lights, method), group in grouped(rows, "scene", "lights", "system").items():
        timed = [row for row in group if row["end"] == "measured"]
        base = [row["cpu_seconds"] for row in timed if row["kernel"] == "double" and row["thickness"] == 1e-12]
        if not base or base[0] < least:
            continue
        scenes[method].add((scene, lights))
        for row in timed:
            if row["thickness"] in (None, 1e-12):
                ratios[method, row["kernel"]].append(row["cpu_seconds"] / base[0])
    lines = []
    for kernel in KERNELS:
        cells = []
        for method in METHODS:
            found = ratios.get((method, kernel))
            cells.append(f"{statistics.median(found):.2g} ({min(found):.2g} to {max(found):.2g})" if found else "-")
        lines.append([kernel, *cells])
    return table(["kernel", *(f"{method} ({len(scenes[method])})" for method in METHODS)], lines)


def thickness_table(found):
    """On how many scenes double is right with each thickness; the greatest of the best ones."""
    lines = []
    for (method, kernel), group in grouped(found["thickness"], "system", "kernel").items():
        judged = [row for row in group if row["judged"]]
        right = {value: sum(any(low <= value <= high for low, high in row["right"]) for row in judged)
                 for value in THICKNESSES}
        best = max(THICKNESSES, key=lambda value: (right[value], value))
        never = sum(not row["right"] for row in judged)
        lines.append([method, kernel, str(len(judged)), f"{best:g}", *(str(right[value]) for value in THICKNESSES),
                      str(never)])
    return table(["method", "kernel", "scenes", "best", *(f"{value:g}" for value in THICKNESSES), "none"], lines)


def first_failures(curves, method, kernel):
    """Axis -> (first step that fails, or "-", or with "?" the first that is not judged, and how)."""
    cells = {}
    for curve in curves:
        if curve["system"] != method or curve["kernel"] != kernel:
            continue
        first = curve["first_failure"]
        if first is None:
            cells[curve["axis"]] = ("-", "")
        else:
            how = next(step["failure"] for step in curve["steps"] if step["k"] == first)
            cells[curve["axis"]] = (f"{first}?", "") if how == "not judged" else (str(first), how)
    return cells


def map_table(parallel, sheared, methods):
    """The first step that fails: axis-parallel; and, where the axis has it, sheared."""
    columns = [(kernel, method) for kernel in MAP_KERNELS for method in methods]
    heads = ["axis", "k", *(f"{kernel} {method}" for kernel, method in columns), "double breaks by"]
    found = {key: first_failures(parallel, key[1], key[0]) for key in columns}
    turned = {key: first_failures(sheared, key[1], key[0]) for key in columns}
    lines = []
    axes = list(dict.fromkeys(curve["axis"] for curve in parallel if curve["system"] in methods))
    for axis in axes:
        value = next(curve["value"] for curve in parallel if curve["axis"] == axis)
        cells = []
        for key in columns:
            first = found[key].get(axis, ("", ""))[0]
            second = turned[key].get(axis, ("", ""))[0]
            cells.append(f"{first}; {second}" if second else first)
        how = found["double", methods[0]].get(axis, ("", ""))[1] or turned["double", methods[0]].get(axis, ("", ""))[1]
        lines.append([axis, value, *cells, how])
    return table(heads, lines)


def write_section(document, name, text):
    path = ROOT / "docs" / document
    begin, end = f"<!-- trade {name} -->", f"<!-- end of trade {name} -->"
    old = path.read_text()
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.S)
    if not pattern.search(old):
        raise SystemExit(f"trade.py: docs/{document} has no '{begin}' ... '{end}'")
    path.write_text(pattern.sub(lambda _: f"{begin}\n{text}{end}", old))


def measure(runs, short):
    few = ["--repeat", "1"] if short else []
    scenes = ["examples/stairs.json", "examples/figure-6.json"] if short else ["examples", *FAMILIES]
    thicknesses = options("--try", ["0", "1e-12"])
    methods = options("--algorithm", METHODS)
    kernels = options("--kernel", ["double", "plane"] if short else KERNELS)
    sizes = [] if short else ["--size", "300"]
    trade = runs.json_of("trade", "tradeoff", *scenes, *methods, *kernels, *thicknesses, *sizes, *few)
    recorded = ["tests/regressions/offsets"] if short else ["tests/regressions"]
    thickness = runs.json_of("thickness", "tradeoff", *recorded, "--thickness", "--repeat", "1",
                             *options("--algorithm", ["sectors", "svbsp"]))
    axes = ["gap", "--steps", "3"] if short else AXES
    for_all = ["--repeat", "1", "--time", "10"]
    some, all_of_map = (options("--kernel", kernels) for kernels in (SHEARED_KERNELS, MAP_KERNELS))
    point_lights = options("--algorithm", ["sectors", "svbsp"])
    maps = [runs.json_of("map", "extremes", *axes, *for_all, *point_lights, *(some if short else all_of_map)),
            runs.json_of("map-sheared", "extremes", *axes, *for_all, *point_lights, *some, "--sheared")]
    axes = ["area-light", "--steps", "3" if short else "17"]
    maps.append(runs.json_of("map-area", "extremes", *axes, *for_all, *(some if short else all_of_map),
                             *options("--algorithm", ["receiver", "merged"])))
    return trade, thickness, maps


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("gnomon")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--write", action="store_true")
    asked = parser.parse_args()
    if not pathlib.Path(asked.gnomon).is_file():
        parser.error(f"{asked.gnomon}: there is no such program")
    asked.folder.mkdir(parents=True, exist_ok=True)
    runs = Runs(str(pathlib.Path(asked.gnomon).resolve()), asked.folder)
    trade, thickness, (parallel, sheared, area) = measure(runs, asked.short)
    sections = {
        ("results.md", "accuracy"): accuracy_table(trade["rows"]),
        ("results.md", "time"): time_table(trade["rows"], 0 if asked.short else 1e-3),
        ("tradeoff.md", "thickness"): thickness_table(thickness),
        ("extremes.md", "map"): map_table(parallel["curves"], sheared["curves"], ["sectors", "svbsp"]),
        ("extremes.md", "area lights"): map_table(area["curves"], [], ["receiver", "merged"]),
    }
    for (document, name), text in sections.items():
        if asked.write:
            write_section(document, name, text)
        else:
            print(f"docs/{document}, {name}\n\n{text}")
    if asked.write:
        runs.picture(ROOT / "docs/img/extremes.svg")
    for failure in runs.failed:
        print(f"trade.py: {failure}", file=sys.stderr)
    return 1 if runs.failed else 0


if __name__ == "__main__":
    sys.exit(main())
