"""The path of a loop with its units and offsets: up the branches of loading, down those of unloading, out of contact.

Vertices lie on the curve itself, at radii through which the path passes on a grid (walk.py). A moving edge is
integrated by core/rate/; loading at rest stays as it is.
"""

import math
from dataclasses import dataclass, replace
from typing import Any, Final, NamedTuple

import numpy as np

from gradhesion.core.draw.draw import draw_curves
from gradhesion.core.loops.fitted import OFFSETS
from gradhesion.core.loops.paths.model import EXPONENT, TURN, Model, Scenes
from gradhesion.core.loops.paths.walk import between, climb, met
from gradhesion.core.problem.toughness import EXPONENTS, Rate
from gradhesion.core.types import Floats, Truths

_A_WAVE: Final = 60  # radii of the grid within the shortest wave: the cubics between them are off by 3e-7 of its height
_SMOOTH: Final = 200  # radii of the grid without waves, each a fixed part further out than the last
_SMALLEST: Final = 0.02  # smallest radius of the grid, in radii at which adhesion outweighs the curvature of the punch
_MOST: Final = 400_000  # radii of the grid at most
_REACH: Final = (1.25, 2.5, 10.0)
"""How far the grid reaches, in radii of contact without adhesion at the turn: the next if one is not enough."""
_BY_LOAD: Final = (0.0, 1.0)  # what loading turns at, as parts of displacement and load


class LoopPath(NamedTuple):
    """A path in SI units, offsets included: vertices in the order in which they are passed.

    `places` are depths in m (of the machine, where its displacement is measured) and loads in N: first along the line
    of no load, then loading, unloading, and back along that line. `turn` is the vertex at which loading ends and
    unloading begins; the edge is pinned up to the next. `aim` is what the turn is prescribed by: the parts of
    displacement and load in it, 0 where it is the end of a branch.
    """

    places: Floats  # (vertices, 2)
    tangents: Floats  # how both grow with the radius, in the same rows; 0 out of contact
    radius: Floats  # contact radii in m; 0 out of contact
    jump: Truths  # whether each is reached by a jump
    curved: Truths  # whether the way to each is part of a smooth branch, of which the vertices are points
    turn: int
    scene: Scenes
    aim: tuple[float, float] = (1.0, 0.0)
    pressed: float | None = None  # by how much at the rim, up to the turn, in m; None if that is not met


@dataclass(eq=False, kw_only=True)
class LoopModel(Model):
    """The path of a loop as a function of the numbers that are searched.

    It turns at the largest depth in m, or load in N, of the data (`furthest`), unless told otherwise, and goes on by
    `blur` in m on the branch where it is, since points at the turn have noise. Where works of adhesion differ the edge
    is pinned at the turn, which is then searched as `TURN`. The line of no load begins at the depth `first`. `rate` is
    the law of an edge that has a speed; its exponent is that of the numbers that are searched, if it is one of them.
    """

    furthest: tuple[float, float]
    first: float
    blur: float = 0.0
    rate: Rate | None = None

    @property
    def driven(self) -> int:
        """The row of the states that is prescribed."""
        return int(self.loading.control == "load")

    def shift(self, vector: Floats) -> tuple[float, ...]:
        """Return the zeros of depth and load, and the tilt, of a vector."""
        own = dict(zip(self.names, vector.tolist(), strict=True))
        return tuple(own.get(name, self.fixed.get(name, 0.0)) for name in OFFSETS)

    def path(self, vector: Floats) -> LoopPath | None:
        """Draw the path; None where the scene has none. With a speed, it turns where that of an edge at rest does."""
        rest = self._at_rest(vector)
        return rest if self.rate is None or rest is None else self._moved(vector, rest, self.rate)

    def _at_rest(self, vector: Floats) -> LoopPath | None:
        """Draw the path of an edge at rest."""
        scene = self.scenes(vector[None]).one
        if not (0.0 < scene.stiffness < math.inf and 0.0 < scene.R * scene.disc < math.inf):
            return None
        depth, load, tilt = self.shift(vector)
        target, aim = scene.turn, (1.0, -scene.compliance)
        if self.turns == "load_max":
            aim = _BY_LOAD
        elif not self.turns:
            aim = _BY_LOAD if self.driven else (1.0, 0.0)
            turned = dict(zip(self.names, vector.tolist(), strict=True)).get(TURN, self.furthest[self.driven])
            target = turned - (load + tilt * self.furthest[0] if self.driven else depth)
        with np.errstate(all="ignore"):
            drawn = self._drawn(scene, target, aim, self.first - depth)
        if drawn is None or not np.isfinite(drawn.places).all():
            return None
        drawn.places[:, 0] += depth
        drawn.places[:, 1] += load + tilt * drawn.places[:, 0]
        drawn.tangents[:, 1] += tilt * drawn.tangents[:, 0]
        return drawn

    def _moved(self, vector: Floats, rest: LoopPath, rate: Rate) -> LoopPath | None:
        """Draw the path of an edge with a speed from that of one at rest."""
        given = {EXPONENT: rate.exponent, **self.fixed, **self.values(vector)}
        exponent = float(given[EXPONENT])
        if rest.radius[rest.turn] == 0.0 or not EXPONENTS[0] <= exponent <= EXPONENTS[1]:
            return rest
        scene, turn, (depth, load, tilt) = rest.scene, rest.turn, self.shift(vector)
        x, y = rest.places[turn]
        pressed = float(x - depth - scene.compliance * (y - load - tilt * x)) / scene.R
        wanted = self.parameters(vector) | {"indentation_max_over_R": pressed}
        law = replace(rate, exponent=exponent)
        drawn, _ = draw_curves(wanted, ["path"], self.profile, self.loading, None, law)
        back = drawn["path_unloading"] == 1
        y = 1.5 * math.pi * scene.R * float(given["work_of_adhesion"]) * drawn["path_load"]
        x = scene.R * drawn["path_indentation"] + scene.compliance * y + depth
        places, radius = np.column_stack([x, y + load + tilt * x]), scene.R * drawn["path_contact_radius"]
        if not np.isfinite(places).all() or not back.any():
            return None
        up: tuple[Any, ...] = tuple(one[: turn + 1] for one in (rest.places, rest.tangents, rest.radius, rest.curved))
        if law.closing != "quasi-static":
            way = np.concatenate([rest.places[:1], places[~back]])
            up = way, _along(way), np.append(0.0, radius[~back]), np.arange(len(way)) > 1
        way = places[back]
        down: tuple[Any, ...] = way, _along(way), radius[back], np.arange(len(way)) > 0
        end: tuple[Any, ...] = [[min(up[0][0, 0], way[-1, 0]), rest.places[-1, 1]]], np.zeros((1, 2)), [0.0], [False]
        chain, tangents, radius, curved = (np.concatenate(parts) for parts in zip(up, down, end, strict=True))
        return LoopPath(chain, tangents, radius, np.zeros(len(chain), bool), curved, len(up[0]) - 1, scene)

    def _grid(self, scene: Scenes, end: float) -> Floats | None:
        """Return radii up to an end, evenly spaced by waves, and by parts of the radius near 0; None for too many."""
        step = self.shortest(scene) / _A_WAVE
        if end / step > _MOST:
            return None
        low = min(_SMALLEST * scene.neck, 0.02 * end)
        growth = math.log(end / low) / _SMOOTH
        begin = max(step / growth, low)  # where both kinds of steps are equal
        if begin >= end:
            return np.geomspace(low, end, _SMOOTH + 1)
        inner, outer = math.ceil(math.log(begin / low) / growth), max(7, math.ceil((end - begin) / step))
        near = math.log(begin / low) / max(1, inner) * np.arange(float(inner))
        return np.concatenate([low * np.exp(near), np.linspace(begin, end, outer + 1)])

    def _reach(self, scene: Scenes, target: float, *, by_load: bool) -> float:
        """Return the radius of contact without adhesion at a load in N, or at a depth in m."""
        m, power = self.profile.exponent, 1.0 + scene.k
        swell = 2.0 * scene.A * scene.wavelength * scene.R if self.has_waves else 0.0
        factor = scene.disc * m / (power + m) if by_load else 1.0
        place = (max(target, 0.0) / (scene.rise * factor)) ** (1.0 / (power + m if by_load else m))
        return float(scene.R * (place + (swell / scene.rise) ** (1.0 / m)))

    def _drawn(self, scene: Scenes, target: float, aim: tuple[float, float], first: float) -> LoopPath | None:
        """Draw a path without offsets, whose line of no load begins at a depth.

        It turns where the parts `aim` of displacement and load first reach a target.
        """
        by_load = aim == _BY_LOAD
        if math.isnan(target) or scene.rim == target == math.inf:
            return None
        if target <= 0.0 and not by_load:  # no contact
            line = np.array([[first, 0.0], [0.0, 0.0], [target, 0.0], [0.0, 0.0], [first, 0.0]])
            no = np.zeros(5, bool)
            return LoopPath(line, np.zeros((5, 2)), np.zeros(5), no, no, 2, scene)
        for reach in _REACH:
            aimed = reach * self._reach(scene, target, by_load=by_load) + 2.5 * scene.neck
            end = min(scene.rim, aimed) if target < math.inf else scene.rim
            grid = self._grid(scene, end)
            if grid is None:
                return None
            states = self.states(scene, grid, np.array([[scene.root], [1.0]]))
            closing, opening = (np.ascontiguousarray(states[:, edge]) for edge in range(2))
            radius, passed, jump = climb(grid, closing, self.driven, 1.0, 0.0)
            at, share = met(radius, passed, jump, aim, target)
            if at < radius.size or end == scene.rim:
                break
        else:
            return None
        pinned = []
        if at == radius.size:  # the rim is met, perhaps by a jump, and the contact pressed on
            if not at or radius[-1] < end:
                radius, jump = np.append(radius, end), np.append(jump, np.True_)
                passed = np.column_stack([passed, closing[:, -1]])
            at = radius.size - 1
            if target < math.inf:
                flat = np.array(self.flat(scene, end))
                deeper = max(0.0, float((target - passed[:2, at] @ aim) / (flat @ aim)))
                pinned = [[*(passed[:2, at] + deeper * flat), *passed[2:, at], end, 0.0, 0.0]]
        elif self.blur > 0.0 and aim == (1.0, 0.0):
            further, part = met(radius, passed, jump, aim, target + self.blur)
            leaps = np.append(np.flatnonzero(jump[at + 1 : further + 1]) + at, radius.size - 1)
            at, share, aim = (int(leaps[0]), 1.0, (0.0, 0.0)) if leaps[0] < further else (further, part, aim)
        up = _rows(radius, passed, jump)[: at + 1]
        up[at, 4], up[at, :4] = between(radius, passed, at, share)
        back = self._unloading(scene, grid, opening, up[at])
        lines = np.zeros((4, 7))
        lines[:, 0] = min(first, 0.0), 0.0, back[-1, 0], min(first, back[-1, 0])
        lines[2, 5] = 1.0
        # under a falling load nothing holds the punch once contact is lost
        rows = np.concatenate([lines[:2], up, np.reshape(pinned, (-1, 7)), back, lines[2 : 2 if self.driven else 4]])
        jumps, curved = rows[:, 5:].T > 0.0
        return LoopPath(
            rows[:, :2].copy(), rows[:, 2:4].copy(), rows[:, 4], jumps, curved, at + 2 + len(pinned), scene, aim,
            deeper if pinned else None,
        )  # fmt: skip

    def _unloading(self, scene: Scenes, grid: Floats, opening: Floats, end: Floats) -> Floats:
        """Return the vertices of unloading from the last one of loading, as of `_rows`; the edge is pinned up to it."""
        turn, begun = float(end[4]), end[:4]
        inside = int(np.count_nonzero(grid < turn))
        if scene.root != 1.0:
            share = (turn - grid[inside - 1]) / (grid[inside] - grid[inside - 1])
            begun = between(grid, opening, inside, share)[1]
        states = np.column_stack([begun, opening[:, :inside][:, ::-1]])
        back = _rows(*climb(np.append(turn, grid[:inside][::-1]), states, self.driven, -1.0, -math.inf))
        back[0, 5:] = 0.0
        return back


def _rows(radius: Floats, states: Floats, jump: Truths) -> Floats:
    """Return vertices as rows: state, radius, whether it is reached by a jump, and whether along a smooth branch."""
    return np.column_stack([states.T, radius, jump, ~jump])


def _along(places: Floats) -> Floats:
    """Return directions of a curve at its points (n, 2), those of parabolas through their neighbours."""
    steps = np.hypot(*(np.diff(places, axis=0) / np.maximum(np.ptp(places, axis=0), np.finfo(float).tiny)).T)
    way = np.append(0.0, np.cumsum(np.maximum(steps, 1e-12)))
    return np.asarray(np.gradient(places, way, axis=0) if len(places) > 1 else places)
