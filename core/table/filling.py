"""Bins filled from the functions of one exponent: sampled at Gauss points, fitted, integrated and bounded."""

import math

import numpy as np

from gradhesion.core.jit import allocating, kernel, leaf, quadrature, quadrature_leaf
from gradhesion.core.table import layout as at
from gradhesion.core.table.functions import LAST, TAIL, Functions, functions_of, pairs_at
from gradhesion.core.table.layout import BY_LOAD, EXACT, FIRST, PER_WAVE, POINTS, RATIO, WEIGHTS, N, Source, Table
from gradhesion.core.table.leading import fill_far_leading, leading_at
from gradhesion.core.types import Floats

_legendre = np.polynomial.legendre
TO_LEGENDRE = np.linalg.inv(_legendre.legvander(POINTS, N - 1))
"""From values at the points to Legendre coefficients; in one step with the next, the fit would lose three digits."""
TO_POWERS = np.array([np.pad(_legendre.leg2poly(row), (0, N - 1 - n)) for n, row in enumerate(np.eye(N))]).T.copy()
"""From Legendre coefficients to powers."""
_SHORT_SERIES = 20.0
"""Centre over half width from which on a power is its binomial series of N terms to 1e-15."""


@quadrature_leaf
def fit(samples: Floats, row: int, poly: Floats, lane: int, legendre: Floats) -> None:
    """Turn values at the points of a bin, a row of `samples` (., N), into a lane of coefficients of `poly` (., N)."""
    for n in range(N):
        total = 0.0
        for j in range(N):
            total += TO_LEGENDRE[n, j] * samples[row, j]
        legendre[n] = total
    for n in range(N):
        total = 0.0
        for j in range(N):
            total += TO_POWERS[n, j] * legendre[j]
        poly[lane, n] = total


@kernel
def fill_far(
    functions: Functions, waves: Floats, width: float, shift: float, far_waves: Floats, far_mean: Floats
) -> None:
    """Add up the expansions in 1/y of all harmonics at every point of the bins of one wave.

    U = sum_i far_mean[0, i] y^(-2i) + y E sum_i far_waves[0, i, bin, point] y^(-i); U1 the same but for the factor y.
    """
    power = -0.5 * (1.0 + functions.k)
    for h in range(len(waves)):
        n, cos, sin = waves[h]
        for pair in range(2):
            for i in range(TAIL):
                far_mean[pair, i] += cos * functions.slow[pair, i] * n ** (-2.0 * i)
        for b in range(far_waves.shape[2]):
            for j in range(N):
                x = n * width * (b + shift + 0.5 + 0.5 * POINTS[j])
                sine, cosine = math.sin(x), math.cos(x)
                for pair in range(2):
                    s = sine * functions.phase[pair, 0] - cosine * functions.phase[pair, 1]
                    c = cosine * functions.phase[pair, 0] + sine * functions.phase[pair, 1]
                    factor = n ** (1.0 + power - pair)
                    for i in range(TAIL // 2):
                        far_waves[pair, 2 * i, b, j] += factor * functions.real[pair, i] * (cos * s + sin * c)
                        factor /= n
                        far_waves[pair, 2 * i + 1, b, j] += factor * functions.imaginary[pair, i] * (cos * c - sin * s)
                        factor /= n


@allocating
def source_of(k: float, exponent: float, waves: Floats, width: float, shift: float, form: int) -> Source:
    """Return what bins of an exponent are filled from; `waves` are rows (n, cos, sin)."""
    functions = functions_of(k)
    per = round(2.0 * math.pi / width)
    far_waves, far_mean = np.zeros((2, TAIL, per, N)), np.zeros((2, TAIL))
    if form == EXACT:
        fill_far(functions, waves, width, shift, far_waves, far_mean)
    else:
        fill_far_leading(k, waves, form, width, shift, far_waves, far_mean)
    return Source(k, exponent, (FIRST + shift) * width, width, waves, functions, far_waves, far_mean, form, shift)


@kernel
def waves_at(source: Source, y: float) -> tuple[float, float]:
    """Return U and U1 at y, harmonic by harmonic."""
    if source.form != EXACT:
        return leading_at(source.k, source.waves, source.form, y)
    u = u1 = 0.0
    for h in range(len(source.waves)):
        n, cos, sin = source.waves[h]
        S0, C0, S1, C1 = pairs_at(source.functions, n * y)
        u += n * (cos * S0 + sin * C0)
        u1 += n * (cos * S1 + sin * C1)
    return y * u, y * u1


@quadrature_leaf
def _sample_powers(
    m: float, power: float, centre: float, half: float, poly: Floats, values: Floats, room: Floats
) -> None:
    """Fill the lanes of y^m and of E, y to a `power`, and their values at the points, rows PP and PE of `values`."""
    if half * _SHORT_SERIES > centre:
        for j in range(N):
            y = centre + half * POINTS[j]
            values[at.PP, j], values[at.PE, j] = y**m, y**power
        fit(values, at.PP, poly, at.PP, room)
        fit(values, at.PE, poly, at.PE, room)
        return
    ratio = half / centre
    a, b = centre**m, centre**power
    for n in range(N):
        poly[at.PP, n], poly[at.PE, n] = a, b
        a *= (m - n) / (n + 1.0) * ratio
        b *= (power - n) / (n + 1.0) * ratio
    for j in range(N):
        values[at.PP, j] = values[at.PE, j] = 0.0
    for n in range(N - 1, -1, -1):
        for j in range(N):
            values[at.PP, j] = values[at.PP, j] * POINTS[j] + poly[at.PP, n]
            values[at.PE, j] = values[at.PE, j] * POINTS[j] + poly[at.PE, n]


@quadrature_leaf
def _sample_far(source: Source, b: int, low: float, centre: float, half: float, values: Floats, room: Floats) -> None:
    """Fill rows PU and PU1 of `values` with U and U1 at the points of a bin beyond y = 40, the b-th bin of its wave."""
    terms = TAIL - 1 if low < 80.0 else 8 if low < 400.0 else 5
    for j in range(N):
        values[at.PU, j] = values[at.PU1, j] = 0.0
        room[j] = 1.0 / (centre + half * POINTS[j])
    for n in range(terms, -1, -1):
        for j in range(N):
            values[at.PU, j] = values[at.PU, j] * room[j] + source.far_waves[0, n, b, j]
            values[at.PU1, j] = values[at.PU1, j] * room[j] + source.far_waves[1, n, b, j]
    for j in range(N):
        square = room[j] * room[j]
        u = u1 = 0.0
        for n in range(terms if terms > 8 else 4, -1, -1):
            u = u * square + source.far_mean[0, n]
            u1 = u1 * square + source.far_mean[1, n]
        values[at.PU, j] = values[at.PU, j] * values[at.PE, j] / room[j] + u
        values[at.PU1, j] = values[at.PU1, j] * values[at.PE, j] / (room[j] if source.form == BY_LOAD else 1.0) + u1


@quadrature_leaf
def _integrate(m: float, values: Floats, centre: float, half: float, i: int, nodes: Floats) -> None:
    """Fill the moments of bin i from the values at its points."""
    at_centre = centre**m
    k0 = k1 = k2 = ku = kuu = kv = 0.0
    for j in range(N):
        weight = half * WEIGHTS[j] / (values[at.PE, j] * values[at.PE, j] * (centre + half * POINTS[j]))  # of y^k
        u = values[at.PP, j] - at_centre
        k0 += weight
        k1 += weight * u
        k2 += weight * u * u
        ku += weight * values[at.PU, j]
        kuu += weight * u * values[at.PU, j]
        kv += weight * values[at.PU, j] * values[at.PU, j]
    nodes[at.K0, i], nodes[at.K1, i], nodes[at.K2, i], nodes[at.KU, i], nodes[at.KUU, i], nodes[at.KV, i] = (
        k0,
        k1,
        k2,
        ku,
        kuu,
        kv,
    )
    nodes[at.M0, i], nodes[at.PC, i], nodes[at.YC, i], nodes[at.HALF, i] = 2.0 * centre * half, at_centre, centre, half


@leaf
def fill_edge(m: float, poly: Floats, centre: float, half: float, t: float, column: int, nodes: Floats) -> None:
    """Fill the rows of an edge, at t = -1 or 1 of a bin."""
    power = stretch = u = u1 = slope = 0.0
    for n in range(N - 1, -1, -1):
        slope = slope * t + u
        u = u * t + poly[at.PU, n]
        u1 = u1 * t + poly[at.PU1, n]
        power = power * t + poly[at.PP, n]
        stretch = stretch * t + poly[at.PE, n]
    y = centre + t * half
    nodes[at.Y, column], nodes[at.P, column], nodes[at.SLOPE, column] = y, power, m * power / y
    nodes[at.U, column], nodes[at.U1, column], nodes[at.V, column] = u, u1, slope / half
    nodes[at.E, column] = nodes[at.KE, column] = stretch
    nodes[at.T, column] = 1.0 / (stretch * stretch)


@leaf
def bend_of(poly: Floats, half: float) -> float:
    """Return a bound of how far U' swings beyond the edges of a bin: h^2/2 sup of its second derivative."""
    top = bottom = 0.0
    sign = -1.0
    for n in range(3, N):
        third = poly[at.PU, n] * (n * (n - 1.0) * (n - 2.0))
        top += third
        bottom -= third * sign
        sign = -sign
    return 0.6 * max(abs(top), abs(bottom), abs(6.0 * poly[at.PU, 3])) / half


@leaf
def bend_of_power(m: float, low: float, high: float) -> float:
    """Return the same bound of m y^(m-1) between two radii."""
    if m == 2.0 or m == 1.0:  # noqa: PLR1714 (numba compiles a set more slowly)
        return 0.0
    half = 0.5 * (high - low)
    return 0.5 * half * half * abs(m * (m - 1.0) * (m - 2.0)) * (high if m > 3.0 else low) ** (m - 3.0)


@quadrature
def fill_bins(
    source: Source, shift: float, first: int, geometric: int, count: int, nodes: Floats, polys: Floats
) -> None:
    """Fill `count` bins: `geometric` ones up to y = (first + shift) width, and uniform ones from there on.

    The phase of the waves is that of bins with the shift of the source; only the radius follows another.
    Rows of bounds and integrals from 0 are left to `fill_bounds`, for they need all bins from the first one.
    """
    k, m, width = source.k, source.exponent, source.width
    start, power = (first + shift) * width, -0.5 * (1.0 + k)
    per = source.far_waves.shape[2]
    values, room = np.zeros((4, N)), np.zeros(N)
    longest = source.waves[:, 0].min()
    for i in range(count):
        number = i - geometric
        if number < 0:
            low = start * RATIO**number
            high = start * RATIO ** (number + 1) if number < -1 else start
        else:
            low, high = (first + shift + number) * width, (first + shift + number + 1) * width
        centre, half = 0.5 * (low + high), 0.5 * (high - low) if number < 0 else 0.5 * width
        poly = polys[i]
        _sample_powers(m, power, centre, half, poly, values, room)
        if low * longest >= LAST:
            _sample_far(source, (first + number) % per, low, centre, half, values, room)
        else:
            for j in range(N):
                values[at.PU, j], values[at.PU1, j] = waves_at(source, centre + half * POINTS[j])
        fit(values, at.PU, poly, at.PU, room)
        fit(values, at.PU1, poly, at.PU1, room)
        if source.form == BY_LOAD:  # any U with this derivative will do: only U' and U - U1 are used of it
            for n in range(N - 1, -1, -1):
                integral = poly[at.PU, n - 1] * half / n if n > 0 else 0.0
                poly[at.PU1, n], poly[at.PU, n] = integral - poly[at.PU1, n], integral
        _integrate(m, values, centre, half, i, nodes)
        fill_edge(m, poly, centre, half, -1.0, i, nodes)
        nodes[at.BV, i] = bend_of(poly, half)
        nodes[at.BP, i] = bend_of_power(m, low, high)
        nodes[at.BE, i] = 0.5 * half * half * power * (power - 1.0) * nodes[at.E, i] / (low * low)
    if count > 0:
        fill_edge(m, polys[count - 1], nodes[at.YC, count - 1], nodes[at.HALF, count - 1], 1.0, count, nodes)


@leaf
def _bend_at_zero(nodes: Floats) -> float:
    """Return U'' below the first bin, where U is of degree 2 to rounding."""
    return (nodes[at.V, 1] - nodes[at.V, 0]) / (nodes[at.Y, 1] - nodes[at.Y, 0])


@kernel
def _fill_below(k: float, nodes: Floats) -> None:
    """Fill the integrals from 0 to the first bin, where U is zero + slope y + bend y^2/2."""
    y, unit, power = nodes[at.Y, 0], nodes[at.T, 0], nodes[at.P, 0]
    m = nodes[at.SLOPE, 0] * y / power if power > 0.0 else 1.0
    bent = 0.5 * _bend_at_zero(nodes) * y * y
    rise = nodes[at.V, 0] * y - 2.0 * bent
    zero = nodes[at.U, 0] - rise - bent
    kappa = nodes[at.KE, 0] / nodes[at.E, 0]
    nodes[at.HM, 0] = 0.5 * (kappa * y) ** 2
    q = 1.0 + k
    nodes[at.HU, 0] = unit * (zero / q + rise / (q + 1.0) + bent / (q + 2.0))
    squares = zero * zero / q + 2.0 * zero * rise / (q + 1.0) + (rise * rise + 2.0 * zero * bent) / (q + 2.0)
    nodes[at.HUU, 0] = unit * (squares + 2.0 * rise * bent / (q + 3.0) + bent * bent / (q + 4.0))
    q += m
    nodes[at.HP, 0], nodes[at.HPP, 0] = unit * power / q, unit * power * power / (q + m)
    nodes[at.HPU, 0] = unit * power * (zero / q + rise / (q + 1.0) + bent / (q + 2.0))


@kernel
def fill_bounds(table: Table, crest: float) -> None:
    """Fill the running bounds of a table, and its integrals from 0 to the edges of the geometric bins.

    `crest` is a bound of -U' y^((k-1)/2) beyond the last bin. V/E and V/(y E) are bounded within bins as well, by what
    V can swing there.
    """
    nodes, bins = table.nodes, table.bins
    highest, lowest = -math.inf, -crest
    for i in range(bins + 1):
        swing = nodes[at.BV, i - 1] / nodes[at.E, i] if i > 0 else 0.0
        highest = max(highest, nodes[at.V, i] / nodes[at.E, i] + swing)
        nodes[at.QUP, i] = highest
        nodes[at.QPOW, i] = nodes[at.SLOPE, i] / nodes[at.E, i]
        nodes[at.RPOW, i] = nodes[at.QPOW, i] / nodes[at.Y, i]
    for i in range(bins, -1, -1):
        swing = nodes[at.BV, i] if i < bins else 0.0
        lowest = min(lowest, (nodes[at.V, i] - swing) / (nodes[at.E, i] * nodes[at.Y, i]))
        nodes[at.RLOW, i] = lowest
    _fill_below(table.k, nodes)
    for i in range(min(table.geometric, bins)):
        c = nodes[at.PC, i]
        nodes[at.HM, i + 1] = nodes[at.HM, i] + nodes[at.M0, i]
        nodes[at.HP, i + 1] = nodes[at.HP, i] + nodes[at.K1, i] + c * nodes[at.K0, i]
        nodes[at.HPP, i + 1] = nodes[at.HPP, i] + nodes[at.K2, i] + c * (2.0 * nodes[at.K1, i] + c * nodes[at.K0, i])
        nodes[at.HU, i + 1] = nodes[at.HU, i] + nodes[at.KU, i]
        nodes[at.HPU, i + 1] = nodes[at.HPU, i] + nodes[at.KUU, i] + c * nodes[at.KU, i]
        nodes[at.HUU, i + 1] = nodes[at.HUU, i] + nodes[at.KV, i]


def width_of(waves: Floats, finer: int = 1) -> float:
    """Return the width of uniform bins for harmonics (n, cos, sin), `finer` times narrower than usual."""
    return 2.0 * math.pi / (PER_WAVE * float(waves[:, 0].max()) * finer)
