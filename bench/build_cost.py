#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Says what building costs: seconds by component, room and kernel, from ninja's log.

usage: build_cost.py [BUILD_DIRECTORY] [--target gnomon] [--steps N] [--systems]

Each step of ninja's is one process, so where the machine has nothing else to do its seconds are those of
a CPU. Only the latest run of each step counts, and steps that a compiler cache answered count as they
were: measure in a fresh directory with CCACHE_DISABLE=1. --target leaves out what that target does not
need, --steps lists the N longest. --systems says what each room of the algorithms adds in the kernels'
own sources, by the bytes of code that they hold of its classes and functions.
"""
import argparse
import collections
import pathlib
import re
import subprocess
import sys

KERNELS = ("longdouble", "long_double", "float", "double", "rational", "epick", "epeck", "plane")


def read_log(directory):
    """The seconds of each output's latest run."""
    seconds = {}
    for line in (directory / ".ninja_log").read_text().splitlines():
        if line.startswith("#"):
            continue
        start, end, _, output, _ = line.split("\t")
        seconds[output] = (int(end) - int(start)) / 1000
    return seconds


def needed_by(directory, target):
    listed = subprocess.run(["ninja", "-C", str(directory), "-t", "inputs", target],
                            capture_output=True, text=True, check=True).stdout
    return {line.strip() for line in listed.splitlines()} | {target, f"bin/{target}"}


def place(output):
    """(component, room, kernel) of an output; the room may be a step such as "link"."""
    parts = output.split("/")
    component = "/".join(parts[:2]) if parts[0] == "tests" else parts[0]
    inner = output.split(".dir/", 1)
    if len(parts) == 1 or not output.endswith((".o", ".gch")) or len(inner) < 2:
        return ("tests" if parts[0] == "test_programs" else component), "link", ""
    if output.endswith(".gch"):
        return "precompiled headers", pathlib.Path(parts[2]).stem, ""
    unit = re.match(r"Unity/unity_(.*)_\d+_cxx\.cxx\.o$", inner[1])
    if unit:
        room = unit.group(1) or "-"
        kernel = re.match(r"kernel_(\w+?)(_\d+)?$", room)
        return (component, "run", kernel.group(1)) if kernel else (component, room, "")
    folder, _, name = inner[1].rpartition("/")
    stem = name.split(".")[0]
    kernel = next((k for k in KERNELS if re.search(rf"(^|_){k}($|_)", stem)), "")
    return component, folder.rpartition("/")[2] or "-", kernel


def print_table(title, sums):
    total = sum(seconds for seconds, _ in sums.values())
    print(f"{title:44} {'seconds':>8} {'share':>7} {'steps':>6}")
    for key, (seconds, steps) in sorted(sums.items(), key=lambda item: -item[1][0]):
        print(f"{key:44} {seconds:8.1f} {100 * seconds / total:6.1f}% {steps:6}")
    print()


def room_classes(root):
    """The names of classes and functions that the headers of each room of the algorithms define."""
    names = {}
    for header in sorted((root / "algorithms").glob("*/*.h")):
        text = header.read_text()
        found = re.findall(r"^(?:class|struct)\s+(\w+)[^;]*\{", text, re.M)
        found += re.findall(r"^[\w:<>,&*\s]*?\b([a-z]\w+)\([^;{}]*\)[^;{}]*\{", text, re.M)
        for name in found:
            names.setdefault(name, header.parent.name)
    return names


def system_costs(root, directory, seconds):
    """Prints, for each room, its bytes of code in the kernels' sources and the seconds they stand for."""
    names = room_classes(root)
    total = sum(seconds.values())
    costs = collections.Counter()
    objects = [o for o in seconds if o.startswith("algorithms/") and place(o)[2] and
               (directory / o).exists()]
    for output in objects:
        listed = subprocess.run(["nm", "-S", "-C", "--defined-only", str(directory / output)],
                                capture_output=True, text=True, check=True).stdout
        sizes = collections.Counter()
        for line in listed.splitlines():
            fields = line.split(None, 3)
            if len(fields) < 4 or fields[2] not in "tTwW":
                continue
            # The outermost name that a room owns says whose code it is.
            words = re.findall(r"\w+", fields[3])
            room = next((names[word] for word in words if word in names), "other")
            sizes[room] += int(fields[1], 16)
        of_all = sum(sizes.values()) or 1
        for room, size in sizes.items():
            costs[room] += seconds[output] * size / of_all
    print(f"{'room, in ' + str(len(objects)) + ' sources of kernels':44} {'seconds':>8} {'of the build':>13}")
    for room, cost in costs.most_common():
        print(f"{room:44} {cost:8.1f} {100 * cost / total:12.1f}%")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    root = pathlib.Path(__file__).resolve().parent.parent
    parser.add_argument("directory", nargs="?", type=pathlib.Path, default=root / "build/release")
    parser.add_argument("--target")
    parser.add_argument("--steps", type=int, default=0)
    parser.add_argument("--systems", action="store_true")
    options = parser.parse_args()
    if not (options.directory / ".ninja_log").exists():
        sys.exit(f"build_cost: {options.directory} has no .ninja_log: build there first")

    seconds = read_log(options.directory)
    if options.target:
        needed = needed_by(options.directory, options.target)
        seconds = {o: s for o, s in seconds.items() if o in needed}
    tables = [collections.defaultdict(lambda: (0.0, 0)) for _ in range(3)]
    for output, cost in seconds.items():
        component, room, kernel = place(output)
        for table, key in zip(tables, (component, f"{component}/{room}", kernel)):
            if key:
                table[key] = (table[key][0] + cost, table[key][1] + 1)
    for title, table in zip(("component", "room", "kernel (its own sources)"), tables):
        print_table(title, table)
    for output, cost in sorted(seconds.items(), key=lambda item: -item[1])[:options.steps]:
        print(f"{cost:8.1f} {output.replace('CMakeFiles/', '')}")
    if options.systems:
        system_costs(root, options.directory, seconds)
    print(f"all: {sum(seconds.values()):.1f} s in {len(seconds)} steps")


if __name__ == "__main__":
    main()
