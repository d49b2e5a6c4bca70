# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the Python module share: scenes, and the command to be held against."""
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import gnomon

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def examples():
    return ROOT / "examples"


@pytest.fixture
def command():
    """Runs the command with these arguments; its path is in GNOMON_PROGRAM."""
    program = os.environ.get("GNOMON_PROGRAM")
    if not program:
        pytest.skip("GNOMON_PROGRAM names no command to be held against")

    def run(*arguments, status=0):
        done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
        assert done.returncode == status, done.stderr
        return done.stdout if status == 0 else done.stderr

    return run


@pytest.fixture
def plate():
    """A plate of 1 x 1 at a height of 1 above a ground of 10 x 10. Under a sun straight above the
    ground is lit but for one hundredth."""
    vertices = np.array([[-5, -5, 0], [5, -5, 0], [5, 5, 0], [-5, 5, 0],
                         [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], dtype=float)
    return gnomon.Scene.from_arrays(vertices, [[0, 1, 2, 3], [4, 5, 6, 7]], ["ground", "plate"],
                                    name="plate")
