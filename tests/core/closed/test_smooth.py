"""The smooth punch: its closed forms against the curve that they come from, at 30 digits."""

import math
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core.closed import smooth

EPS = 2.0**-52
EXPONENTS = [0.0, 1e-16, 0.27, 0.5, 0.83, 1 - 1e-12, 1.0]
KINDS = [lambda f: f, lambda f: f.py_func]


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
@pytest.mark.parametrize("kind", KINDS)
def test_pull_off_is_the_lowest_load(k: float, kind: Callable[..., Any]) -> None:
    """P = X (X/(3+k) - 1) in units that are 4/3 of 1.5 pi R dgamma for every k."""
    force, place = kind(smooth.smooth_force)(k, kind(smooth.smooth_constants)(k)[0], math.inf)
    z = mpmath.findroot(lambda z: mpmath.diff(lambda y: _load(k, y), z), mpmath.mpf(1.4))
    assert abs(place / z - 1) <= 4 * EPS
    assert abs(force / (-4 * _load(k, z) / 3) - 1) <= 4 * EPS
    assert abs(force - (3 + k) / 3) <= EPS


@pytest.mark.parametrize("k", EXPONENTS)
def test_small_punch_is_pulled_off_at_its_rim(k: float) -> None:
    for rim in (1e-30, 0.1, 1.1):
        force, place = smooth.smooth_force(k, smooth.smooth_constants(k)[0], rim)
        assert place == rim
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
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("rim", [0.05, 0.31, 0.9, 1.5, 2.7, math.inf])
def test_cycle(k: float, rim: float, kind: Callable[..., Any]) -> None:
    loaded, unloaded, unloading, last = kind(smooth.smooth_cycle)(k, kind(smooth.smooth_constants)(k), rim)
    kappa = mpmath.mpf(k)
    goal = min(mpmath.mpf(rim), 2 ** (2 / (3 + kappa)))
    left = min(mpmath.mpf(rim), ((1 - kappa) / 2) ** (2 / (3 + kappa)))
    expected_last = _depth(kappa, left) if left > 0 else mpmath.mpf(-1)
    # the jump-in and the jump-out are differences of terms of the size z^2
    assert abs(loaded - _energy(kappa, goal, mpmath.mpf(0))) <= 8 * EPS * float(goal) ** 2
    expected = -_energy(kappa, left, expected_last) if left > 0 else 0
    assert abs(unloaded - expected) <= 8 * EPS * float(goal) ** 2
    assert unloading == (0 if k == 1.0 else 1)
    assert abs(last - expected_last) <= 4 * EPS


@pytest.mark.parametrize("k", [0.0, 0.27, 0.83, 1.0])
def test_loss_is_continuous_in_the_rim_and_constant_beyond_the_jump_in(k: float) -> None:
    constants = smooth.smooth_constants(k)
    for place in (2 ** (2 / (3 + k)), (0.5 * (1 - k)) ** (2 / (3 + k))):
        if place > 0.0:
            near = [sum(smooth.smooth_cycle(k, constants, place * (1 + step))[:2]) for step in (-1e-12, 1e-12)]
            assert math.isclose(*near, abs_tol=1e-11)
    assert smooth.smooth_cycle(k, constants, 3.0) == smooth.smooth_cycle(k, constants, math.inf)


@pytest.mark.parametrize("k", [0.0, 0.5, 0.9])
def test_whole_cycle_in_closed_form(k: float) -> None:
    """H = pi dgamma [F(q) a2^2 - F(1) a1^2], section 11 of docs/theory.md."""
    loss = sum(smooth.smooth_cycle(k, smooth.smooth_constants(k), math.inf)[:2])

    def part(q: float) -> float:
        return 16 * q**2 / ((1 + k) * (3 + k) * (5 + k)) - 8 * q / ((1 + k) * (3 + k)) + 2 / (1 + k) - 1

    # at b = 1, (1+k) R s = 2 in units of the length
    q = (1 - k) / 4
    first, second = 2 ** (2 / (3 + k)), (2 * q) ** (2 / (3 + k))
    assert math.isclose(loss, 0.5 * (part(q) * second**2 - part(1.0) * first**2), rel_tol=8 * EPS)


def test_depth_plain_and_jitted() -> None:
    for k in EXPONENTS:
        for z in np.geomspace(1e-8, 1e8, 30):
            expected = smooth.smooth_depth.py_func(k, z)
            assert math.isclose(smooth.smooth_depth(k, z), expected, rel_tol=4 * EPS, abs_tol=4 * EPS)


@pytest.mark.parametrize("k", [0.0, 0.3, 1.0])
def test_places_are_the_first_of_the_constants(k: float) -> None:
    assert smooth.smooth_places(k)[:2] == smooth.smooth_constants(k)[:2]
