"""From the numbers of scenes to the results of their moving edges: one scene at a time."""

import math
from collections.abc import Callable
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.cosine import force_unit
from gradhesion.core.curve.general import Basis, Made, curve_at
from gradhesion.core.harmonics.series import highest_harmonic
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.problem.curves import GeneralCurves
from gradhesion.core.problem.rate import MOST_WAVES
from gradhesion.core.problem.status import NO_CONTACT, NO_VALUE, PULL_OFF_AT_RIM, TOLERANCE_NOT_MET, TOO_MANY_WAVES
from gradhesion.core.rate.closing import close_edge
from gradhesion.core.rate.law import Law
from gradhesion.core.rate.opening import open_edge
from gradhesion.core.rate.place import coordinate_of, load_of, place_at
from gradhesion.core.rate.step import Room, room_for_steps
from gradhesion.core.rate.stopping import stop_edge
from gradhesion.core.types import Floats, Integers

PROMISED: Final = 1e-9
"""Estimated error of force and energy above which a scene is reported."""
_SLOWEST: Final = 1e-15
"""(V/v*)^n below which a step may pass the end of a branch unseen: the lag there is below rounding."""
_AT_RIM: Final = 1e-9
"""Relative distance, over a_t, below which an edge has not moved."""
OPENED: Final = (
    "pull_off_force",
    "pull_off_radius",
    "opening_energy",
    "delta_jump_out",
    "edge_speed_at_pull_off",
    "pull_off_force_error",
    "opening_energy_error",
)
"""The results of opening, in the order of the rows."""
CLOSED: Final = (
    "turning_radius",
    "closing_energy",
    "radius_at_turn",
    "depth_at_turn",
    "coordinate_at_turn",
    "load_at_turn",
    "depth_edge_stops",
    "coordinate_edge_stops",
    "load_edge_stops",
    "rho_edge_stops",
    "closing_energy_error",
)
"""The results of closing, in the order of the rows."""


class Edges(NamedTuple):
    """Scenes of one profile, control, exponent of the gradient and law; arrays have the shape (scenes,)."""

    curves: GeneralCurves  # each with one rim: a_t/R of opening, a_max/R of closing
    speeds: Floats  # V/v*
    power: float  # n of the law
    ratios: Floats  # Gamma of closing; opening does not read it
    turns: Floats  # Y/R at which the machine turns, inf where it does at the rim; opening does not read it


@kernel()
def _is_in_range(made: Made, edges: Edges, i: int) -> bool:
    """Return whether scene number i, the curve of which is given, can be solved."""
    valid = made.valid and edges.curves.compliance[i] < math.inf
    return valid and edges.curves.rims[i, 0] > 0.0 and 0.0 < edges.speeds[i] < math.inf


@kernel()
def _shortest_wave(made: Made) -> float:
    """Return the shortest wave in wavelengths, inf of a smooth punch."""
    highest = highest_harmonic(made.series)
    return 1.0 / highest if highest > 0.0 else math.inf


@kernel()
def _open(waves: Basis, made: Made, edges: Edges, i: int, room: Room, out: Floats) -> int:
    """Solve scene number i, the curve of which is given; return its status."""
    curve, wavelength, length, unit = made.curve, made.wavelength, made.length, made.depth
    x, shortest = edges.curves.rims[i, 0] / wavelength, _shortest_wave(made)
    if not _is_in_range(made, edges, i) or not x < math.inf:
        return NO_VALUE
    if x > MOST_WAVES * shortest:
        return NO_VALUE | TOO_MANY_WAVES
    law = Law(edges.power, 1.0, 1.0, edges.speeds[i] * length * curve.alpha / unit)
    opened = open_edge(waves, curve, law, x, shortest, room)
    force, area = force_unit(waves.table.k, length, unit), TWO_PI * length * length
    if not abs(area * opened.energy) < math.inf or not abs(force * opened.load) < math.inf:
        return NO_VALUE
    out[0, i], out[1, i] = -force * opened.load, length * opened.z
    out[2, i], out[3, i], out[4, i] = area * opened.energy, unit * opened.depth, opened.speed
    out[5, i], out[6, i] = force * opened.of_load, area * opened.of_energy
    status = PULL_OFF_AT_RIM if opened.z >= (1.0 - _AT_RIM) * TWO_PI * x else 0
    too_slow = edges.speeds[i] ** edges.power < _SLOWEST
    if too_slow or opened.of_load > PROMISED * abs(opened.load) or opened.of_energy > PROMISED * opened.energy:
        status |= TOLERANCE_NOT_MET
    return status


@kernel()
def _put_state(waves: Basis, made: Made, x: float, rho: float, out: Floats, row: int, i: int) -> None:
    """Store depth and coordinate in R, and the load in 1.5 pi R dgamma, of a state."""
    curve, unit = made.curve, made.depth
    place = place_at(waves, curve, x)
    out[row, i] = unit * (place.depth - place.adhesion * rho)
    out[row + 1, i] = unit / curve.alpha * coordinate_of(curve, place, rho)
    out[row + 2, i] = force_unit(waves.table.k, made.length, unit) * load_of(place, rho)


@kernel()
def _close(waves: Basis, made: Made, edges: Edges, i: int, room: Room, out: Floats) -> int:
    """Solve scene number i, the curve of which is given; return its status."""
    curve, wavelength, length, unit = made.curve, made.wavelength, made.length, made.depth
    shortest, a_max, ratio = _shortest_wave(made), edges.curves.rims[i, 0], edges.ratios[i]
    rim, target = a_max / wavelength, edges.turns[i] * curve.alpha / unit
    if not _is_in_range(made, edges, i) or not 0.0 < ratio <= 1.0 or not (rim < math.inf or target < math.inf):
        return NO_VALUE
    if target < 0.0:
        out[1, i], out[10, i] = 0.0, 0.0
        return NO_CONTACT
    law = Law(edges.power, math.sqrt(ratio), -1.0, edges.speeds[i] * length * curve.alpha / unit)
    size = edges.curves.stretch[i] ** (2.0 / (3.0 + waves[0].k)) / wavelength
    furthest = MOST_WAVES * shortest
    if rim < math.inf and rim > furthest and target == math.inf:
        return NO_VALUE | TOO_MANY_WAVES
    turn = close_edge(waves, curve, law, rim, shortest, (size, furthest, target), room)
    end = stop_edge(waves, curve, law, rim, shortest, turn, furthest, room.track) if turn.turned else turn
    if not (end.x > 0.0 and turn.x > 0.0 and end.energy < math.inf):
        return NO_VALUE | (TOO_MANY_WAVES if end.furthest > furthest else 0)
    area = TWO_PI * length * length
    out[0, i] = a_max if end.x == rim else wavelength * end.x
    out[1, i] = area * end.energy
    out[2, i] = a_max if turn.x == rim else wavelength * turn.x
    _put_state(waves, made, turn.x, law.root - turn.lag, out, 3, i)
    _put_state(waves, made, end.x, law.root - end.lag, out, 6, i)
    out[9, i], out[10, i] = law.root - end.lag, area * end.of_energy
    too_slow = edges.speeds[i] ** edges.power < _SLOWEST
    return TOLERANCE_NOT_MET if too_slow or end.of_energy > PROMISED * (TWO_PI * end.x) ** 2 else 0


def loop_of(*, opens: bool) -> Callable[..., None]:
    """Return the kernel that opens many scenes, or closes them: numba drops the other before it compiles it."""

    @kernel()
    def move_edges(basis: Basis, edges: Edges, out: Floats, status: Integers) -> None:
        """Solve scenes; `out` has the rows of `OPENED` or `CLOSED`, (rows, scenes), NaN where nothing is stored."""
        room = room_for_steps()
        for i in edges.curves.numbers:
            made = curve_at(basis, edges.curves, i)
            waves = Basis(basis.table, made.cosine_bins, made.series)
            if opens:
                status[i] = _open(waves, made, edges, i, room, out)
            else:
                status[i] = _close(waves, made, edges, i, room, out)

    return move_edges


open_scenes: Final = loop_of(opens=True)
close_scenes: Final = loop_of(opens=False)


@kernel()
def track_edge(basis: Basis, edges: Edges, inwards: bool, points: int) -> tuple[int, Floats]:
    """Follow the edge of the one scene that there is; return its status, and where it has been.

    That is an array of shape (3, points): radii and depths in R, loads in 1.5 pi R dgamma.
    """
    room, out, i = room_for_steps(points), np.empty((len(CLOSED), 1)), 0
    made = curve_at(basis, edges.curves, i)
    waves = Basis(basis.table, made.cosine_bins, made.series)
    status = _open(waves, made, edges, i, room, out) if inwards else _close(waves, made, edges, i, room, out)
    number = int(room.track[0, 0])
    found, force = np.empty((3, number)), force_unit(basis.table.k, made.length, made.depth)
    for j in range(number):
        x, rho = room.track[0, j + 1], room.track[1, j + 1]
        place = place_at(waves, made.curve, x)
        found[0, j] = x * made.wavelength
        found[1, j] = made.depth * (place.depth - place.adhesion * rho)
        found[2, j] = force * load_of(place, rho)
    return status, found
