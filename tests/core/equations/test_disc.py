"""Contact over a disc against the integrals that define it, the printed sums, and 24 scenes solved to 30 digits."""

import itertools
import math
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core.equations import general, hertz, jkr, quadrature
from tests.conformance.kinds import Kind
from tests.conformance.theory import Curve
from tests.core.scene import EPS, material_of, scene_of

M, WAVELENGTH = 71.3, 0.37
ONE, SERIES = ([-0.023], []), ([-0.021, 0.004, 0.0], [0.003, 0.0, -0.002])


def slope_of(s: Any, waves: tuple[list[float], list[float]], m: float, lib: Any) -> Any:
    total = s ** (m - 1)
    for n, a_n, b_n in general.harmonics(*waves):
        y = 2 * lib.pi * n * s / WAVELENGTH
        total = total + 2 * lib.pi * n * (b_n * lib.cos(y) - a_n * lib.sin(y))
    return total


@pytest.mark.parametrize("k", [0.0, 0.37, 1.0])
def test_integrals_are_struves_and_bessels_functions(k: float) -> None:
    """(B1)-(B4): sqrt(pi)/2 Gamma(n + j) (z/2)^(1/2 - n - j) H and J of the order n + j - 1/2, n = (1+k)/2, z = 2 pi x.

    Far out that is sines with a mean height 1/z, (B5)-(B8); values do not depend on what stands beside them.
    """
    x = np.array([1.3e-4, 0.21, 1.7, 9.3, 200.25, 2000.6])
    found = np.array([*hertz.sine_integrals(k, x)[:2], *hertz.cosine_integrals(k, x)])
    n = (1 + mpmath.mpf(k)) / 2
    for i, one in enumerate(x):
        z = 2 * mpmath.pi * mpmath.mpf(float(one))
        kinds = itertools.product((mpmath.struveh, mpmath.besselj), (0, 1))
        for value, (wave, j) in zip(found[:, i], kinds, strict=True):
            size = mpmath.sqrt(mpmath.pi) / 2 * mpmath.gamma(n + j) * (z / 2) ** (mpmath.mpf(0.5) - n - j)
            assert value == pytest.approx(float(size * wave(n + j - 0.5, z)), abs=20 * EPS * (1 + 6 * min(one, 10.0)))
        alone = (*hertz.sine_integrals(k, one)[:2], *hertz.cosine_integrals(k, one))
        assert found[:, i].tolist() == [float(value) for value in alone]
    at_0 = [math.sqrt(math.pi) / 2 * math.gamma(0.5 * k + j + 0.5) / math.gamma(0.5 * k + j + 1) for j in (0, 1)]
    assert hertz.cosine_integrals(k, 0.0) == pytest.approx(np.array(at_0), rel=20 * EPS)
    assert not np.any(hertz.sine_integrals(k, 0.0)[:2])


@pytest.mark.parametrize(("k", "a", "m"), [(0.0, 0.29, 1.0), (0.31, 0.017, 3.7), (0.31, 1.3, 2.0), (1.0, 0.29, 2.0)])
@pytest.mark.parametrize("waves", [ONE, SERIES])
def test_depth_and_load(k: float, a: float, m: float, waves: tuple[list[float], list[float]]) -> None:
    with mpmath.workdps(20):
        nodes = mpmath.linspace(0, mpmath.pi / 2, 3 + math.ceil(6 * a / WAVELENGTH))

        def integral(power: float) -> Any:  # of f' (a^2-s^2)^((power-1)/2), s = a sin u
            quad = mpmath.quad(lambda u: slope_of(a * mpmath.sin(u), waves, m, mpmath) * mpmath.cos(u) ** power, nodes)
            return mpmath.mpf(a) ** power * quad

        moment, depth = integral(k + 2), mpmath.mpf(a) ** (1 - k) * integral(k)
        load = float(2 ** (1 - mpmath.mpf(k)) * M / (1 + k) * (mpmath.mpf(a) ** (1 + k) * depth - moment))
        smooth = [mpmath.beta(mpmath.mpf(m) / 2, (1 + mpmath.mpf(k)) / 2 + j) / 2 for j in (0, 1)]
    assert hertz.power_indentation(k, a, m) == pytest.approx(float(smooth[0]) * a**m, rel=20 * EPS)
    assert hertz.power_moment(k, a, m) == pytest.approx(float(smooth[1]) * a ** (1 + k + m), rel=20 * EPS)
    size = a**m + 0.2 * a
    stiff = size * 2 * M * a ** (1 + k)
    found = general.hertz_indentation(k, a, WAVELENGTH, *waves, m)
    assert found == pytest.approx(float(depth), abs=20 * EPS * size)
    found = general.hertz_load(k, M, a, WAVELENGTH, *waves, m)
    assert 1.5 * math.pi * found == pytest.approx(load, abs=40 * EPS * stiff)
    by_quadrature = (lambda s: slope_of(s, waves, m, np)), WAVELENGTH / 3
    assert quadrature.hertz_indentation(k, a, *by_quadrature) == pytest.approx(float(depth), abs=1e-13 * size)
    found = quadrature.hertz_load(k, M, a, *by_quadrature)
    assert 1.5 * math.pi * found == pytest.approx(load, abs=1e-13 * stiff)
    if waves is ONE:
        one = (WAVELENGTH, 0.023)
        assert hertz.indentation(k, a, *one, m) == pytest.approx(float(depth), abs=20 * EPS * size)
        assert 1.5 * math.pi * hertz.load(k, M, a, *one, m) == pytest.approx(load, abs=40 * EPS * stiff)
        assert hertz.wave_indentation(k, a, *one) == pytest.approx(float(depth - smooth[0] * a**m), abs=20 * EPS * size)
        rest = float(moment - smooth[1] * a ** (1 + k + m))
        assert hertz.wave_moment(k, a, *one) == pytest.approx(rest, abs=20 * EPS * size * a ** (1 + k))


@pytest.mark.parametrize("k", [0.0, 0.43, 0.9])
def test_the_printed_sums(k: float) -> None:
    """(5.8)-(5.11) with (B1)-(B4), as tests/conformance/theory.py has them: Struve's functions, Bessel's of the sines."""
    kind, a = Kind(waves=((1, 0.021, 0.003), (2, -0.004, 0.0), (3, 0.0, -0.002))), np.linspace(0.05, 0.8, 9)
    scene = scene_of(k, 0.3, 430.0, 0.13, 0.13, 1.0, math.inf)
    curve, wave = Curve(kind, scene), (k, material_of(scene), a, 0.13, *SERIES)
    np.testing.assert_allclose(general.indentation(*wave), curve.depth(a), rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(general.load(*wave), curve.load(a), rtol=1e-11)


@pytest.mark.parametrize("k", [0.0, 0.31, 0.9])
def test_the_inversion_of_the_generalised_abel_equation(k: float) -> None:
    # (3.8), (A1)-(A5): the depth gives the profile back, f(a) = (2/pi) cos(k pi/2) int_0^a s^k delta (a^2-s^2)^-n ds
    a, n = mpmath.mpf("0.7"), (1 + mpmath.mpf(k)) / 2

    def depth(s: mpmath.mpf) -> float:
        return float(quadrature.hertz_indentation(k, float(s), np.sinh))

    def integrand(v: mpmath.mpf) -> mpmath.mpf:  # a^2 - s^2 = a^2 v^(1/(1-n))
        s = a * mpmath.sqrt(1 - v ** (1 / (1 - n)))
        return s ** (k - 1) * depth(s)

    with mpmath.workdps(15):
        total = mpmath.quad(integrand, [*mpmath.linspace(0, 0.9, 4), 0.99, 0.999, 1], maxdegree=5)
        found = mpmath.cos(mpmath.pi * k / 2) / mpmath.pi * total * a ** (2 - 2 * n) / (1 - n)
        # (A4): int (T^2-a^2)^((1+k)/2) f' da = (1+k) int s^k delta ds
        moment = mpmath.quad(lambda s: s**k * depth(s), [0, 0.01, 0.1, a], maxdegree=5)
        slope = mpmath.quad(lambda s: (a * a - s * s) ** n * mpmath.sinh(s), [0, a / 2, a])
    assert float(found) == pytest.approx(math.cosh(0.7) - 1.0, rel=1e-8)
    assert float((1 + k) * moment / slope) == pytest.approx(1.0, rel=1e-9)


@pytest.mark.parametrize("k", [0.0, 0.37, 1.0])
def test_slopes(k: float) -> None:
    # central differences leave step^2/6 of the third derivative, and rounding eps/step
    a, step, wave, stiff = np.linspace(0.02, 0.8, 300), 1e-6, (0.13, 0.017), 3.0 * M

    def rate(function: Any) -> Any:
        return (function(a + step) - function(a - step)) / (2 * step)

    number, stretch = jkr.fold_number(k, stiff, a, *wave), jkr.adhesive_depth(k, stiff, a)
    disc = hertz.disc_stiffness(k, stiff, a)
    for function, level, scale in ((jkr.indentation, 0.5 * (1 - k), 1.0), (jkr.load, 0.5 * (3 + k), disc)):
        # d/da = scale Delta/a (q - level)
        found = rate(lambda x, function=function: function(k, stiff, x, *wave)) / scale
        np.testing.assert_allclose(found, stretch / a * (number - level), atol=2e-5)
        assert ((number > level)[:-1] != (number > level)[1:]).any()
    series = (0.13, *SERIES, 2.3)
    depth = rate(lambda x: general.hertz_indentation(k, x, *series))
    np.testing.assert_allclose(quadrature.indentation_slope(k, a, *series), depth, atol=1e-7)
    np.testing.assert_allclose(rate(lambda x: general.hertz_load(k, stiff, x, *series)), disc * depth, atol=1e-5)
    expected = rate(lambda x: hertz.sine_integrals(k, x)[:2]) / (2 * math.pi)
    np.testing.assert_allclose(hertz.sine_integrals(k, a)[2:], expected, atol=1e-8)
    expected = rate(lambda r: general.height(r, *wave, 3.3))
    np.testing.assert_allclose(general.slope(a, *wave, 3.3), expected, atol=1e-7)
    assert np.isnan(general.slope([0.5, 1.0, 2.0], *wave, 0.5)).all()
