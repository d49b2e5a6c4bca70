# SPDX-License-Identifier: GPL-3.0-or-later
"""A classified scene: shares by light and side, fragments as arrays."""
from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _arrays
from ._errors import Error

if TYPE_CHECKING:
    from fractions import Fraction

    import numpy.typing as npt

    from . import _native

#: The classes of fragments; `Fragments.state` counts them from 0.
STATES = ("lit", "shadow", "penumbra", "umbra")


@dataclass(frozen=True)
class Fragments:
    """Convex loops that tile every side that a light reaches, m of them with n corners in all.

    Attributes:
        points: (n, 3) float64, scene units: the doubles nearest to the corners.
        offsets: (m + 1,) int64: fragment i has the corners points[offsets[i]:offsets[i + 1]],
            counter-clockwise seen from its side.
        light: (m,) int32, into Shadows.lights.
        polygon: (m,) int32, into Scene.polygons.
        back: (m,) uint8: 1 for the back of the polygon.
        state: (m,) uint8, into STATES.
        caster: (m,) int32: the polygon that hides the light, or -1 where it is lit or no single
            polygon does.
        exact_points: n triples of fractions.Fraction with the corners themselves, if they were
            asked for.
    """

    points: npt.NDArray[np.float64]
    offsets: npt.NDArray[np.int64]
    light: npt.NDArray[np.int32]
    polygon: npt.NDArray[np.int32]
    back: npt.NDArray[np.uint8]
    state: npt.NDArray[np.uint8]
    caster: npt.NDArray[np.int32]
    exact_points: list[tuple[Fraction, Fraction, Fraction]] | None = None

    def __len__(self) -> int:
        return len(self.state)

    def loop(self, index: int) -> npt.NDArray[np.float64]:
        """The corners of one fragment, (k, 3), a view into `points`."""
        if not -len(self) <= index < len(self):
            raise IndexError(f"fragment {index} of {len(self)}")
        index %= len(self)
        return self.points[self.offsets[index]:self.offsets[index + 1]]


class Shadows:
    """What Scene.shadows() found."""

    def __init__(self, native: _native.Shadows) -> None:
        self._native = native

    @property
    def lights(self) -> list[str]:
        """Ids of the lights, in order."""
        return list(self._native.lights)

    @property
    def sides(self) -> list[str]:
        """Names of the columns of shares: the polygon's id, and "ID#back" for a second side."""
        return list(self._native.sides)

    @property
    def kernel(self) -> str:
        return str(self._native.kernel)

    @property
    def algorithm(self) -> str:
        return str(self._native.algorithm)

    def shares(self, state: str = "lit") -> npt.NDArray[np.float64]:
        """Shares of one class, (n_lights, n_sides): "lit", "shadow", "penumbra" or "umbra".

        A side that does not face the light is in shadow (umbra) as a whole. Of exact kernels each
        number is within a few units in the last place of the true share.
        """
        return np.asarray(self._native.shares(state))

    def exact_shares(self, state: str = "lit") -> npt.NDArray[np.object_]:
        """The same as fractions.Fraction, (n_lights, n_sides) objects.

        A polygon whose parts lie in several planes has areas that are square roots; its share is no
        rational number in general, and stands there as a float. Errors: usage, without exact=True.
        """
        if not self._native.is_exact:
            raise Error("no exact fractions were kept; expected shadows(..., exact=True)",
                        expected="shadows(..., exact=True)")
        return _arrays.objects(self._native.exact_shares(state),
                               (len(self.lights), len(self.sides)))

    @property
    def fragments(self) -> Fragments:
        """All fragments as arrays. Errors: usage, without fragments=True."""
        if not self._native.has_fragments:
            raise Error("no fragments were kept; expected shadows(..., fragments=True)",
                        expected="shadows(..., fragments=True)")
        exact = None
        if self._native.is_exact:
            from fractions import Fraction

            numbers = [Fraction(text) for text in self._native.exact_points()]
            exact = list(zip(numbers[0::3], numbers[1::3], numbers[2::3]))
        return Fragments(exact_points=exact, **self._native.fragments())

    def to_json(self, path: str | os.PathLike[str] | None = None) -> str:
        """The result file that `gnomon shadows` writes; also into `path`, if there is one."""
        text = str(self._native.json())
        if path is not None:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        return text

    def to_dict(self) -> dict[str, Any]:
        """The same as a dictionary."""
        import json

        result: dict[str, Any] = json.loads(self.to_json())
        return result

    def __repr__(self) -> str:
        return (f"<gnomon.Shadows of {len(self.lights)} lights on {len(self.sides)} sides, "
                f"{self.kernel}, {self.algorithm}>")
