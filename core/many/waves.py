"""Waves far out: the bins of any of them, mixed from a few, and sums of what is smooth in their number.

Wave w begins at y = 2 pi w + cut, where waves fall most steeply. All that its bins hold is a smooth function of w, once
powers of the radius are taken out: known at ten places of each doubling of w, it is known everywhere, at a fifth of the
price of new bins. The number need not be whole: the phase of the waves is kept, the radius alone follows.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.jit import allocating, kernel, leaf, quadrature
from gradhesion.core.table import layout as at
from gradhesion.core.table.filling import fill_bins
from gradhesion.core.table.layout import LANES, N, Source, Table
from gradhesion.core.types import Floats

FIRST_WAVE: Final = 16
"""Where the first doubling begins: far enough out for the expansions of filling.py."""
PLACES: Final = 10
"""Places of a doubling: what is left of w^(-1/2) there is 1e-17."""
_EDGE: Final = (at.V, at.U, at.U1, at.P, at.SLOPE, at.E)
"""Rows of an edge that are mixed."""
_BIN: Final = (at.K0, at.K1, at.K2, at.KU, at.KUU, at.KV, at.PC, at.BV, at.BP, at.BE)
"""Rows of a bin that are mixed."""
_LANES_AT: Final = len(_EDGE) + len(_BIN)
SIZE: Final = _LANES_AT + LANES * N
"""Numbers of a bin that are mixed, in this order: _EDGE of its lower edge, _BIN, its polynomials lane by lane."""
_ANGLES = (np.arange(PLACES) + 0.5) * np.pi / PLACES
_PLACE = 0.5 - 0.5 * np.cos(_ANGLES)
"""Chebyshev's points, in the logarithm to base 2."""
_BARYCENTRIC = np.sin(_ANGLES) * (-1.0) ** np.arange(PLACES)
GAUSS: Final = 10
"""Places at which a sum over waves is sampled."""
_LEGENDRE = np.polynomial.legendre.leggauss(GAUSS)[0]


class Waves(NamedTuple):
    """The bins of one wave of a table, at chosen numbers.

    k, exponent, share, width, lowest   as of the table
    steepest    a bound of -U' y^((k-1)/2)
    cut         y at which wave 0 begins
    per         bins of a wave
    values      (doublings, per + 1, PLACES, SIZE); the last bin is an edge alone
    sums        integrals from 0 to where each doubling begins: of y^k times U, y^m U and U^2, (doublings, 3)
    """

    k: float
    exponent: float
    share: float
    width: float
    lowest: float
    steepest: float
    cut: float
    per: int
    values: Floats
    sums: Floats


@leaf
def start_of(waves: Waves, number: float) -> float:
    """Return the y at which a wave begins."""
    return 2.0 * math.pi * number + waves.cut


@leaf
def wave_of(waves: Waves, y: float) -> float:
    """Return the number of waves up to y, which is whole where a wave begins."""
    return (y - waves.cut) / (2.0 * math.pi)


@leaf
def _fill_scales(k: float, m: float, y: float, scales: Floats) -> None:
    """Put into `scales` (SIZE,), in the order of what is mixed, the powers of y that are taken out of it.

    y is where a wave begins.
    """
    power = y * y if m == 2.0 else y**m
    stretch = y ** (-0.5 * (1.0 + k))
    crest = y * stretch
    to_k = 1.0 / (stretch * stretch * y)
    scales[0] = scales[1] = crest  # V, U
    scales[2], scales[3], scales[4], scales[5] = 1.0, power, power / y, stretch  # U1, y^m, its slope / m, E
    bent = power / (y * y)
    scales[6], scales[7], scales[8] = to_k, to_k * bent, to_k * bent * power  # K0, K1, K2
    scales[9], scales[10], scales[11] = to_k * crest, to_k * crest * power / y, to_k * crest * crest  # KU, KUU, KV
    scales[12], scales[13], scales[14], scales[15] = power, crest, bent / y, stretch / (y * y)  # PC, BV, BP, BE
    for n in range(N):
        scales[_LANES_AT + n], scales[_LANES_AT + N + n] = crest, 1.0  # of U and U1
        scales[_LANES_AT + 2 * N + n], scales[_LANES_AT + 3 * N + n] = power, stretch  # of y^m and E


@allocating
def _fill_doubling(source: Source, index: int, doubling: int, values: Floats, nodes: Floats, polys: Floats) -> None:
    """Fill one doubling of `values`; `index` is the bin of `source` in which wave 0 would begin, the rest is room."""
    per, scales = values.shape[1] - 1, np.empty(SIZE)
    none = per - per  # not a plain 0, for which callees would be compiled once more
    for place in range(PLACES):
        number = FIRST_WAVE * 2.0 ** (doubling + _PLACE[place])
        whole = int(number)
        shift = source.shift + per * (number - whole)
        fill_bins(source, shift, per * whole + index, none, per, nodes, polys)
        _fill_scales(source.k, source.exponent, nodes[at.Y, 0], scales)
        for i in range(per + 1):
            out = values[doubling, i, place]
            for row in range(len(_EDGE)):
                out[row] = nodes[_EDGE[row], i] / scales[row]
            if i == per:
                continue
            for row in range(len(_BIN)):
                out[len(_EDGE) + row] = nodes[_BIN[row], i] / scales[len(_EDGE) + row]
            for lane in range(LANES):
                for n in range(N):
                    c = _LANES_AT + lane * N + n
                    out[c] = polys[i, lane, n] / scales[c]


@quadrature
def _mix_wave(waves: Waves, number: float, column: int, nodes: Floats, polys: Floats) -> None:
    """Put the bins of a wave into the columns from `column` on, and the edge after them."""
    k, bins, width, y = waves.k, waves.per, waves.width, start_of(waves, number)
    place = max(math.log2(number / FIRST_WAVE), 0.0)
    doubling = min(int(place), waves.values.shape[0] - 1)
    scales, weights, mixed = np.empty(SIZE), np.empty(PLACES), np.empty(SIZE)
    _fill_scales(k, waves.exponent, y, scales)
    total, exact = 0.0, -1
    for n in range(PLACES):
        distance = place - doubling - _PLACE[n]
        if distance == 0.0:
            exact = n
        weights[n] = _BARYCENTRIC[n] / distance
        total += weights[n]
    for n in range(PLACES):
        weights[n] = weights[n] / total if exact < 0 else 1.0 if n == exact else 0.0
    for i in range(bins + 1):
        size = SIZE if i < bins else len(_EDGE)
        mixed[:] = 0.0
        for n in range(PLACES):
            weight = weights[n]
            for c in range(size):
                mixed[c] += weight * waves.values[doubling, i, n, c]
        for c in range(size):
            mixed[c] *= scales[c]
        j = column + i
        low = y + i * width
        nodes[at.Y, j] = low
        for row in range(len(_EDGE)):
            nodes[_EDGE[row], j] = mixed[row]
        nodes[at.KE, j] = nodes[at.E, j]
        nodes[at.T, j] = 1.0 / (nodes[at.E, j] * nodes[at.E, j])
        if i == bins:
            return
        for row in range(len(_BIN)):
            nodes[_BIN[row], j] = mixed[len(_EDGE) + row]
        nodes[at.BV, j] *= 1.01  # a largest value, which is not quite smooth
        nodes[at.YC, j], nodes[at.HALF, j] = low + 0.5 * width, 0.5 * width
        nodes[at.M0, j] = width * (low + 0.5 * width)
        for lane in range(LANES):
            for n in range(N):
                polys[j, lane, n] = mixed[_LANES_AT + lane * N + n]


@kernel
def waves_from(waves: Waves, number: float, nodes: Floats, polys: Floats) -> Table:
    """Return a table of as many waves, from one on, as the given room holds."""
    bins = len(polys)
    nodes[at.HM, 0] = math.nan  # until `fill_from_zero`: what stands there is of other waves
    for j in range(bins // waves.per):
        _mix_wave(waves, number + j, j * waves.per, nodes, polys)
    start = start_of(waves, number)
    return Table(waves.k, waves.exponent, waves.share, start, waves.width, waves.lowest, 0, bins, nodes, polys)


@allocating
def fill_rule(count: float, places: Floats, weights: Floats, last: Floats) -> None:
    """Fill Gauss's rule for sums over 0, 1, ..., count - 1 (count > GAUSS), exact up to degree 2 GAUSS - 1.

    `last` (2, GAUSS) are the two orthonormal polynomials of the highest degrees below GAUSS, times the weights: what
    they find in the values is what the rule would begin to miss.
    """
    p = np.empty(GAUSS + 1)
    for i in range(GAUSS):
        x = _LEGENDRE[i]  # in (-1, 1); the polynomials are those of Gram
        for _ in range(20):
            p[0], p[1] = 1.0, x
            before, slope = 0.0, 1.0
            for j in range(1, GAUSS):
                share = j * j * (1.0 - (j / count) ** 2) / (4.0 * j * j - 1.0)
                p[j + 1] = x * p[j] - share * p[j - 1]
                before, slope = slope, p[j] + x * slope - share * before
            step = p[GAUSS] / slope
            if abs(step) < 1e-15:
                break
            x -= step
        norm, total = 1.0, 1.0
        for j in range(1, GAUSS):
            norm *= j * j * (1.0 - (j / count) ** 2) / (4.0 * j * j - 1.0)
            total += p[j] * p[j] / norm
            if j >= GAUSS - 2:
                last[j - GAUSS + 2, i] = p[j] / math.sqrt(norm)
        places[i], weights[i] = 0.5 * (count - 1.0) + 0.5 * count * x, count / total
        last[0, i] *= weights[i]
        last[1, i] *= weights[i]


@kernel
def _add_integrals(waves: Waves, number: float, weight: float, nodes: Floats, polys: Floats, sums: Floats) -> None:
    """Add the integrals of y^k times U, y^m U and U^2 over wave `number`, times `weight`, to `sums` (3,).

    `nodes` (ROWS, per + 1) and `polys` (per, LANES, N) are room for the bins of that wave.
    """
    waves_from(waves, number, nodes, polys)
    for i in range(waves.per):
        sums[0] += weight * nodes[at.KU, i]
        sums[1] += weight * (nodes[at.KUU, i] + nodes[at.PC, i] * nodes[at.KU, i])
        sums[2] += weight * nodes[at.KV, i]


@allocating
def _integrate(waves: Waves, first: int, last: int, nodes: Floats, polys: Floats, sums: Floats) -> None:
    """Add the integrals of `_add_integrals` over the waves `first` to `last` - 1, of one doubling, to `sums`.

    Many are summed by Gauss's rule.
    """
    count = last - first
    if count <= 2 * GAUSS:
        for number in range(first, last):
            _add_integrals(waves, float(number), 1.0, nodes, polys, sums)
        return
    places, weights, rest = np.empty(GAUSS), np.empty(GAUSS), np.empty((2, GAUSS))
    fill_rule(float(count), places, weights, rest)
    for i in range(GAUSS):
        _add_integrals(waves, first + places[i], weights[i], nodes, polys, sums)


@allocating
def fill_from_zero(waves: Waves, number: int, room: Floats, polys: Floats, nodes: Floats) -> None:
    """Fill the integrals from 0 to the start of a wave, rows HM to HUU, in the first column of `nodes`."""
    doubling = min(int(math.log2(number / FIRST_WAVE)), waves.values.shape[0] - 1)
    sums = waves.sums[doubling].copy()
    _integrate(waves, FIRST_WAVE * 2**doubling, number, room, polys, sums)
    y, k, m = start_of(waves, float(number)), waves.k, waves.exponent
    nodes[at.HM, 0] = 0.5 * y * y
    nodes[at.HP, 0] = y ** (1.0 + k + m) / (1.0 + k + m)
    nodes[at.HPP, 0] = y ** (1.0 + k + 2.0 * m) / (1.0 + k + 2.0 * m)
    nodes[at.HU, 0], nodes[at.HPU, 0], nodes[at.HUU, 0] = sums[0], sums[1], sums[2]


@allocating
def fill_waves(waves: Waves, table: Table, source: Source) -> None:
    """Fill the values and sums of waves; `table` reaches beyond FIRST_WAVE and begins at 0."""
    per = waves.per
    nodes, polys = np.zeros((at.ROWS, per + 1)), np.zeros((per, LANES, N))
    index = round(waves.cut / waves.width - source.shift)
    for doubling in range(waves.values.shape[0]):
        _fill_doubling(source, index, doubling, waves.values, nodes, polys)
    sums = np.zeros(3)
    sums[0], sums[1], sums[2] = table.nodes[at.HU, 0], table.nodes[at.HPU, 0], table.nodes[at.HUU, 0]
    end = table.geometric + round((start_of(waves, float(FIRST_WAVE)) - table.start) / table.width)
    for i in range(end):
        sums[0] += table.nodes[at.KU, i]
        sums[1] += table.nodes[at.KUU, i] + table.nodes[at.PC, i] * table.nodes[at.KU, i]
        sums[2] += table.nodes[at.KV, i]
    for doubling in range(waves.values.shape[0]):
        for row in range(sums.size):
            waves.sums[doubling, row] = sums[row]
        first = FIRST_WAVE * 2**doubling
        _integrate(waves, first, 2 * first, nodes, polys, sums)


def reach_of(waves: Waves) -> int:
    """Return the number w up to which waves can be mixed: the end of the last doubling, not a wave that is kept."""
    return FIRST_WAVE << len(waves.values)


def waves_of(table: Table, source: Source, steepest: float, cut: float, most: float) -> Waves:
    """Return the waves of a table up to number `most`, given the y at which wave 0 begins."""
    per = round(2.0 * math.pi / table.width)
    doublings = max(1, math.ceil(math.log2(max(most, 1.0) / FIRST_WAVE)))
    values, sums = np.zeros((doublings, per + 1, PLACES, SIZE)), np.zeros((doublings, 3))
    waves = Waves(table.k, table.exponent, table.share, table.width, table.lowest, steepest, cut, per, values, sums)
    fill_waves(waves, table, source)
    return waves
