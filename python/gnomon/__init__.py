# SPDX-License-Identifier: GPL-3.0-or-later
"""Exact shadows of polygons, and the verdict on every other way to compute them.

    import gnomon
    scene = gnomon.read("house.idf")
    suns = gnomon.suns(33.45, -111.98, times)
    lit = scene.sunlit(suns, numbers="decimal")      # (n_suns, n_polygons)

The guide is docs/python.md of the project.
"""
from . import _native
from ._errors import Error, SceneWarning
from ._scene import Scene, read, suns
from ._shadows import STATES, Fragments, Shadows
from ._verdict import Verdict

__version__: str = _native.version

__all__ = ["STATES", "Error", "Fragments", "Scene", "SceneWarning", "Shadows", "Verdict", "read",
           "suns", "__version__"]
