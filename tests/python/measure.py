#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the module costs beside the command: 100 suns on a city of 10,001 polygons.

    GNOMON_PROGRAM=build/release/bin/gnomon PYTHONPATH=build/release/python \\
        build/venv/bin/python tests/python/measure.py [--runs N] [--jobs N]

Runs command and module in turn, and prints the ratio of the medians: wall time and CPU time of whole
processes, in each of which the scene is read and all is computed. Both tables must be equal bit by bit.
Exit status 1 if they are not, or if the module takes more than a tenth more CPU time.
"""
import argparse
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

MODULE = """
import sys, numpy as np, gnomon
scene, suns, table, jobs = sys.argv[1:]
lit = gnomon.read(scene).sunlit(np.load(suns), sides="all", numbers="decimal", jobs=int(jobs))
np.save(table, lit)
"""


def seconds(arguments):
    """Wall and CPU seconds of a process."""
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(arguments, check=True, stdout=subprocess.DEVNULL)
    wall, after = time.perf_counter() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("--runs", type=int, default=5)
    options.add_argument("--jobs", type=int, default=1)
    options.add_argument("--houses", type=int, default=2000)
    asked = options.parse_args()
    program = os.environ.get("GNOMON_PROGRAM", "gnomon")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        scene, lights = folder / "city.json", folder / "lights.json"
        subprocess.run([program, "generate", "city", "--param", f"n={asked.houses}", "--param",
                        "light=1", "-o", scene],
                       check=True, stdout=subprocess.DEVNULL)
        turns = np.linspace(0, 2 * np.pi, 100, endpoint=False)
        suns = np.round(np.column_stack([np.cos(turns), np.sin(turns), 0.2 + turns / 7]), 6)
        np.save(folder / "suns.npy", suns)
        lights.write_text('{"format": "gnomon-scene", "version": 1, "numbers": "decimal", "lights": ['
                          + ", ".join(f'{{"id": "s{i}", "type": "directional", "to_light": {sun}}}'
                                      for i, sun in enumerate(suns.tolist())) + "]}")
        command = [program, "shadows", scene, "--numbers", "decimal", "--lights", lights, "--jobs",
                   str(asked.jobs), "--shares", folder / "command.npy"]
        command += [word for i in range(100) for word in ("--light", f"s{i}")]
        module = [sys.executable, "-c", MODULE, scene, folder / "suns.npy", folder / "module.npy",
                  str(asked.jobs)]
        start = seconds([sys.executable, "-c", "import numpy, gnomon"])
        times = {"command": [], "module": []}
        for _ in range(asked.runs):
            times["command"].append(seconds(command))
            times["module"].append(seconds(module))
        same = np.array_equal(np.load(folder / "command.npy"), np.load(folder / "module.npy"))
        wall, cpu = ({kind: statistics.median(run[k] for run in runs) for kind, runs in times.items()}
                     for k in (0, 1))
        own = cpu["module"] - start[1]
        print(f"{asked.houses * 5 + 1} polygons, 100 suns, {asked.jobs} threads, "
              f"median of {asked.runs}; tables equal: {same}")
        print(f"command  {wall['command']:.2f} s wall, {cpu['command']:.2f} s CPU")
        print(f"module   {wall['module']:.2f} s wall, {cpu['module']:.2f} s CPU, "
              f"{start[1]:.2f} s of it to start Python and NumPy")
        print(f"ratio of CPU times {cpu['module'] / cpu['command']:.3f}, "
              f"{own / cpu['command']:.3f} without the start")
        return 0 if same and own <= 1.1 * cpu["command"] else 1


if __name__ == "__main__":
    sys.exit(main())
