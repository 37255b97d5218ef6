"""The slopes of a sum over waves: those of each jump, summed as waves/cosine_sum.py sums the energies of jumps.

At a fixed index of the wave the slope is as smooth a function of the index as the loss, with the same branch points; at
the inner one its power is 1/2 in the place of 3/2, for which Gauss's rule in v is exact as well.
"""

import math
from typing import Final

from gradhesion.core.compiler.jit import NO, YES, kernel
from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.curve.cosine_energy import LONG, NODES, SHORT_NODES, SHORT_WEIGHTS, WEIGHTS, panel_above
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.sensitivities.jump_slopes import BEND, DEPTH, EXPONENT, GAIN, SLOPES, panel_slopes_above
from gradhesion.core.sensitivities.neighbours import Near
from gradhesion.core.types import Slopes, Table, Work
from gradhesion.core.waves.cosine import ends_of_jump, slope_at
from gradhesion.core.waves.cosine_sum import (
    _DIRECT,
    _EDGE,
    _EVEN,
    _FIRST,
    _FRACTION,
    _LONG,
    _LONGEST,
    _PART,
    _WIDE,
    branch_points,
    limit_terms,
    limits,
    place_and_share,
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
    start, landing, left = ends_of_jump(table, curve, whole, outwards)
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
        _, _, _, z, height, stretch = slope_at(tables[j], other, whole, start)
        left = (z, height, stretch)
        for i in range(panels):
            loss = panel_above(tables[j], other, whole, start, left, low + i * width, width, work)
            found[EXPONENT] += sign * weights[j] * loss


@kernel()
def _add_part(
    table: Table,
    curve: Cosine,
    near: Near,
    waves: tuple[float, float],
    at: tuple[float, bool],
    outwards: bool,
    work: Work,
    total: Slopes,
) -> None:
    """Add the integral between two waves in y or in v, as `at` says, which begins with the branch point of that.

    The rest is as of `add_slopes_of_waves`.
    """
    found = work[_SAMPLES + 2 * _EDGE * SLOPES : _SAMPLES + (2 * _EDGE + 1) * SLOPES]
    _, in_y = at
    nodes, weights = (NODES, WEIGHTS) if in_y else (SHORT_NODES, SHORT_WEIGHTS)
    point, low, width = limits(waves[0], waves[1], at)
    for i in range(nodes.size):
        place = low + width * nodes[i]
        wave, share = place_and_share(point, place, weights[i], in_y)
        slopes_of_wave(table, curve, near, wave, outwards, work, found)
        total += (share * width) * found


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
        _add_part(table, curve, near, (begin, middle), (inner, NO), outwards, work, total)
        begin = middle
    if end > _LONGEST * begin:
        _add_part(table, curve, near, (begin, _FRACTION * end), (outer, YES), outwards, work, total)
        begin = _FRACTION * end
    _add_part(table, curve, near, (begin, end), (outer, YES), outwards, work, total)


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
