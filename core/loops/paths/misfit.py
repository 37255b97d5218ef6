"""The misfit of a loop: signed distances of its points to the path, over the noise, with their exact derivatives."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Final, NamedTuple

import numpy as np
from scipy.optimize import least_squares

from gradhesion.core.loops.paths.distance import Feet, feet
from gradhesion.core.loops.paths.model import TURN
from gradhesion.core.loops.paths.motion import moving
from gradhesion.core.loops.paths.path import LoopModel, LoopPath
from gradhesion.core.types import Floats, Truths

_STEP: Final = 1e-5  # step of differences of paths, in parts of a range
_CLEAR: Final = 4.0  # standard deviations of chi square within which a misfit is noise
LOST: Final = 1e3
"""Distance, in standard deviations, of every point where a scene has no path."""


class Nearest(NamedTuple):
    """Where points are nearest to a path: for each branch its points, its vertices and the feet; kept by its vector."""

    vector: bytes
    branches: list[tuple[Truths, slice, Feet]]
    drawn: LoopPath | None


@dataclass(eq=False)
class Misfit:
    """The points of a loop in units of their noise, the model of its path, and the ends of the range of each number."""

    data: Floats
    """Rows of depth in m (of the machine's displacement, if that is measured) and load in N, of shape (n, 2)."""
    back: Truths
    """Whether each belongs to unloading."""
    noise: tuple[float, float]
    """The standard deviations of depth and load of one raw point."""
    counts: Floats
    """Of how many of these each is the mean."""
    model: LoopModel
    low: Floats
    high: Floats

    def __post_init__(self) -> None:
        self.scale, self.names, self.weights = np.array(self.noise), self.model.names, np.sqrt(self.counts)
        self.points = self.data / self.scale
        self.turn = [place for place, name in enumerate(self.names) if name == TURN]
        """The place of the turn, which is likely near the middle of its range: one more residual says so."""
        self._kept = Nearest(b"", [], None)

    def thinned(self, count: int) -> "Misfit":
        """Return the misfit of about this many of the points, evenly."""
        some = slice(None, None, max(1, len(self.data) // count))
        return replace(self, data=self.data[some], back=self.back[some], counts=self.counts[some])

    def without(self, names: Sequence[str], **more: float) -> "Misfit":
        """Return the misfit of the loop less some numbers, with others fixed."""
        model = self.model.without(names, **more)
        use = [self.names.index(name) for name in model.names]
        return replace(self, model=model, low=self.low[use], high=self.high[use])

    def named(self, vector: Floats) -> dict[str, float]:
        """Give the numbers their names and units."""
        return {name: float(value) for name, value in self.model.values(vector).items()}

    def nearest(self, vector: Floats) -> Nearest:
        """Find where points are nearest to the path; the last result is kept, for the derivatives."""
        if self._kept.vector != vector.tobytes():
            self._kept = Nearest(vector.tobytes(), [], self.model.path(vector))
            if (drawn := self._kept.drawn) is not None:
                chain, tangents = drawn.places / self.scale, drawn.tangents / self.scale
                up, down = slice(0, drawn.turn + 1), slice(drawn.turn, len(chain))
                for own, piece in ((~self.back, up), (self.back, down)):
                    near = feet(self.points[own], chain[piece], tangents[piece], drawn.curved[piece])
                    self._kept.branches.append((own, piece, near))
        return self._kept

    def residual(self, vector: Floats) -> Floats:
        """Return the signed distances of points to the path, in standard deviations; behind them that of the turn."""
        found = np.full(self.weights.size, LOST)
        for own, _, near in self.nearest(vector).branches:
            found[own] = near.distance
        turn = (2.0 * vector - self.low - self.high)[self.turn] / (self.high - self.low)[self.turn]
        return np.append(found * self.weights, turn)

    def jacobian(self, vector: Floats) -> Floats:
        """Return the derivatives of the residual, of shape (points, numbers)."""
        if self.model.by_differences:  # central ones, of one side at the end of a range
            steps = np.diag(_STEP * (self.high - self.low))
            ends = [(np.minimum(vector + step, self.high), np.maximum(vector - step, self.low)) for step in steps]
            changes = [(self.residual(above) - self.residual(below)) / np.sum(above - below) for above, below in ends]
            return np.column_stack(changes)
        found, (_, branches, drawn) = np.zeros((self.weights.size, vector.size)), self.nearest(vector)
        if drawn is not None:
            begun = np.concatenate([piece.start + near.piece for _, piece, near in branches])
            used = np.unique([begun, begun + 1])
            moved = moving(self.model, vector, drawn, self.low, self.high, used) / self.scale[:, None]
            for own, piece, near in branches:
                found[own] = near.slopes(moved[piece], drawn.tangents[piece] / self.scale)
        turn = (2.0 * np.eye(vector.size) / (self.high - self.low))[self.turn]
        return np.concatenate([found * self.weights[:, None], turn])

    def size(self, vector: Floats) -> float:
        """Return a measure of the misfit that outliers hardly move."""
        return float(np.sum(np.log1p(self.residual(vector) ** 2)))

    def is_noise(self, cost: float) -> bool:
        """Say whether half a sum of squares is no more than noise leaves."""
        count = self.weights.size
        return 2.0 * cost <= count + _CLEAR * math.sqrt(2.0 * count)

    def refined(self, start: Floats, *, most: int = 60, held: Sequence[int] = (), tolerance: float = 1e-8) -> Any:
        """Refine a start within the ranges, the numbers `held` fixed; as of `least_squares`, `x` with all numbers."""
        searched = np.setdiff1d(np.arange(start.size), held)
        low, high = self.low[searched], self.high[searched]

        def whole(part: Floats) -> Floats:
            vector = start.copy()
            vector[searched] = part
            return vector

        margin = 1e-6 * (high - low)
        done = least_squares(
            lambda part: self.residual(whole(part)), np.clip(start[searched], low + margin, high - margin),
            jac=lambda part: self.jacobian(whole(part))[:, searched], bounds=(low, high), x_scale="jac",
            xtol=tolerance, ftol=tolerance, gtol=1e-10, max_nfev=most,
        )  # fmt: skip
        done.x = whole(done.x)
        return done
