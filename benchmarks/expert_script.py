"""The script that an expert writes: compiled by numba, one thread, tables of both functions, folds found by a scan.

With y = 2 pi a/lambda and depth in units of s l^((1-k)/2), l = lambda/(2 pi), a curve is three numbers b, g, k:

    f(y) = h(y) - y^((1-k)/2),   h = b y^2/2 + g y S0(y)         depth, and depth without adhesion
    p(y) = y^(1+k) [b y^2/(3+k) + g y (S0 - S1) - y^((1-k)/2)]   load
    h' = q y^(-(1+k)/2) at the folds of depth, q = (1-k)/2, and of load, q = (3+k)/2

Folds are sought between `radii` radii a wave, and refined by Newton's steps within their brackets. A fold and the next
that lie between two radii of the scan are missed, which is where the worst errors come from. A jump at the depth d
dissipates the integral of 2 y - 2 y^k (h - d)^2, by Gauss's rule in panels but for the terms in closed form.
"""

import math
from typing import Any, Final, NamedTuple

import numpy as np
from numba import njit
from scipy.special import roots_jacobi, roots_legendre

Values = np.ndarray[Any, np.dtype[np.float64]]
DEGREE: Final = 9
BINS_A_UNIT: Final = 2
LARGEST: Final = 104
"""The y to which tables reach."""


class Effort(NamedTuple):
    """What the script spends: its error follows."""

    radii: int
    """Radii of the scan for each wave."""
    step: float
    """The Newton step in y after which no other follows."""
    nodes: int = 4
    """Nodes of Gauss's rule in a panel."""
    panel: float = 3.0
    """The width of panels in y."""


def table_of(k: float) -> Values:
    """Return the coefficients of S0 and S1 in bins of y, of shape (bins, DEGREE + 1, 2), by quadrature."""
    x, weights = roots_jacobi(200, 0.5 * (k - 1.0), 0.0)
    t = 0.5 * (1.0 + x)
    first = weights * 0.5 ** (0.5 * (1.0 + k)) * (1.0 + t) ** (0.5 * (k - 1.0))
    nodes = np.cos(math.pi * (np.arange(DEGREE + 1) + 0.5) / (DEGREE + 1))
    centres = (np.arange(BINS_A_UNIT * LARGEST) + 0.5) / BINS_A_UNIT
    waves = np.sin((centres[:, None] + 0.5 * nodes / BINS_A_UNIT)[..., None] * t)
    inverse = np.linalg.inv(np.vander(nodes, increasing=True))
    return np.stack([waves @ first @ inverse.T, waves @ (first * (1.0 - t * t)) @ inverse.T], axis=-1).copy()


@njit(inline="always")
def pair(table: Values, y: float) -> tuple[float, float]:
    """Return S0 and S1."""
    place = int(y * BINS_A_UNIT)
    u = 2.0 * (y * BINS_A_UNIT - place) - 1.0
    rows = table[place]
    s0, s1 = rows[DEGREE, 0], rows[DEGREE, 1]
    for n in range(DEGREE - 1, -1, -1):
        s0, s1 = s0 * u + rows[n, 0], s1 * u + rows[n, 1]
    return s0, s1


@njit(inline="always")
def depth(table: Values, b: float, g: float, k: float, y: float) -> float:
    """Return f."""
    return 0.5 * b * y * y + g * y * pair(table, y)[0] - y ** (0.5 * (1.0 - k))


@njit(inline="always")
def load(table: Values, b: float, g: float, k: float, y: float) -> float:
    """Return p."""
    s0, s1 = pair(table, y)
    return y ** (1.0 + k) * (b * y * y / (3.0 + k) + g * y * (s0 - s1) - y ** (0.5 * (1.0 - k)))


@njit(inline="always")
def slope(table: Values, b: float, g: float, k: float, q: float, y: float) -> tuple[float, float]:
    """Return h' - q y^(-(1+k)/2) and its derivative."""
    s0, s1 = pair(table, y)
    rate, n = (1.0 - y * s1) / (1.0 + k), 0.5 * (1.0 + k)
    hold = q * y**-n
    return b * y + g * (s0 + y * rate) - hold, b + g * (2.0 * rate + y * (s1 - s0)) + n * hold / y


@njit
def fold(table: Values, curve: tuple[float, float, float], q: float, low: float, high: float, step: float) -> float:
    """Return the fold between two radii of the scan."""
    b, g, k = curve
    rising = slope(table, b, g, k, q, high)[0] > 0.0
    y = 0.5 * (low + high)
    for _ in range(50):
        value, rate = slope(table, b, g, k, q, y)
        low, high = (low, y) if (value > 0.0) == rising else (y, high)
        new = y - value / rate
        if not low < new < high:
            new = 0.5 * (low + high)
        done, y = abs(new - y) < step, new
        if done:
            break
    return y


@njit
def crossing(
    table: Values, curve: tuple[float, float, float], level: float, low: float, high: float, step: float
) -> float:
    """Return where depth, which rises from low to high, is at a level."""
    b, g, k = curve
    y = 0.5 * (low + high)
    for _ in range(50):
        value = depth(table, b, g, k, y) - level
        low, high = (low, y) if value > 0.0 else (y, high)
        new = y - value / slope(table, b, g, k, 0.5 * (1.0 - k), y)[0]
        if not low < new < high:
            new = 0.5 * (low + high)
        done, y = abs(new - y) < step, new
        if done:
            break
    return y


@njit
def jump(
    table: Values, curve: tuple[float, float, float], level: float, low: float, high: float, rule: Values, panel: float
) -> float:
    """Return the integral of 2 y - 2 y^k (h - level)^2 from low to high."""
    b, g, k = curve
    n = 1.0 + k
    total = (high - low) * (high + low) - 2.0 * level * level * (high**n - low**n) / n
    panels = max(1, math.ceil((high - low) / panel))
    half = 0.5 * (high - low) / panels
    for i in range(panels):
        for j in range(rule.shape[1]):
            y = low + half * (2 * i + 1 + rule[0, j])
            h = 0.5 * b * y * y + g * y * pair(table, y)[0]
            total -= 2.0 * half * rule[1, j] * y**k * h * (h - 2.0 * level)
    return total


@njit
def force_of(table: Values, curve: tuple[float, float, float], rim: float, radii: int, step: float) -> float:
    """Return minus the least load up to the rim."""
    b, g, k = curve
    q, cells = 0.5 * (3.0 + k), max(4, math.ceil(rim * radii / (2.0 * math.pi)))
    lowest, falling, before = load(table, b, g, k, rim), True, 1e-3 * rim / cells
    for i in range(1, cells + 1):
        y = rim * i / cells
        rises = slope(table, b, g, k, q, y)[0] > 0.0
        if falling and rises:
            near = load(table, b, g, k, y)
            if near < lowest + 0.5 * abs(lowest):  # else the minimum in this cell is not the lowest, most likely
                lowest = min(lowest, load(table, b, g, k, fold(table, curve, q, before, y, step)))
        falling, before = not rises, y
    return -lowest


@njit
def energy_of(
    table: Values,
    curve: tuple[float, float, float],
    rim: float,
    radii: int,
    step: float,
    rule: Values,
    panel: float,
    at: Values,
    depths: Values,
) -> float:
    """Return what a cycle to the rim loses; at and depths have room for all folds."""
    b, g, k = curve
    q, cells = 0.5 * (1.0 - k), max(4, math.ceil(rim * radii / (2.0 * math.pi)))
    at[0] = depths[0] = 0.0
    last, rose, before = 0, False, 1e-3 * rim / cells
    for i in range(1, cells + 1):
        y = rim * i / cells
        rises = slope(table, b, g, k, q, y)[0] > 0.0
        if rises != rose:
            last += 1
            at[last] = fold(table, curve, q, before, y, step)
            depths[last] = depth(table, b, g, k, at[last])
        rose, before = rises, y
    last += 1
    at[last], depths[last] = rim, depth(table, b, g, k, rim)
    lost, place, y, level = 0.0, 0, 0.0, 0.0
    while place < last:  # loading: along branches that rise, and outward where they end
        following = place + 1
        while following <= last and depths[following] <= level:
            following += 1
        if following > last:
            lost += jump(table, curve, level, y, rim, rule, panel)
            break
        start = crossing(table, curve, level, at[following - 1], at[following], step)
        lost += jump(table, curve, level, y, start, rule, panel)
        place, y, level = following, at[following], depths[following]
    place, y, level = last, rim, depths[last]
    while True:  # unloading: down the branch, and inward from its trough
        if place > 0 and depths[place - 1] < level and place > 1:
            place -= 1
            y, level = at[place], depths[place]
        following = place - 1
        while following > 0 and depths[following] >= level:
            following -= 1
        if following <= 0:
            return lost - jump(table, curve, level, 0.0, y, rule, panel)
        end = crossing(table, curve, level, at[following], at[following + 1], step)
        lost -= jump(table, curve, level, end, y, rule, panel)
        place, y, level = following, at[following], depths[following]


@njit
def reduced(scene: Values) -> tuple[tuple[float, float, float], float, float]:
    """Return b, g and k of a row k, M, lambda, A, a_max, the unit of y in R, and that of depth."""
    k, M, wavelength, A, _ = scene
    n, unit = 0.5 * (1.0 + k), wavelength / (2.0 * math.pi)
    hold = math.sqrt(2.0 ** (1.0 + k) * math.pi / M) * unit ** (1.0 - n)
    return (unit * unit / (n * hold), A * wavelength / hold, k), unit, hold


@njit
def forces_of(tables: Values, which: Any, scenes: Values, radii: int, step: float) -> Values:
    """Return pull-off forces over 1.5 pi R dgamma."""
    out = np.empty(len(scenes))
    for i in range(len(scenes)):
        curve, unit, hold = reduced(scenes[i])
        k, M = scenes[i, 0], scenes[i, 1]
        front = 2.0 ** (1.0 - k) * M / (1.0 + k) * unit ** (1.0 + k) * hold / (1.5 * math.pi)
        out[i] = front * force_of(tables[which[i]], curve, scenes[i, 4] / unit, radii, step)
    return out


@njit
def energies_of(
    tables: Values, which: Any, scenes: Values, radii: int, step: float, rule: Values, panel: float
) -> Values:
    """Return dissipated energies over R^2 dgamma."""
    out, at, depths = np.empty(len(scenes)), np.empty(10_000), np.empty(10_000)
    for i in range(len(scenes)):
        curve, unit, _ = reduced(scenes[i])
        lost = energy_of(tables[which[i]], curve, scenes[i, 4] / unit, radii, step, rule, panel, at, depths)
        out[i] = math.pi * unit * unit * lost
    return out


def solve(output: str, tables: Values, which: Any, scenes: Values, effort: Effort) -> Values:
    """Return an output of scenes in rows k, M, lambda, A, a_max; which are the places of their k among the tables."""
    if output == "pull_off_force":
        return forces_of(tables, which, scenes, effort.radii, effort.step)
    rule = np.array(roots_legendre(effort.nodes))
    return energies_of(tables, which, scenes, effort.radii, effort.step, rule, effort.panel)
