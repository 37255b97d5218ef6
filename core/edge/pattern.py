"""A toughness that varies with the radius (physics 16): the table of one scene.

With t(y) the pattern and kappa = t or its root, depth = B y^m + g U - kappa y E = B y^m + (g U - W) - y E, where
W = (kappa - 1) y E: waves of their own, of size 1. Only what the edge of a contact loses, kappa^2 - rho^2, and the
share of the load in the fold function, kappa E, know of kappa.
"""

import math
from typing import NamedTuple

import numpy as np

from gradhesion.core.curve.energy import GAUSS, GAUSS_WEIGHTS
from gradhesion.core.curve.values import bin_of
from gradhesion.core.jit import kernel, quadrature
from gradhesion.core.table import layout as at
from gradhesion.core.table.filling import bend_of, fill_bounds, fit
from gradhesion.core.table.layout import POINTS, WEIGHTS, N, Table
from gradhesion.core.types import Floats


class Pattern(NamedTuple):
    """The pattern of one scene.

    rows        cosine and sine of the harmonics 1, 2, ..., (2, highest)
    waves       waves of the pattern in one of the profile
    amplitude   toughness_amplitude
    of_work     whether it multiplies the work of adhesion, so that kappa is its root
    most        a bound of kappa
    steep       a bound of its slope by y
    """

    rows: Floats
    waves: float
    amplitude: float
    of_work: bool
    most: float
    steep: float


def rows_by_number(harmonics: Floats) -> Floats:
    """Return cosines and sines of the harmonics 1, 2, ... from rows (n, cos, sin)."""
    rows = np.zeros((2, int(harmonics[:, 0].max(initial=0.0))))
    for n, cos, sin in harmonics:
        rows[:, int(n) - 1] = cos, sin
    return rows


@kernel
def toughness_at(pattern: Pattern, y: float) -> float:
    """Return kappa at a radius; 1 without pattern."""
    cos1, sin1 = math.cos(pattern.waves * y), math.sin(pattern.waves * y)
    cos, sin, total = cos1, sin1, 0.0
    for n in range(pattern.rows.shape[1]):
        total += pattern.rows[0, n] * cos + pattern.rows[1, n] * sin
        cos, sin = cos * cos1 - sin * sin1, sin * cos1 + cos * sin1
    t = 1.0 + pattern.amplitude * total
    return math.sqrt(max(t, 0.0)) if pattern.of_work else t


@quadrature
def _sample(pattern: Pattern, centre: float, half: float, kappa: Floats, rise: Floats, circle: Floats) -> None:
    """Put kappa at the points of a bin into `kappa` (N,), and what it is above that of the centre into `rise` (N,).

    The rise is no difference of the two: at k = 1 it is all that bends the depth, down to the smallest radii.
    `circle` is room (4, N) for sin x, 1 - cos x, sin n x and 1 - cos n x.
    """
    cos0, sin0 = math.cos(0.5 * pattern.waves * centre), math.sin(0.5 * pattern.waves * centre)
    for j in range(N):
        angle = 0.5 * pattern.waves * half * POINTS[j]
        near_cos, near_sin = math.cos(angle), math.sin(angle)
        cos, sin = cos0 * near_cos - sin0 * near_sin, sin0 * near_cos + cos0 * near_sin
        circle[0, j] = circle[2, j] = 2.0 * sin * cos
        circle[1, j] = circle[3, j] = 2.0 * sin * sin
        rise[j] = 0.0
    for n in range(pattern.rows.shape[1]):
        for j in range(N):
            sin, versine = circle[2, j], circle[3, j]
            rise[j] += pattern.amplitude * (pattern.rows[1, n] * sin - pattern.rows[0, n] * versine)
            circle[2, j] = sin * (1.0 - circle[1, j]) + (1.0 - versine) * circle[0, j]
            circle[3, j] = versine * (1.0 - circle[1, j]) + circle[1, j] + sin * circle[0, j]
    at_centre = toughness_at(pattern, 0.0)
    for j in range(N):
        if pattern.of_work:  # the rise of a root from that of its square
            kappa[j] = math.sqrt(max(at_centre * at_centre + rise[j], 0.0))
            rise[j] /= max(kappa[j] + at_centre, 1e-300)
        else:
            kappa[j] = at_centre + rise[j]


@quadrature
def _fill_bins(plain: Table, g: float, pattern: Pattern, bins: int, nodes: Floats, polys: Floats) -> None:
    """Fill the first bins of the table of `patterned_table`, all but their bounds."""
    k = plain.k
    for row in range(at.ROWS):
        factor = g * g if row == at.KV else g if row in (at.U, at.U1, at.V, at.KU, at.KUU) else 1.0
        for i in range(bins + 1):
            nodes[row, i] = factor * plain.nodes[row, i]
    samples, waves, legendre = np.zeros((1, N)), np.zeros((1, N)), np.zeros(N)
    kappa, rise, circle, stretch = np.zeros(N), np.zeros(N), np.zeros((4, N)), np.zeros(N)
    above = toughness_at(pattern, 0.0) - 1.0
    for i in range(bins):
        centre, half = plain.nodes[at.YC, i], plain.nodes[at.HALF, i]
        _sample(pattern, centre, half, kappa, rise, circle)
        stretch[:] = 0.0
        for n in range(N - 1, -1, -1):
            for j in range(N):
                stretch[j] = stretch[j] * POINTS[j] + plain.polys[i, at.PE, n]
        area, middle = 0.0, 1.0 if k == 1.0 else centre * plain.polys[i, at.PE, 0]
        for j in range(N):
            y = centre + half * POINTS[j]
            pull = 1.0 if k == 1.0 else y * stretch[j]  # without rounding, which would bend it
            samples[0, j] = rise[j] * pull + above * (pull - middle)
            area += half * WEIGHTS[j] * y * kappa[j] * kappa[j]
        fit(samples, 0, waves, 0, legendre)
        waves[0, 0] += above * middle
        nodes[at.M0, i] = area
        bend = 0.0
        for n in range(N):
            polys[i, at.PW, n] = waves[0, n]
            polys[i, at.PU, n] = g * plain.polys[i, at.PU, n] - waves[0, n]
            polys[i, at.PU1, n] = g * plain.polys[i, at.PU1, n]
            polys[i, at.PP, n], polys[i, at.PE, n] = plain.polys[i, at.PP, n], plain.polys[i, at.PE, n]
            bend += abs(waves[0, n]) * n * (n - 1.0)
        nodes[at.BV, i] = bend_of(polys[i], half) + 0.5 * (1.0 + k) * bend / centre
        for edge in range(2 if i == bins - 1 else 1):
            value = slope = 0.0
            for n in range(N - 1, -1, -1):
                slope = slope * (2.0 * edge - 1.0) + value
                value = value * (2.0 * edge - 1.0) + waves[0, n]
            nodes[at.U, i + edge] -= value
            nodes[at.V, i + edge] -= slope / half
            nodes[at.KE, i + edge] = nodes[at.E, i + edge] + value / nodes[at.Y, i + edge]


@kernel
def patterned_table(
    plain: Table, crest: float, g: float, pattern: Pattern, y_end: float, nodes: Floats, polys: Floats
) -> Table:
    """Return the table of one scene up to y_end, in the given room: that of waves g U - W, for which g is 1.

    `crest` bounds -U' y^((k-1)/2) of the `plain` table; `polys` has a lane more than its polynomials.
    """
    k, bins = plain.k, bin_of(plain, y_end) + 1
    _fill_bins(plain, g, pattern, bins, nodes, polys)
    lowest = g * plain.lowest - (pattern.most - 1.0)
    table = Table(k, plain.exponent, plain.share, plain.start, plain.width, lowest, plain.geometric, bins, nodes, polys)
    fill_bounds(table, g * crest + pattern.steep)
    for i in range(bins + 1):  # the share of the load in D is (1+k) kappa E at most, which the scan takes for (1+k) E
        nodes[at.RLOW, i] -= (1.0 + k) * (pattern.most - 1.0) / nodes[at.Y, i]
    return table


@kernel
def edge_area(table: Table, pattern: Pattern, y: float) -> float:
    """Return int_0^y y kappa^2 dy, by the moments of a table of this pattern."""
    if pattern.rows.shape[1] == 0:
        return 0.5 * y * y
    i = bin_of(table, y)
    low, total = table.nodes[at.Y, i], 0.0
    half = 0.5 * (y - low)
    for j in range(GAUSS.size):
        x = low + half * (1.0 + GAUSS[j])
        total += half * GAUSS_WEIGHTS[j] * x * toughness_at(pattern, x) ** 2
    for j in range(i):
        total += table.nodes[at.M0, j]
    return total


def bounds_of(rows: Floats, amplitude: Floats, of_work: bool, reach: Floats) -> tuple[Floats, Floats, Floats]:
    """Return, for amplitudes, the least value of a pattern, a bound of kappa, and of its slope by the phase.

    `rows` are those of `rows_by_number`, `reach` is the rim over the wavelength; the least value is looked for at 64
    phases of the shortest wave.
    """
    n = np.arange(1, rows.shape[1] + 1)
    phases = np.linspace(0.0, 2.0 * np.pi, 64 * rows.shape[1] + 1)
    angle = np.outer(phases, n)
    series = np.cos(angle) @ rows[0] + np.sin(angle) @ rows[1]
    least = 1.0 + np.minimum(amplitude * series.min(), amplitude * series.max())
    for i in np.flatnonzero((least <= 0.0) & (reach < 1.0)):  # a punch may end before
        inside = int(np.searchsorted(phases, 2.0 * np.pi * reach[i])) + 1
        least[i] = 1.0 + (amplitude[i] * series[:inside]).min()
    size = np.hypot(*rows)
    most, steep = 1.0 + np.abs(amplitude) * size.sum(), np.abs(amplitude) * (n * size).sum()
    if of_work:
        with np.errstate(all="ignore"):
            most, steep = np.sqrt(most), 0.5 * steep / np.sqrt(least)
    return least, most, steep


def bins_of_wave(rows: Floats, amplitude: Floats, of_work: bool, least: Floats) -> Floats:
    """Return how many bins a wave of each pattern needs: 8 of the shortest; of a root more, where t nearly vanishes.

    A root is smooth only as far as the nearest complex phase at which t is 0: half of the strip in which it is not.
    """
    n = np.arange(1, rows.shape[1] + 1)[:, None]
    need = np.full(amplitude.shape, 8.0 * rows.shape[1])
    if of_work:
        size = np.abs(amplitude) * np.hypot(*rows)[:, None]
        low, high = np.zeros(need.shape), np.full(need.shape, 9.0 / rows.shape[1])
        for _ in range(30):
            strip = 0.5 * (low + high)
            inside = (size * (np.cosh(n * strip) - 1.0)).sum(axis=0) < np.maximum(least, 1e-9)
            low, high = np.where(inside, strip, low), np.where(inside, high, strip)
        need = np.maximum(need, 6.5 * np.pi / high)
    return need
