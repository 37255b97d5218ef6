"""Reports on a scene on a patterned interface on request, as scene/general_report.py.

error of the force   6 eps times the sizes of the terms of the load at pull-off, with what a rounded place changes
                     of kappa, and its change with the radius if that is where a cycle turns
error of the energy  20 eps [2 pi a^2 chi (1 + chi) dgamma + H], chi that of all waves at their crests and of kappa
                     at its furthest from 1, with what rounded numbers of waves change of kappa
"""

import math

from gradhesion.core.compiler.jit import NO, kernel
from gradhesion.core.curve.general import Basis, Patterned, Series
from gradhesion.core.curve.patterned import MOST_CELLS, are_too_many, window
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.general import walk
from gradhesion.core.scene import general_report
from gradhesion.core.scene.general_report import (
    ENERGY_ROUNDING,
    LOOPED,
    crests,
    last_fold_between,
    last_left,
    loop,
    spring_factor,
)


@general_report.load_terms.answers(Patterned)
@kernel()
def load_terms(basis: Basis, curve: Patterned, x: float) -> float:
    """Return those of the profile, and what kappa adds to them."""
    table, pattern, _ = basis
    bare = Series(curve.bend, curve.exponent, pattern.gain, 0.0, 1.0)
    z = TWO_PI * x
    pull = z ** (0.5 * (3.0 + table.k)) * (pattern.most - 1.0 + pattern.steepest * z)
    return general_report.load_terms(Basis(table, pattern.cosine_bins, pattern.waves), bare, x) + pull


@general_report.energy_reports.answers(Patterned)
@kernel()
def energy_reports(
    basis: Basis, curve: Patterned, rim: float, _rim_low: float, energy: float, scale: float
) -> tuple[float, float, float]:
    """Return them with what kappa adds, of the walked trace alone."""
    table, pattern, _ = basis
    bounds = window(basis, curve)
    outermost, total, spring = min(rim, bounds[1]), math.nan, 1.0
    if are_too_many(basis, bounds[0], outermost):
        return math.nan, math.nan, math.nan
    if outermost - bounds[0] <= LOOPED:
        count, trace, _ = walk(basis, curve, bounds, rim, NO)
        if count >= 0:
            total, outermost = loop(basis, curve, count, trace, rim)
            spring = spring_factor(basis, curve, last_left(basis, curve, count, trace, rim))
    chi = crests(table, pattern.waves, pattern.gain) + max(pattern.most - 1.0, 1.0 - pattern.least)
    phase = pattern.steepest * TWO_PI * outermost
    residual = 2.0 / (1.0 + table.k) * total / curve.alpha if curve.alpha > 0.0 else math.nan
    terms = (TWO_PI * outermost) ** 2 * (chi * (1.0 + chi) + 0.1 * phase) + spring * abs(energy)
    return scale * ENERGY_ROUNDING * table.rounding * terms, terms, residual


@general_report.outermost_fold.answers(Patterned)
@kernel()
def outermost_fold(basis: Basis, curve: Patterned) -> float:
    """Return it from a search cell by cell."""
    first, last = window(basis, curve)
    if last == math.inf or are_too_many(basis, first, last):
        return math.inf if last == math.inf else math.nan
    return last_fold_between(basis, curve, first, last, 2 * MOST_CELLS)
