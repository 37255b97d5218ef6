"""Reports on a scene on a patterned interface on request, as scene/general_report.py.

error of the force   6 eps times the sizes of the terms of the load at pull-off, with what a rounded place changes
                     of kappa, and its change with the radius if that is where a cycle turns
error of the energy  20 eps [2 pi a^2 chi (1 + chi) dgamma + H], chi that of all waves at their crests and of kappa
                     at its furthest from 1, with what rounded numbers of waves change of kappa
"""

import math
from typing import Any

from gradhesion.core.compiler.jit import NO, kernel
from gradhesion.core.curve.cosine import force_unit
from gradhesion.core.curve.general import Basis, Patterned, Series
from gradhesion.core.curve.patterned import MOST_CELLS, are_too_many, patterned_curve, window
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.general import walk
from gradhesion.core.problem.curves import GeneralCurves, Patterns
from gradhesion.core.problem.status import NO_VALUE, PULL_OFF_AT_RIM
from gradhesion.core.scene.general_report import (
    ENERGY_ROUNDING,
    FORCE_ROUNDING,
    LOOPED,
    Solved,
    crests,
    force_terms,
    last_fold_between,
    last_left,
    load_terms,
    loop,
    spring_factor,
)
from gradhesion.core.types import Floats, Harmonics, Table, Truths


@load_terms.answers(Patterned)
@kernel()
def load_terms_of_pattern(basis: Basis, curve: Patterned, x: float) -> float:
    """Answer with those of the profile, and what kappa adds to them."""
    table, pattern, _ = basis
    bare = Series(curve.bend, curve.exponent, pattern.gain, 0.0, 1.0)
    z = TWO_PI * x
    pull = z ** (0.5 * (3.0 + table.k)) * (pattern.most - 1.0 + pattern.steepest * z)
    return load_terms(Basis(table, pattern.cosine_bins, pattern.waves), bare, x) + pull


@kernel()
def _energy_reports(basis: Basis, curve: Patterned, rim: float, energy: float) -> tuple[float, float]:
    """Return the size of the terms of the energy, and its loop integral, over 2 pi l^2 dgamma; NaN if not known."""
    table, pattern, _ = basis
    bounds = window(basis, curve)
    outermost, total, spring = min(rim, bounds[1]), math.nan, 1.0
    if are_too_many(basis, bounds[0], outermost):
        return math.nan, math.nan
    if outermost - bounds[0] <= LOOPED:
        count, trace, _ = walk(basis, curve, bounds, rim, NO)
        if count >= 0:
            total, outermost = loop(basis, curve, count, trace, rim)
            spring = spring_factor(basis, curve, last_left(basis, curve, count, trace, rim))
    chi = crests(table, pattern.waves, pattern.gain) + max(pattern.most - 1.0, 1.0 - pattern.least)
    phase = pattern.steepest * TWO_PI * outermost
    residual = 2.0 / (1.0 + table.k) * total / curve.alpha if curve.alpha > 0.0 else math.nan
    return (TWO_PI * outermost) ** 2 * (chi * (1.0 + chi) + 0.1 * phase) + spring * abs(energy), residual


@kernel()
def _outermost_fold(basis: Basis, curve: Patterned) -> float:
    """Return x of the last fold of a curve, 0 if it has none, inf if folds need not end; NaN if it is not found."""
    first, last = window(basis, curve)
    if last == math.inf:
        return last
    return (
        math.nan if are_too_many(basis, first, last) else last_fold_between(basis, curve, first, last, 2 * MOST_CELLS)
    )


@kernel()
def report_scenes(
    table: Table,
    cosine_bins: Any,
    series: Harmonics,
    curves: GeneralCurves,
    patterns: Patterns,
    solved: Solved,
    wanted: Truths,
    out: Floats,
) -> None:
    """Report on scenes of one gradient exponent, each a curve with one rim, as `report_scenes` of general_report.py."""
    radius, energy, turned, status = solved
    for i in curves.numbers:
        if status[i] & NO_VALUE:
            continue
        _, pattern, finest, curve, units = patterned_curve(table, cosine_bins, series, curves, patterns, i)
        basis, (wavelength, length, unit) = Basis(table, pattern, finest), units
        if wanted[0]:
            terms = force_terms(basis, curve, radius[i] / wavelength, turned and status[i] & PULL_OFF_AT_RIM != 0)
            out[0, i] = FORCE_ROUNDING * table.rounding * force_unit(table.k, length, unit) * terms
        if wanted[1] or wanted[2]:
            scale = TWO_PI * length * length
            terms, total = _energy_reports(basis, curve, curves.rims[i, 0] / wavelength, energy[i] / scale)
            out[1, i] = scale * ENERGY_ROUNDING * table.rounding * terms
            out[2, i] = energy[i] - scale * total
        if wanted[3]:
            out[3, i] = _outermost_fold(basis, curve) * wavelength
