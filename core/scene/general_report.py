"""Reports on a general scene on request, as core/scene/cosine_report.py does for one cosine wave.

    error of the force   6 eps times the sizes of the terms of the load at pull-off, every wave for itself, and its
                         change with the logarithm of the radius if that is where a cycle turns
    error of the energy  20 eps [2 pi a^2 chi (1 + chi) dgamma + H], a the outermost radius of a jump and chi that of
                         all waves at their crests: what one wave loses, |1 - rho^2| <= 4 chi (1 + chi), another one may
                         gain, and what the smooth punch loses is a part of H. A soft spring loses P^2/2S: of a machine
                         H is multiplied by a fifth of what the terms of P at the jump-out are over P, if that is more

and where waves are summed (path/general_long.py) four times the difference from a sum that begins and ends elsewhere.

The residual is the energy less the loop integral of P over what is prescribed, by Gauss's rule along the branches: a
computation that shares no integrand with the energies of jumps. A dead load closes no loop and has none.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.compiler.dispatch import face_of
from gradhesion.core.compiler.jit import NO, NONE, YES, kernel
from gradhesion.core.curve.branches import ARRIVAL, END, LANDING, NEXT, START, Trace
from gradhesion.core.curve.cells import MOST
from gradhesion.core.curve.cosine import force_unit
from gradhesion.core.curve.cosine_energy import NODES, WEIGHTS
from gradhesion.core.curve.general import Basis, Series, coordinate, curve_at, slope, state
from gradhesion.core.curve.general_folds import MOST_CELLS, cell_width, folds_of_cell, room
from gradhesion.core.face import measured_by, window
from gradhesion.core.harmonics.series import integrals
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.numbers.intrinsics import fma
from gradhesion.core.path.general import walk
from gradhesion.core.path.general_long import Tasks, stride
from gradhesion.core.path.general_middle import FEW, LONGEST_WALK, NEAR_END, REGULAR, middle_of, regular_waves
from gradhesion.core.path.loading import highest_depth, loading_to
from gradhesion.core.path.pieces import notes_for
from gradhesion.core.path.unloading import descend, leave_rim, unloading_from
from gradhesion.core.problem.curves import GeneralCurves
from gradhesion.core.problem.status import NO_VALUE, PULL_OFF_AT_RIM, TOLERANCE_NOT_MET
from gradhesion.core.pull_off.general import INWARDS
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Bits, Floats, Harmonics, Table, Truths
from gradhesion.core.waves.general import cut_of

ROWS: Final = ("pull_off_force_error", "dissipated_energy_error", "energy_residual", "saturation_radius")
"""What the kernel finds; the others are ratios of what is known."""
_OF_PATTERNS: Final = "gradhesion.core.scene.patterned_report"
_FORCE_ROUNDING: Final = 6.0 * 2.0**-52
ENERGY_ROUNDING: Final = 20.0 * 2.0**-52
"""The true errors on scenes of the twin are at most 4.2 and 15 eps (docs/accuracy.md)."""
_OF_LOAD: Final = 0.2
"""Of the terms of the load over the load: the true errors of soft machines are at most 2.5 eps of that and H."""
_PANEL: Final = 0.6
"""Waves a panel of 16 nodes of the loop."""
_APART: Final = 5.0
"""Waves by which the other sum begins later and ends earlier."""
LOOPED: Final = 2048.0
"""Waves up to which a loop is integrated."""
PROMISED: Final = 1e-9
"""Error of the energy, in parts of its terms, above which a scene does not meet the tolerance (docs/accuracy.md)."""
_NEGLIGIBLE: Final = 1e-8
"""Of the outer end of a branch that begins in a point (k = 1), up to where its work is about the cube of it."""


@kernel()
def crests(table: Table, series: Harmonics, gain: float) -> float:
    """Return chi of all waves at their crests."""
    total = 0.0
    for i in range(series.shape[0]):
        total += math.hypot(series[i, 1], series[i, 2]) * series[i, 0] ** (0.5 * (1.0 - table.k))
    return gain * table.amplitude * total


@face_of(Series, _OF_PATTERNS)
@kernel()
def load_terms(basis: Basis, curve: Series, x: float) -> float:
    """Return the size of the terms of the load at x, every wave for itself."""
    table, cosine_bins, series = basis
    B, m, g, _, _ = curve
    z = TWO_PI * x
    power = amplitude_power(table, z)
    waves = 0.0
    for i in range(series.shape[0]):
        n = series[i, 0]
        h = n * math.hypot(series[i, 1], series[i, 2])
        _, s0, s1, _, t0, t1 = integrals(table, cosine_bins, n * x, 0.0)
        waves += h * min(abs(s0) + abs(s1) + abs(t0) + abs(t1), 4.0)
        waves += h * min(1.0, table.amplitude * (n * z) ** (-0.5 * (1.0 + table.k)))
    return (B * z**m * (m / (1.0 + table.k + m)) + z * power + g * z * waves) / (power * power)


@kernel()
def _force_terms(basis: Basis, curve: Series, x: float, turns: bool) -> float:
    """Return the size of the terms of a pull-off at x, its change with ln x among them where a cycle `turns` there.

    Then x is no number given.
    """
    terms = load_terms(basis, curve, x)
    if turns:
        _, _, rate = slope(basis, measured_by(curve, YES), x)
        terms += abs(TWO_PI * x * rate)
    return terms


@kernel()
def _work(basis: Basis, curve: Series, low: float, high: float) -> float:
    """Return the integral of the load over the coordinate along a branch, from its inner end to its outer one."""
    _, _, series = basis
    shortest = 0.0
    for i in range(series.shape[0]):
        shortest = max(shortest, series[i, 0])
    longest = _PANEL / shortest if shortest > 0.0 else math.inf
    total, end = 0.0, max(low, _NEGLIGIBLE * high)
    while high > end:
        width = min(longest, high / 3.0, high - low)
        part = 0.0
        for i in range(NODES.size):
            x = high - width * NODES[i]
            _, _, _, _, load = state(basis, curve, x, 0.0)
            _, _, rate = slope(basis, curve, x, 0.0)
            part += WEIGHTS[i] * load * rate
        total += width * part
        high = max(low, high - width)
    return total * TWO_PI


@kernel()
def loop(basis: Basis, curve: Series, count: int, trace: Trace, rim: float) -> tuple[float, float]:
    """Return the loop integral of the load over the coordinate, and the outermost radius that a jump passes.

    The trace is that of path/general.py, walked as far as the rim at least.
    """
    _, _, _, alpha, beta = curve
    total, outermost = 0.0, 0.0
    arrival = math.inf  # on the branch of the rim
    for branch in range(count):
        if not trace[ARRIVAL, branch] <= rim or trace[ARRIVAL, branch] == math.inf:
            continue
        outermost = trace[ARRIVAL, branch]
        if trace[END, branch] < rim:
            total += _work(basis, curve, outermost, trace[END, branch])
        else:
            arrival = outermost
    level = math.inf
    if rim < math.inf:
        level = coordinate(basis, curve, rim)
        _, _, front, _, load = state(basis, curve, rim)
        pinned = highest_depth(count, trace, rim, level) - level
        total -= pinned * (load + 0.5 * pinned * front / (alpha + beta * front))
        outermost = outermost if arrival < math.inf else rim
    now, landing = leave_rim(basis, curve, count, trace, rim, level)
    if now >= 0:
        descend(basis, curve, trace, now, NO)
    while now >= 0:
        # loading that lands on the branch of the rim as well goes the rest of it both ways
        high = arrival if landing == rim and arrival < math.inf else landing
        total -= _work(basis, curve, trace[START, now], high)
        landing = trace[LANDING, now]
        now = int(trace[NEXT, now])
    return total, outermost


@kernel()
def last_fold_between(basis: Basis, curve: Series, first: float, high: float, cells: int) -> float:
    """Return x of the last fold between two places, 0 if there is none, NaN if none is met in so many cells inwards."""
    zeros, work = np.empty(MOST), room()
    for _ in range(cells):
        if not high > first:
            return 0.0
        low = max(first, high - min(cell_width(basis.series, high), INWARDS * high))
        value, _, _ = slope(basis, curve, low, 0.0)
        found, _, _ = folds_of_cell(basis, curve, low, high, value, work, zeros, 0.0)
        if found > 0:
            return zeros[found - 1]
        high = low
    return math.nan


@face_of(Series, _OF_PATTERNS)
@kernel()
def outermost_fold(basis: Basis, curve: Series) -> float:
    """Return x of the last fold of a curve, 0 if it has none, inf if folds need not end; NaN if it is not found."""
    table, _, series = basis
    first, high = window(basis, curve)
    if high == math.inf:
        return high
    if series.shape[0] > 0 and high - first > LONGEST_WALK:
        _, begin, end, ends = regular_waves(basis, curve, cut_of(table, series), first, high)
        if ends:
            high = min(high, max(begin, end + NEAR_END) + 2.0 * NEAR_END)
    return last_fold_between(basis, curve, first, high, MOST_CELLS)


@kernel()
def last_left(basis: Basis, curve: Series, count: int, trace: Trace, rim: float) -> float:
    """Return the place that unloading leaves last."""
    level = coordinate(basis, curve, rim) if rim < math.inf else math.inf
    now, _ = leave_rim(basis, curve, count, trace, rim, level)
    if now < 0:
        return rim
    descend(basis, curve, trace, now, NO)
    while int(trace[NEXT, now]) >= 0:
        now = int(trace[NEXT, now])
    return trace[START, now]


@kernel()
def spring_factor(basis: Basis, curve: Series, place: float) -> float:
    """Return by what the energy is multiplied in its error, which is mostly that of a spring if that is soft.

    Its energy is the square of the load at the place that unloading leaves last: as well known as that, twice.
    """
    _, _, _, alpha, beta = curve
    if not (alpha > 0.0 and beta > 0.0 and 0.0 < place < math.inf):
        return 1.0
    _, _, _, _, load = state(basis, curve, place, 0.0)
    return max(1.0, _OF_LOAD * load_terms(basis, curve, place) / abs(load)) if load != 0.0 else 1.0


@kernel()
def _other_sum(basis: Basis, curve: Series, first: float, last: float, rim: tuple[float, float]) -> tuple[float, float]:
    """Return the energy of a long curve over 2 pi l^2 dgamma by other sums, and the place that unloading leaves last.

    Folds stand between x = `first` and `last` only; `rim` is x of the rim, and its rounding error.

    NaN if it cannot be summed.
    """
    middle = middle_of(basis, curve, first, last, _APART)
    if middle.kind == REGULAR:
        tasks = Tasks(YES, curve.alpha > 0.0, NO, NO)
        done, up, down, _, _, _, _ = stride(basis, curve, first, middle, rim, tasks, notes_for(NONE))
        return up.loss + down.loss if done else math.nan, down.waves + down.left
    if middle.kind == FEW:
        x, _ = rim
        count, trace, _ = walk(basis, curve, (first, middle.until), x, YES)
        if count >= 0:
            level = coordinate(basis, curve, x) if x < math.inf else math.inf
            loss, _ = loading_to(basis, curve, count, trace, x, YES)
            unloaded, _, _ = unloading_from(basis, curve, count, trace, x, level, YES)
            return loss + unloaded, last_left(basis, curve, count, trace, x)
    return math.nan, math.nan


@face_of(Series, _OF_PATTERNS)
@kernel()
def energy_reports(
    basis: Basis, curve: Series, rim: float, rim_low: float, energy: float, scale: float
) -> tuple[float, float, float]:
    """Return the error of the energy, and over the scale 2 pi l^2 dgamma the size of its terms and its loop integral.

    The rim is x and its rounding error, the energy over the scale. NaN if not known.
    """
    table, _, series = basis
    _, _, g, alpha, _ = curve
    first, last = window(basis, curve)
    last = min(rim, last)
    waves = last - first
    if last == math.inf:
        return math.nan, math.nan, math.nan
    apart, total, outermost, left = 0.0, math.nan, last, math.nan
    if series.shape[0] > 0 and waves > LONGEST_WALK:
        other, left = _other_sum(basis, curve, first, last, (rim, rim_low))
        apart = 4.0 * abs(energy - other)
    if not waves > LOOPED:
        count, trace, _ = walk(basis, curve, (first, last), rim, NO)
        if count >= 0:
            total, outermost = loop(basis, curve, count, trace, rim)
            left = last_left(basis, curve, count, trace, rim)
    residual = 2.0 / (1.0 + table.k) * total / alpha if alpha > 0.0 else math.nan
    chi = crests(table, series, g)
    terms = (TWO_PI * outermost) ** 2 * chi * (1.0 + chi) + spring_factor(basis, curve, left) * abs(energy)
    return scale * (ENERGY_ROUNDING * table.rounding * terms + apart), terms, residual


class Solved(NamedTuple):
    """The results of solved scenes that reports use, of shape (scenes,)."""

    radius: Floats  # a/R of the pull-off
    energy: Floats  # the dissipated energy in R^2 dgamma
    turned: bool  # whether their cycles turn at the rims
    status: Bits  # bits of problem/status.py


@kernel()
def report_scenes(basis: Basis, curves: GeneralCurves, solved: Solved, wanted: Truths, out: Floats) -> None:
    """Report on the scenes of one gradient exponent that have values, each a curve with one rim of its own.

    `wanted` are those of ROWS that are found, of shape (4,), and `out` where they go, of shape (4, scenes): the error
    of the force in 1.5 pi R dgamma, error and residual of the energy in R^2 dgamma, the radius of saturation in R. The
    status also has a flag where an energy is not as accurate as promised.
    """
    table = basis.table
    radius, energy, turned, status = solved
    for i in curves.numbers:
        if status[i] & NO_VALUE:
            continue
        _, cosine_bins, series, curve, wavelength, length, unit = curve_at(basis, curves, i)
        waves = Basis(table, cosine_bins, series)
        if wanted[0]:
            terms = _force_terms(waves, curve, radius[i] / wavelength, turned and status[i] & PULL_OFF_AT_RIM != 0)
            out[0, i] = _FORCE_ROUNDING * table.rounding * force_unit(table.k, length, unit) * terms
        if wanted[1] or wanted[2]:
            rim, scale = curves.rims[i, 0], TWO_PI * length * length
            x = rim / wavelength
            x_low = fma(-x, wavelength, rim) / wavelength if x < math.inf else 0.0
            out[1, i], terms, total = energy_reports(waves, curve, x, x_low, energy[i] / scale, scale)
            out[2, i] = energy[i] - scale * total
            if out[1, i] > PROMISED * scale * terms:
                status[i] |= TOLERANCE_NOT_MET
        if wanted[3]:
            out[3, i] = outermost_fold(waves, curve) * wavelength
