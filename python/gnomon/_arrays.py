# SPDX-License-Identifier: GPL-3.0-or-later
"""What callers have, as the arrays that the native module looks at. Nothing is copied that is
contiguous and of the right type already."""
from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ._errors import Error

# What types alone need, and what few calls do, is not imported with the module: it starts sooner.
if TYPE_CHECKING:
    from fractions import Fraction
    from typing import TypeAlias

    import numpy.typing as npt

    Doubles: TypeAlias = npt.NDArray[np.float64]
    Integers: TypeAlias = npt.NDArray[np.int64]


def points(values: npt.ArrayLike, name: str) -> Doubles:
    """(n, 3) doubles. A single point or vector is an array of one."""
    array = np.ascontiguousarray(values, dtype=np.float64)
    if array.shape == (3,):
        array = array.reshape(1, 3)
    if array.ndim == 1 and array.size == 0:
        array = array.reshape(0, 3)
    if array.ndim != 2 or array.shape[1] != 3:
        raise Error(f"{name}: an array of shape {array.shape}; expected (n, 3)", expected="(n, 3)")
    return array


def loops(faces: Any) -> tuple[Integers, Integers]:
    """The corners of all polygons one after the other, and where each polygon begins."""
    if isinstance(faces, np.ndarray) and faces.dtype != object:
        if faces.ndim != 2 or not np.issubdtype(faces.dtype, np.integer):
            raise Error(f"faces: an array of shape {faces.shape} and type {faces.dtype}; expected "
                        "(m, k) integers, or a sequence of sequences", expected="(m, k) integers")
        flat = np.ascontiguousarray(faces, dtype=np.int64).reshape(-1)
        count, corners = faces.shape
        return flat, np.arange(count + 1, dtype=np.int64) * corners
    parts = [np.asarray(face) for face in faces]
    for i, part in enumerate(parts):
        if part.ndim != 1 or (part.size and not np.issubdtype(part.dtype, np.integer)):
            raise Error(f"faces: polygon {i} is no sequence of integers",
                        pointer=f"/polygons/{i}/loop", expected="a sequence of integers")
    offsets = np.zeros(len(parts) + 1, dtype=np.int64)
    np.cumsum([part.size for part in parts], out=offsets[1:])
    flat = np.concatenate(parts).astype(np.int64) if parts else np.zeros(0, dtype=np.int64)
    return np.ascontiguousarray(flat), offsets


def names(values: Iterable[Any] | None, count: int, what: str) -> list[str]:
    """One text for each of `count` things; none where there are none."""
    if values is None:
        return []
    texts = [str(value) for value in values]
    if len(texts) != count:
        raise Error(f"{what}: {len(texts)} for {count} polygons; expected one each",
                    expected="one each")
    return texts


def seconds(times: Any) -> Integers:
    """Whole seconds since 1970 in UTC, of anything that pandas or NumPy takes as times.

    Times without a zone are taken as UTC; those with one are turned into it.
    """
    if hasattr(times, "tz_convert") and getattr(times, "tz", None) is not None:
        times = times.tz_convert("UTC").tz_localize(None)
    elif hasattr(times, "dt") and getattr(times.dt, "tz", None) is not None:
        times = times.dt.tz_convert("UTC").dt.tz_localize(None)
    else:
        listed = times if isinstance(times, (list, tuple)) else None
        if listed is not None and any(getattr(t, "tzinfo", None) is not None for t in listed):
            import datetime

            times = [t.astimezone(datetime.timezone.utc).replace(tzinfo=None)
                     if t.tzinfo is not None else t for t in listed]
        elif getattr(times, "tzinfo", None) is not None:
            import datetime

            times = times.astimezone(datetime.timezone.utc).replace(tzinfo=None)
    array = np.atleast_1d(np.asarray(times, dtype="datetime64[s]"))
    if np.isnat(array).any():
        raise Error("times: one of them is no time", code="number")
    return np.ascontiguousarray(array.astype(np.int64).reshape(-1))


def fraction_or_float(text: str) -> Fraction | float | None:
    """What a text of the native module means: "p/q", a double where no rational number is it, or
    nothing."""
    if not text:
        return None
    if "/" in text or text.lstrip("-").isdigit():
        from fractions import Fraction

        return Fraction(text)
    return float(text)


def objects(texts: Sequence[str], shape: tuple[int, int]) -> npt.NDArray[np.object_]:
    array = np.empty(len(texts), dtype=object)
    for i, text in enumerate(texts):
        array[i] = fraction_or_float(text)
    return array.reshape(shape)
