"""The reduced curve: against the equilibrium of the punch in its own units, and its slopes against derivatives."""

import math
from collections.abc import Callable
from typing import Any

import mpmath
import pytest

from gradhesion.core.curve.cosine import Cosine, depth, load, slope, slopes, wave
from gradhesion.core.numbers.circle import TWO_PI

EPS = 2.0**-52
Pair = Callable[..., tuple[mpmath.mpf, mpmath.mpf]]
CURVES = [Cosine(0.013, 0.71, 0.0), Cosine(2.9, 0.33, 0.0), Cosine(1e-5, 1.9, 0.0), Cosine(0.4, 0.0, 0.0)]
PLACES = [1e-9, 0.0031, 0.17, 1.0, 5.77, 6.41, 83.3]
EXPONENTS = [0.0, 0.37, 0.5, 1 - 1e-12, 1.0]


def _turns(x: float) -> mpmath.mpf:
    return 2 * mpmath.pi * mpmath.mpf(x)


def _depth(k: float, curve: Any, z: mpmath.mpf, pair: Pair) -> mpmath.mpf:
    b, g, _ = curve
    return b * z * z / 2 + g * z * pair(k, z)[0] - z ** ((1 - mpmath.mpf(k)) / 2)


def _load(k: float, curve: Any, z: mpmath.mpf, pair: Pair) -> mpmath.mpf:
    b, g, _ = curve
    s0, s1 = pair(k, z)
    kappa = mpmath.mpf(k)
    return z ** (1 + kappa) * (b * z * z / (3 + kappa) + g * z * (s0 - s1) - z ** ((1 - kappa) / 2))


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("curve", CURVES)
def test_depth_and_load(k: float, curve: Any, table_of: Callable[[float], Any], slow_pair: Pair) -> None:
    table = table_of(k)
    for x in PLACES:
        z = _turns(x)
        # the sizes of the three terms; the wave's is its amplitude
        amplitude = min(float(z) ** 2, float(z) ** ((1 - k) / 2))
        size = curve[0] * float(z) ** 2 + 2 * curve[1] * amplitude + float(z) ** ((1 - k) / 2)
        assert abs(depth(table, curve, x) - _depth(k, curve, z, slow_pair)) <= 6 * EPS * size
        assert abs(load(table, curve, x) - _load(k, curve, z, slow_pair)) <= 12 * EPS * size * float(z) ** (1 + k)


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("curve", CURVES)
def test_slopes_are_derivatives(k: float, curve: Any, table_of: Callable[[float], Any], slow_pair: Pair) -> None:
    """D, D', D'' of both levels from numerical derivatives of depth and load at 50 digits."""
    mpmath.mp.dps = 50
    kappa = mpmath.mpf(k)
    for x in (0.0031, 0.17, 5.77, 6.41):
        z = _turns(x)
        of_depth = [mpmath.diff(lambda y: _depth(k, curve, y, slow_pair), z, order) for order in (1, 2, 3)]

        def tilt(y: mpmath.mpf) -> mpmath.mpf:
            return mpmath.diff(lambda u: _load(k, curve, u, slow_pair), y) / y ** (1 + kappa)

        of_load = [tilt(z), mpmath.diff(tilt, z, h=mpmath.mpf("1e-12"))]
        for level, exact in ((0.5 * (1 - k), of_depth), (0.5 * (3 + k), of_load)):
            values = slope(table_of(k), curve, level, x)
            for order, truth in enumerate(exact):
                # each derivative of a power of z is of that power over z, and none of the wave is smaller
                size = (curve[0] * float(z) + 4 * curve[1] * max(1.0, float(z) ** ((1 - k) / 2))) + 4 * float(z) ** (
                    -(1 + k) / 2
                ) * min(1.0, float(z)) ** -order
                assert abs(values[order] - truth) <= 12 * EPS * size
            assert values[3] == pytest.approx(depth(table_of(k), curve, x), rel=8 * EPS, abs=8 * EPS)


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("curve", CURVES)
def test_one_slope_more(k: float, curve: Any, table_of: Callable[[float], Any], slow_pair: Pair) -> None:
    """The third of D from a numerical derivative of the depth at 50 digits; the others are those of `slope`."""
    table, level = table_of(k), 0.5 * (1 - k)
    for x in (0.17, 1.0, 5.77, 6.41, 83.3):
        z = _turns(x)
        values, others = slopes(table, curve, level, x), slope(table, curve, level, x)
        size = curve[0] * float(z) + 6 * curve[1] * max(1.0, float(z) ** ((1 - k) / 2)) + 6 * min(1.0, float(z)) ** -4
        for value, other in zip((*values[:3], values[4]), others, strict=True):
            assert abs(value - other) <= 8 * EPS * size * max(1.0, float(z))
        with mpmath.workdps(50):
            truth = mpmath.diff(lambda y: _depth(k, curve, y, slow_pair), z, 4)
        assert abs(values[3] - truth) <= 12 * EPS * size


@pytest.mark.parametrize("k", [0.0, 0.37, 1.0])
def test_it_is_the_equilibrium_of_the_punch(k: float, table_of: Callable[[float], Any]) -> None:
    """From f'(s) = s/R + 2 pi A sin(2 pi s/lambda) by quadrature: sections 3 and 4 of docs/theory.md, R = 1.7."""
    kappa = mpmath.mpf(k)
    radius, wavelength, amplitude = mpmath.mpf("1.7"), mpmath.mpf("0.23"), mpmath.mpf("0.031")
    stiffness, adhesion = mpmath.mpf("340"), mpmath.mpf("1.3")
    x = 2.77
    a = wavelength * mpmath.mpf(x)
    factor = 2 ** (1 - kappa) * stiffness / (1 + kappa)

    def moment(power: mpmath.mpf) -> mpmath.mpf:
        # s = a sin u takes the end point where the weight is not smooth
        def integrand(u: mpmath.mpf) -> mpmath.mpf:
            s = a * mpmath.sin(u)
            shape = s / radius + 2 * mpmath.pi * amplitude * mpmath.sin(2 * mpmath.pi * s / wavelength)
            return shape * (a * mpmath.cos(u)) ** (2 * power + 1)

        return mpmath.quad(integrand, mpmath.linspace(0, mpmath.pi / 2, 9))

    hertz = a ** (1 - kappa) * moment((kappa - 1) / 2)
    stretch = mpmath.sqrt(2 ** (1 + kappa) * mpmath.pi * adhesion * a ** (1 - kappa) / stiffness)
    force = factor * (a ** (1 + kappa) * hertz - moment((kappa + 1) / 2)) - factor * a ** (1 + kappa) * stretch

    length = wavelength / (2 * mpmath.pi)
    s = mpmath.sqrt(2 ** (1 + kappa) * mpmath.pi * adhesion / stiffness)
    depth_scale = s * length ** ((1 - kappa) / 2)
    curve = Cosine(
        float(2 * length**2 / ((1 + kappa) * radius * depth_scale)),
        float(amplitude * wavelength / depth_scale),
        0.0,
    )
    table = table_of(k)
    assert abs(depth(table, curve, x) * depth_scale / (hertz - stretch) - 1) <= 40 * EPS
    load_scale = factor * length ** (1 + kappa) * depth_scale
    assert abs(load(table, curve, x) * load_scale / force - 1) <= 40 * EPS


@pytest.mark.parametrize("k", EXPONENTS)
def test_load_rises_with_the_hertzian_depth(k: float, table_of: Callable[[float], Any]) -> None:
    """dP/da = K a^(1+k) d delta_H/da + the stretch: one D for both, apart by the level alone."""
    for curve in CURVES:
        for x in PLACES[1:]:
            of_depth, of_load = (slope(table_of(k), curve, level, x)[0] for level in (0.5 * (1 - k), 0.5 * (3 + k)))
            power = (2 * math.pi * x) ** (-0.5 * (1 + k))
            size = abs(of_depth) + 2 * power
            assert abs(of_depth - of_load - (1 + k) * power) <= 6 * EPS * size


def test_lag_shifts_the_waves(table_of: Callable[[float], Any]) -> None:
    """A lag of whole waves changes nothing; one of half a wave turns the sign of what oscillates."""
    table = table_of(0.37)
    x = 20.3
    plain, whole = wave(table, 0.0, x), wave(table, 3.0, x)
    for value, other in zip(plain, whole, strict=True):
        assert math.isclose(value, other, rel_tol=1e-13)
    z = TWO_PI * x
    half = wave(table, 0.5, x)
    # S0 = 1/z + ... and a wave of amplitude C z^(-n)
    assert abs(plain[2] + half[2] - 2 / z) <= 2 / z**3


def test_no_lag_below_the_switch(table_of: Callable[[float], Any]) -> None:
    assert wave(table_of(0.37), 0.25, 3.3) == wave(table_of(0.37), 0.0, 3.3)
