"""The answers of any profile under any control about its sensitivities (core/face.py)."""

import math

from gradhesion.core import face
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve import general
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.sensitivities.general_jump_slopes import Change, rim_slope_of
from gradhesion.core.sensitivities.general_wave_slopes import add_jump, add_jump_from_zero
from gradhesion.core.types import Slopes, Work


@face.steepness_at.answers(Series)
@kernel()
def steepness_at(basis: Basis, curve: Series, x: float) -> float:
    _, _, rate = general.slope(basis, curve, x)
    return rate


@face.rim_slope.answers(Series)
@kernel()
def rim_slope(basis: Basis, curve: Series, level: float, x: float) -> float:
    """Return it for a place before which no waves were left out."""
    return rim_slope_of(basis, curve, level, x)


@face.add_slopes.answers(Series)
@kernel()
def add_slopes(basis: Basis, curve: Series, near: Change, start: float, end: float, _work: Work, total: Slopes) -> None:
    """Add them for places before which no waves were left out."""
    add_jump(basis, curve, near, start, end, 0.0, total)


@face.add_slopes_to_zero.answers(Series)
@kernel()
def add_slopes_to_zero(basis: Basis, curve: Series, near: Change, x: float, inwards: bool, total: Slopes) -> None:
    """Add them for a place before which no waves were left out."""
    add_jump_from_zero(basis, curve, near, x, 0.0, inwards, total)


@face.start_of_wave.answers(Series)
@kernel()
def start_of_wave(_basis: Basis, _curve: Series, _wave: float) -> tuple[float, float]:
    """Return NaN: there is none."""
    return math.nan, math.nan


@face.add_slopes_of_waves.answers(Series)
@kernel()
def add_slopes_of_waves(
    _basis: Basis,
    _curve: Series,
    _near: Change,
    _waves: tuple[float, float],
    _outwards: bool,
    _final: float,
    _work: Work,
    total: Slopes,
) -> None:
    """Add NaN: there are none."""
    total[:] = math.nan
