#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The sun on a wall, day by day and hour by hour, as a picture: what docs/python.md shows.

    examples/wall_year.py [--scene FILE] [--wall ID] [--step MINUTES] [-o FILE.svg]

By default the south window wall of examples/courtyard.json in Phoenix. Needs the module gnomon with
xarray, and matplotlib.
"""
import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import gnomon

HERE = Path(__file__).resolve().parent


def day_by_hour(lit, zone):
    """(days, steps of a day) of a series that has every step of every day, by the place's clock."""
    steps = int(np.timedelta64(1, "D") / (lit.time.values[1] - lit.time.values[0]))
    local = lit.time.values + np.timedelta64(int(60 * zone), "m")
    days = local.astype("datetime64[D]")
    return days[::steps], lit.values.reshape(-1, steps)


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("--scene", default=HERE / "courtyard.json")
    options.add_argument("--wall", default="south")
    options.add_argument("--step", type=int, default=15, help="minutes")
    options.add_argument("-o", "--output", default=HERE.parent / "docs" / "img" / "wall-year.png")
    asked = options.parse_args()

    scene = gnomon.read(asked.scene)
    year = scene.year(at=(33.45, -111.98), tz=-7, step=asked.step)
    days, table = day_by_hour(year.lit.sel(side=asked.wall), year.attrs["time_zone"])
    _, altitude = day_by_hour(year.sun_altitude, year.attrs["time_zone"])
    table = np.where(altitude > 0, table, np.nan)

    figure, axes = plt.subplots(figsize=(8, 4.2), layout="constrained")
    axes.set_facecolor("#20242c")
    picture = axes.imshow(table.T, origin="lower", aspect="auto", vmin=0, vmax=1, cmap="inferno",
                          extent=(0, len(days), 0, 24), interpolation="nearest")
    months = [i for i, day in enumerate(days) if str(day).endswith("-01")]
    axes.set_xticks(months, [np.datetime_as_string(days[i], "M")[5:] for i in months])
    axes.set_yticks(range(0, 25, 4), [f"{hour}:00" for hour in range(0, 25, 4)])
    axes.set(xlabel="month", ylabel="hour, standard time", ylim=(4, 20),
             title=f"Lit share of {asked.wall}, {scene.name}, Phoenix {days[0].astype(object).year}")
    figure.colorbar(picture, ax=axes, label="lit share")
    figure.savefig(asked.output, dpi=110, metadata={"Software": None})
    print(f"{asked.output}: {table.shape[0]} days, {np.nansum(table) * asked.step / 60:.0f} hours of sun")


if __name__ == "__main__":
    main()
