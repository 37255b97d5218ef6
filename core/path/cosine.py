"""A cycle of loading and unloading under displacement control: its jumps and the energy that they cost.

A curve of moderate length is walked branch by branch, once for all its rims: loading does not depend on the rim until
it gets there, and unloading does not depend on where it came from. A long one is not walked (path/cosine_long.py).
"""

import math
from typing import Final

from gradhesion.core.compiler.jit import NONE, kernel
from gradhesion.core.curve.branches import GAP, RUN, Trace, append_branches, room_for
from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.curve.cosine_folds import first_arch, last_arch
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.loading import load_up
from gradhesion.core.path.ties import note_loading
from gradhesion.core.types import Table

LONGEST_WALK: Final = 160.0
"""Arches, two a wave, up to which a curve is walked."""
COUNTABLE: Final = 2.0**53
LARGEST: Final = 1e60
"""Bend and gain of a curve, and waves within its rim, above which powers of them may overflow."""
SMALLEST: Final = 1e-60
"""Radius over wavelength below which powers of it may underflow."""
_FURTHEST: Final = 1e300
"""An arch that stands for all beyond: numbers of arches are subtracted from each other."""
MOST_ARCHES: Final = 2.0e9
"""Arches up to which a double resolves the phase of a radius well enough to walk there."""
_NEGLIGIBLE: Final = 2.0**-56
"""Curvature of the waviness over that of the paraboloid below which it is lost in rounding."""


@kernel()
def extent(table: Table, curve: Cosine) -> tuple[float, float]:
    """Return the first and the last arch on which the curve can fold."""
    level = 0.5 * (1.0 - table.k)
    return min(_FURTHEST, first_arch(table, curve, level)), min(_FURTHEST, last_arch(table, curve, level))


@kernel()
def is_long(table: Table, arches: tuple[float, float], rim: float) -> bool:
    """Return whether a rim is too far out to walk there."""
    return min(arches[1], 2.0 * rim - table.phase / math.pi) - arches[0] > LONGEST_WALK


@kernel()
def is_endless_wave(wavelength: float, amplitude: float) -> bool:
    """Return whether a wave (lambda/R, A) is so long that its curvature 4 pi^2 A/lambda is nothing beside 1/R."""
    return TWO_PI * TWO_PI * amplitude <= _NEGLIGIBLE * wavelength


@kernel()
def is_unresolved(arches: tuple[float, float], rim: float) -> bool:
    """Return whether a rim has no value: up to it folds are beyond counting, or powers of it underflow."""
    return min(arches[1], 2.0 * rim) > COUNTABLE or rim < SMALLEST or LARGEST < rim < math.inf


@kernel()
def is_smooth(arches: tuple[float, float]) -> bool:
    """Return whether folds could stand only so far out, and on so few waves, that they are of the size of rounding."""
    return arches[0] > MOST_ARCHES and arches[1] - arches[0] <= LONGEST_WALK


@kernel()
def walk(
    table: Table, curve: Cosine, arches: tuple[float, float], furthest: float, trace: Trace, losses: bool
) -> tuple[int, Trace]:
    """Walk a curve of moderate length outwards to `furthest`; return the number of its branches and the trace."""
    first, final = arches
    trace = room_for(trace, min(final, 2.0 * furthest) - first + 8.0)
    count = append_branches(table, curve, int(min(first, COUNTABLE)), final, furthest, trace, NONE)
    trace[RUN, GAP] = math.inf
    load_up(table, curve, count, trace, furthest, losses)
    note_loading(table, curve, count, trace, furthest)
    return count, trace
