"""How the path of a loop moves with what is fitted.

A distance to a curve changes only as the curve moves normal to itself, not as its vertices move along it. So vertices
are moved at fixed contact radius, those at the rim with it, where depth and load are closed forms (model.py), and no
derivative of a fold is needed: it is a stationary point. Corners are moved along their branches as well: a landing
stays at the coordinate of its jump, and the turn, with the radius at which the edge is pinned, at that of the data.
Closed forms are differentiated by central differences, good to 1e-9.
"""

from typing import Final

import numpy as np

from gradhesion.core.loops.paths.offsets import DEPTH_ZERO, LOAD_ZERO, TILT
from gradhesion.core.loops.paths.offsets import NAMES as OFFSETS
from gradhesion.core.loops.paths.path import LoopModel, LoopPath
from gradhesion.core.types import Floats

_STEP: Final = 1e-5
"""Relative step of the differences: their error is of its square, or of 1e-16 over it."""


def moving(model: LoopModel, vector: Floats, drawn: LoopPath) -> Floats:
    """Return how the vertices of a path move with each number that is searched.

    Returns
    -------
    Of shape (vertices, 2, numbers). Out of contact vertices move with the offsets alone.
    """
    count = len(model.names)
    moved = np.zeros((drawn.radius.size, 2, count))
    inner = [i for i, name in enumerate(model.names) if name not in OFFSETS]
    within = np.flatnonzero(drawn.radius > 0.0)
    if inner and within.size:
        steps = np.full(len(inner), _STEP)
        if "indentation_max" in model.names:
            steps[model.names.index("indentation_max")] *= model.furthest[0]
        both = np.zeros((2 * len(inner), count))
        both[range(len(inner)), inner], both[range(len(inner), 2 * len(inner)), inner] = steps, -steps
        scenes = model.scenes(vector + both)
        edge = np.where(within <= drawn.turn, scenes.root, 1.0)
        radius, shape = drawn.radius[within][None], (2 * len(inner), within.size)
        if drawn.is_pressed:
            radius = np.where(radius == drawn.scene.rim, scenes.rim, radius)
        found = model.states(scenes, radius)
        depth, load = found.at(edge)
        if not depth.shape == load.shape == shape:  # only the compliance, the turn or the rim is searched
            depth, load = (np.array(np.broadcast_to(row, shape)) for row in (depth, load))
        if drawn.is_pressed:
            at = np.flatnonzero(within == drawn.turn)
            aim, flat = _turned(model, vector, drawn)[int(drawn.by_load)], found.slope[:, at]
            deeper = model.deeper(scenes, aim, depth[:, at], load[:, at], flat)
            depth[:, at] += deeper
            load[:, at] += flat * deeper
        places = np.array([depth + scenes.compliance * load, load])
        moves = (places[:, : len(inner)] - places[:, len(inner) :]) / (2.0 * steps[:, None])
        moved[within[0] : within[-1] + 1, :, inner] = moves.transpose(2, 0, 1)
    tilt = model.shift(vector)[2]
    if within.size:
        _slide(model, drawn, moved, _turned(model, vector, drawn)[1])
    for axis, name in enumerate((DEPTH_ZERO, LOAD_ZERO)):
        if name in model.names:
            moved[:, axis, model.names.index(name)] += 1.0
    moved[:, 1] += tilt * moved[:, 0]
    if TILT in model.names:
        moved[:, 1, model.names.index(TILT)] += drawn.places[:, 0]
    return moved


def _turned(model: LoopModel, vector: Floats, drawn: LoopPath) -> tuple[float, float]:
    """Return the depth (of the machine, unless that of the specimen is given) and the load of the turn, unshifted."""
    depth, load, tilt = model.shift(vector)
    x, y = (float(each) for each in drawn.places[drawn.turn])
    y -= load + tilt * x
    return x - depth - (drawn.scene.compliance * y if model.turns_at_depth else 0.0), y


def _slide(model: LoopModel, drawn: LoopPath, moved: Floats, load_max: float) -> None:
    """Move the turn, at a load, and the places where jumps land, along their branches to stay at their coordinates."""
    scene, turn, axis = drawn.scene, drawn.turn, int(model.loading.control == "load")
    landings = np.flatnonzero(drawn.jump & (drawn.radius > 0.0))
    at = np.concatenate([[turn, turn + 1], landings])
    steps = 1.0 + _STEP * np.repeat([1.0, -1.0], at.size)
    states = model.states(scene, np.tile(drawn.radius[at], 2) * steps)
    depth, load = states.at(np.tile(np.where(at <= turn, scene.root, 1.0), 2))
    both = np.column_stack([depth + scene.compliance * load, load])
    along = (both[: at.size] - both[at.size :]) / (2.0 * _STEP * drawn.radius[at, None])
    if drawn.is_pressed:
        flat = 0.5 * float(states.slope[0] + states.slope[at.size])
        along[0] = [1.0 + scene.compliance * flat, flat]
    if (drawn.radius[turn] < scene.rim or drawn.is_pressed) and not drawn.jump[turn]:
        by = int(drawn.by_load)
        rates = {"indentation_max": 1.0, "preload": scene.turn}
        if not model.turns:
            rates = {OFFSETS[by]: -1.0, TILT: -by * model.furthest[0]}
        target = np.array([rates.get(name, 0.0) for name in model.names])
        gone, ahead = moved[turn, by].copy(), along[0, by]
        if by == 0 and model.turns_at_depth:  # depth of the specimen: the machine's less the stretch of its spring
            gone -= scene.compliance * moved[turn, 1]
            ahead -= scene.compliance * along[0, 1]
            if "spring_constant" in model.names:
                gone[model.names.index("spring_constant")] += scene.compliance * load_max
        if ahead > 0.0:
            rate = (target - gone) / ahead
            ends = 1 if drawn.is_pressed else 2  # at the rim the edge is pinned
            moved[turn : turn + ends] += along[:ends, :, None] * rate
    for landing, slope in zip(landings, along[2:], strict=True):
        if slope[axis] != 0.0 and landing != turn + 1:
            moved[landing] += slope[:, None] * (moved[landing - 1, axis] - moved[landing, axis]) / slope[axis]
    for apart in np.flatnonzero(drawn.jump & (drawn.radius == 0.0)):
        moved[apart, 0] = moved[apart - 1, 0]
