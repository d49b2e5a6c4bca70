# SPDX-License-Identifier: GPL-3.0-or-later
"""A program of somebody who checks types: every function of the module, once. test_types.py has mypy read it."""
from __future__ import annotations

import datetime
from fractions import Fraction
from pathlib import Path

import numpy as np
import numpy.typing as npt

import gnomon


def hours_of_sun(path: Path) -> dict[str, float]:
    scene: gnomon.Scene = gnomon.read(path, numbers="decimal", skip_bad=True)
    day = datetime.datetime(2026, 6, 21, tzinfo=datetime.timezone.utc)
    times = [day + datetime.timedelta(hours=hour) for hour in range(24)]
    suns: npt.NDArray[np.float64] = gnomon.suns(33.45, -111.98, times, model="energyplus")
    lit: npt.NDArray[np.float64] = scene.sunlit(suns[suns[:, 2] > 0], numbers="decimal")
    return {name: float(hours) for name, hours in zip(scene.polygons, lit.sum(axis=0))}


def largest_share(vertices: npt.NDArray[np.float64], faces: list[list[int]]) -> Fraction:
    scene = gnomon.Scene.from_arrays(vertices, faces, [f"face {i}" for i in range(len(faces))])
    shares: npt.NDArray[np.object_] = scene.sunlit([[0, 0, 1]], exact=True)
    return max(Fraction(share) for share in shares[0])


def dark_loops(scene: gnomon.Scene) -> list[npt.NDArray[np.float64]]:
    shadows: gnomon.Shadows = scene.shadows(suns=[[1, 2, 3]], exact=True)
    fragments: gnomon.Fragments = shadows.fragments
    dark = np.flatnonzero(fragments.state == gnomon.STATES.index("shadow"))
    shadows.to_json(Path("result.json"))
    return [fragments.loop(int(index)) for index in dark]


def judged(scene: gnomon.Scene, theirs: npt.NDArray[np.float64]) -> str:
    try:
        verdict: gnomon.Verdict = scene.certify(theirs, suns=[[1, 2, 3]], tolerance=1e-3)
    except gnomon.Error as error:
        return f"{error.code} in line {error.line}: {error.expected}"
    worst = verdict.worst
    return verdict.verdict if bool(verdict) or worst is None else str(worst["polygon"])


def checksum_of_a_week(scene: gnomon.Scene) -> str:
    week = scene.year(at=(33.45, -111.98), tz=-7, from_="06-01", to="06-07", step=30)
    return str(week.attrs["checksum"])
