# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes from files and arrays: what they hold, and what is refused, in the command's words."""
import pickle
import warnings

import numpy as np
import pytest

import gnomon

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)


def refused(*arguments, **named):
    with pytest.raises(gnomon.Error) as caught:
        gnomon.Scene.from_arrays(*arguments, **named)
    return caught.value


def test_a_file_is_what_the_command_sees(examples, command):
    scene = gnomon.read(examples / "courtyard.json")
    assert scene.name == "courtyard"
    assert len(scene.polygons) == 44
    assert scene.lights == ["sun", "lamp"]
    assert scene.numbers == "decimal"
    assert scene.geometry in command("shadows", examples / "courtyard.json")
    assert scene.sides[:2] != [] and set(scene.polygons) <= set(scene.sides)


def test_areas_are_those_of_polygons(plate):
    assert plate.areas.tolist() == [100, 1]


def test_ids_are_indices_where_there_are_none():
    scene = gnomon.Scene.from_arrays(SQUARE, [[0, 1, 2], [0, 2, 3]])
    assert scene.polygons == ["0", "1"]


def test_faces_are_an_array_or_loops_of_any_length():
    corners = np.array([[0, 1, 2], [0, 2, 3]], dtype=np.uint32)
    by_array = gnomon.Scene.from_arrays(SQUARE, corners)
    by_lists = gnomon.Scene.from_arrays(SQUARE.tolist(), [[0, 1, 2], (0, 2, 3)])
    assert by_array.geometry == by_lists.geometry
    ragged = gnomon.Scene.from_arrays(SQUARE, [[0, 1, 2], np.array([0, 1, 2, 3])])
    assert ragged.areas.tolist() == [0.5, 1]


def test_two_sided_polygons_have_two_sides():
    scene = gnomon.Scene.from_arrays(SQUARE, [[0, 1, 2, 3]], ["sheet"], two_sided=True)
    assert scene.sides == ["sheet", "sheet#back"]


def test_decimals_are_tenths_exactly():
    vertices = SQUARE * 0.1
    scene = gnomon.Scene.from_arrays(vertices, [[0, 1, 2, 3]], numbers="decimal")
    assert scene.numbers == "decimal"
    assert scene.areas.tolist() == [0.01]


@pytest.mark.parametrize("faces, code, pointer", [
    ([[0, 1, 7]], "index", "/polygons/0/loop/2"),
    ([[0, 1, 2], [0, -1, 2]], "index", "/polygons/1/loop/1"),
    ([[0, 1]], "format", "/polygons/0/loop"),
    ([[0, 2, 1, 3]], "geometry", "/polygons/0"),
])
def test_what_is_wrong_is_named_with_its_place(faces, code, pointer):
    error = refused(SQUARE, faces, name="square")
    assert error.code == code
    assert error.pointer.startswith(pointer)
    assert str(error).startswith("square: ")


def test_an_index_is_refused_in_the_words_of_files(tmp_path, command):
    file = tmp_path / "bad.json"
    file.write_text('{"format": "gnomon-scene", "version": 1, "vertices": [[0,0,0],[1,0,0],[1,1,0]],'
                    ' "polygons": [{"loop": [0, 1, 9]}]}')
    said = command("info", file, status=2).strip()
    with pytest.raises(gnomon.Error) as caught:
        gnomon.read(file)
    assert said == "gnomon: " + str(caught.value)
    assert "index 9 is not that of a vertex; expected 0 to 2" in str(caught.value)
    assert "index 9 is not that of a vertex; expected 0 to 2" in str(
        refused(SQUARE[:3], [[0, 1, 9]]))


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_numbers_that_are_none_are_refused(value):
    vertices = SQUARE.copy()
    vertices[2, 1] = value
    error = refused(vertices, [[0, 1, 2, 3]])
    assert (error.code, error.pointer) == ("number", "/vertices/2/1")


def test_shapes_are_checked():
    assert "(n, 3)" in refused(SQUARE[:, :2], [[0, 1, 2]]).expected
    assert "integers" in refused(SQUARE, np.array([[0.0, 1.0, 2.0]])).expected
    assert refused(SQUARE, [[0, 1, 2]], ["a", "b"]).expected == "one each"
    assert refused(SQUARE, [[0, 1, 2]], casts=[True, False]).expected == "one each"
    assert refused(SQUARE, [[0, 1, 2], [0, 2, 3]], ["a", "a"]).code == "id"


def test_a_file_that_is_not_there():
    with pytest.raises(gnomon.Error) as caught:
        gnomon.read("/no/such.json")
    assert caught.value.code == "file"
    assert "/no/such.json" in str(caught.value)


def test_an_error_has_its_line(tmp_path):
    file = tmp_path / "broken.json"
    file.write_text('{"format": "gnomon-scene",\n "version": }')
    with pytest.raises(gnomon.Error) as caught:
        gnomon.read(file)
    error = caught.value
    assert (error.code, error.line, error.file) == ("syntax", 2, str(file))
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.line) == (str(error), 2)


def test_polygons_left_out_are_warned_of(tmp_path):
    file = tmp_path / "bad.off"
    file.write_text("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 2 1 3\n")
    with pytest.raises(gnomon.Error):
        gnomon.read(file)
    with pytest.warns(gnomon.SceneWarning, match="1 of 2 polygons left out"):
        scene = gnomon.read(file, skip_bad=True)
    assert scene.polygons == ["0"]
    assert [name for name, _ in scene.left_out] == ["1"]


def test_polygons_without_area_are_warned_of_and_have_no_side():
    with pytest.warns(gnomon.SceneWarning, match="polygon line is dropped"):
        scene = gnomon.Scene.from_arrays(SQUARE, [[0, 1, 2, 3], [0, 1, 0]], ["square", "line"])
    assert scene.sides == ["square"]
    lit = scene.sunlit([[0, 0, 1]])
    assert lit[0, 0] == 1 and np.isnan(lit[0, 1])
    assert scene.sunlit([[0, 0, 1]], exact=True)[0, 1] is None


def test_a_good_scene_warns_of_nothing(examples):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        gnomon.read(examples / "courtyard.json")


@pytest.mark.parametrize("name", ["a\0b.json", "a\udcff.json", b"a\xff.json"])
def test_names_that_no_file_has(name):
    with pytest.raises(gnomon.Error, match="expected a name in UTF-8") as caught:
        gnomon.read(name)
    assert caught.value.code == "file"


def test_paths_of_any_kind(examples):
    for path in (str(examples / "figure-6.json"), bytes(examples / "figure-6.json")):
        assert gnomon.read(path).polygons


@pytest.mark.parametrize("jobs", [-1, 1025, 10**12])
def test_jobs_out_of_range(plate, jobs):
    for call in (lambda: plate.sunlit([0, 0, 1], jobs=jobs),
                 lambda: plate.certify([[0.99, 1]], suns=[0, 0, 1], jobs=jobs)):
        with pytest.raises(gnomon.Error, match="expected 0 to 1024"):
            call()


def test_more_jobs_than_processors_say_nothing(plate, capfd):
    for jobs in (1, 3, 1024):
        assert plate.sunlit([0, 0, 1], jobs=jobs).tolist() == [[0.99, 1.0]]
        assert plate.shadows(suns=[[0, 0, 1]], jobs=jobs).shares().tolist() == [[0.99, 1.0]]
        assert plate.certify([[0.99, 1]], suns=[[0, 0, 1]], jobs=jobs)
    told = capfd.readouterr()
    assert told.out == told.err == ""


def test_a_place_that_is_none(plate):
    pytest.importorskip("xarray")
    for at in ("33,-111", (33,), (1, 2, 3)):
        with pytest.raises(gnomon.Error, match="latitude, longitude"):
            plate.year(at=at, tz=0)


def test_a_result_that_is_no_text(plate, tmp_path):
    file = tmp_path / "result.json"
    file.write_bytes(b"{\xff")
    with pytest.raises(gnomon.Error, match="byte 1 is not valid UTF-8") as caught:
        plate.certify(file, suns=[[0, 0, 1]])
    assert caught.value.file == str(file)
