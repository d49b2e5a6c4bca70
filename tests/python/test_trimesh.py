# SPDX-License-Identifier: GPL-3.0-or-later
"""The way of whoever has a mesh, a place and times, and wants a table: trimesh, suns, pandas."""
import numpy as np
import pandas as pd
import pytest

import gnomon

trimesh = pytest.importorskip("trimesh")


def test_from_a_mesh_to_hours_of_sun_by_face():
    tower = trimesh.creation.box(extents=(4, 4, 10))
    tower.apply_translation((0, 0, 5))
    house = trimesh.creation.box(extents=(4, 4, 4))
    house.apply_translation((0, 8, 2))  # north of the tower
    both = trimesh.util.concatenate([tower, house])
    scene = gnomon.Scene.from_arrays(both.vertices, both.faces)
    times = pd.date_range("2026-12-21 07:30", "2026-12-21 17:30", freq="h", tz="Etc/GMT+7")
    vectors = gnomon.suns(33.45, -111.98, times)
    up = vectors[:, 2] > 0
    table = pd.DataFrame(0.0, index=times, columns=scene.polygons)
    table[up] = scene.sunlit(vectors[up], numbers="decimal")
    assert table.shape == (11, 24)
    assert ((table >= 0) & (table <= 1)).all().all()
    hours = table.sum()
    south = both.face_normals[:, 1] < -0.5
    of_tower = np.arange(len(both.faces)) < len(tower.faces)
    # The tower's south wall has all the sun there is; the house's is in its shadow at noon.
    assert hours[south & of_tower].min() > hours[south & ~of_tower].max()
    # Floors and north walls have none in December.
    dark = (both.face_normals[:, 2] < -0.5) | (both.face_normals[:, 1] > 0.5)
    assert hours[dark].max() == 0


def test_the_area_that_is_lit_is_what_an_image_of_it_shows():
    """A sphere lights half its area, and what is lit projects onto the whole disc."""
    ball = trimesh.creation.icosphere(subdivisions=2)
    scene = gnomon.Scene.from_arrays(ball.vertices, ball.faces)
    np.testing.assert_allclose(scene.areas, ball.area_faces, rtol=1e-12)
    sun = np.array([0.3, 0.2, 0.9])
    lit = scene.sunlit(sun)[0]
    towards = ball.face_normals @ (sun / np.linalg.norm(sun))
    assert set(lit[towards > 1e-6]) == {1.0}  # convex: nothing hides a face that faces the sun
    assert set(lit[towards < -1e-6]) == {0.0}
