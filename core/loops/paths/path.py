"""The path of a loop with its units and offsets: up the branches of loading, down those of unloading, out of contact.

Vertices lie on the curve itself, at radii through which the path passes on a grid (walk.py).
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final, NamedTuple

import numpy as np

from gradhesion.core.loops.paths.model import Model, Scenes, States
from gradhesion.core.loops.paths.offsets import NAMES as OFFSETS
from gradhesion.core.loops.paths.walk import climb, crossing
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.toughness import Toughness
from gradhesion.core.types import Floats, Truths

_A_WAVE: Final = 48
"""Radii of the grid within the shortest wave."""
_SMOOTH: Final = 320
"""Radii of the grid without waves, each a fixed part further out than the last."""
_SMALLEST: Final = 0.02
"""Smallest radius of the grid, in radii at which adhesion outweighs the curvature of the punch."""
_MOST: Final = 400_000
"""Radii of the grid at most."""
_FEWEST: Final = 5
"""Radii of a grid at least."""
_PARTS: Final = np.linspace(0.0, 1.0, 9)
"""Places, in parts of the way by which loading continues within the noise."""
_REACH: Final = (1.25, 2.5, 10.0)
"""How far the grid reaches, in radii of contact without adhesion at the depth: the next if one is not enough."""


class Walk(NamedTuple):
    """The results of `climb`."""

    radius: Floats
    jump: Truths
    level: Floats


@dataclass(frozen=True, eq=False)
class LoopPath:
    """A path in SI units, offsets included: vertices in the order in which they are passed.

    Attributes
    ----------
    places
        Rows of depth in m (of the machine, where its displacement is measured) and load in N: first along the line of
        no load, then loading, unloading, and back along that line.
    radius
        The contact radius of each, in m; 0 out of contact.
    jump
        Whether each is reached by a jump.
    curved
        Whether the way to each is part of a smooth branch, of which the vertices are points.
    toughness
        Root of the work at the edge over that of opening: that of closing, then 1.
    turn
        The number of the vertex at which loading ends and unloading begins; the edge is pinned up to the next.
    scene
        The scene that was drawn.
    is_pressed
        Whether the contact is pressed on at the rim, up to the turn.
    by_load
        Whether it turns at a load.
    """

    places: Floats
    radius: Floats
    jump: Truths
    curved: Truths
    toughness: Floats
    turn: int
    scene: Scenes
    is_pressed: bool = False
    by_load: bool = False


def _met(radius: Floats, jump: Truths, level: Floats, target: float) -> float | None:
    """Return the radius at which loading first has a level, None where it has not; as `climb` returns these."""
    i = int(np.argmax(level >= target)) if level.size else 0
    if not level.size or not level[i] >= target:
        return None
    if i == 0 or jump[i]:
        return float(radius[i])
    jumps = np.flatnonzero(jump)
    edge = int(np.searchsorted(jumps, i))
    first = int(jumps[edge - 1]) if edge else 0
    branch = slice(first, int(jumps[edge]) if edge < jumps.size else None)
    if radius[branch].size < _FEWEST:
        share = (target - level[i - 1]) / (level[i] - level[i - 1])
        return float(radius[i - 1] + share * (radius[i] - radius[i - 1]))
    return float(crossing(radius[branch], level[branch], i - first, target))


class LoopModel(Model):
    """The path of a loop as a function of the numbers that are searched.

    Parameters
    ----------
    fixed, names, profile, loading, toughness
        As of `Model`.
    furthest
        The largest depth in m and the largest load in N of the data, at which they turn.
    blur
        How far the path goes on beyond that depth at most, in m, to the largest load.
    first
        Where the line of no load begins, in m.
    """

    by_differences = False
    """Whether derivatives are differences of paths."""
    fineness = 1
    """Points of the grid of radii over those of the search: the errors of its vertices fall as the fourth power."""

    def __init__(
        self,
        fixed: Mapping[str, float],
        names: tuple[str, ...],
        *,
        furthest: tuple[float, float],
        blur: float = 0.0,
        first: float,
        profile: Profile,
        loading: Loading | None = None,
        toughness: Toughness | None = None,
    ) -> None:
        super().__init__(fixed, names, profile, loading or Loading(), toughness)
        self.furthest, self.blur, self.first = furthest, blur, first

    @property
    def turns_at_depth(self) -> bool:
        """Whether loading turns at a given depth of the specimen, while the far end of a machine is driven."""
        return self.turns == "indentation_max_over_R" and self.loading.control == "machine"

    def shift(self, vector: Floats) -> tuple[float, ...]:
        """Return the zeros of depth and load, and the tilt, of a vector."""
        return tuple(float(vector[self.names.index(name)]) if name in self.names else 0.0 for name in OFFSETS)

    def _targets(self, scene: Scenes, vector: Floats) -> tuple[float, float]:
        """Return the coordinate at which loading turns and the load that it reaches there; inf is never reached."""
        if self.turns:
            turn = float(scene.turn)
            return (math.inf, turn) if self.turns == "load_max" else (turn, -math.inf)
        depth, load, tilt = self.shift(vector)
        highest = self.furthest[1] - load - tilt * self.furthest[0]
        return (math.inf, highest) if self.loading.control == "load" else (self.furthest[0] - depth, highest)

    def path(self, vector: Floats) -> LoopPath | None:
        """Draw the path; None where the scene has none."""
        scene = self.scenes(vector[None]).one
        if not (0.0 < scene.stiffness < math.inf and 0.0 < scene.R * scene.disc < math.inf):
            return None
        depth, load, tilt = self.shift(vector)
        with np.errstate(all="ignore"):
            drawn = self._drawn(scene, self._targets(scene, vector), self.first - depth)
        if drawn is None or not np.isfinite(drawn.places).all():
            return None
        drawn.places[:, 0] += depth
        drawn.places[:, 1] += load + tilt * drawn.places[:, 0]
        return drawn

    def _grid(self, scene: Scenes, end: float) -> Floats | None:
        """Return the radii between which branches are searched, up to an end, of shape (n,); None for too many."""
        step, count = self.shortest(scene) / (_A_WAVE * self.fineness), _SMOOTH * self.fineness
        if end / step > _MOST:
            return None
        low = min(_SMALLEST * scene.neck, 0.02 * end)
        growth = math.log(end / low) / count
        begin = max(step / growth, low)  # where both kinds of steps are equal
        if begin >= end:
            return low * np.exp(growth * np.arange(count + 1.0))
        inner, outer = math.ceil(math.log(begin / low) / growth), max(7, math.ceil((end - begin) / step))
        near = math.log(begin / low) / max(1, inner) * np.arange(float(inner))
        return np.concatenate([low * np.exp(near), begin + (end - begin) / outer * np.arange(outer + 1.0)])

    def _coordinate(self, scene: Scenes, depth: Any, load: Any) -> Any:
        """Return what is prescribed: the depth, the load, or the far end of the machine."""
        return load if self.loading.control == "load" else depth + scene.compliance * load

    def _extent(self, scene: Scenes, target: float, *, by_load: bool) -> float:
        """Return the radius of contact without adhesion at the depth, or the load, that loading turns at."""
        m, power = self.profile.exponent, 1.0 + scene.k
        swell = 2.0 * scene.A * scene.wavelength * scene.R if self.has_waves else 0.0
        if by_load:
            place = (max(target, 0.0) * (power + m) / (scene.rise * scene.disc * m)) ** (1.0 / (power + m))
        else:
            place = (max(target, 0.0) / scene.rise) ** (1.0 / m)
        return float(scene.R * (place + (swell / scene.rise) ** (1.0 / m)))

    def _drawn(self, scene: Scenes, targets: tuple[float, float], first: float) -> LoopPath | None:
        """Draw a path without offsets, whose line of no load begins at a depth."""
        rim, (target, highest) = scene.rim, targets
        by_load = target == math.inf and math.isfinite(highest)
        if math.isnan(target + highest) or (target == math.inf and rim == math.inf and not by_load):
            return None
        if target <= 0.0:
            return self._apart(scene, target, first)
        aim = highest if by_load else target
        for reach in _REACH:
            end = rim
            if aim < math.inf:
                end = min(rim, reach * self._extent(scene, aim, by_load=by_load) + 2.5 * scene.neck)
            grid = self._grid(scene, end)
            if grid is None:
                return None
            states = self.states(scene, grid)
            up = Walk(*climb(grid, self._coordinate(scene, *states.at(scene.root)), 0.0))
            levels = up.level
            if by_load or self.turns_at_depth:
                levels = self.states(scene, up.radius).at(scene.root)[int(by_load)]
            place = _met(up.radius, up.jump, levels, aim)
            if place is not None:
                blurred = not by_load and not self.turns and self.blur > 0.0
                turned = self._further(scene, up, place, targets) if blurred else (place, by_load)
                return self._joined(scene, grid, states, up, turned, None, first)
            if end == rim:
                pressed = self._pressed(scene, aim) if aim < math.inf else None
                return self._joined(scene, grid, states, up, (rim, False), pressed, first)
        return None

    def _pressed(self, scene: Scenes, aim: float) -> float:
        """Return what is prescribed where a contact that is pinned at the rim is pressed on to the turn."""
        if not self.turns_at_depth:
            return aim
        found = self.states(scene, np.array([scene.rim]))
        (depth,), (load,) = found.at(scene.root)
        return float(aim + scene.compliance * (load + float(found.slope[0]) * (aim - depth)))

    def _further(self, scene: Scenes, up: Walk, place: float, targets: tuple[float, float]) -> tuple[float, bool]:
        """Return the radius at which loading turns, and whether its load decides.

        Where the load rises by many deviations within one of the depth, it determines the turn better. The path then
        continues to the largest load, within the noise of the depth, but over no fold.
        """
        target, highest = targets
        end = _met(up.radius, up.jump, up.level, target + self.blur)
        if end is None or bool(np.any(up.jump & (up.radius > place) & (up.radius <= end))):
            return place, False
        some = place + (end - place) * _PARTS
        loads = self.states(scene, some).at(scene.root)[1]
        if loads[0] >= highest:
            return place, False
        found = _met(some, np.zeros(some.size, bool), loads, highest)
        return (end, False) if found is None else (found, True)

    def _apart(self, scene: Scenes, target: float, first: float) -> LoopPath:
        """Return the line of no load of a cycle without contact, up to a depth."""
        line = np.array([[first, 0.0], [0.0, 0.0], [target, 0.0], [0.0, 0.0], [first, 0.0]])
        no, zero = np.zeros(5, bool), np.zeros(5)
        return LoopPath(line, zero, no, no, zero, 2, scene)

    def _joined(
        self,
        scene: Scenes,
        grid: Floats,
        states: States,
        up: Walk,
        turned: tuple[float, bool],
        pressed: float | None,
        first: float,
    ) -> LoopPath:
        """Join loading up to the radius of the turn, unloading from there, and the line of no load."""
        turn = turned[0]
        within, inner = up.radius < turn, grid < turn
        if np.count_nonzero(inner) < _FEWEST:
            grid = turn * np.linspace(0.1, 0.9, _FEWEST)
            inner, states = np.ones(_FEWEST, bool), self.states(scene, grid)
        opened = self._coordinate(scene, *self.states(scene, np.array([turn])).at(1.0))
        falls = self._coordinate(scene, *states.at(1.0))[inner]
        down = Walk(*climb(
            np.append(grid[inner], turn)[::-1].copy(), -np.append(falls, opened)[::-1], -math.inf
        ))  # fmt: skip
        down.jump[0] = False
        split = int(np.count_nonzero(within))
        reached = bool(up.jump[split]) if split < up.jump.size and up.radius[split] == turn else split == 0
        more = [turn] if pressed is not None else []  # from the rim on
        way = np.concatenate([up.radius[within], [turn], more, down.radius])
        jump = np.concatenate([up.jump[within], [reached], np.zeros(len(more), bool), down.jump])
        split += len(more)
        edge = np.concatenate([np.full(split + 1, scene.root), np.ones(down.radius.size)])
        found = self.states(scene, way)
        depth, load = found.at(edge)
        if pressed is not None:  # pinned at the rim, the contact is a flat punch
            at, flat = self._coordinate(scene, depth[split], load[split]), found.slope[split]
            way_on = (pressed - at) / (flat if self.loading.control == "load" else 1.0 + scene.compliance * flat)
            depth[split] += max(0.0, way_on)
            load[split] += flat * max(0.0, way_on)
        x = depth + scene.compliance * load
        curved = ~jump
        curved[[0, split + 1, *([split] if pressed is not None else [])]] = False
        # under a falling load nothing holds the punch once contact is lost
        tail = [] if self.loading.control == "load" else [[x[-1], 0.0], [min(first, x[-1]), 0.0]]
        out, no = np.zeros(len(tail)), np.zeros(2, bool)
        head = [[min(first, 0.0), 0.0], [0.0, 0.0]]
        return LoopPath(
            np.concatenate([head, np.column_stack([x, load]), np.reshape(tail, (-1, 2))]),
            np.concatenate([no, way, out]),
            np.concatenate([no, jump, np.arange(out.size) == 0]),
            np.concatenate([no, curved, out > 0.0]),
            np.concatenate([no, edge, out]),
            split + 2,
            scene,
            pressed is not None,
            turned[1],
        )
