"""The answers of any profile under any control (core/face.py), and of the leading form of its short waves."""

import math
from typing import Any

from gradhesion.core import face
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.arches import folds_between, is_one_cosine
from gradhesion.core.curve.branches import Trace, ends
from gradhesion.core.curve.general import Basis, Patterned, Series, size, slope, state
from gradhesion.core.curve.general_branches import find_level
from gradhesion.core.curve.general_folds import Zeros, room
from gradhesion.core.curve.one_cosine_energy import jump_of_one_cosine, jump_of_one_cosine_from_zero
from gradhesion.core.curve.short_wave import ShortWave
from gradhesion.core.curve.window import first_fold_bound, last_fold_bound
from gradhesion.core.harmonics.series import highest_harmonic, sums
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.turning.general_reach import reach
from gradhesion.core.types import Harmonics, Work
from gradhesion.core.waves.general_jump import jump_between, jump_from_zero


@face.find_place.answers(Series, ShortWave, Patterned)
@kernel()
def find_place(basis: Basis, curve: Series, level: float, trace: Trace, branch: int) -> float:
    return find_level(basis, curve, level, ends(trace, branch), 0.0)


@face.loss_between.answers(Series)
@kernel()
def loss_between(basis: Basis, curve: Series, start: float, end: float, _work: Work) -> float:
    """Return it in closed form for one cosine where that is accurate, else by quadrature."""
    if is_one_cosine(basis[2], curve.exponent) and end > 0.0:
        served, energy = jump_of_one_cosine(basis, curve, start, end)
        if served:
            return energy
    return jump_between(basis, curve, start, end, 0.0)


@kernel()
def _from_zero(basis: Basis, curve: Series, x: float, level: float) -> float:
    """Return the energy that the jump from zero contact to x loses at a level."""
    if is_one_cosine(basis[2], curve.exponent):
        served, energy = jump_of_one_cosine_from_zero(basis, curve, x, level)
        if served:
            return energy
    return jump_from_zero(basis, curve, x, level, 0.0)


@face.loss_from_zero.answers(Series)
@kernel()
def loss_from_zero(basis: Basis, curve: Series, x: float) -> float:
    return _from_zero(basis, curve, x, 0.0)


@face.loss_to_zero.answers(Series)
@kernel()
def loss_to_zero(basis: Basis, curve: Series, x: float, level: float) -> float:
    """Return it as `loss_between` does; 0 under a dead load."""
    return 0.0 if curve.alpha == 0.0 else -_from_zero(basis, curve, x, level)


@face.depth_at.answers(Series, ShortWave, Patterned)
@kernel()
def depth_at(basis: Basis, curve: Series, x: float, _level: float) -> float:
    """Return the depth of the contact, whatever is prescribed."""
    if x == 0.0:
        return face.depth_of_point(basis, curve)
    _, _, _, depth, _ = state(basis, curve, x, 0.0)
    return depth


@face.waves_at.answers(Series)
@kernel(contract=True)
def waves_at(basis: Basis, _curve: Series, x: float, whole: float) -> tuple[float, float, float, float]:
    table, cosine_bins, series = basis
    return sums(table, cosine_bins, series, x, whole)


@face.depth_of_point.answers(Series)
@kernel()
def depth_of_point(basis: Basis, _curve: Series) -> float:
    return -1.0 if basis[0].k == 1.0 else 0.0


@face.relative_toughness.answers(Series, ShortWave)
@kernel()
def relative_toughness(_basis: Basis, _curve: Series, _x: float) -> float:
    return 1.0


@face.shortest_wave.answers(Series, ShortWave)
@kernel()
def shortest_wave(basis: Basis, _curve: Series) -> float:
    return highest_harmonic(basis.series)


@face.window.answers(Series)
@kernel()
def window(basis: Basis, curve: Series) -> tuple[float, float]:
    return first_fold_bound(basis, curve) / TWO_PI, last_fold_bound(basis, curve) / TWO_PI


@face.punch_of.answers(Series)
@kernel()
def punch_of(basis: Basis, curve: Series) -> tuple[Any, Harmonics, float]:
    return basis.cosine_bins, basis.series, curve.gain


@face.find_all_folds.answers(Series)
@kernel()
def find_all_folds(basis: Basis, curve: Series, first: float, last: float, zeros: Zeros) -> tuple[int, bool, float]:
    return folds_between(basis, curve, first, last, room(), zeros)


face.reach.answers(Series)(reach)


@face.measured_by.answers(Series)
@kernel()
def measured_by(curve: Series, by_load: bool) -> Series:
    B, m, g, _, _ = curve
    return Series(B, m, g, 0.0, 1.0) if by_load else Series(B, m, g, 1.0, 0.0)


@face.size_at.answers(Series)
@kernel()
def size_at(basis: Basis, curve: Series, x: float) -> float:
    return size(basis, curve, x, 0.0)


@face.most_size_at.answers(Series, Patterned)
@kernel()
def most_size_at(_basis: Basis, _curve: Series, _x: float) -> float:
    """Return inf: no bound is known without a power."""
    return math.inf


@face.fold_at.answers(Series, Patterned)
@kernel()
def fold_at(basis: Basis, curve: Series, x: float) -> tuple[float, float]:
    value, rate, _ = slope(basis, curve, x, 0.0)
    return value, rate


@face.gap_in.answers(Series, Patterned)
@kernel()
def gap_in(_curve: Series, _trace: Trace) -> float:
    """Return inf: a long curve has notes instead (path/general_long.py)."""
    return math.inf
