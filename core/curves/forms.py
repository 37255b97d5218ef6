"""The curves that can be drawn, in reduced form: depth and load at a radius.

EXACT      the curve of one wave (curve/cosine.py); a place is x = a/lambda
PLAIN      a smooth punch of any pull (smooth.py, envelope.py), z^2/2 - pull z^((1-k)/2) and X [X/(3+k) - pull] with
           X = z^((3+k)/2); a place is z = a/l with the bend 1
PowerLaw   a smooth punch of any power, z^m - pull z^c and z^(1+k) [m/(1+k+m) z^m - pull z^c] with c = (1-k)/2; z = a/l
General    any power and any waves (core/curve/general.py), or their leading form (core/curve/short_wave.py); a place is
           x = a/lambda, and the basis of the curve stands for the table

The first two are one type, `Reduced`, so that one compiled sampler works for both.
"""

import math
from typing import Any, Final, NamedTuple

import numpy as np

from gradhesion.core.compiler.dispatch import face
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.cosine import wave
from gradhesion.core.curve.general import Basis, Series, state
from gradhesion.core.face import AnyTable, depth_of_point
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Floats, Harmonics, Table

EXACT: Final = 0
PLAIN: Final = 1


class Reduced(NamedTuple):
    """The numbers of one wave, or of a smooth punch."""

    kind: int  # EXACT or PLAIN
    first: float  # the bend of the wave; k
    second: float  # its gain; the pull
    height: float = 0.0  # that the depth of a smooth punch gains


class PowerLaw(NamedTuple):
    """The numbers of a smooth punch of any power and pull, in units in which its depth is z^m."""

    k: float
    exponent: float  # m
    pull: float
    height: float  # that the depth gains


class General(NamedTuple):
    """The numbers of any power and any waves."""

    curve: Any  # a `Series`, or another kind of it
    half_wave: float  # half the shortest wave
    ripple: float  # the sum of the amplitudes of all waves


@kernel(contract=True)
def _exact_point(table: Table, numbers: Reduced, x: float) -> tuple[float, float]:
    """Return depth and load of curve/cosine.py."""
    if x == 0.0:
        return (-1.0 if table.k == 1.0 else 0.0), 0.0
    _, b, g, _ = numbers
    z, power, s0, s1, _, _, _ = wave(table, 0.0, x)
    return (
        z * (0.5 * b * z + g * s0 - power),
        z / (power * power) * (b * z / (3.0 + table.k) + g * (s0 - s1) - power),
    )


@kernel()
def _plain_point(numbers: Reduced, z: float) -> tuple[float, float]:
    """Return depth and load of a smooth punch."""
    _, k, pull, height = numbers
    abscissa = z ** (0.5 * (3.0 + k))
    return 0.5 * z * z - pull * z ** (0.5 * (1.0 - k)) + height, abscissa * (abscissa / (3.0 + k) - pull)


def general_numbers(k: float, curve: Series, amplitude: float, series: Harmonics) -> General:
    """Return the numbers of the general form; `amplitude` is that of S0 (struve/table.py)."""
    n = series[:, 0]
    heights = np.hypot(series[:, 1], series[:, 2]) * n ** (0.5 * (1.0 - k))
    half_wave = 0.5 / float(n.max()) if n.size else math.inf
    return General(curve, half_wave, amplitude * curve.gain * float(heights.sum()))


@face(by="numbers")
def point(table: AnyTable, numbers: Any, place: float) -> tuple[float, float]:
    """Return the reduced depth and load of a form at a place >= 0."""


@face(by="numbers")
def ripple(table: AnyTable, numbers: Any, place: float) -> tuple[float, float, float]:
    """Return the length of a half wave, and the amplitude of the waves in depth and in load at a place."""


@point.answers(Reduced)
@kernel()
def reduced_point(table: Table, numbers: Reduced, place: float) -> tuple[float, float]:
    return _exact_point(table, numbers, place) if numbers.kind == EXACT else _plain_point(numbers, place)


@ripple.answers(Reduced)
@kernel()
def reduced_ripple(table: Table, numbers: Reduced, place: float) -> tuple[float, float, float]:
    if numbers.kind != EXACT:
        return math.inf, 0.0, 0.0
    z = TWO_PI * place
    power = amplitude_power(table, z)
    height = table.amplitude * numbers.second
    return 0.5, height * z * power, height * z / power


@point.answers(PowerLaw)
@kernel()
def power_law_point(_table: Table, numbers: PowerLaw, place: float) -> tuple[float, float]:
    k, m, pull, height = numbers
    own, adhesion = place**m, pull * place ** (0.5 * (1.0 - k))
    return own - adhesion + height, place ** (1.0 + k) * (m / (1.0 + k + m) * own - adhesion)


@ripple.answers(PowerLaw)
@kernel()
def power_law_ripple(_table: Table, _numbers: PowerLaw, _place: float) -> tuple[float, float, float]:
    return math.inf, 0.0, 0.0


@point.answers(General)
@kernel()
def general_point(basis: Basis, numbers: General, place: float) -> tuple[float, float]:
    if place == 0.0:
        return depth_of_point(basis, numbers.curve), 0.0
    _, _, _, depth, load = state(basis, numbers.curve, place, 0.0)
    return depth, load


@ripple.answers(General)
@kernel()
def general_ripple(basis: Basis, numbers: General, place: float) -> tuple[float, float, float]:
    """Return this for the waves of all harmonics together."""
    z = TWO_PI * place
    power = amplitude_power(basis.table, z)
    return numbers.half_wave, numbers.ripple * z * power, numbers.ripple * z / power


@kernel()
def fill_points(table: AnyTable, numbers: Any, knots: Floats) -> None:
    """Put depth and load in the second and third row of `knots`, of shape (3, n), whose first row has the places."""
    for i in range(knots.shape[1]):
        knots[1, i], knots[2, i] = point(table, numbers, knots[0, i])
