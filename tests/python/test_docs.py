# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of the module runs as it stands, and so does the script of its picture."""
import re
import subprocess
import sys

import pytest


def test_the_page_runs_top_to_bottom(examples, monkeypatch):
    monkeypatch.chdir(examples)
    page = (examples.parent / "docs" / "python.md").read_text()
    blocks = re.findall(r"^```python\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
    assert len(blocks) >= 6
    names = {}
    for block in blocks:
        exec(compile(block, "docs/python.md", "exec"), names)
    assert names["lit"].shape == (14, 44)
    assert names["hours"] > 1


def test_the_picture_is_made(examples, tmp_path):
    pytest.importorskip("matplotlib")
    done = subprocess.run([sys.executable, "-B", examples / "wall_year.py", "--step", "240",
                           "-o", tmp_path / "wall.png"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "365 days" in done.stdout
    assert (tmp_path / "wall.png").read_bytes().startswith(b"\x89PNG")
