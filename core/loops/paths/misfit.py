"""The misfit of a loop: signed distances of its points to the path, over the noise, with their exact derivatives."""

from collections.abc import Sequence
from copy import copy
from typing import Any, Final, NamedTuple

import numpy as np
from scipy.optimize import least_squares

from gradhesion.core.loops.paths.distance import Feet, feet
from gradhesion.core.loops.paths.motion import moving
from gradhesion.core.loops.paths.path import LoopModel, LoopPath
from gradhesion.core.types import Floats, Truths

_All: Final = slice(None)

_STEP: Final = 1e-5
"""Step of differences of paths, in parts of a range."""
_FINER: Final = 3
"""How much finer the last grid is: minima are then accurate to 0.05 standard deviations, 0.5 before."""
LOST: Final = 1e3
"""Distance, in standard deviations, of every point where a scene has no path."""


class Data(NamedTuple):
    """The points of a loop.

    Rows of depth in m (of the machine's displacement, if that is measured) and load in N, of shape (n, 2); whether each
    belongs to unloading; the standard deviations of depth and load of one raw point; and of how many of these each is
    the mean.
    """

    points: Floats
    back: Truths
    noise: tuple[float, float]
    counts: Floats


class _Nearest(NamedTuple):
    """Where points are nearest to a path: for each branch its points, its vertices and the feet; kept by its vector."""

    vector: bytes
    use: slice
    branches: list[tuple[Truths, slice, Feet]]
    drawn: LoopPath | None


class Misfit:
    """The points of a loop in units of their noise.

    Parameters
    ----------
    data
        The points.
    model
        The model that draws the path.
    low, high
        Ends of the range of each number, as it is searched.
    """

    def __init__(self, data: Data, model: LoopModel, low: Floats, high: Floats) -> None:
        self.data, self.scale = data, np.array(data.noise)
        self.points, self.back, self.weights = data.points / self.scale, data.back, np.sqrt(data.counts)
        self.model, self.names, self.low, self.high = model, model.names, low, high
        self._kept: _Nearest | None = None

    def finer(self) -> "Misfit":
        """Return the same misfit on a grid that is `_FINER` times as fine."""
        model = copy(self.model)
        model.fineness *= _FINER
        return Misfit(self.data, model, self.low, self.high)

    def named(self, vector: Floats) -> dict[str, float]:
        """Give the numbers their names and units."""
        return {name: float(value) for name, value in self.model.values(vector).items()}

    def path(self, vector: Floats) -> LoopPath | None:
        """Draw the path."""
        return self.model.path(vector)

    def residual(self, vector: Floats, use: slice = _All) -> Floats:
        """Return the signed distances of points to the path, in standard deviations."""
        found = np.full(self.back[use].size, LOST)
        for own, _, nearest in self._nearest(vector, use).branches:
            found[own] = nearest.distance
        return found * self.weights[use]

    def jacobian(self, vector: Floats, use: slice = _All) -> Floats:
        """Return the derivatives of the distances."""
        if self.model.by_differences:
            return self._differences(vector, use)
        found, kept = np.zeros((self.back[use].size, len(self.names))), self._nearest(vector, use)
        if kept.drawn is not None:
            moved = moving(self.model, vector, kept.drawn) / self.scale[:, None]
            for own, piece, nearest in kept.branches:
                found[own] = nearest.slopes(moved[piece])
        return found * self.weights[use, None]

    def _differences(self, vector: Floats, use: slice) -> Floats:
        """Return the derivatives of the distances by central differences."""
        steps = _STEP * (self.high - self.low)
        return np.column_stack([
            (self.residual(vector + step, use) - self.residual(vector - step, use)) / (2.0 * step[i])
            for i, step in enumerate(np.diag(steps))
        ])  # fmt: skip

    def feet(self, vector: Floats) -> list[tuple[Truths, slice, Feet]]:
        """Return, for each branch, its points, its vertices, and where these points are nearest to it."""
        return self._nearest(vector, _All).branches

    def _nearest(self, vector: Floats, use: slice) -> _Nearest:
        """Find where points are nearest to the path; the last result is kept, for the derivatives."""
        key = vector.tobytes()
        if self._kept is None or self._kept[:2] != (key, use):
            self._kept = _Nearest(key, use, [], self.path(vector))
            if (drawn := self._kept.drawn) is not None:
                points, back, chain = self.points[use], self.back[use], drawn.places / self.scale
                for own, piece in ((~back, slice(0, drawn.turn + 1)), (back, slice(drawn.turn, None))):
                    if own.any():
                        near = feet(points[own], chain[piece], drawn.curved[piece])
                        self._kept.branches.append((own, piece, near))
        return self._kept

    def refined(
        self,
        start: Floats,
        use: slice = _All,
        *,
        loss: str = "linear",
        most: int = 60,
        held: Sequence[int] = (),
        tolerance: float = 1e-8,
    ) -> Any:
        """Refine a start within the ranges, the numbers `held` fixed.

        Returns
        -------
        The result of `scipy.optimize.least_squares`, `x` with all numbers.
        """
        searched = np.setdiff1d(np.arange(start.size), held)
        low, high = self.low[searched], self.high[searched]
        width = high - low

        def whole(part: Floats) -> Floats:
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
            xtol=tolerance,
            ftol=tolerance,
            gtol=1e-10,
            max_nfev=most,
        )
        done.x = whole(done.x)
        return done

    def size(self, vector: Floats, use: slice = _All) -> float:
        """Return a measure of the misfit that outliers hardly move."""
        return float(np.sum(np.log1p(self.residual(vector, use) ** 2)))
