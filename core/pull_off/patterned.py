"""The pull-off on a patterned interface: the search of pull_off/general.py with kappa at most its bound.

load >= X [ B m/(1+k+m) z^(m-c) - kappa_most - chi(z) ],   X = z^((3+k)/2)
"""

import math

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.cosine_folds import CLOSE
from gradhesion.core.curve.general import Basis, Patterned
from gradhesion.core.curve.general_folds import Search
from gradhesion.core.curve.patterned import MOST_CELLS
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.pull_off import rims
from gradhesion.core.pull_off.general import chi_terms, load_at_rim, lowest_of_cells
from gradhesion.core.pull_off.lowest_two import Lowest
from gradhesion.core.types import Floats


@kernel()
def lowest_load(
    basis: Basis, curve: Patterned, rim: tuple[float, float], work: Search, deepest: float
) -> tuple[float, float, float]:
    """Return the lowest reduced load up to a rim, the x where it is met, and the second lowest trough (or 0).

    NaN if there are too many waves to search, 0 without a place where no load is below zero: the centre may have no
    adhesion. `rim` is x and its rounding error, `deepest` what `deepest_wave` (pull_off/general.py) returns.
    """
    table, pattern, _ = basis
    k, (x_rim, x_rim_low) = table.k, rim
    B, m, g, _, _ = curve
    by_load = Patterned(B, m, g, 0.0, 1.0)
    terms = chi_terms(table, pattern.waves, pattern.gain, deepest)
    more, e, power = pattern.most - 1.0, 0.5 * (3.0 + k), m - 0.5 * (1.0 - k)
    z = ((pattern.most + terms[2]) * e / (B * m / (1.0 + k + m) * (power + e))) ** (1.0 / power)
    start = min(z / TWO_PI, x_rim)
    best: Lowest = (0.0, 0.0, 0.0)
    if not 1e-100 < start < math.inf:
        return math.nan, math.nan, 0.0
    if x_rim < math.inf:
        at_rim = load_at_rim(basis, by_load, x_rim, x_rim_low)
        if at_rim < 0.0:
            best = (at_rim, x_rim, 0.0)
    found, best = lowest_of_cells(basis, by_load, terms, more, (start, x_rim), best, MOST_CELLS, work)
    return best if found > 0 else (0.0 if found == 0 else math.nan, math.nan, 0.0)


@rims.lowest_loads.answers(Patterned)
@kernel()
def lowest_loads(
    basis: Basis, curve: Patterned, rims: Floats, rims_low: Floats, work: Search, deepest: float, found: Floats
) -> None:
    """Keep no cells: only the trough of the largest rim is that of others as well."""
    furthest = 0
    for i in range(rims.size):
        if rims[i] > rims[furthest] or not rims[furthest] > 0.0:
            furthest = i
    free: Lowest = (math.nan, math.nan, 0.0)
    if rims[furthest] > 0.0:
        free = lowest_load(basis, curve, (rims[furthest], rims_low[furthest]), work, deepest)
    shared = free[0] < 0.0 and free[2] >= free[0] * (1.0 - CLOSE)
    for i in range(rims.size):
        if rims[i] > 0.0:
            best = free
            if i != furthest and not (shared and free[1] < rims[i]):
                best = lowest_load(basis, curve, (rims[i], rims_low[i]), work, deepest)
            found[i, 0], found[i, 1], found[i, 2] = best
