# SPDX-License-Identifier: GPL-3.0-or-later
"""Lit shares under many suns: against what can be worked out by hand, and against the command."""
import signal
import threading
import time
from fractions import Fraction

import numpy as np
import pytest

import gnomon

SUNS = np.array([[0, 0, 1], [1, 2, 3], [-2, 1, 5], [0.3, -0.2, -1]], dtype=float)


def tall_grid(n):
    """n x n boxes without floors, of different heights, in squares of 1 unit."""
    vertices, faces = [], []
    for i in range(n):
        for j in range(n):
            at, height = len(vertices), 1 + (7 * i + 3 * j) % 5
            for z in (0, height):
                vertices += [[2 * i, 2 * j, z], [2 * i + 1, 2 * j, z],
                             [2 * i + 1, 2 * j + 1, z], [2 * i, 2 * j + 1, z]]
            faces += [[at + k, at + (k + 1) % 4, at + 4 + (k + 1) % 4, at + 4 + k]
                      for k in range(4)] + [[at + 4, at + 5, at + 6, at + 7]]
    return gnomon.Scene.from_arrays(np.array(vertices, dtype=float), faces, name="boxes")


def test_a_plate_hides_a_hundredth(plate):
    lit = plate.sunlit(SUNS[:1])
    assert lit.dtype == np.float64 and lit.shape == (1, 2)
    assert lit.flags.c_contiguous and lit.flags.writeable
    assert lit.tolist() == [[0.99, 1]]


def test_exactly(plate):
    lit = plate.sunlit([0, 0, 1], exact=True)
    assert lit.tolist() == [[Fraction(99, 100), Fraction(1)]]
    moved = plate.sunlit([16, 0, 3], exact=True)  # by 16/3, so that a third of the shadow falls off
    assert moved[0, 0] == 1 - Fraction(2, 3) / 100


def test_a_sun_below_sees_no_front(plate):
    assert plate.sunlit([[0, 0, -1]]).tolist() == [[0, 0]]


def test_no_sun_is_no_row(plate):
    assert plate.sunlit(np.empty((0, 3))).shape == (0, 2)


def test_doubles_are_the_nearest_to_fractions(examples):
    scene = gnomon.read(examples / "courtyard.json")
    lit = scene.sunlit(SUNS, sides="all")
    exact = scene.sunlit(SUNS, sides="all", exact=True)
    assert lit.shape == exact.shape == (4, len(scene.sides))
    assert all(isinstance(value, (Fraction, float)) for value in exact.flat)
    np.testing.assert_allclose(lit, exact.astype(float), rtol=0, atol=1e-14)


def test_every_exact_kernel_has_the_same_fractions(examples):
    scene = gnomon.read(examples / "figure-6.json")
    by_kernel = [scene.sunlit(SUNS, exact=True, kernel=kernel).tolist()
                 for kernel in ("plane", "rational", "epeck")]
    assert by_kernel[0] == by_kernel[1] == by_kernel[2]


def test_the_command_writes_the_same_doubles(examples, command, tmp_path):
    scene = gnomon.read(examples / "courtyard.json")
    suns = [f"--sun={x},{y},{z}" for x, y, z in SUNS.tolist()]
    command("shadows", examples / "courtyard.json", "--shares", tmp_path / "shares.npy", *suns,
            *(f"--light=sun{i}" for i in range(len(SUNS))))
    assert np.array_equal(scene.sunlit(SUNS, sides="all"), np.load(tmp_path / "shares.npy"))


def test_vectors_mean_what_they_are_told_to(plate):
    tenth = [[0.1, 0.2, 0.3]]
    decimal = plate.sunlit(tenth, numbers="decimal", exact=True)
    assert np.array_equal(decimal, plate.sunlit([[1, 2, 3]], exact=True))
    double = plate.sunlit([[0.1, 0.7, 0.3]], numbers="double", exact=True)
    assert np.array_equal(double, plate.sunlit([[0.1, 0.7, 0.3]], exact=True))


def test_lists_views_and_other_types_are_taken(plate):
    want = plate.sunlit(SUNS)
    assert np.array_equal(plate.sunlit(SUNS.tolist()), want)
    assert np.array_equal(plate.sunlit(np.asfortranarray(SUNS)), want)
    assert np.array_equal(plate.sunlit(SUNS[:3].astype(int)), want[:3])
    read_only = SUNS.copy()
    read_only.flags.writeable = False
    assert np.array_equal(plate.sunlit(read_only), want)
    assert np.array_equal(plate.sunlit(np.repeat(SUNS, 2, axis=0)[::2]), want)


@pytest.mark.parametrize("vectors, code", [
    ([[0, 0, 0]], "geometry"), ([[0, np.nan, 1]], "number"), ([[1, 2]], "usage"),
    (np.zeros((2, 2, 3)), "usage")])
def test_vectors_that_are_none(plate, vectors, code):
    with pytest.raises(gnomon.Error) as caught:
        plate.sunlit(vectors)
    assert caught.value.code == code


@pytest.mark.parametrize("named", [
    {"kernel": "quadruple"}, {"algorithm": "magic"}, {"sides": "left"}, {"jobs": -1},
    {"numbers": "octal"}, {"kernel": "double", "exact": True}])
def test_names_that_are_none(plate, named):
    with pytest.raises(gnomon.Error) as caught:
        plate.sunlit(SUNS, **named)
    assert caught.value.code == "usage"
    assert caught.value.expected or "in {double,decimal}" in str(caught.value)


def test_jobs_change_nothing():
    scene = tall_grid(8)
    assert np.array_equal(scene.sunlit(SUNS, jobs=1), scene.sunlit(SUNS, jobs=3))


def test_other_threads_go_on_while_it_computes():
    scene = tall_grid(20)
    suns = np.column_stack([np.linspace(-1, 1, 60), np.full(60, 0.3), np.full(60, 0.4)])
    done = threading.Event()
    worker = threading.Thread(target=lambda: (scene.sunlit(suns), done.set()))
    turns = 0
    worker.start()
    while not done.wait(0.001):
        turns += 1
    worker.join()
    assert turns > 3


def test_threads_share_a_scene():
    scene = tall_grid(6)
    want = scene.sunlit(SUNS)
    found = [None] * 4

    def compute(i):
        found[i] = scene.sunlit(SUNS)

    threads = [threading.Thread(target=compute, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(one, want) for one in found)


def test_ctrl_c_stops_it():
    scene = tall_grid(40)
    suns = np.random.default_rng(1).normal(size=(20000, 3))
    suns[:, 2] = abs(suns[:, 2]) + 0.1
    threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        scene.sunlit(suns)
    assert time.monotonic() - begin < 30
