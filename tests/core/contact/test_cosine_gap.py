"""The gap outside a contact: another route to it, limits, and the published condition that is not sufficient."""

import math
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core.contact.gap import height, opening, opening_far, opening_near, openings_between
from gradhesion.core.curve.cosine import Cosine, depth
from gradhesion.core.face import edge_at
from gradhesion.core.struve.fractional import NODES

EXPONENTS = [0.0, 0.3, 0.7, 0.95]
CASES = [(0.4, 1.1), (0.9, 1.0), (0.9, 3.3), (2.37, 2.9), (2.37, 9.4)]
BEND, GAIN = 0.037, 0.83
EPS = 2.0**-52
Table = Callable[[float], Any]
Pair = Callable[[float, float], tuple[mpmath.mpf, mpmath.mpf]]


def _gap(table: Any, k: float, a: float, r: float) -> float:
    """The gap in units of the depth, from the opening."""
    c = 0.5 * (1.0 - k)
    curve = Cosine(BEND, GAIN, 0.0)
    z1, z = 2 * math.pi * a, 2 * math.pi * r
    share = math.sin(math.pi * c) / (math.pi * c) if c > 0 else 1.0
    return share * (z * z - z1 * z1) ** c / z1**c * float(opening(table, curve, edge_at(table, curve, a), r))


def _second_route(k: float, a: float, r: float, pair: Pair) -> mpmath.mpf:
    """The profile less the depth, and what the contact itself contributes: the integral from 0 to a, not from a to r."""
    k_, pi = mpmath.mpf(k), mpmath.pi

    def hertz(z: mpmath.mpf) -> mpmath.mpf:
        return BEND * z * z / 2 + GAIN * z * pair(k, z)[0]

    z1, z = 2 * pi * mpmath.mpf(a), 2 * pi * mpmath.mpf(r)
    level = hertz(z1) - z1 ** ((1 - k_) / 2)
    profile = (1 + k_) * BEND * z * z / 4 + GAIN * (1 - mpmath.cos(z))
    places = [0, z1 / 4, z1 / 2, z1 * 0.75, z1 * 0.95, z1]
    inside = mpmath.quad(lambda s: s**k_ * (level - hertz(s)) * (z * z - s * s) ** (-(1 + k_) / 2), places)
    return profile - level + 2 / pi * mpmath.cos(k_ * pi / 2) * inside


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize(("a", "r"), CASES)
def test_second_route(k: float, a: float, r: float, table_of: Table, slow_pair: Pair) -> None:
    with mpmath.workdps(18):
        expected = _second_route(k, a, r, slow_pair)
    assert abs(_gap(table_of(k), k, a, r) - expected) < 1e-11 * (1 + abs(expected))


@pytest.mark.parametrize("k", EXPONENTS)
def test_the_two_integrals_are_one(k: float, table_of: Table) -> None:
    """Far outside: from the contact outwards, and over the contact."""
    table, curve = table_of(k), Cosine(BEND, GAIN, 0.0)
    for a, r in [(0.4, 9.0), (2.37, 17.0), (7.7, 40.0)]:
        edge = edge_at(table, curve, a)
        near, far = (float(integral(table, curve, edge, r)) for integral in (opening_near, opening_far))
        assert math.isclose(near, far, rel_tol=1e-8)


@pytest.mark.parametrize(("a", "r"), CASES)
def test_at_k_1_it_is_local(a: float, r: float, table_of: Table) -> None:
    """There depth_H = b z^2/2 + g (1 - cos z), and the gap is depth_H(r) - depth(a)."""
    z1, z = 2 * math.pi * a, 2 * math.pi * r
    level = BEND * z1**2 / 2 + GAIN * (1 - math.cos(z1)) - 1
    expected = BEND * z**2 / 2 + GAIN * (1 - math.cos(z)) - level
    assert math.isclose(_gap(table_of(1.0), 1.0, a, r), expected, rel_tol=1e-11)
    assert math.isclose(_gap(table_of(1 - 1e-12), 1 - 1e-12, a, r), expected, rel_tol=1e-10)


@pytest.mark.parametrize("k", [*EXPONENTS, 1.0])
def test_at_the_edge_it_is_one(k: float, table_of: Table) -> None:
    table, curve = table_of(k), Cosine(BEND, GAIN, 0.0)
    for a in (0.4, 2.37, 31.1):
        edge = edge_at(table, curve, a)
        assert math.isclose(height(table, curve, edge, a), 1.0, rel_tol=1e-14)
        assert math.isclose(opening(table, curve, edge, a * (1 + 1e-9)), 1.0, abs_tol=2e-6)  # it changes by 7 z there


@pytest.mark.parametrize("k", [*EXPONENTS, 1.0])
@pytest.mark.parametrize("a", [1.3, 6.7, 80.2])
def test_windows(k: float, a: float, table_of: Table) -> None:
    """Seventeen openings at once, to what a polynomial over a wave leaves; a part of them from further out."""
    table, curve = table_of(k), Cosine(BEND, GAIN, 0.0)
    edge = edge_at(table, curve, a)
    heights, openings = np.empty(16), np.empty(17)
    for high in (a + 0.3, a + 1.1):
        openings_between(table, curve, edge, a, high, heights, openings)
        radii = np.sqrt(a * a + (high * high - a * a) * np.array([*NODES, 1.0]))
        expected = [opening(table, curve, edge, r) for r in radii]
        # at a = 1.3 the branch point at 0 is near; depths grow by bend 2 pi a a wave
        assert np.abs(openings - expected).max() < (1e-6 if a < 2 else 3e-9) * np.abs(heights).max()
    # powers are good to two units either way, and the terms of a height are no larger than some of these
    assert abs(heights[3] - height(table, curve, edge, radii[3])) < 64 * EPS * np.abs(heights).max()
    # no curve at all leaves F = 1 - (1 - z^c/z_a^c): it falls, and averages of it from a + 0.4 on lie between
    flat = Cosine(0.0, 0.0, 0.0)
    edge = edge_at(table, flat, a)
    openings_between(table, flat, edge, a + 0.4, a + 0.8, heights, openings)
    assert (openings[:16] >= heights - 1e-12).all()
    assert (openings <= height(table, flat, edge, a + 0.4) + 1e-12).all()


def test_a_monotonic_profile_is_not_sufficient(table_of: Table) -> None:
    """k = 0, M R/dgamma = 1e7, lambda = 0.1 R: no slope of the profile is negative, and yet the surfaces overlap."""
    wavelength, a, r = 0.1, 0.0511, 0.0811
    A = 4.59 * wavelength / (4 * math.pi**2)
    radii = np.linspace(0, 1, 100_001)
    assert (radii + 2 * math.pi * A * np.sin(2 * math.pi * radii / wavelength) >= 0).all()
    stretch = math.sqrt(2 * math.pi / 1e7)
    length = wavelength / (2 * math.pi)
    scale = stretch * math.sqrt(length)
    table, curve = table_of(0.0), Cosine(2 * length * length / scale, A * wavelength / scale, 0.0)
    edge = edge_at(table, curve, a / wavelength)
    z1, z = a / length, r / length
    gap = 2 / math.pi * math.sqrt((z * z - z1 * z1) / z1) * opening(table, curve, edge, r / wavelength) * scale
    assert math.isclose(gap, -2.597e-4, rel_tol=1e-3)
    assert depth(table, curve, a / wavelength) > 0.0
