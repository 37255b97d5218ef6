"""The equilibrium curve of any profile under any control, in the reduced form of core/curve/cosine.py.

    depth(z) = B z^m + g z w0 - z^c                       c = (1-k)/2, n = (1+k)/2, w0 and w1 of harmonics/series.py
    load(z)  = z^(1+k) [B z^m m/(1+k+m) + g z w1 - z^c]
    B = G(m/2) G(n)/(2 G(n + m/2)) l^(m-c)/(R^(m-1) s),   g = A lambda/(s l^c),   l = lambda/2 pi

What is prescribed is the *coordinate* Y = alpha depth + beta load: the depth (1, 0), the load (0, 1), or the far end of
a machine of stiffness S, depth + load K l^(1+k)/S, here divided by 1 + K l^(1+k)/S. With t = beta z^(1+k)

    dY/dz = (alpha + t) D,   D = m B z^(m-1) + g v - q z^(-n),   q = [alpha (1-k)/2 + t (3+k)/2]/(alpha + t)

so that every control has the folds D = 0 of its own level q (docs/theory.md, section 15).
"""

import math
from typing import Any, NamedTuple

from gradhesion.core.compiler.dispatch import face_of
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.face import waves_at
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.problem.curves import GeneralCurves, is_in_range
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Floats, Harmonics, Table


class Series(NamedTuple):
    """Any profile under any control: B, m, g, and the shares alpha of the depth and beta of the load."""

    bend: float
    exponent: float
    gain: float
    alpha: float
    beta: float


class Patterned(Series):
    """The same on an interface whose toughness varies with the radius (curve/patterned.py)."""

    __slots__ = ()


class Basis(NamedTuple):
    """What a series is computed from."""

    table: Table  # the table of the exponent
    cosine_bins: Any  # the flat array of harmonics/series_table.py; of a short wave its mean height over g
    series: Harmonics  # the harmonics


class Made(NamedTuple):
    """A curve made from the numbers of a scene, all of its `Basis` but the table, and its units in R."""

    valid: bool  # whether the numbers are in range
    cosine_bins: Any
    series: Harmonics
    curve: Any  # a `Series`, or `Patterned`
    wavelength: float  # the unit of x
    length: float  # l, that of z
    depth: float  # the unit of depth


@face_of(GeneralCurves, "gradhesion.core.curve.patterned", by="curves")
@kernel()
def rims_of(curves: GeneralCurves, i: int) -> Floats:
    """Return the rims a_max/R of curve number i, of shape (rims,)."""
    return curves.rims[i if curves.rims.shape[0] > 1 else 0]


@kernel(contract=True)
def state(basis: Basis, curve: Series, x: float, whole: float = 0.0) -> tuple[float, float, float, float, float]:
    """Return z, z^c, z^(1+k), depth and load at whole + x > 0."""
    table, _, _ = basis
    B, m, g, _, _ = curve
    z = TWO_PI * (whole + x)
    power = amplitude_power(table, z)
    stretch, front = z * power, 1.0 / (power * power)
    bend = B * z * z if m == 2.0 else B * z**m
    w0, w1, _, _ = waves_at(basis, curve, x, whole)
    depth = bend + g * z * w0 - stretch
    load = front * (bend * (m / (1.0 + table.k + m)) + g * z * w1 - stretch)
    return z, stretch, front, depth, load


@kernel(contract=True)
def coordinate(basis: Basis, curve: Series, x: float, whole: float = 0.0) -> float:
    """Return Y at whole + x > 0."""
    _, _, _, alpha, beta = curve
    _, _, _, depth, load = state(basis, curve, x, whole)
    return alpha * depth + beta * load


@kernel(contract=True)
def level_at(k: float, alpha: float, t: float) -> float:
    """Return q."""
    if alpha == 0.0:
        return 0.5 * (3.0 + k)
    return (alpha * (0.5 * (1.0 - k)) + t * (0.5 * (3.0 + k))) / (alpha + t)


@kernel(contract=True)
def level_with_rate(k: float, alpha: float, beta: float, power: float, z: float) -> tuple[float, float, float]:
    """Return t, q and dq/dz, with power = z^(-n)."""
    if beta == 0.0:
        return 0.0, 0.5 * (1.0 - k), 0.0
    t = beta / (power * power)
    change = 0.0 if alpha == 0.0 else alpha * t * ((1.0 + k) / (alpha + t)) ** 2 / z
    return t, level_at(k, alpha, t), change


@kernel(contract=True)
def slope(basis: Basis, curve: Series, x: float, whole: float = 0.0) -> tuple[float, float, float]:
    """Return D, dD/dz, and dY/dz at whole + x > 0."""
    table, _, _ = basis
    B, m, g, alpha, beta = curve
    k = table.k
    z = TWO_PI * (whole + x)
    power = amplitude_power(table, z)
    t, q, change = level_with_rate(k, alpha, beta, power, z)
    bend = 2.0 * B * z if m == 2.0 else m * B * z ** (m - 1.0)
    _, _, v, v1 = waves_at(basis, curve, x, whole)
    value = bend + g * v - q * power
    return value, (m - 1.0) * bend / z + g * v1 + (0.5 * (1.0 + k) * q / z - change) * power, (alpha + t) * value


@kernel(contract=True)
def rise(basis: Basis, curve: Series, x: float, whole: float = 0.0) -> tuple[float, float, float]:
    """Return Y and its first two derivatives with respect to z at whole + x > 0."""
    table, _, _ = basis
    B, m, g, alpha, beta = curve
    k = table.k
    z = TWO_PI * (whole + x)
    power = amplitude_power(table, z)
    stretch, front = z * power, 1.0 / (power * power)
    t, q, change = level_with_rate(k, alpha, beta, power, z)
    bend = B * z * z if m == 2.0 else B * z**m
    push = m * bend / z
    w0, w1, v, v1 = waves_at(basis, curve, x, whole)
    value = push + g * v - q * power
    rate = (m - 1.0) * push / z + g * v1 + (0.5 * (1.0 + k) * q / z - change) * power
    load = front * (bend * (m / (1.0 + k + m)) + g * z * w1 - stretch)
    here = alpha * (bend + g * z * w0 - stretch) + beta * load
    return here, (alpha + t) * value, (alpha + t) * rate + t * (1.0 + k) / z * value


@kernel(contract=True)
def size(basis: Basis, curve: Series, x: float, whole: float = 0.0) -> float:
    """Return the size of the terms of Y at whole + x > 0."""
    table, _, series = basis
    B, m, g, alpha, beta = curve
    z = TWO_PI * (whole + x)
    power = amplitude_power(table, z)
    waves = 0.0
    for i in range(series.shape[0]):
        n = series[i, 0]
        height = abs(series[i, 1]) if series[i, 2] == 0.0 else math.hypot(series[i, 1], series[i, 2])
        waves += height if n == 1.0 else height * n ** (0.5 * (1.0 - table.k))
    bend = B * z * z if m == 2.0 else B * z**m
    return (alpha + beta / (power * power)) * (bend + z * power * (1.0 + g * table.amplitude * waves) + g * waves)


@kernel()
def curve_of(
    k: float,
    exponent: float,
    depth_factor: float,
    stretch: float,
    wavelength: float,
    amplitude: float,
    compliance: float,
) -> tuple[Series, float, float]:
    """Return the curve, l, and the unit of depth, from k, m, s, lambda and A (0 for a smooth punch); lengths are in R.

    The depth factor is G(m/2) G(n)/(2 G(n + m/2)), the compliance K/S in units of 1/R^(1+k): 0 under displacement
    control, inf under load control.
    """
    length = wavelength / TWO_PI
    c = 0.5 * (1.0 - k)
    unit = stretch * length**c
    share = compliance * length ** (1.0 + k)
    alpha, beta = (0.0, 1.0) if share == math.inf else (1.0 / (1.0 + share), share / (1.0 + share))
    return (
        Series(depth_factor * length**exponent / unit, exponent, amplitude * wavelength / unit, alpha, beta),
        length,
        unit,
    )


@face_of(GeneralCurves, "gradhesion.core.curve.patterned", by="curves")
@kernel()
def curve_at(basis: Basis, curves: GeneralCurves, i: int) -> Made:
    """Return curve number i of some, from the basis of their profile; without harmonics where the amplitude is 0."""
    _, exponent, depth_factor, stretch, wavelength, amplitude, compliance, _, _ = curves
    rows = basis.series[: basis.series.shape[0] if amplitude[i] > 0.0 else 0]
    curve, length, unit = curve_of(
        basis.table.k, exponent, depth_factor, stretch[i], wavelength[i], amplitude[i], compliance[i]
    )
    valid = is_in_range(stretch[i], wavelength[i], amplitude[i]) and compliance[i] >= 0.0
    valid = valid and 0.0 < curve.bend < math.inf and 0.0 <= curve.gain < math.inf
    return Made(valid, basis.cosine_bins, rows, curve, wavelength[i], length, unit)
