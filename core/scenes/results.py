"""The results of a scene as the loops store them: a row each, and what they need on the way."""

from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.curve.trace import room_for
from gradhesion.core.table.basis import room_of
from gradhesion.core.table.layout import LANES
from gradhesion.core.types import Floats, Integers

# Rows of results, (rows, scenes): forces in 1.5 pi R dgamma, lengths in R, energies in R^2 dgamma.
FORCE, PULL_OFF_RADIUS, ENERGY, LOADING, UNLOADING, LOADING_JUMPS, UNLOADING_JUMPS = range(7)
DEEPEST, JUMP_OUT, TURN, FRONT, PINNED, SNAP, REACH, RESIDUAL, SATURATION, STATUS = range(7, 17)
RESULT_ROWS: Final = 17
NAMES: Final = (
    "pull_off_force",
    "pull_off_radius",
    "dissipated_energy",
    "loading_energy",
    "unloading_energy",
    "loading_jumps",
    "unloading_jumps",
    "delta_max",
    "delta_jump_out",
    "turning_radius",
    "front_energy",
    "pinned_depth",
    "snap_in_force",
    "reach",
    "energy_residual",
    "saturation_radius",
)
"""Their names, in the order of the rows."""
INTEGERS: Final = ("loading_jumps", "unloading_jumps")
"""Results that are counts."""

SHORT: Final = -1.0
"""In the place of a status: the table is too short."""


class Wanted(NamedTuple):
    """What of a scene is wanted."""

    cycle: bool  # anything but the pull-off
    depth: bool  # the depth at rims beyond the table
    contact: bool  # whether loading keeps the contact one disc
    residual: bool  # the loop integral
    saturation: bool  # the radius beyond which there is no fold


class Rooms(NamedTuple):
    """Room for the curves of one task, so that little is allocated in its loops.

    traces      of closing, of opening, and of what is measured for the turn, (3, ROWS, branches)
    columns     those that loading visits, and a stack of unloading, (2, branches)
    nodes       of the tables of closing and of opening of interfaces with a pattern, (2, ROWS, bins + 1)
    polys       their polynomials, (2, bins, LANES + 1, N)
    limits      those of `loading_is_one_disc` of the last curve, (2,)
    """

    traces: Floats
    columns: Integers
    nodes: Floats
    polys: Floats
    limits: Floats


def rooms_for(bins: int, patterned: bool) -> Rooms:
    """Return room for tables of that many bins."""
    nodes, polys = room_of(bins if patterned else 0, LANES + 1)
    traces = np.empty((3, *room_for(bins).shape))
    columns = np.empty((2, traces.shape[2]), dtype=np.int64)
    return Rooms(traces, columns, np.stack((nodes, nodes)), np.stack((polys, polys)), np.empty(2))
