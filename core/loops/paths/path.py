"""The path of a loop with its units and offsets: up the branches of loading, down those of unloading, out of contact.

Vertices lie on the curve itself, at radii through which the path passes on a grid (walk.py). A moving edge is
integrated by core/rate/; loading at rest stays as it is.
"""

import math
from dataclasses import replace
from typing import Any, Final, NamedTuple

import numpy as np

from gradhesion.core.draw.draw import draw_curves
from gradhesion.core.loops.paths.model import EXPONENT, TURN, LoopModel, Scenes
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
    turn: int
    scene: Scenes
    aim: tuple[float, float] = (1.0, 0.0)
    pressed: float | None = None  # by how much at the rim, up to the turn, in m; None if that is not met

    @property
    def curved(self) -> Truths:
        """Whether the way to each vertex is part of a smooth branch: in contact, neither a jump nor pinned."""
        before = np.append(0.0, self.radius[:-1])
        return ~self.jump & (self.radius > 0.0) & (before > 0.0) & (self.radius != before)


def draw_loop(model: LoopModel, vector: Floats) -> LoopPath | None:
    """Draw the path; None where the scene has none. With a speed, it turns where that of an edge at rest does."""
    scene = model.scenes(vector[None]).one
    if not (0.0 < scene.stiffness < math.inf and 0.0 < scene.R * scene.disc < math.inf):
        return None
    depth, load, tilt = model.shift(vector)
    target, aim = scene.turn, (1.0, -scene.compliance)
    if model.turns == "load_max":
        aim = _BY_LOAD
    elif not model.turns:
        aim = _BY_LOAD if model.driven else (1.0, 0.0)
        turned = float(model.values(vector).get(TURN, model.furthest[model.driven]))
        target = turned - (load + tilt * model.furthest[0] if model.driven else depth)
    with np.errstate(all="ignore"):
        drawn = _drawn(model, scene, target, aim, model.first - depth)
    if drawn is not None and model.rate is not None:
        drawn = _moved(model, vector, drawn, model.rate)
    if drawn is None or not np.isfinite(drawn.places).all():
        return None
    drawn.places[:, 0] += depth
    drawn.places[:, 1] += load + tilt * drawn.places[:, 0]
    drawn.tangents[:, 1] += tilt * drawn.tangents[:, 0]
    return drawn


def _moved(model: LoopModel, vector: Floats, rest: LoopPath, rate: Rate) -> LoopPath | None:
    """Draw the path of an edge with a speed, without offsets, from that of one at rest."""
    given = {EXPONENT: rate.exponent, **model.fixed, **model.values(vector)}
    exponent, scene, turn = float(given[EXPONENT]), rest.scene, rest.turn
    if rest.radius[turn] == 0.0 or not EXPONENTS[0] <= exponent <= EXPONENTS[1]:
        return rest
    pressed = float(rest.places[turn] @ [1.0, -scene.compliance]) / scene.R
    wanted, law = model.parameters(vector) | {"indentation_max_over_R": pressed}, replace(rate, exponent=exponent)
    drawn, _ = draw_curves(wanted, ["path"], model.profile, model.loading, None, law)
    back = drawn["path_unloading"] == 1
    if not back.any():
        return None
    y = 1.5 * math.pi * scene.R * float(given["work_of_adhesion"]) * drawn["path_load"]
    places = np.column_stack([scene.R * drawn["path_indentation"] + scene.compliance * y, y])
    radius = scene.R * drawn["path_contact_radius"]
    up: tuple[Any, ...] = tuple(row[: turn + 1] for row in (rest.places, rest.tangents, rest.radius, rest.jump))
    if law.closing != "quasi-static":
        way = np.concatenate([rest.places[:1], places[~back]])
        up = way, _along(way), np.append(0.0, radius[~back]), np.zeros(len(way), bool)
    down: tuple[Any, ...] = places[back], _along(places[back]), radius[back], np.zeros(np.count_nonzero(back), bool)
    end: tuple[Any, ...] = [[min(up[0][0, 0], places[-1, 0]), 0.0]], np.zeros((1, 2)), [0.0], [False]
    chain, tangents, radius, jump = (np.concatenate(parts) for parts in zip(up, down, end, strict=True))
    return LoopPath(chain, tangents, radius, jump, len(up[0]) - 1, scene)


def _grid(model: LoopModel, scene: Scenes, end: float) -> Floats | None:
    """Return radii up to an end, evenly spaced by waves, and by parts of the radius near 0; None for too many."""
    step = model.shortest(scene) / _A_WAVE
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


def _reach(model: LoopModel, scene: Scenes, target: float, *, by_load: bool) -> float:
    """Return the radius of contact without adhesion at a load in N, or at a depth in m."""
    m, power = model.profile.exponent, 1.0 + scene.k
    swell = 2.0 * scene.A * scene.wavelength * scene.R if model.has_waves else 0.0
    factor = scene.disc * m / (power + m) if by_load else 1.0
    place = (max(target, 0.0) / (scene.rise * factor)) ** (1.0 / (power + m if by_load else m))
    return float(scene.R * (place + (swell / scene.rise) ** (1.0 / m)))


def _drawn(model: LoopModel, scene: Scenes, target: float, aim: tuple[float, float], first: float) -> LoopPath | None:
    """Draw a path without offsets, whose line of no load begins at a depth.

    It turns where the parts `aim` of displacement and load first reach a target.
    """
    by_load = aim == _BY_LOAD
    if math.isnan(target) or scene.rim == target == math.inf:
        return None
    if target <= 0.0 and not by_load:  # no contact
        line = np.array([[first, 0.0], [0.0, 0.0], [target, 0.0], [0.0, 0.0], [first, 0.0]])
        return LoopPath(line, np.zeros((5, 2)), np.zeros(5), np.zeros(5, bool), 2, scene)
    for reach in _REACH:
        aimed = reach * _reach(model, scene, target, by_load=by_load) + 2.5 * scene.neck
        end = min(scene.rim, aimed) if target < math.inf else scene.rim
        grid = _grid(model, scene, end)
        if grid is None:
            return None
        states = model.states(scene, grid, np.array([[scene.root], [1.0]]))
        closing, opening = (np.ascontiguousarray(states[:, edge]) for edge in range(2))
        radius, passed, jump = climb(grid, closing, model.driven, 1.0, 0.0)
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
            flat = np.array(model.flat(scene, end))
            deeper = max(0.0, float((target - passed[:2, at] @ aim) / (flat @ aim)))
            pinned = [[*(passed[:2, at] + deeper * flat), *passed[2:, at], end, 0.0]]
    elif model.blur > 0.0 and aim == (1.0, 0.0):
        further, part = met(radius, passed, jump, aim, target + model.blur)
        leaps = np.append(np.flatnonzero(jump[at + 1 : further + 1]) + at, radius.size - 1)
        at, share, aim = (int(leaps[0]), 1.0, (0.0, 0.0)) if leaps[0] < further else (further, part, aim)
    up = _rows(radius, passed, jump)[: at + 1]
    up[at, 4], up[at, :4] = between(radius, passed, at, share)
    back = _unloading(model, scene, grid, opening, up[at])
    lines = np.zeros((4, 6))
    lines[:, 0] = min(first, 0.0), 0.0, back[-1, 0], min(first, back[-1, 0])
    lines[2, 5] = 1.0
    # under a falling load nothing holds the punch once contact is lost
    rows = np.concatenate([lines[:2], up, np.reshape(pinned, (-1, 6)), back, lines[2 : 2 if model.driven else 4]])
    chain = rows[:, :2].copy(), rows[:, 2:4].copy(), rows[:, 4], rows[:, 5] > 0.0
    return LoopPath(*chain, at + 2 + len(pinned), scene, aim, deeper if pinned else None)


def _unloading(model: LoopModel, scene: Scenes, grid: Floats, opening: Floats, end: Floats) -> Floats:
    """Return the vertices of unloading from the last one of loading, as of `_rows`; the edge is pinned up to it."""
    turn, begun = float(end[4]), end[:4]
    inside = int(np.count_nonzero(grid < turn))
    if scene.root != 1.0:
        share = (turn - grid[inside - 1]) / (grid[inside] - grid[inside - 1])
        begun = between(grid, opening, inside, share)[1]
    states = np.column_stack([begun, opening[:, :inside][:, ::-1]])
    back = _rows(*climb(np.append(turn, grid[:inside][::-1]), states, model.driven, -1.0, -math.inf))
    back[0, 5] = 0.0
    return back


def _rows(radius: Floats, states: Floats, jump: Truths) -> Floats:
    """Return vertices as rows: state, radius, and whether it is reached by a jump."""
    return np.column_stack([states.T, radius, jump])


def _along(places: Floats) -> Floats:
    """Return directions of a curve at its points (n, 2), those of parabolas through their neighbours."""
    steps = np.hypot(*(np.diff(places, axis=0) / np.maximum(np.ptp(places, axis=0), np.finfo(float).tiny)).T)
    way = np.append(0.0, np.cumsum(np.maximum(steps, 1e-12)))
    return np.asarray(np.gradient(places, way, axis=0) if len(places) > 1 else places)
