"""The misfit of a loop: signed distances of its points to the path, over the noise, with their exact derivatives.

A distance to a curve changes only as the curve moves normal to itself, not as its vertices move along it. So vertices
are moved at fixed contact radius, those at the rim with it, where depth and load are closed forms (model.py), and no
derivative of a fold is needed: it is a stationary point. Corners are moved along their branches as well: a landing
stays at the coordinate of its jump, and the turn, with the radius at which the edge is pinned, at that of the data.
Closed forms are differentiated by differences within the ranges, good to 1e-9 but at their ends.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Final, NamedTuple

import numpy as np
from scipy.optimize import least_squares

from gradhesion.core.loops.fitted import DEPTH_ZERO, LOAD_ZERO, OFFSETS, TILT
from gradhesion.core.loops.paths.distance import Feet, feet
from gradhesion.core.loops.paths.model import TURN, LoopModel, Scenes
from gradhesion.core.loops.paths.path import LoopPath, draw_loop
from gradhesion.core.types import Floats, Integers, Truths

_STEP: Final = 1e-5
"""Step of differences, of logarithms, ratios or parts of a range: their error is of its square, or 1e-16 over it."""
_CLEAR: Final = 4.0  # standard deviations of chi square within which a misfit is noise
LOST: Final = 1e3
"""Distance, in standard deviations, of every point where a scene has no path."""


class Nearest(NamedTuple):
    """Where the points are nearest to the path of a vector; None where that has none."""

    vector: bytes
    feet: Feet | None = None
    drawn: LoopPath | None = None


@dataclass(eq=False)
class Misfit:
    """The points of a loop in units of their noise, the model of its path, and the ends of the range of each number."""

    data: Floats  # rows of depth in m (displacement of the machine, if that is measured) and load in N, (n, 2)
    back: Truths  # whether each belongs to unloading
    noise: tuple[float, float]  # standard deviations of depth and load of one raw point
    counts: Floats  # of how many of these each is the mean
    model: LoopModel
    low: Floats
    high: Floats

    def __post_init__(self) -> None:
        self.scale, self.names, self.weights = np.array(self.noise), self.model.names, np.sqrt(self.counts)
        self.points = self.data / self.scale
        self.turn = [place for place, name in enumerate(self.names) if name == TURN]
        """The place of the turn, which is likely near the middle of its range: one more residual says so."""
        self._kept = Nearest(b"")

    def thinned(self, count: int) -> "Misfit":
        """Return the misfit of about this many of the points, evenly."""
        some = slice(None, None, max(1, len(self.data) // count))
        return replace(self, data=self.data[some], back=self.back[some], counts=self.counts[some])

    def without(self, names: Sequence[str], **more: float) -> "Misfit":
        """Return the misfit of the loop less some numbers, with others fixed and an edge at rest."""
        use = [place for place, name in enumerate(self.names) if name not in names]
        fixed = {name: value for name, value in self.model.fixed.items() if name not in names} | more
        model = replace(self.model, fixed=fixed, names=tuple(self.names[place] for place in use), rate=None)
        return replace(self, model=model, low=self.low[use], high=self.high[use])

    def named(self, vector: Floats) -> dict[str, float]:
        """Give the numbers their names and units, but for where the cycle turns: the data say so."""
        return {name: float(value) for name, value in self.model.values(vector).items() if name != TURN}

    def nearest(self, vector: Floats) -> Nearest:
        """Find where points are nearest to the path; the last result is kept, for the derivatives."""
        if self._kept.vector != vector.tobytes():
            near, drawn = None, draw_loop(self.model, vector)
            if drawn is not None:
                branches = np.array([[0, drawn.turn - 1], [drawn.turn, len(drawn.radius) - 2]])  # the pieces of each
                chain, tangents = drawn.places / self.scale, drawn.tangents / self.scale
                near = feet(self.points, chain, tangents, drawn.curved, branches[self.back.astype(int)])
            self._kept = Nearest(vector.tobytes(), near, drawn)
        return self._kept

    def residual(self, vector: Floats) -> Floats:
        """Return the signed distances of points to the path, in standard deviations; behind them that of the turn."""
        near = self.nearest(vector).feet
        turn = (2.0 * vector - self.low - self.high)[self.turn] / (self.high - self.low)[self.turn]
        return np.append(self.weights * (LOST if near is None else near.distance), turn)

    def jacobian(self, vector: Floats) -> Floats:
        """Return the derivatives of the residual, of shape (points, numbers)."""
        if self.model.rate is not None:  # of paths, which are integrated
            ends = zip(*self._ends(vector, _STEP * (self.high - self.low)), strict=True)
            return np.column_stack([(self.residual(up) - self.residual(down)) / width for up, down, width in ends])
        found, (_, near, drawn) = np.zeros((self.weights.size, vector.size)), self.nearest(vector)
        if near is not None and drawn is not None:
            moved = self._motion(vector, drawn, near.piece) / self.scale[:, None]
            found = near.slopes(moved, drawn.tangents / self.scale)
        turn = (2.0 * np.eye(vector.size) / (self.high - self.low))[self.turn]
        return np.concatenate([found * self.weights[:, None], turn])

    def _ends(self, vector: Floats, steps: Floats) -> tuple[Floats, Floats, Floats]:
        """Return rows in which one number each is a step higher, or lower, within its range; and how far that is."""
        above, below = np.minimum(vector + np.diag(steps), self.high), np.maximum(vector - np.diag(steps), self.low)
        return above, below, np.sum(above - below, axis=1)

    def _motion(self, vector: Floats, drawn: LoopPath, begun: Integers) -> Floats:
        """Return how the ends of pieces that begin at some vertices move with each number, (vertices, 2, numbers).

        Others have no meaning. Out of contact they move with the offsets alone.
        """
        names, tilt = self.names, self.model.shift(vector)[2]
        moved = np.zeros((drawn.radius.size, 2, len(names)))
        wanted = np.unique(np.append([begun, begun + 1], [drawn.turn, drawn.turn + 1]))
        wanted = np.union1d(wanted, wanted[drawn.jump[wanted]] - 1)  # a landing moves with the end of its jump
        if (within := wanted[drawn.radius[wanted] > 0.0]).size:
            self._slide(drawn, within, moved, self._at_fixed_radius(vector, drawn, within, moved), tilt)
        for axis, name in enumerate((DEPTH_ZERO, LOAD_ZERO)):
            if name in names:
                moved[:, axis, names.index(name)] += 1.0
        moved[:, 1] += tilt * moved[:, 0]
        if TILT in names:
            moved[:, 1, names.index(TILT)] += drawn.places[:, 0]
        return moved

    def _at_fixed_radius(self, vector: Floats, drawn: LoopPath, within: Integers, moved: Floats) -> Floats:
        """Fill in how vertices `within` the contact move at their radii, or with the rim, but for the offsets.

        Return how much what is prescribed at the turn grows there by that, less its target, with each number.
        """
        names, model = self.names, self.model
        inner = np.array([i for i, name in enumerate(names) if name not in (*OFFSETS, TURN)], dtype=int)
        steps = np.array([_STEP * (model.furthest[0] if name == "indentation_max" else 1.0) for name in names])
        above, below, width = (rows[inner] for rows in self._ends(vector, steps))
        column = np.zeros((2 * inner.size + 1, 1))
        scenes = Scenes(*(value + column for value in model.scenes(np.concatenate([above, below, vector[None]]))))
        radius = np.where(drawn.radius[within] == drawn.scene.rim, scenes.rim, drawn.radius[within])
        states = model.states(scenes, radius, np.where(within <= drawn.turn, scenes.root, 1.0))[:2]
        at = within == drawn.turn
        if drawn.pressed is not None:
            states[:, :, at] += drawn.pressed * np.stack(model.flat(scenes, radius[:, at]))

        def change(values: Any) -> Floats:
            return np.asarray((values[..., : inner.size, :] - values[..., inner.size : -1, :]) / width[:, None])

        moved[within[:, None], :, inner] = change(states).transpose(2, 1, 0)
        by_load = drawn.aim[1] == 1.0
        share = -scenes.compliance if model.turns and not by_load else drawn.aim[1]
        level = drawn.aim[0] * states[0][:, at] + share * states[1][:, at] - (scenes.turn if model.turns else 0.0)
        missed = np.zeros(len(names))
        missed[inner] = change(level)[:, 0]
        if not model.turns:
            zeros = {OFFSETS[int(by_load)]: 1.0, TILT: by_load * model.furthest[0], TURN: -1.0}
            missed += [zeros.get(name, 0.0) for name in names]
        return missed

    def _slide(self, drawn: LoopPath, within: Integers, moved: Floats, missed: Floats, tilt: float) -> None:
        """Move corners along their branches: the turn until nothing is missed, landings to where their jumps are."""
        turn, is_pressed, driven = drawn.turn, drawn.pressed is not None, self.model.driven
        along = drawn.tangents - tilt * drawn.tangents[:, [0]] * [0.0, 1.0]
        if is_pressed:
            along[turn] = self.model.flat(drawn.scene, drawn.scene.rim)
        ahead = float(along[turn] @ drawn.aim)
        if (drawn.radius[turn] < drawn.scene.rim or is_pressed) and not drawn.jump[turn] and ahead > 0.0:
            rows = slice(turn, turn + (1 if is_pressed else 2))  # pinned at a rim
            moved[rows] -= along[rows, :, None] * missed / ahead
        for landing in within[drawn.jump[within]]:
            if landing != turn + 1 and along[landing, driven] != 0.0:
                behind = moved[landing - 1, driven] - moved[landing, driven]
                moved[landing] += along[landing, :, None] * behind / along[landing, driven]
        for apart in np.flatnonzero(drawn.jump & (drawn.radius == 0.0)):
            moved[apart, 0] = moved[apart - 1, 0]

    def size(self, vector: Floats) -> float:
        """Return a measure of the misfit that outliers hardly move."""
        return float(np.sum(np.log1p(self.residual(vector) ** 2)))

    def is_noise(self, found: Sequence[Any]) -> bool:
        """Say whether the best of some refined starts leaves no more than noise does."""
        count = self.weights.size
        return any(2.0 * done.cost <= count + _CLEAR * math.sqrt(2.0 * count) for done in found)

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
