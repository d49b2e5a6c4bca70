# SPDX-License-Identifier: GPL-3.0-or-later
"""Whoever checks types can: the package and a program that uses it, read by mypy as strictly as it can."""
import os
import subprocess
import sys
from pathlib import Path

import pytest

import gnomon

pytest.importorskip("mypy")
PROGRAM = Path(__file__).with_name("typed_user.py")


def strictly(folder, *arguments):
    """What mypy says, in a folder of its own, of the package that is tested here."""
    package = Path(gnomon.__file__).parent.parent
    environment = {name: value for name, value in os.environ.items() if name != "MYPYPATH"}
    if package.name != "site-packages":  # else it is found there, and refused here
        environment["MYPYPATH"] = str(package)
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(folder / "cache"),
                           *map(str, arguments)], cwd=folder, env=environment, capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def test_a_program_and_the_stubs_are_typed(tmp_path):
    status, said = strictly(tmp_path, PROGRAM)
    assert status == 0, said
    status, said = strictly(tmp_path, "-p", "gnomon")
    assert status == 0, said
    # Wrong calls are seen, so the package is not just taken for Any.
    wrong = tmp_path / "wrong.py"
    wrong.write_text("import gnomon\n"
                     "gnomon.read(1)\n"
                     "gnomon.read('a.json').sunlit([[0, 0, 1]], numbers='octal')\n"
                     "gnomon.suns(1, 2, []).nothing\n")
    status, said = strictly(tmp_path, wrong)
    assert status == 1 and all(f"wrong.py:{line}: error" in said for line in (2, 3, 4)), said
