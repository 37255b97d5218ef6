"""The results of a scene as the loops store them: a row each, and what they need on the way."""

from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.curve.folds import CHUNK
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
    """Room for the curves of one task, so that nothing is allocated in its loops.

    closing, opening, measured   traces
    visited, stack               columns of branches, (bins,)
    closing_nodes, closing_polys, opening_nodes, opening_polys   tables of interfaces with a pattern
    slopes                       (CHUNK,)
    limits                       (2,), those of `loading_is_one_disc`
    """

    closing: Floats
    opening: Floats
    measured: Floats
    visited: Integers
    stack: Integers
    closing_nodes: Floats
    closing_polys: Floats
    opening_nodes: Floats
    opening_polys: Floats
    slopes: Floats
    limits: Floats


def rooms_for(bins: int, patterned: bool) -> Rooms:
    """Return room for tables of that many bins."""
    closing, opening = (room_of(bins if patterned else 0, LANES + 1) for _ in range(2))
    traces = [room_for(bins) for _ in range(3)]
    columns = [np.empty(bins + 8, dtype=np.int64) for _ in range(2)]
    return Rooms(*traces, *columns, *closing, *opening, np.empty(CHUNK), np.empty(2))
