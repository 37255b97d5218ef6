"""How the path of a loop moves with what is fitted.

A distance to a curve changes only as the curve moves normal to itself, not as its vertices move along it. So vertices
are moved at fixed contact radius, those at the rim with it, where depth and load are closed forms (model.py), and no
derivative of a fold is needed: it is a stationary point. Corners are moved along their branches as well: a landing
stays at the coordinate of its jump, and the turn, with the radius at which the edge is pinned, at that of the data.
Closed forms are differentiated by differences within the ranges, good to 1e-9 but at their ends.
"""

from typing import Any, Final

import numpy as np

from gradhesion.core.loops.paths.model import TURN, Scenes
from gradhesion.core.loops.paths.offsets import DEPTH_ZERO, LOAD_ZERO, TILT
from gradhesion.core.loops.paths.offsets import NAMES as OFFSETS
from gradhesion.core.loops.paths.path import LoopModel, LoopPath
from gradhesion.core.types import Floats, Integers

_STEP: Final = 1e-5
"""Step of the differences, of logarithms and ratios: their error is of its square, or of 1e-16 over it."""


def moving(model: LoopModel, vector: Floats, drawn: LoopPath, low: Floats, high: Floats, used: Integers) -> Floats:
    """Return how vertices `used` of a path move with each number that is searched, between the ends of its range.

    Returns
    -------
    Of shape (vertices, 2, numbers), for others than those that are used without a meaning. Out of contact vertices move
    with the offsets alone.
    """
    names, tilt = model.names, model.shift(vector)[2]
    moved = np.zeros((drawn.radius.size, 2, len(names)))
    wanted = np.zeros(drawn.radius.size + 1, bool)
    wanted[[*used, drawn.turn, drawn.turn + 1]] = True
    wanted[np.flatnonzero(drawn.jump & wanted[:-1]) - 1] = True  # a landing moves with the end of its jump
    if (within := np.flatnonzero(wanted[:-1] & (drawn.radius > 0.0))).size:
        along = drawn.tangents - tilt * drawn.tangents[:, [0]] * [0.0, 1.0]
        missed = _at_fixed_radius(model, vector, drawn, within, moved, low, high)
        _slide(model, drawn, within, moved, along, missed)
    for axis, name in enumerate((DEPTH_ZERO, LOAD_ZERO)):
        if name in names:
            moved[:, axis, names.index(name)] += 1.0
    moved[:, 1] += tilt * moved[:, 0]
    if TILT in names:
        moved[:, 1, names.index(TILT)] += drawn.places[:, 0]
    return moved


def _at_fixed_radius(
    model: LoopModel, vector: Floats, drawn: LoopPath, within: Integers, moved: Floats, low: Floats, high: Floats
) -> Floats:
    """Fill in how the vertices `within` the contact move at their radii, or with the rim, but for the offsets.

    Returns
    -------
    How much what is prescribed at the turn grows there by that, less its target, with each number.
    """
    names, turn = model.names, drawn.turn
    inner = np.array([i for i, name in enumerate(names) if name not in (*OFFSETS, TURN)], dtype=int)
    steps = np.array([_STEP * (model.furthest[0] if name == "indentation_max" else 1.0) for name in names])
    above, below = (np.tile(vector, (inner.size, 1)) for _ in range(2))
    rows = np.arange(inner.size)
    above[rows, inner] = np.minimum(vector + steps, high)[inner]
    below[rows, inner] = np.maximum(vector - steps, low)[inner]
    width = above[rows, inner] - below[rows, inner]
    column = np.zeros((2 * inner.size + 1, 1))
    scenes = Scenes(*(value + column for value in model.scenes(np.concatenate([above, below, vector[None]]))))
    radius = np.where(drawn.radius[within] == drawn.scene.rim, scenes.rim, drawn.radius[within])
    states = model.states(scenes, radius, np.where(within <= turn, scenes.root, 1.0))[:2]
    at = within == turn
    if drawn.pressed is not None:
        states[:, :, at] += drawn.pressed * np.stack(model.flat(scenes, radius[:, at]))

    def change(values: Any) -> Floats:
        return np.asarray((values[..., : inner.size, :] - values[..., inner.size : -1, :]) / width[:, None])

    moved[within[:, None], :, inner] = change(states).transpose(2, 1, 0)
    by_load = drawn.aim[1] == 1.0
    missed = np.zeros(len(names))
    share = -scenes.compliance if model.turns and not by_load else drawn.aim[1]
    level = drawn.aim[0] * states[0][:, at] + share * states[1][:, at] - (scenes.turn if model.turns else 0.0)
    missed[inner] = change(level)[:, 0]
    if not model.turns:
        zeros = {OFFSETS[int(by_load)]: 1.0, TILT: by_load * model.furthest[0], TURN: -1.0}
        missed += [zeros.get(name, 0.0) for name in names]
    return missed


def _slide(model: LoopModel, drawn: LoopPath, within: Integers, moved: Floats, along: Floats, missed: Floats) -> None:
    """Move corners along their branches: the turn until nothing is missed, landings to where their jumps are."""
    turn, rows = drawn.turn, slice(drawn.turn, drawn.turn + (1 if drawn.pressed is not None else 2))  # pinned at a rim
    if drawn.pressed is not None:
        along[turn] = model.flat(drawn.scene, drawn.scene.rim)
    ahead = float(along[turn] @ drawn.aim)
    if (drawn.radius[turn] < drawn.scene.rim or drawn.pressed is not None) and not drawn.jump[turn] and ahead > 0.0:
        moved[rows] -= along[rows, :, None] * missed / ahead
    for landing in within[drawn.jump[within]]:
        if landing != turn + 1 and along[landing, model.driven] != 0.0:
            behind = moved[landing - 1, model.driven] - moved[landing, model.driven]
            moved[landing] += along[landing, :, None] * behind / along[landing, model.driven]
    for apart in np.flatnonzero(drawn.jump & (drawn.radius == 0.0)):
        moved[apart, 0] = moved[apart - 1, 0]
