# SPDX-License-Identifier: GPL-3.0-or-later
"""Years of suns as xarray has them, against the command; suns at times."""
import datetime

import numpy as np
import pandas as pd
import pytest

import gnomon

PHOENIX = {"at": (33.45, -111.98), "tz": -7}
PHOENIX_OPTIONS = ["--at=33.45,-111.98", "--tz", "-7"]
DAYS = {"from_": "03-20", "to": "03-22", "step": 30}
DAY_OPTIONS = ["--from", "03-20", "--to", "03-22", "--step", "30"]


def test_a_year_is_that_of_the_command(examples, command, tmp_path):
    import xarray  # reads .npy's beside it as JSON; netCDF needs one more library

    assert xarray.__version__
    scene = gnomon.read(examples / "courtyard.json")
    year = scene.year(**PHOENIX, **DAYS)
    said = command("year", examples / "courtyard.json", *PHOENIX_OPTIONS, *DAY_OPTIONS,
                   "-o", tmp_path / "year.npy")
    assert year.attrs["checksum"] in said
    assert year.lit.dims == ("time", "side") and year.lit.dtype == np.float64
    assert np.array_equal(year.lit.values, np.load(tmp_path / "year.npy"))
    assert list(year.side.values) == scene.sides


def test_suns_are_those_of_the_year(plate):
    year = plate.year(**PHOENIX, **DAYS)
    vectors = gnomon.suns(33.45, -111.98, year.time.values)
    stated = np.column_stack([year.sun_x, year.sun_y, year.sun_z])
    assert np.array_equal(vectors, stated)
    day = vectors[:, 2] > 0
    lit = plate.sunlit(vectors[day], numbers="decimal")
    assert np.array_equal(lit, year.lit.values[day])
    assert (year.lit.values[~day] == 0).all()


def test_daily_sums_are_one_line(plate):
    daily = plate.year(**PHOENIX, **DAYS).lit.resample(time="1D").sum() / 2
    assert daily.sizes["side"] == 2


def test_times_of_any_kind():
    noon = datetime.datetime(2026, 6, 21, 19, 30, tzinfo=datetime.timezone.utc)
    want = gnomon.suns(33.45, -111.98, np.array(["2026-06-21T19:30"], dtype="datetime64[m]"))
    assert want.shape == (1, 3)
    assert want[0, 2] > 0.98  # 80 degrees high
    phoenix = datetime.timezone(datetime.timedelta(hours=-7))
    for times in (noon, [noon], noon.astimezone(phoenix), [noon.astimezone(phoenix)],
                  noon.replace(tzinfo=None), pd.DatetimeIndex([noon]),
                  pd.DatetimeIndex([noon]).tz_convert("America/Phoenix"),
                  pd.Series(pd.DatetimeIndex([noon])), ["2026-06-21T19:30:00"]):
        assert np.array_equal(gnomon.suns(33.45, -111.98, times), want)


def test_north_turns_the_sun():
    times = np.array(["2026-03-20T15:00"], dtype="datetime64[s]")
    straight = gnomon.suns(33.45, -111.98, times)[0]
    turned = gnomon.suns(33.45, -111.98, times, north=90)[0]  # y points east
    assert turned == pytest.approx([-straight[1], straight[0], straight[2]], abs=2e-6)


def test_places_and_times_that_are_none():
    for arguments in ((99, 0, ["2026-01-01"]), (0, 0, ["1900-01-01"]), (0, 0, ["NaT"])):
        with pytest.raises(gnomon.Error):
            gnomon.suns(*arguments)
    with pytest.raises(gnomon.Error, match="no such model"):
        gnomon.suns(0, 0, ["2026-01-01"], model="moon")


@pytest.mark.parametrize("named, words", [
    ({}, "no place is known"),
    ({"at": (33.45, -111.98)}, "--at without a time zone"),
    ({"tz": -7}, "--tz without a place"),
    ({**PHOENIX, "epw": "a.epw"}, "two places"),
    ({**PHOENIX, "step": 7}, "does not divide a day"),
    ({**PHOENIX, "from_": "13-40"}, "--from"),
    ({**PHOENIX, "average_days": 20}, "EnergyPlus"),
    ({**PHOENIX, "average_days": 0}, "1 to 366"),
    ({**PHOENIX, "pressure": 900.0}, "--refraction"),
    ({**PHOENIX, "sun_model": "moon"}, "erfa or energyplus"),
    ({**PHOENIX, "sun_at": "noon"}, "start, middle or end"),
    ({**PHOENIX, "year": 1066}, "1961 to 2500"),
    ({"epw": "/no/such.epw"}, "/no/such.epw"),
])
def test_what_is_asked_wrongly_is_said_in_the_words_of_the_command(plate, named, words):
    with pytest.raises(gnomon.Error) as caught:
        plate.year(**named)
    assert words in str(caught.value)


def test_years_of_whole_walls():
    vertices = np.array([[0, 0, 0], [3, 0, 0], [3, 0, 3], [0, 0, 3]], dtype=float)
    wall = gnomon.Scene.from_arrays(vertices, [[0, 1, 2, 3]], ["wall"])
    year = wall.year(**PHOENIX, **DAYS, gross=True)
    assert list(year.side.values) == ["wall"]  # it has no window
