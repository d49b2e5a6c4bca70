# SPDX-License-Identifier: GPL-3.0-or-later
"""Fragments as arrays, shares of all classes, the result file; and verdicts."""
import json
from fractions import Fraction

import numpy as np
import pytest

import gnomon

ABOVE = [[0, 0, 1]]


def area(loop):
    """Of a loop in a plane across z."""
    x, y = loop[:, 0], loop[:, 1]
    return 0.5 * np.dot(x, np.roll(y, -1)) - 0.5 * np.dot(y, np.roll(x, -1))


def test_fragments_tile_every_side_that_is_reached(plate):
    shadows = plate.shadows(suns=ABOVE)
    fragments = shadows.fragments
    areas = {}
    for i in range(len(fragments)):
        key = (plate.polygons[fragments.polygon[i]], gnomon.STATES[fragments.state[i]])
        areas[key] = areas.get(key, 0) + area(fragments.loop(i))
    assert areas == {("ground", "lit"): 99, ("ground", "shadow"): 1, ("plate", "lit"): 1}
    dark = np.flatnonzero(fragments.state == gnomon.STATES.index("shadow"))
    assert {plate.polygons[fragments.caster[i]] for i in dark} == {"plate"}
    assert set(fragments.caster[fragments.state == 0]) == {-1}
    assert fragments.points.shape == (fragments.offsets[-1], 3)
    assert fragments.loop(0).base is fragments.points
    with pytest.raises(IndexError):
        fragments.loop(len(fragments))


def test_exact_corners_and_shares(plate):
    shadows = plate.shadows(suns=[[1, 1, 3]], exact=True)
    fragments = shadows.fragments
    assert len(fragments.exact_points) == len(fragments.points)
    for exact, nearest in zip(fragments.exact_points, fragments.points):
        assert all(isinstance(value, Fraction) for value in exact)
        assert [float(value) for value in exact] == nearest.tolist()
    assert Fraction(-1, 3) in {value for point in fragments.exact_points for value in point}
    assert shadows.exact_shares("lit").tolist() == [[Fraction(99, 100), 1]]
    assert shadows.exact_shares("shadow").tolist() == [[Fraction(1, 100), 0]]


def test_shares_of_each_class_add_up(examples):
    shadows = gnomon.read(examples / "room.json").shadows(fragments=False)
    total = sum(shadows.shares(state) for state in gnomon.STATES)
    np.testing.assert_allclose(total, 1, atol=1e-12)


def test_area_lights_have_penumbra(plate):
    lamp = [[0.25, 0.25, 3], [0.25, 0.75, 3], [0.75, 0.75, 3], [0.75, 0.25, 3]]
    shadows = plate.shadows(areas=[lamp], fragments=False)
    assert shadows.lights == ["area0"]
    # Similar triangles: the umbra is 1.25 wide on the ground, the shadow as a whole 1.75.
    assert shadows.shares("umbra")[0, 0] == pytest.approx(1.25**2 / 100, abs=1e-12)
    assert shadows.shares("penumbra")[0, 0] == pytest.approx((1.75**2 - 1.25**2) / 100, abs=1e-12)


def test_the_file_is_that_of_the_command(examples, command, tmp_path):
    shadows = gnomon.read(examples / "courtyard.json").shadows(algorithm="sectors")
    shadows.to_json(tmp_path / "result.json")
    command("shadows", examples / "courtyard.json", "--fragments", "--algorithm", "sectors",
            "-o", tmp_path / "command.json")
    assert (tmp_path / "result.json").read_bytes() == (tmp_path / "command.json").read_bytes()
    assert shadows.to_dict()["format"] == "gnomon-result"


def test_lights_are_chosen(examples):
    scene = gnomon.read(examples / "courtyard.json")
    assert scene.shadows(fragments=False).lights == ["sun", "lamp"]
    assert scene.shadows(["lamp"], fragments=False).lights == ["lamp"]
    assert scene.shadows(["lamp"], suns=ABOVE, fragments=False).lights == ["lamp", "sun0"]
    assert scene.shadows(suns=ABOVE, points=[[1, 1, 9]],
                         fragments=False).lights == ["point0", "sun0"]
    with pytest.raises(gnomon.Error, match="no such light; expected one of: sun, lamp"):
        scene.shadows(["moon"])


def test_a_scene_without_lights_says_so(plate):
    with pytest.raises(gnomon.Error, match="there is no light"):
        plate.shadows()


def test_what_was_not_kept_is_refused(plate):
    shadows = plate.shadows(suns=ABOVE, fragments=False)
    for use in (lambda: shadows.fragments, lambda: shadows.exact_shares(),
                lambda: plate.certify(shadows), lambda: shadows.shares("dusk")):
        with pytest.raises(gnomon.Error):
            use()


def test_right_shares_agree_and_wrong_ones_fail(plate):
    right = plate.certify([[0.99, 1]], suns=ABOVE)
    assert right and right.verdict == "shares agree"
    wrong = plate.certify([[0.98, 1]], suns=ABOVE)
    assert not wrong and wrong.verdict == "failed"
    assert wrong.worst["polygon"] == "ground"
    assert "ground" in str(wrong) and wrong.reason
    assert plate.certify([[0.98, 1]], suns=ABOVE, tolerance=0.02)


def test_shares_that_are_none_tell_nothing(plate):
    assert plate.certify([[0.99, np.nan]], suns=ABOVE)
    assert not plate.certify([[0.5, np.nan]], suns=ABOVE)


def test_own_shares_are_certified(examples):
    scene = gnomon.read(examples / "courtyard.json")
    suns = [[1, 2, 3], [-1, 0.5, 1]]
    assert scene.certify(scene.sunlit(suns), suns=suns).verdict == "shares agree"


def test_fragments_are_certified(plate, examples):
    assert plate.certify(plate.shadows(suns=ABOVE, exact=True)).verdict == "identical"
    shadows = plate.shadows(suns=ABOVE)
    as_file = plate.certify(shadows.to_dict(), suns=ABOVE)
    assert as_file.verdict in ("identical", "within tolerance")
    scene = gnomon.read(examples / "courtyard.json")
    rounded = scene.certify(scene.shadows(kernel="float"))
    assert rounded.verdict == "failed"


def test_a_file_is_judged_as_by_the_command(examples, command, tmp_path):
    file = tmp_path / "result.json"
    command("shadows", examples / "courtyard.json", "--kernel", "double", "--fragments", "-o", file)
    command("certify", examples / "courtyard.json", "--candidate", file,
            "--json", tmp_path / "verdict.json")
    verdict = gnomon.read(examples / "courtyard.json").certify(file)
    assert verdict.document == json.loads((tmp_path / "verdict.json").read_text())


def test_candidates_that_are_none(plate, tmp_path):
    for candidate in ([[0.99]], np.zeros((2, 2)), tmp_path / "none.json", {"lights": 7}):
        with pytest.raises(gnomon.Error):
            plate.certify(candidate, suns=ABOVE)
