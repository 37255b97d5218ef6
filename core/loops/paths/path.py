"""The path of a loop with its units and offsets: up the branches of loading, down those of unloading, out of contact.

Vertices lie on the curve itself, at radii through which the path passes on a grid (walk.py).
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from gradhesion.core.loops.paths.grid import grid_of, reach_of
from gradhesion.core.loops.paths.model import Model, Scenes, States
from gradhesion.core.loops.paths.offsets import NAMES as OFFSETS
from gradhesion.core.loops.paths.walk import Walk, climb
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.toughness import Toughness
from gradhesion.core.types import Floats, Truths

_FEWEST: Final = 5
"""Radii of a grid at least."""
_PARTS: Final = np.linspace(0.0, 1.0, 9)
"""Places, in parts of the way by which loading continues within the noise."""
_REACH: Final = (1.25, 2.5, 10.0)
"""How far the grid reaches, in radii of contact without adhesion at the depth: the next if one is not enough."""


@dataclass(frozen=True, eq=False)
class LoopPath:
    """A path in SI units, offsets included: vertices in the order in which they are passed."""

    places: Floats
    """Rows of depth in m (of the machine, where its displacement is measured) and load in N: first along the line
    of no load, then loading, unloading, and back along that line."""
    radius: Floats
    """The contact radius of each, in m; 0 out of contact."""
    jump: Truths
    """Whether each is reached by a jump."""
    curved: Truths
    """Whether the way to each is part of a smooth branch, of which the vertices are points."""
    turn: int
    """The number of the vertex at which loading ends and unloading begins; the edge is pinned up to the next."""
    scene: Scenes
    """The scene that was drawn."""
    is_pressed: bool = False
    """Whether the contact is pressed on at the rim, up to the turn."""
    by_load: bool = False
    """Whether it turns at a load, or is pressed on to one."""


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
        """Whether loading turns at a given depth of the specimen, which is not what is driven."""
        return self.turns == "indentation_max_over_R" and self.loading.control != "displacement"

    @property
    def turns_at_load(self) -> bool:
        """Whether loading turns at a load: a given one, or that of the data where the load is driven."""
        return self.turns == "load_max" or (not self.turns and self.loading.control == "load")

    def shift(self, vector: Floats) -> tuple[float, ...]:
        """Return the zeros of depth and load, and the tilt, of a vector."""
        return tuple(float(vector[self.names.index(name)]) if name in self.names else 0.0 for name in OFFSETS)

    def _targets(self, scene: Scenes, vector: Floats) -> tuple[float, float]:
        """Return the coordinate at which loading turns and the load that it reaches there; inf is never reached."""
        if self.turns:
            return (math.inf, scene.turn) if self.turns == "load_max" else (scene.turn, -math.inf)
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

    def _coordinate(self, scene: Scenes, depth: Any, load: Any) -> Any:
        """Return what is prescribed: the depth, the load, or the far end of the machine."""
        return load if self.loading.control == "load" else depth + scene.compliance * load

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
                end = min(rim, reach * reach_of(self, scene, aim, by_load=by_load) + 2.5 * scene.neck)
            grid = grid_of(self, scene, end, self.fineness)
            if grid is None:
                return None
            states = self.states(scene, grid)
            up = Walk(*climb(grid, self._coordinate(scene, *states.at(scene.root)), 0.0))
            aimed = up
            if by_load or self.turns_at_depth:
                aimed = up._replace(level=self.states(scene, up.radius).at(scene.root)[int(by_load)])
            place = aimed.met(aim)
            if place is not None:
                blurred = not by_load and not self.turns and self.blur > 0.0
                turned = self._further(scene, up, place, targets) if blurred else (place, by_load)
                return self._joined(scene, grid, states, up, turned, None, first)
            if end == rim:
                return self._joined(scene, grid, states, up, (rim, by_load), aim if aim < math.inf else None, first)
        return None

    def deeper(self, scenes: Scenes, aim: Any, depth: Any, load: Any, slope: Any) -> Any:
        """Return how much deeper contacts pinned at the rim, flat punches of a stiffness, are pressed up to the turn.

        `aim` is the depth or the load at which loading turns; depth, load and stiffness (slope) are those at the rim,
        before, of shape (scenes, 1) or numbers.
        """
        if self.turns_at_load:
            return (aim - load) / slope
        if self.turns_at_depth:
            return aim - depth
        return (aim - depth - scenes.compliance * load) / (1.0 + scenes.compliance * slope)

    def _further(self, scene: Scenes, up: Walk, place: float, targets: tuple[float, float]) -> tuple[float, bool]:
        """Return the radius at which loading turns, and whether its load decides.

        Where the load rises by many deviations within one of the depth, it determines the turn better. The path then
        continues to the largest load, within the noise of the depth, but over no fold.
        """
        target, highest = targets
        end = up.met(target + self.blur)
        if end is None or bool(np.any(up.jump & (up.radius > place) & (up.radius <= end))):
            return place, False
        some = place + (end - place) * _PARTS
        loads = self.states(scene, some).at(scene.root)[1]
        if loads[0] >= highest:
            return place, False
        found = Walk(some, np.zeros(some.size, bool), loads).met(highest)
        return (end, False) if found is None else (found, True)

    def _apart(self, scene: Scenes, target: float, first: float) -> LoopPath:
        """Return the line of no load of a cycle without contact, up to a depth."""
        line = np.array([[first, 0.0], [0.0, 0.0], [target, 0.0], [0.0, 0.0], [first, 0.0]])
        no = np.zeros(5, bool)
        return LoopPath(line, np.zeros(5), no, no, 2, scene)

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
        """Join loading up to the radius of the turn, unloading from there, and the line of no load.

        `grid` are radii (n,) in m and `states` equilibrium there; `up` is how loading passes them; `turned` the radius
        at which it turns, and whether its load decides; `pressed` the depth or load at the turn of a contact that is
        pinned at the rim, else None; `first` the depth at which the line of no load begins.
        """
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
        if pressed is not None:
            flat = found.slope[split]
            deeper = max(0.0, self.deeper(scene, pressed, depth[split], load[split], flat))
            depth[split] += deeper
            load[split] += flat * deeper
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
            split + 2,
            scene,
            pressed is not None,
            turned[1],
        )
