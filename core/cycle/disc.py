"""Is the contact one disc? The gap around it must nowhere be negative (physics 7).

    gap(r) ~ int_a^r y^k [depth_H(y) - depth] (r^2 - y^2)^(c-1) dy,   c = (1-k)/2,   up to a positive factor

It can be negative only beyond a radius at which depth_H < depth: that is read off the rows of the table, for every
control. Only from there on the gap itself is looked at, at the edges and middles of bins and at its least values.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.curve.trace import END, END_DEPTH, LANDING
from gradhesion.core.curve.values import Curve, bin_of, place_of
from gradhesion.core.jit import kernel, leaf
from gradhesion.core.table.layout import PE, PP, PU, SLOPE, E, N, P, U, V, Y, end_of
from gradhesion.core.types import Floats, Integers

_SAMPLES: Final = 32
"""Of the profile, in its shortest wave."""
RULE: Final = 8
"""Points of a half wave at which a gap is summed: good to 1e-9 of its terms."""
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(RULE)


class Disc(NamedTuple):
    """What the tests of one exponent, power and series need.

    c           (1-k)/2
    weights     of the rule for c x^(c-1) on (0, 1) at the points of Gauss's, (RULE,)
    crest, mean  |U| < crest y E + mean
    wave        the shortest wave
    bend        the profile is bend B y^m + g profile[1]
    profile     that of `profile_of`
    waves       the harmonics, rows (n, cos, sin)
    """

    c: float
    weights: Floats
    crest: float
    mean: float
    wave: float
    bend: float
    profile: Floats
    waves: Floats


def profile_of(waves: Floats) -> Floats:
    """Return y over one wavelength, the waves cos (1 - cos n y) + sin sin n y and their slope, (3, samples).

    It is empty, (3, 0), if the waves are nowhere below 0. `waves` are rows (n, cos, sin).
    """
    if not ((waves[:, 1] < 0.0).any() or waves[:, 2].any()):
        return np.empty((3, 0))
    y = np.linspace(0.0, 2.0 * np.pi, _SAMPLES * int(waves[:, 0].max()) + 1)
    height, slope = np.zeros(y.size), np.zeros(y.size)
    for n, cos, sin in waves:
        cosine, sine = np.cos(n * y), np.sin(n * y)
        height += cos * (1.0 - cosine) + sin * sine
        slope += n * (cos * sine + sin * cosine)
    return np.array([y, height, slope])


@kernel
def fill_weights(k: float, weights: Floats) -> None:
    """Fill the weights of the rule for c x^(c-1) on (0, 1), c = (1-k)/2, at the points of Gauss's, (RULE,).

    The moments of Legendre's polynomials with that weight are prod_(j <= n) (c - j)/(c + j), also at c = 0.
    """
    c = 0.5 * (1.0 - k)
    weights[:] = 0.0
    for j in range(RULE):
        x, moment = _POINTS[j], 1.0
        before, polynomial = 0.0, 1.0
        for n in range(RULE):
            weights[j] += 0.5 * _WEIGHTS[j] * (2.0 * n + 1.0) * polynomial * moment
            before, polynomial = polynomial, ((2.0 * n + 1.0) * x * polynomial - n * before) / (n + 1.0)
            moment *= (c - n - 1.0) / (c + n + 1.0)


@leaf
def _excess(curve: Curve, depth: float, y: float) -> float:
    """Return y^k (depth_H - depth)."""
    i, t = place_of(curve.table, y)
    polys = curve.table.polys
    flat = stretch = 0.0
    for n in range(N - 1, -1, -1):
        flat = flat * t + (curve.B * polys[i, PP, n] + curve.g * polys[i, PU, n])
        stretch = stretch * t + polys[i, PE, n]
    return (flat - depth) / (stretch * stretch * y)


@kernel
def _opening(curve: Curve, disc: Disc, depth: float, a: float, r: float) -> float:
    """Return the gap at r around a contact a, up to a factor: its last half wave by the rule of its end, then Gauss."""
    c = disc.c
    low = max(a, r - 0.5 * disc.wave, 0.6 * r)
    total = 0.0
    for j in range(RULE):
        y = r - (r - low) * (0.5 + 0.5 * _POINTS[j])
        total += disc.weights[j] * _excess(curve, depth, y) * (r + y) ** (c - 1.0)
    total *= (r - low) ** c
    while low > a and c > 0.0:
        high = low
        low = max(a, high - disc.wave, 0.5 * high)
        part = 0.0
        for j in range(RULE):
            y = low + (high - low) * (0.5 + 0.5 * _POINTS[j])
            part += 0.5 * _WEIGHTS[j] * _excess(curve, depth, y) * ((r - y) * (r + y)) ** (c - 1.0)
        total += c * (high - low) * part
    return total


@kernel
def _dip_is_open(
    curve: Curve,
    disc: Disc,
    depth: float,
    a: float,
    radii: tuple[float, float, float],
    gaps: tuple[float, float, float],
) -> bool:
    """Return whether no gap is negative near the least of three, the middle one, by vertices of parabolas.

    The first of `gaps` may be inf.
    """
    r0, r1, r2 = radii
    g0, g1, g2 = gaps
    for _ in range(4):
        left, right = (g1 - g0) / (r1 - r0), (g2 - g1) / (r2 - r1)
        r = 0.5 * (r1 + r2)
        if g0 < math.inf and right > left:
            r = 0.5 * (r0 + r1) - 0.5 * left * (r2 - r0) / (right - left)
        gap = _opening(curve, disc, depth, a, r)
        if gap < 0.0:
            return False
        if abs(r - r1) < 1e-4 * (r2 - r0):
            break
        if gap < g1:
            if r > r1:
                r0, g0 = r1, g1
            else:
                r2, g2 = r1, g1
            r1, g1 = r, gap
        elif r > r1:
            r2, g2 = r, gap
        else:
            r0, g0 = r, gap
    return True


@kernel
def gap_is_open(curve: Curve, disc: Disc, a: float, depth: float, end: float) -> bool:
    """Return whether the gap around a contact a at a depth is nowhere negative up to a radius."""
    nodes = curve.table.nodes
    i, last = bin_of(curve.table, a) + 1, bin_of(curve.table, min(end, end_of(curve.table)))
    r0 = r1 = a
    gap0 = gap1 = math.inf  # the last two
    search, slope = False, 0.0
    while i <= last + 1:
        y = min(nodes[Y, i], end)
        power = curve.B * nodes[P, i]
        height, before = power + curve.g * nodes[U, i] - depth, slope
        slope = curve.B * nodes[SLOPE, i] + curve.g * nodes[V, i]
        if not search:
            if height > 0.0 and power - curve.g * (disc.crest * nodes[Y, i] * nodes[E, i] + disc.mean) > depth:
                return True  # here and from here on
            dips = before < 0.0 < slope and height < slope * (nodes[Y, i] - nodes[Y, i - 1])
            search = height < 0.0 or dips
            r0 = r1 = max(a, nodes[Y, i - 1])
            gap0 = gap1 = math.inf
        if search:
            for part in range(2):
                r = max(a, nodes[Y, i - 1])
                r = y if part == 1 else 0.5 * (r + y)
                gap = _opening(curve, disc, depth, a, r)
                if gap < 0.0:
                    return False
                if gap1 <= gap0 and gap1 <= gap and r1 > r0:  # a least one between
                    low = gap1 < gap - gap1 + min(gap0, 2.0 * gap) - gap1
                    if low and not _dip_is_open(curve, disc, depth, a, (r0, r1, r), (gap0, gap1, gap)):
                        return False
                    search = height < 0.0
                r0, gap0, r1, gap1 = r1, gap1, r, gap
        i += 1
    return True


@leaf
def _height(curve: Curve, disc: Disc, r: float) -> float:
    """Return the height of the profile at r over its centre."""
    height = disc.bend * curve.B * r**curve.table.exponent
    for h in range(len(disc.waves)):
        n, cos, sin = disc.waves[h]
        height += curve.g * (cos * (1.0 - math.cos(n * r)) + sin * math.sin(n * r))
    return height


@kernel
def _touches_at_centre(curve: Curve, disc: Disc, end: float) -> bool:
    """Return whether the profile is nowhere below its centre up to a radius."""
    y, height, slope = disc.profile[0], disc.profile[1], disc.profile[2]
    if y.size == 0:
        return True
    m, bend, g = curve.table.exponent, disc.bend * curve.B, curve.g
    if g * slope[0] + (bend if m == 1.0 else 0.0) < 0.0 or _height(curve, disc, min(end, y[-1])) < 0.0:
        return False
    before, i = 0.0, 1
    while i < y.size and y[i] <= end:
        power = bend * y[i] ** m
        here, rise = power + g * height[i], power * m / y[i] + g * slope[i]
        if here < 0.0:
            return False
        if before < 0.0 < rise:  # the place of the least value, by these slopes
            r = y[i - 1] + (y[i] - y[i - 1]) * before / (before - rise)
            if _height(curve, disc, r) < 0.0:
                return False
        before = rise
        i += 1
    return True


@kernel
def loading_is_one_disc(
    curve: Curve, disc: Disc, trace: Floats, visited: Integers, visits: int, rim: float, limits: Floats
) -> bool:
    """Return whether no jump of loading up to a rim leaves a contact that is no disc; `curve` is without pattern.

    `limits` (2,) are the radii up to which that is so, and from which on it is not, for all rims of a curve: (0, -1),
    for unknown, at first.
    """
    if rim <= limits[0] or rim >= limits[1] > 0.0:
        return rim <= limits[0]
    for v in range(visits + 1):
        y, depth = 0.0, 0.0
        if v > 0:
            y, depth = trace[END, visited[v - 1]], trace[END_DEPTH, visited[v - 1]]
        landing = trace[LANDING, visited[v]] if v < visits else rim
        if landing <= limits[0]:
            continue
        if y >= rim:
            return True
        end = min(landing, rim)
        is_open = _touches_at_centre(curve, disc, end) if v == 0 else gap_is_open(curve, disc, y, depth, end)
        if not is_open:
            if landing <= rim:
                limits[1] = landing
            return False
        limits[0] = max(limits[0], end)
    return True
