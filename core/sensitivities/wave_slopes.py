"""The slopes of a sum over waves: those of each jump, summed as waves/cosine_sum.py sums the energies of jumps.

At a fixed index of the wave the slope is as smooth a function of the index as the loss, with the same branch points; at
the inner one its power is 1/2 in the place of 3/2, for which Gauss's rule in v is exact as well.
"""

import math
from typing import Final

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.curve.cosine_energy import LONG, NODES, SHORT_NODES, SHORT_WEIGHTS, WEIGHTS, panel_above
from gradhesion.core.sensitivities.jump_slopes import BEND, DEPTH, EXPONENT, GAIN, SLOPES, panel_slopes_above
from gradhesion.core.sensitivities.neighbours import Near
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.types import Slopes, Table, Work
from gradhesion.core.waves.cosine import _fold, _landing, _slope
from gradhesion.core.waves.cosine_sum import (
    _DIRECT,
    _EDGE,
    _EVEN,
    _FIRST,
    _FRACTION,
    _LONG,
    _LONGEST,
    _PART,
    _REMOTE,
    _WIDE,
    branch_points,
    inner_limits,
    limit_terms,
    outer_limits,
)

_SAMPLES: Final = 64
"""Where the rows of `work` begin that hold slopes: the nodes of a panel stand before them."""
ROOM: Final = 112
"""Number of floats of `work`."""


@kernel()
def slopes_of_wave(
    table: Table, curve: Cosine, near: Near, wave: float, outwards: bool, work: Work, found: Slopes
) -> None:
    """Put the slopes of the jump from a wave to the next one, as waves/cosine.py finds it, into `found`."""
    tables, curves, weights = near
    whole = wave - 2.0
    centre = table.phase / TWO_PI + 2.0
    start = _fold(table, curve, whole, centre, not outwards)
    _, _, _, z, height, stretch = _slope(table, curve, whole, start)
    left = (z, height, stretch)
    landing = _landing(table, curve, whole, left, start, centre + (1.0 if outwards else -1.0), not outwards)
    low, high = min(start, landing), max(start, landing)
    panels = int((high - low) / LONG) + 1
    width = (high - low) / panels
    sign = TWO_PI if outwards else -TWO_PI
    found[:] = 0.0
    for i in range(panels):
        bend, gain, level = panel_slopes_above(table, curve, whole, start, left, low + i * width, width, work)
        found[BEND] += sign * bend
        found[GAIN] += sign * gain
        found[DEPTH] += sign * level
    for j in range(weights.size):
        other = Cosine(curves[j, 0], curves[j, 1], 0.0)
        _, _, _, z, height, stretch = _slope(tables[j], other, whole, start)
        left = (z, height, stretch)
        for i in range(panels):
            loss = panel_above(tables[j], other, whole, start, left, low + i * width, width, work)
            found[EXPONENT] += sign * weights[j] * loss


@kernel()
def _add_outer_part(
    table: Table,
    curve: Cosine,
    near: Near,
    waves: tuple[float, float],
    outer: float,
    outwards: bool,
    work: Work,
    total: Slopes,
) -> None:
    """Add the integral in y between two waves; `outer` is a branch point, the rest as of `add_slopes_of_waves`."""
    begin, end = waves
    found = work[_SAMPLES + 2 * _EDGE * SLOPES : _SAMPLES + (2 * _EDGE + 1) * SLOPES]
    outer = min(max(outer, end), _REMOTE * end)
    low, width = outer_limits(begin, end, outer)
    for i in range(NODES.size):
        y = low + width * NODES[i]
        rest = 1.0 - y * y
        slopes_of_wave(table, curve, near, outer * rest**4, outwards, work, found)
        total += (WEIGHTS[i] * 8.0 * outer * y * rest**3 * width) * found


@kernel()
def _add_inner_part(
    table: Table,
    curve: Cosine,
    near: Near,
    waves: tuple[float, float],
    inner: float,
    outwards: bool,
    work: Work,
    total: Slopes,
) -> None:
    """Add the integral in v between two waves; `inner` is a branch point, the rest as of `add_slopes_of_waves`."""
    begin, end = waves
    found = work[_SAMPLES + 2 * _EDGE * SLOPES : _SAMPLES + (2 * _EDGE + 1) * SLOPES]
    inner = min(inner, begin)
    low, width = inner_limits(begin, end, inner)
    for i in range(SHORT_NODES.size):
        v = low + width * SHORT_NODES[i]
        slopes_of_wave(table, curve, near, inner + v * v, outwards, work, found)
        total += (SHORT_WEIGHTS[i] * 2.0 * v * width) * found


@kernel()
def _add_integral(
    table: Table,
    curve: Cosine,
    near: Near,
    waves: tuple[float, float],
    points: tuple[float, float],
    outwards: bool,
    work: Work,
    total: Slopes,
) -> None:
    """Add the integral over the index between two waves; `points` are the branch points of waves/cosine_sum.py."""
    begin, end = waves
    inner, outer = points
    if inner > _WIDE * begin or end > _LONG * begin:
        middle = max(begin, min(_PART * max(inner, begin), math.sqrt(begin * end)))
        _add_inner_part(table, curve, near, (begin, middle), inner, outwards, work, total)
        begin = middle
    if end > _LONGEST * begin:
        _add_outer_part(table, curve, near, (begin, _FRACTION * end), outer, outwards, work, total)
        begin = _FRACTION * end
    _add_outer_part(table, curve, near, (begin, end), outer, outwards, work, total)


@kernel()
def add_slopes_of_waves(
    table: Table,
    curve: Cosine,
    near: Near,
    waves: tuple[float, float],
    outwards: bool,
    final: float,
    work: Work,
    total: Slopes,
) -> None:
    """Add the slopes of what the jumps from the first to the last of some waves lose, as `sum_of_waves` does.

    The arguments are those of core/face.py; `work` is of shape (ROOM,), `total` of shape (SLOPES,), in 2 pi l^2 dgamma.
    """
    first, last = waves
    found = work[_SAMPLES + 2 * _EDGE * SLOPES : _SAMPLES + (2 * _EDGE + 1) * SLOPES]
    points = branch_points(table, curve, final, outwards)
    if last - first > _EVEN:
        _add_integral(table, curve, near, (first - 0.5, last + 0.5), points, outwards, work, total)
        return
    if last - first < _DIRECT:
        wave = first
        while wave <= last:
            slopes_of_wave(table, curve, near, wave, outwards, work, found)
            total += found
            wave += 1.0
        return
    values = work[_SAMPLES : _SAMPLES + 2 * _EDGE * SLOPES].reshape((SLOPES, 2 * _EDGE))
    for i in range(_FIRST + _EDGE):
        slopes_of_wave(table, curve, near, first + i, outwards, work, found)
        if i < _FIRST:
            total += found
        if i >= _FIRST - _EDGE:
            values[:, i - _FIRST + _EDGE] = found
    for j in range(SLOPES):
        total[j] += limit_terms(values[j])
    for i in range(2 * _EDGE):
        slopes_of_wave(table, curve, near, last - (2 * _EDGE - 1) + i, outwards, work, found)
        values[:, i] = found
        if i >= _EDGE:
            total += found
    for j in range(SLOPES):
        total[j] -= limit_terms(values[j])
    _add_integral(table, curve, near, (first + _FIRST - 0.5, last - _EDGE + 0.5), points, outwards, work, total)
