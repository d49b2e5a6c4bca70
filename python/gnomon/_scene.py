# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes, and what is asked of them."""
from __future__ import annotations

import os
import warnings
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np

from . import _arrays, _native
from ._errors import Error, SceneWarning
from ._shadows import Shadows
from ._verdict import Verdict

if TYPE_CHECKING:
    import numpy.typing as npt
    import xarray

Numbers = Literal["double", "decimal"]
Sides = Literal["front", "all"]


def _checked_jobs(jobs: int) -> int:
    if not 0 <= jobs <= 1024:
        raise Error(f"jobs: {jobs}; expected 0 to 1024", expected="0 to 1024")
    return jobs


def _names_of_run(kernel: str, algorithm: str, jobs: int) -> _native.RunNames:
    names = _native.RunNames()
    names.kernel, names.algorithm, names.jobs = kernel, algorithm, _checked_jobs(jobs)
    return names


def _name_of(path: str | os.PathLike[str], what: str) -> str:
    """A path as the native module takes it: text without a NUL."""
    name = os.fsdecode(path)
    if "\0" in name or any("\ud800" <= c <= "\udfff" for c in name):
        raise Error(f"{what}: {name!r} holds a NUL, or bytes that are no UTF-8; expected a name in UTF-8",
                    code="file", expected="a name in UTF-8")
    return name


def _asked_lights(lights: Iterable[str] | None, suns: npt.ArrayLike | None,
                  points: npt.ArrayLike | None, areas: Sequence[npt.ArrayLike],
                  numbers: Numbers | None) -> _native.AskedLights:
    asked = _native.AskedLights()
    asked.ids = None if lights is None else list(lights)
    asked.suns = None if suns is None else _arrays.points(suns, "suns")
    asked.points = None if points is None else _arrays.points(points, "points")
    asked.areas = [_arrays.points(area, f"areas[{i}]") for i, area in enumerate(areas)]
    asked.numbers = numbers or ""
    return asked


class Scene:
    """Polygons, and the lights that their file has. It never changes.

    Made by read() and Scene.from_arrays(). Threads may share one: no method holds the GIL while it
    computes, and Ctrl-C stops it.
    """

    def __init__(self, native: _native.Scene, stacklevel: int = 3) -> None:
        self._native = native
        for text in native.warnings:
            warnings.warn(text, SceneWarning, stacklevel=stacklevel)

    @classmethod
    def from_arrays(cls, vertices: npt.ArrayLike, faces: Any, ids: Iterable[Any] | None = None, *,
                    casts: npt.ArrayLike | None = None, two_sided: bool = False,
                    numbers: Numbers = "double", name: str = "arrays") -> Scene:
        """A scene from arrays as trimesh, meshio and Open3D have them.

        Args:
            vertices: (n, 3) numbers, scene units.
            faces: (m, k) integers, or m sequences of integers of any lengths: the corners of each
                polygon as indices into `vertices`, counter-clockwise seen from its front.
            ids: names of the polygons; else "0", "1", ...
            casts: (m,) truth values: which polygons cast shadows; else all.
            two_sided: whether backs receive light, too, as those of sheets do. A closed mesh needs
                its fronts alone.
            numbers: "double": every coordinate is exactly the double that it is. "decimal": it is
                the shortest decimal number of that double, 0.1 exactly a tenth.
            name: of the scene, for messages and results.

        Errors: number (no finite coordinate), index, id (two equal ones), format (fewer than three
        corners), geometry (a polygon that crosses itself); each with the place as a JSON pointer.
        """
        points = _arrays.points(vertices, "vertices")
        indices, offsets = _arrays.loops(faces)
        count = len(offsets) - 1
        flags = None
        if casts is not None:
            flags = np.ascontiguousarray(casts, dtype=np.bool_).reshape(-1)
            if len(flags) != count:
                raise Error(f"casts: {len(flags)} for {count} polygons; expected one each",
                            expected="one each")
        return cls(_native.from_arrays(points, indices, offsets, _arrays.names(ids, count, "ids"),
                                       flags, two_sided, numbers, name))

    @property
    def name(self) -> str:
        return str(self._native.name)

    @property
    def polygons(self) -> list[str]:
        """Ids of the polygons, n_polygons of them, in the order of the file."""
        return list(self._native.polygons)

    @property
    def sides(self) -> list[str]:
        """Names of the sides that the command's tables have as columns: the polygon's id, and
        "ID#back" after it for one with two sides. Polygons without an area have none."""
        return list(self._native.sides)

    @property
    def lights(self) -> list[str]:
        """Ids of the lights of the file."""
        return list(self._native.lights)

    @property
    def areas(self) -> npt.NDArray[np.float64]:
        """(n_polygons,) areas, scene units squared: the nearest doubles."""
        return np.asarray(self._native.areas)

    @property
    def geometry(self) -> str:
        """The digest of polygons and vertices that results state."""
        return str(self._native.geometry)

    @property
    def numbers(self) -> Numbers:
        """What the scene's numbers mean."""
        return "decimal" if self._native.decimal else "double"

    @property
    def left_out(self) -> list[tuple[str, str]]:
        """Polygons that skip_bad left out, and why."""
        return list(self._native.left_out)

    @overload
    def sunlit(self, vectors: npt.ArrayLike, *, exact: Literal[False] = False,
               sides: Sides = "front", numbers: Numbers | None = None, kernel: str = "plane",
               algorithm: str = "auto", jobs: int = 0) -> npt.NDArray[np.float64]: ...

    @overload
    def sunlit(self, vectors: npt.ArrayLike, *, exact: Literal[True], sides: Sides = "front",
               numbers: Numbers | None = None, kernel: str = "plane", algorithm: str = "auto",
               jobs: int = 0) -> npt.NDArray[np.object_]: ...

    def sunlit(self, vectors: npt.ArrayLike, *, exact: bool = False, sides: Sides = "front",
               numbers: Numbers | None = None, kernel: str = "plane", algorithm: str = "auto",
               jobs: int = 0) -> npt.NDArray[np.float64] | npt.NDArray[np.object_]:
        """The lit share of every polygon under every sun.

        Args:
            vectors: (n_suns, 3): directions to the suns, of any length; z is up where the sun is.
            exact: fractions.Fraction instead of doubles. A polygon whose parts lie in several
                planes has no rational share in general: a float stands there. None where a polygon
                has no area.
            sides: "front": a column a polygon, its front's share. "all": the columns of
                Scene.sides, as the command's tables have them.
            numbers: what the vectors' numbers mean, "double" or "decimal"; else as the scene's.
                Vectors of few decimals, as suns() gives them, are faster and the same as the
                command's as "decimal".
            kernel, algorithm: as of the command. plane, rational and epeck are exact.
            jobs: threads, at most one a processor; 0: that many.

        Returns:
            (n_suns, n_polygons) float64 in 0..1; not a number where a polygon has no area. 0 where
            a side does not face the sun. Within a few units in the last place of the true share.

        Errors: geometry (a vector of length 0), number (one that is not finite), usage.
        Cost: what is prepared once for all suns takes about as long as one or two of them.
        """
        if sides not in ("front", "all"):
            raise Error(f"sides: {sides!r}; expected front or all", expected="front or all")
        directions = _arrays.points(vectors, "vectors")
        names = _names_of_run(kernel, algorithm, jobs)
        fronts = sides == "front"
        if not exact:
            return np.asarray(
                self._native.sunlit(directions, numbers or "", fronts, names))
        texts = self._native.sunlit_exact(directions, numbers or "", fronts, names)
        columns = len(self.polygons) if fronts else len(self.sides)
        return _arrays.objects(texts, (len(directions), columns))

    def shadows(self, lights: Iterable[str] | None = None, *, suns: npt.ArrayLike | None = None,
                points: npt.ArrayLike | None = None, areas: Sequence[npt.ArrayLike] = (),
                numbers: Numbers | None = None, fragments: bool = True, exact: bool = False,
                kernel: str = "plane", algorithm: str = "auto", jobs: int = 0) -> Shadows:
        """Classifies the scene: which part of which polygon is lit.

        Args:
            lights: ids of lights of the scene; else all of them, or none where others are given.
            suns: (n, 3) directions to suns: sun0, sun1, ...
            points: (n, 3) positions of lamps: point0, point1, ...
            areas: (k, 3) corners of each area light: area0, area1, ...
            numbers: what these numbers mean; else as the scene's.
            fragments: keep the fragments, not only shares.
            exact: keep exact fractions, and exact corners of fragments.
            kernel, algorithm, jobs: as of sunlit().

        Errors: usage (no light, no such light, a kernel that rounds with exact), geometry, number,
        limit.
        """
        asked = _asked_lights(lights, suns, points, areas, numbers)
        return Shadows(self._native.shadows(asked, fragments, exact,
                                            _names_of_run(kernel, algorithm, jobs)))

    def year(self, *, at: tuple[float, float] | None = None, tz: float | str | None = None,
             epw: str | os.PathLike[str] | None = None, elevation: float | None = None,
             north: float | None = None, year: int = 2025, from_: str = "", to: str = "",
             step: int = 60, sun_at: str = "middle", sun_model: str = "erfa",
             average_days: int = 1, refraction: bool = False, pressure: float | None = None,
             temperature: float | None = None, gross: bool = False, kernel: str = "plane",
             algorithm: str = "auto", jobs: int = 0) -> xarray.Dataset:
        """The lit shares of all sides under the suns of a year, as `gnomon year` computes them.

        Args are the command's options: docs/year.md says what they mean.
            at: latitude and longitude in degrees, north and east positive; with `tz`, hours from
                UTC of the standard clock. Else `epw`, or the place that the scene itself tells.
            from_, to: first and last day, "06-21" of `year` or "2026-06-21".
            step: minutes. sun_at: "start", "middle" or "end" of a step.

        Returns:
            xarray.Dataset with lit(time, side) float64 (0 at night and for a side that faces
            away), sun_azimuth, sun_altitude (time), degrees, sun_x, sun_y, sun_z (time): the
            direction, exactly. `time` is UTC, as in the .nc file. attrs: scene, geometry, kernel,
            sun_model, latitude, longitude, time_zone, and the command's checksum.

        Errors: usage, file, syntax; a message that names an option, as --tz, means the argument.
        Memory: 8 bytes times rows times sides.
        """
        import xarray

        asked = _native.AskedSuns()
        if at is not None and (isinstance(at, str) or len(at) != 2):
            raise Error(f"at: {at!r}; expected (latitude, longitude)", expected="(latitude, longitude)")
        asked.at = "" if at is None else f"{float(at[0])!r},{float(at[1])!r}"
        asked.tz = "" if tz is None else str(tz)
        asked.epw = "" if epw is None else _name_of(epw, "epw")
        asked.elevation, asked.north = elevation, north
        asked.year, asked.first, asked.last, asked.step = year, from_, to, step
        asked.sun_at, asked.sun_model, asked.average_days = sun_at, sun_model, average_days
        asked.refraction, asked.pressure, asked.temperature = refraction, pressure, temperature
        found = self._native.year(asked, gross, _names_of_run(kernel, algorithm, jobs))
        time = found["time"].astype("datetime64[s]").astype("datetime64[ns]")
        direction = found["direction"]
        degrees = {"units": "degree"}
        return xarray.Dataset(
            {
                "lit": (("time", "side"), found["lit"],
                        {"units": "1",
                         "long_name": "lit share of the side's area; 0 at night and where it "
                                      "faces away"}),
                "sun_azimuth": ("time", found["azimuth"],
                                degrees | {"long_name": "from north, clockwise"}),
                "sun_altitude": ("time", found["altitude"],
                                 degrees | {"long_name": "over the horizon"}),
                "sun_x": ("time", direction[:, 0]),
                "sun_y": ("time", direction[:, 1]),
                "sun_z": ("time", direction[:, 2]),
            },
            coords={"time": time, "side": found["side"]},
            attrs={"source": "gnomon year", "scene": self.name, "geometry": found["geometry"],
                   "kernel": found["kernel"], "sun_model": sun_model,
                   "latitude": found["latitude"], "longitude": found["longitude"],
                   "time_zone": found["zone_minutes"] / 60, "checksum": found["checksum"]},
        )

    def certify(self, candidate: Any, lights: Iterable[str] | None = None, *,
                suns: npt.ArrayLike | None = None, points: npt.ArrayLike | None = None,
                areas: Sequence[npt.ArrayLike] = (), numbers: Numbers | None = None,
                tolerance: float | None = None, width: float | None = None,
                clearance: float = 0, strict: bool = False, subset: bool = False,
                jobs: int = 0) -> Verdict:
        """Judges a result against the exact answer, by code that shares nothing with kernels.

        Args:
            candidate: what is judged:
                - (n_lights, n_polygons) lit shares, one row a light, in the order of `lights`,
                  `points`, `suns`, `areas`; a number that is none (NaN) tells nothing;
                - a result as a dictionary, or the path of a result file (docs/formats.md);
                - a Shadows with fragments.
            lights, suns, points, areas, numbers: the lights, as of shadows(); of a Shadows its own.
            tolerance: wrong share of a polygon that is tolerated (1e-9); of shares that are told
                alone, half a unit of the last digit written, or 1e-9 of doubles.
            width: of a region of error that is tolerated, scene units (1e-9 of the diagonal).
            clearance: errors that moving one vertex by this much would undo are set apart.
            strict: tolerance and width 0.
            subset: lights and polygons may be missing.

        Errors: usage, file, syntax, format, number; and Error of an array of the wrong shape.
        """
        limits = _native.Limits()
        limits.tolerance, limits.width, limits.clearance = tolerance, width, clearance
        limits.strict, limits.subset, limits.jobs = strict, subset, _checked_jobs(jobs)
        if isinstance(candidate, Shadows):
            if not candidate._native.has_fragments:
                raise Error("shadows without fragments cannot be judged; expected "
                            "shadows(..., fragments=True)",
                            expected="shadows(..., fragments=True)")
            return Verdict(*candidate._native.certify(limits))
        asked = _asked_lights(lights, suns, points, areas, numbers)
        name = "candidate"
        if isinstance(candidate, (str, os.PathLike)):
            name = os.fspath(candidate)
            try:
                with open(name, encoding="utf-8") as file:
                    text = file.read()
            except OSError as error:
                raise Error(f"{name}: {error.strerror}", code="file", file=name) from error
            except UnicodeDecodeError as error:
                raise Error(f"{name}: byte {error.start} is not valid UTF-8; expected a file in UTF-8",
                            code="syntax", file=name, expected="a file in UTF-8") from error
        elif isinstance(candidate, dict):
            import json

            text = json.dumps(candidate)
        else:
            text, some_left_out = self._told_shares(candidate, self._names_of(asked))
            limits.subset = subset or some_left_out
        return Verdict(*self._native.certify(asked, text, name, limits))

    def _names_of(self, asked: _native.AskedLights) -> list[str]:
        """The lights of a call, in the order in which they are asked for."""
        brings = asked.suns is not None or asked.points is not None or len(asked.areas) > 0
        names = list(asked.ids) if asked.ids is not None else [] if brings else self.lights
        for kind, some in (("point", asked.points), ("sun", asked.suns), ("area", asked.areas)):
            names += [f"{kind}{i}" for i in range(0 if some is None else len(some))]
        return names

    def _told_shares(self, candidate: npt.ArrayLike, lights: list[str]) -> tuple[str, bool]:
        """A result that tells lit shares alone, and whether it leaves some out."""
        import json

        shares = np.asarray(candidate, dtype=np.float64)
        polygons = self.polygons
        if shares.ndim == 1 and len(lights) == 1:
            shares = shares.reshape(1, -1)
        if shares.shape != (len(lights), len(polygons)):
            expected = f"({len(lights)}, {len(polygons)}), lights by polygons"
            raise Error(f"candidate: an array of shape {shares.shape}; expected {expected}",
                        expected=expected)
        two_sided = any(side.endswith("#back") for side in self.sides)
        told = [
            {"id": light,
             "polygons": [{"id": polygon, "lit": share} | ({"side": "front"} if two_sided else {})
                          for polygon, share in zip(polygons, row) if share == share]}
            for light, row in zip(lights, shares.tolist())
        ]
        return json.dumps({"lights": told}), bool(np.isnan(shares).any()) or two_sided

    def __repr__(self) -> str:
        return f"<gnomon.Scene {self.name!r}: {len(self.polygons)} polygons>"


def read(path: str | os.PathLike[str], *, numbers: Numbers | None = None, two_sided: bool = False,
         skip_bad: bool = False, lod: str = "", keep_axes: bool = False) -> Scene:
    """Reads a scene from a file of any format that the command reads (docs/formats.md).

    Args:
        numbers: what the file's numbers mean, "double" or "decimal"; else what the file says.
        two_sided: both sides of all polygons receive and cast.
        skip_bad: leave out polygons that cannot be used, and list them in Scene.left_out.
        lod: of CityJSON, this level of detail.
        keep_axes: of IDF and epJSON, leave the building in its own axes, as `gnomon year` does:
            year() then turns the sun, and geometry stays exact. Else the building is turned.

    Warns (SceneWarning) in the command's words. Errors: file, syntax, format, number, index, id,
    geometry, limit, each with the place in the file.
    """
    return Scene(_native.read(_name_of(path, "path"), numbers or "", two_sided, skip_bad, lod, keep_axes))


def suns(latitude: float, longitude: float, times: Any, *, elevation: float = 0, north: float = 0,
         model: str = "erfa", refraction: bool = False) -> npt.NDArray[np.float64]:
    """Directions to the sun at a place, for Scene.sunlit().

    Args:
        latitude, longitude: degrees, north and east positive.
        times: n times: a pandas.DatetimeIndex, datetimes, numpy.datetime64. Without a zone they
            are UTC. Whole seconds count.
        elevation: metres above the sea.
        north: degrees from north, clockwise, to where the scene's y axis points.
        model: "erfa", the IAU's, or "energyplus". EnergyPlus' takes the clock as UTC's.
        refraction: the sun as air lifts it.

    Returns:
        (n, 3) float64: x east, y north, z up (turned by `north`), of length 1 but for rounding to
        six decimals, which is within 0.00005 degrees and what `gnomon year` does. At night z is
        negative or 0: below the horizon nothing shades the sun but the Earth, which no scene has.

    Errors: usage (no such place or model, a year before 1961 or after 2500).
    """
    found = _native.suns_at(float(latitude), float(longitude), _arrays.seconds(times),
                            float(elevation), float(north), model, refraction)
    return np.asarray(found["direction"])
