"""The work of a cycle: the loop integral of the load along the path, by quadrature along its smooth parts."""

import math

from gradhesion.core.curve.energy import GAUSS, GAUSS_WEIGHTS
from gradhesion.core.curve.values import Curve, bin_of, coordinate_of, depth_and_load, slope_near, softness, state_in
from gradhesion.core.cycle.jumps import LANDED, LANDED_BRANCH, LEFT, LEFT_DEPTH, LEFT_LOAD
from gradhesion.core.cycle.turning import value_at
from gradhesion.core.jit import kernel
from gradhesion.core.table.layout import HALF, YC, end_of
from gradhesion.core.types import Floats


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
def work_of_cycle(closing: Curve, opening: Curve, rim: float, jumps: Floats, loading: int, count: int) -> float:
    """Return the work of the cycle up to a rim in 2 pi l^2 dgamma of opening; NaN for a rim beyond the table.

    `jumps` are those of the cycle (jumps.py), the first `loading` of them on the curve of closing. Loads of closing are
    in sqrt(ratio) times the unit of those of opening, and so are its depths. Of a prescribed depth or far end of a
    machine, not of a load.
    """
    if rim > end_of(closing.table):
        return math.nan
    ratio, work = (opening.B / closing.B) ** 2, 0.0
    for n in range(1, loading):
        work += ratio * _along(closing, jumps[LANDED, n - 1], jumps[LEFT, n])
    top = coordinate_of(closing, jumps[LEFT_DEPTH, loading - 1], jumps[LEFT_LOAD, loading - 1])
    if jumps[LANDED_BRANCH, loading - 1] >= 0.0:
        work += ratio * _along(closing, jumps[LANDED, loading - 1], rim)
        top = value_at(closing, rim)
    depth, load = state_in(opening, rim)
    fall = math.sqrt(ratio) * top - coordinate_of(opening, depth, load)
    stiffness = rim ** (1.0 + opening.table.k)  # while the edge is pinned at the rim, where the load is linear
    work -= fall * (load + 0.5 * stiffness * fall / softness(opening, stiffness))
    y = rim
    for n in range(loading, count):
        work -= _along(opening, jumps[LEFT, n], y)
        y = jumps[LANDED, n]
    work -= _along(opening, 0.0, y)  # where the contact shrinks to a point
    return 2.0 / (1.0 + opening.table.k) * work
