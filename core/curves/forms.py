"""The curves that can be drawn, in reduced form: depth and load at a place.

EXACT      the curve of one wave (curve/cosine.py); a place is x = a/lambda, `numbers` are its bend and gain
PLAIN      a smooth punch of any pull (smooth.py, envelope.py), z^2/2 - pull z^((1-k)/2) and X [X/(3+k) - pull] with
           X = z^((3+k)/2); a place is z = a/l with the bend 1, `numbers` are k, the pull and a height that depth gains
GENERAL    any power and any waves (core/curve/general.py), or their leading form (core/curve/short_wave.py); a place is
           x = a/lambda, `numbers` are the curve, half the shortest wave and the sum of the amplitudes, and its basis
           stands for the table

All other numbers are padded to five, so that one compiled sampler serves all forms but the general ones, which the
compiler tells by their three.
"""

import math
from typing import Any, Final, TypeAlias

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.cosine import wave
from gradhesion.core.curve.general import Basis, Series, state
from gradhesion.core.face import AnyTable, depth_of_point
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Floats, Harmonics, Table

Numbers: TypeAlias = tuple[float, float, float, float, float]
"""The numbers of a form, by its kind; a general one has `GENERAL_NUMBERS`, of which the first five are a `Series`."""

EXACT: Final = 0
PLAIN: Final = 1
GENERAL: Final = 2
GENERAL_NUMBERS: Final = 3


@kernel(contract=True)
def _exact_point(table: Table, numbers: Numbers, x: float) -> tuple[float, float]:
    """Return depth and load of curve/cosine.py."""
    if x == 0.0:
        return (-1.0 if table.k == 1.0 else 0.0), 0.0
    b, g, _, _, _ = numbers
    z, power, s0, s1, _, _, _ = wave(table, 0.0, x)
    return (
        z * (0.5 * b * z + g * s0 - power),
        z / (power * power) * (b * z / (3.0 + table.k) + g * (s0 - s1) - power),
    )


@kernel()
def _plain_point(numbers: Numbers, z: float) -> tuple[float, float]:
    """Return depth and load of a smooth punch."""
    k, pull, height, _, _ = numbers
    abscissa = z ** (0.5 * (3.0 + k))
    return 0.5 * z * z - pull * z ** (0.5 * (1.0 - k)) + height, abscissa * (abscissa / (3.0 + k) - pull)


@kernel()
def _general_point(basis: Basis, numbers: Any, x: float) -> tuple[float, float]:
    """Return depth and load of curve/general.py."""
    if x == 0.0:
        return depth_of_point(basis, numbers[0]), 0.0
    _, _, _, depth, load = state(basis, numbers[0], x, 0.0)
    return depth, load


@kernel()
def _general_ripple(basis: Basis, numbers: Any, x: float) -> tuple[float, float, float]:
    """Return what `ripple` does: the waves of all harmonics together."""
    z = TWO_PI * x
    power = amplitude_power(basis[0], z)
    return numbers[1], numbers[2] * z * power, numbers[2] * z / power


def general_numbers(k: float, curve: Series, amplitude: float, series: Harmonics) -> tuple[Series, float, float]:
    """Return the numbers of the general form; `amplitude` is that of S0 (struve/table.py)."""
    n = series[:, 0]
    heights = np.hypot(series[:, 1], series[:, 2]) * n ** (0.5 * (1.0 - k))
    half_wave = 0.5 / float(n.max()) if n.size else math.inf
    return curve, half_wave, amplitude * curve.gain * float(heights.sum())


@kernel()
def point(kind: int, table: AnyTable, numbers: Any, place: float) -> tuple[float, float]:
    """Return the reduced depth and load of a form at a place >= 0."""
    if len(numbers) == GENERAL_NUMBERS:
        return _general_point(table, numbers, place)
    if kind == EXACT:
        return _exact_point(table, numbers, place)
    return _plain_point(numbers, place)


@kernel()
def ripple(kind: int, table: AnyTable, numbers: Any, place: float) -> tuple[float, float, float]:
    """Return the length of a half wave, and the amplitude of the waves in depth and in load at a place."""
    if len(numbers) == GENERAL_NUMBERS:
        return _general_ripple(table, numbers, place)
    if kind == EXACT:
        z = TWO_PI * place
        power = amplitude_power(table, z)
        height = table.amplitude * numbers[1]
        return 0.5, height * z * power, height * z / power
    return math.inf, 0.0, 0.0


@kernel()
def fill_points(kind: int, table: AnyTable, numbers: Numbers, knots: Floats) -> None:
    """Put depth and load in the second and third row of `knots`, of shape (3, n), whose first row holds places."""
    for i in range(knots.shape[1]):
        knots[1, i], knots[2, i] = point(kind, table, numbers, knots[0, i])
