"""The misfit of a loop: signed distances of its points to the path, over the noise, with their exact derivatives."""

import math
from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from gradhesion.core.answers.loop_distance import Feet, feet
from gradhesion.core.answers.loop_path import LINEAR, LoopModel, LoopPath
from gradhesion.core.answers.loop_points import OFFSETS
from gradhesion.core.problem.profile import Profile

_Array = NDArray[np.float64]
_All: Final = slice(None)

CHORD: Final = 3e-5
"""Standard deviation of the chords by which a path is drawn, in parts of the spans: it adds to the noise."""
LOST: Final = 1e3
"""Distance, in standard deviations, of points of a scene that has no path."""
_WIDEST: Final = 0.1
"""Of the offsets, in parts of the spans: further off zero is not taken to be."""


class Misfit:
    """The points of a loop in units of their noise.

    Parameters
    ----------
    points
        Rows of depth in m (of the machine's displacement if `through_machine`) and load in N.
    back
        Whether each belongs to unloading.
    fixed, free, noise, profile, through_machine, offsets
        As `fit_loop` takes them.
    """

    def __init__(
        self,
        points: _Array,
        back: NDArray[np.bool_],
        fixed: Mapping[str, float],
        free: Mapping[str, tuple[float, float]],
        noise: tuple[float, float],
        profile: Profile,
        *,
        offsets: bool,
        through_machine: bool,
    ) -> None:
        self.span = np.ptp(points, axis=0)
        self.scale = np.hypot(noise, CHORD * self.span)
        self.points, self.back = points / self.scale, back
        self.names = (*free, *(OFFSETS if offsets else ()))
        self.physical = len(free)
        ends = [free[name] if name in LINEAR else tuple(np.log(free[name])) for name in free]
        ends += [(-_WIDEST * size, _WIDEST * size) for size in self.span] if offsets else []
        self.low, self.high = np.array(ends, dtype=float).T
        self.model = LoopModel(
            fixed,
            self.names,
            deepest=float(points[:, 0].max()),
            first=float(points[:, 0].min() - self.span[0]),
            profile=profile,
            through_machine=through_machine,
        )
        self._kept: tuple[bytes, Any, list[tuple[NDArray[np.bool_], slice, Feet]], LoopPath | None] | None = None

    def named(self, vector: _Array) -> dict[str, float]:
        """Give the numbers their names and units."""
        return {name: float(value) for name, value in self.model.values(vector).items()}

    def sizes(self, vector: _Array) -> _Array:
        """Return the size of a change of each number: of offsets the spans, of the others 1."""
        sizes = np.ones(vector.size)
        sizes[self.physical :] = self.span[: vector.size - self.physical]
        return sizes

    def path(self, vector: _Array) -> LoopPath | None:
        """Draw the path."""
        return self.model.path(vector)

    def residual(self, vector: _Array, use: slice = _All) -> _Array:
        """Return the signed distances of points to the path, in standard deviations."""
        _, _, parts, drawn = self._at(vector, use)
        found = np.full(self.back[use].size, LOST)
        if drawn is not None:
            for own, _, nearest in parts:
                found[own] = nearest.distance
        return found

    def jacobian(self, vector: _Array, use: slice = _All) -> _Array:
        """Return the derivatives of the distances."""
        _, _, parts, drawn = self._at(vector, use)
        found = np.zeros((self.back[use].size, len(self.names)))
        if drawn is not None:
            moving = self.model.moving(vector, drawn) / self.scale[:, None]
            for own, piece, nearest in parts:
                found[own] = nearest.slopes(moving[piece], drawn.jump[piece])
        return found

    def _at(self, vector: _Array, use: slice) -> Any:
        """Find where points are nearest to the path; the last answer is kept, for the derivatives."""
        key = vector.tobytes()
        if self._kept is None or self._kept[:2] != (key, use):
            drawn = self.path(vector)
            parts = []
            if drawn is not None:
                points, back = self.points[use], self.back[use]
                chain = drawn.places / self.scale
                for own, piece in ((~back, slice(0, drawn.turn + 1)), (back, slice(drawn.turn, None))):
                    parts.append((own, piece, feet(points[own], chain[piece])))
            self._kept = key, use, parts, drawn
        return self._kept

    def refined(
        self, start: _Array, use: slice = _All, *, loss: str = "linear", most: int = 60, held: int | None = None
    ) -> Any:
        """Refine a start within the ranges, the number `held` kept as it is.

        Returns
        -------
        What `scipy.optimize.least_squares` does, `x` with all numbers.
        """
        searched = np.array([i for i in range(start.size) if i != held])
        low, high = self.low[searched], self.high[searched]
        width = high - low

        def whole(part: _Array) -> _Array:
            vector = start.copy()
            vector[searched] = part
            return vector

        done = least_squares(
            lambda part: self.residual(whole(part), use),
            np.clip(start[searched], low + 1e-6 * width, high - 1e-6 * width),
            jac=lambda part: self.jacobian(whole(part), use)[:, searched],
            bounds=(low, high),
            x_scale="jac",
            loss=loss,
            xtol=1e-8,
            ftol=1e-8,
            gtol=1e-10,
            max_nfev=most,
        )
        done.x = whole(done.x)
        return done

    def at_end(self, vector: _Array) -> NDArray[np.bool_]:
        """Say which numbers are at an end of their range."""
        width = self.high - self.low
        return np.asarray((vector - self.low < 1e-4 * width) | (self.high - vector < 1e-4 * width))

    def size(self, vector: _Array, use: slice) -> float:
        """Return a measure of the misfit that outliers hardly move."""
        return float(np.sum(np.log1p(self.residual(vector, use) ** 2)))

    @property
    def nothing(self) -> float:
        """That measure of a point of a scene without a path."""
        return math.log1p(LOST**2)
