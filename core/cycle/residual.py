"""The work of a cycle: the loop integral of the load along the path, by quadrature along its smooth parts."""

import math

from gradhesion.core.curve.energy import GAUSS, GAUSS_WEIGHTS
from gradhesion.core.curve.levels import LANDING as ACCURACY
from gradhesion.core.curve.levels import at_level
from gradhesion.core.curve.trace import END, END_LEVEL, LANDING, START, START_LEVEL
from gradhesion.core.curve.values import Curve, bin_of, coordinate_of, depth_and_load, slope_near, softness, state_in
from gradhesion.core.cycle.path import inner_branch, started_within, visited_within
from gradhesion.core.jit import kernel
from gradhesion.core.table.layout import HALF, YC, end_of
from gradhesion.core.types import Floats, Integers


@kernel
def _along(curve: Curve, low: float, high: float) -> float:
    """Return int P d(what is prescribed) along a branch between two radii within the table, low first."""
    table, total = curve.table, 0.0
    if high <= low:
        return 0.0
    last = bin_of(table, high)
    for i in range(bin_of(table, low) if low > 0.0 else 0, last + 1):
        centre, half = table.nodes[YC, i], table.nodes[HALF, i]
        a = max(-1.0, (low - centre) / half)
        b = min(1.0, (high - centre) / half)
        for j in range(GAUSS.size):
            t = 0.5 * (a + b) + 0.5 * (b - a) * GAUSS[j]
            slope, _, _, _ = slope_near(curve, i, t)
            _, load = depth_and_load(curve, i, t)
            stiffness = (centre + half * t) ** (1.0 + table.k)
            total += 0.5 * (b - a) * GAUSS_WEIGHTS[j] * load * slope * softness(curve, stiffness)
    return total


@kernel
def work_of_cycle(
    closing: Curve,
    opening: Curve,
    rim: float,
    loading: Floats,
    visits: int,
    visited: Integers,
    unloading: Floats,
    count: int,
) -> float:
    """Return the work of the cycle up to a rim in 2 pi l^2 dgamma of opening; NaN for a rim beyond the table.

    `loading` and `unloading` are the traces of the two curves. Loads of closing are in sqrt(ratio) times the unit of
    those of opening, and so are its depths. Of a prescribed depth or far end of a machine, not of a load.
    """
    if rim > end_of(closing.table):
        return math.nan
    ratio = (opening.B / closing.B) ** 2
    work, top = 0.0, 0.0
    n = visited_within(loading, visited, visits, rim)
    for v in range(n):
        j = visited[v]
        work += ratio * _along(closing, loading[LANDING, j], min(loading[END, j], rim))
        top = loading[END_LEVEL, j]
        if loading[END, j] >= rim:
            depth, load = state_in(closing, rim)
            top = coordinate_of(closing, depth, load)
    depth, load = state_in(opening, rim)
    level = coordinate_of(opening, depth, load)
    fall = math.sqrt(ratio) * top - level  # while the edge is pinned at the rim, where the load is linear
    stiffness = rim ** (1.0 + opening.table.k)
    work -= fall * (load + 0.5 * stiffness * fall / softness(opening, stiffness))
    j, y = started_within(unloading, count, rim) - 1, rim
    if j < 0 or unloading[END, j] < rim:
        j = inner_branch(unloading, j, level)
        y = -1.0
    while j >= 0:
        if y < 0.0:
            y = at_level(opening, level, unloading[START, j], unloading[END, j], ACCURACY)
        work -= _along(opening, unloading[START, j], y)
        level, y = unloading[START_LEVEL, j], -1.0
        j = inner_branch(unloading, j - 1, level)
    return 2.0 / (1.0 + opening.table.k) * work
