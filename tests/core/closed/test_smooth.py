"""The smooth punch: its closed forms against the curve that they come from, at 30 digits."""

import math

import mpmath
import numpy as np
import pytest

from gradhesion.core.closed import smooth

EPS = 2.0**-52
EXPONENTS = [0.0, 1e-16, 0.27, 0.5, 0.83, 1 - 1e-12, 1.0]
UNIT = 2.0
"""(1+k) s where the length l is R."""


def _depth(k: mpmath.mpf, z: mpmath.mpf) -> mpmath.mpf:
    return z * z / 2 - z ** ((1 - k) / 2)


def _load(k: float, z: mpmath.mpf) -> mpmath.mpf:
    abscissa = z ** ((3 + mpmath.mpf(k)) / 2)
    return abscissa * (abscissa / (3 + mpmath.mpf(k)) - 1)


def _energy(k: mpmath.mpf, z: mpmath.mpf, level: mpmath.mpf) -> mpmath.mpf:
    """Integrate the drop of the potential from zero contact to z, the substitution y = u^2 taking the branch point."""
    return mpmath.quad(
        lambda u: 2 * u * u * u * (1 - ((u**4 / 2 - level) / u ** (1 - k)) ** 2) if u else mpmath.mpf(0),
        [0, mpmath.sqrt(z)],
    )


@pytest.mark.parametrize("k", EXPONENTS)
def test_pull_off_is_the_lowest_load(k: float) -> None:
    """P = X (X/(3+k) - 1) in units that are 4/3 of 1.5 pi R dgamma for every k."""
    force = smooth.smooth_force(k, math.inf)
    place = smooth.smooth_places(k)[0]
    z = mpmath.findroot(lambda z: mpmath.diff(lambda y: _load(k, y), z), mpmath.mpf(1.4))
    assert abs(place / z - 1) <= 4 * EPS
    assert abs(force / (-4 * _load(k, z) / 3) - 1) <= 4 * EPS
    assert abs(force - (3 + k) / 3) <= EPS
    # on both sides of that radius: a force at the rim is as large there
    edge = 0.5 * (3.0 + k)
    assert math.isclose(smooth.smooth_force(k, edge * (1 - EPS)), force, rel_tol=2 * EPS)


@pytest.mark.parametrize("k", EXPONENTS)
def test_small_punch_is_pulled_off_at_its_rim(k: float) -> None:
    stretch = UNIT / (1.0 + k)
    for rim in (1e-30, 0.1, 1.1):
        force = smooth.smooth_force(k, smooth.smooth_abscissa(k, stretch, rim))
        # a power, whose exponent is rounded, and three products
        assert abs(force / (-4 * _load(k, mpmath.mpf(rim)) / 3) - 1) <= (4 + abs(math.log(rim))) * EPS


@pytest.mark.parametrize("k", EXPONENTS)
def test_length_makes_the_bend_one(k: float) -> None:
    stretch = 0.00371
    length = smooth.smooth_length(k, stretch)
    bend = 2 * mpmath.mpf(length) ** ((3 + mpmath.mpf(k)) / 2) / ((1 + mpmath.mpf(k)) * stretch)
    assert abs(bend - 1) <= 8 * EPS
    assert math.isclose(smooth.smooth_length.py_func(k, stretch), length, rel_tol=4 * EPS)


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("rim", [0.05, 0.31, 0.9, 1.5, 2.7, math.inf])
def test_cycle(k: float, rim: float) -> None:
    """At the stretch 2/(1+k) the length l is R."""
    stretch, kappa = UNIT / (1.0 + k), mpmath.mpf(k)
    goal = min(mpmath.mpf(rim), 2 ** (2 / (3 + kappa)))
    left = min(mpmath.mpf(rim), ((1 - kappa) / 2) ** (2 / (3 + kappa)))
    loaded = smooth.smooth_loading(k, stretch, rim)
    expected = 2 * mpmath.pi * _energy(kappa, goal, mpmath.mpf(0))
    assert abs(loaded - expected) <= 8 * EPS * expected
    unloaded = smooth.smooth_unloading(k, stretch, rim)
    expected = -2 * mpmath.pi * _energy(kappa, left, _depth(kappa, left)) if left > 0 else mpmath.mpf(0)
    # 1 - k, 1 + k and 3 + k are rounded; quadrature is as good as that of terms that cancel
    assert abs(unloaded - expected) <= 16 * EPS * expected + 1e-27
    expected_last = 2 * _depth(kappa, left) / (1 + kappa) if left > 0 else mpmath.mpf(-1)
    assert abs(smooth.smooth_last(k, stretch, rim) - expected_last) <= 4 * EPS
    deepest = smooth.smooth_deepest(k, stretch, rim)
    if rim < math.inf:
        depth = 2 * max(mpmath.mpf(0), _depth(kappa, mpmath.mpf(rim))) / (1 + kappa)
        assert abs(deepest - depth) <= 8 * EPS * (1 + rim**2), "a difference of two terms"
    else:
        assert deepest == math.inf


@pytest.mark.parametrize("k", EXPONENTS)
def test_places_are_those_of_the_closed_forms(k: float) -> None:
    stretch, kappa = UNIT / (1.0 + k), mpmath.mpf(k)
    *radii, last = smooth.smooth_places(k)
    for radius, abscissa in zip(radii, (0.5 * (3.0 + k), smooth.ABSCISSA_OF_JUMP_IN, 0.5 * (1.0 - k)), strict=True):
        assert abs(radius**2 - smooth.smooth_square(k, stretch, abscissa)) <= 8 * EPS * radius**2
        assert abs(smooth.smooth_abscissa(k, stretch, radius) - abscissa) <= 8 * EPS * abscissa
    assert abs(last - (_depth(kappa, mpmath.mpf(radii[-1])) if k < 1.0 else -1)) <= 4 * EPS


def losses(k: float, rim: float) -> tuple[float, float]:
    """Return what loading and unloading lose where the length l is R."""
    stretch = UNIT / (1.0 + k)
    return smooth.smooth_loading(k, stretch, rim), smooth.smooth_unloading(k, stretch, rim)


@pytest.mark.parametrize("k", [0.0, 0.27, 0.83, 1.0])
def test_loss_is_continuous_in_the_rim_and_constant_beyond_the_jump_in(k: float) -> None:
    for place in (2 ** (2 / (3 + k)), (0.5 * (1 - k)) ** (2 / (3 + k))):
        if place > 0.0:
            near = [sum(losses(k, place * (1 + step))) for step in (-1e-12, 1e-12)]
            assert math.isclose(*near, abs_tol=1e-11)
    assert losses(k, 3.0) == losses(k, math.inf)


@pytest.mark.parametrize("k", [0.0, 0.5, 0.9])
def test_whole_cycle_in_closed_form(k: float) -> None:
    """H = pi dgamma [e(t) a2^2 - e(1) a1^2], section 11 of docs/theory.md."""

    def part(q: float) -> float:
        return 16 * q**2 / ((1 + k) * (3 + k) * (5 + k)) - 8 * q / ((1 + k) * (3 + k)) + 2 / (1 + k) - 1

    # at b = 1, (1+k) R s = 2 in units of the length
    q = (1 - k) / 4
    first, second = 2 ** (2 / (3 + k)), (2 * q) ** (2 / (3 + k))
    expected = math.pi * (part(q) * second**2 - part(1.0) * first**2)
    assert math.isclose(sum(losses(k, math.inf)), expected, rel_tol=8 * EPS)


def test_depth_plain_and_jitted() -> None:
    for k in EXPONENTS:
        for z in np.geomspace(1e-8, 1e8, 30):
            expected = smooth.smooth_depth.py_func(k, z)
            assert math.isclose(smooth.smooth_depth(k, z), expected, rel_tol=4 * EPS, abs_tol=4 * EPS)
