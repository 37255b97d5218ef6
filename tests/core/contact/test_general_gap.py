"""The gap outside a contact of any profile: another route to it at 18 digits, its limits, and its windows."""

import math
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core import Profile
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.contact.gap import (
    height,
    opening,
    opening_far,
    opening_near,
    openings_between,
)
from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.face import edge_at, panels_of
from gradhesion.core.problem.shape import rows_of
from gradhesion.core.struve.fractional import NODES

ONE = [(1.0, 1.0, 0.0)]
SHIFTED = [(1.0, 0.8, 0.6)]
MIXED = [(2.0, 0.61, 0.0), (3.0, -0.1, 0.21)]
BEND, GAIN = 0.037, 0.83
EXPONENTS = [0.0, 0.3, 0.9]


def _scene(k: float, m: float, rows: list[tuple[float, float, float]]) -> tuple[Any, Any]:
    return Basis(*tables_of(k), np.array(rows)), Series(BEND * (2 * math.pi) ** (2 - m), m, GAIN, 1.0, 0.0)


def _second_route(k: float, curve: Any, rows: Any, a: float, r: float) -> mpmath.mpf:
    """The profile less the depth, and what the contact contributes, from depths by the definitions of section 4."""
    B, m, g, _, _ = (mpmath.mpf(float(number)) for number in curve)
    k_, pi = mpmath.mpf(k), mpmath.pi

    def hertz(z: mpmath.mpf) -> mpmath.mpf:
        total = B * z**m
        for n, even, odd in rows:
            y = n * z
            s0 = y / (1 + k_) * mpmath.hyp1f2(1, mpmath.mpf(3) / 2, (3 + k_) / 2, -y * y / 4)
            t0 = mpmath.beta(0.5, (1 + k_) / 2) / 2 * mpmath.hyp0f1(1 + k_ / 2, -y * y / 4)
            total += g * z * n * (even * s0 + odd * t0)
        return total

    z1, z = 2 * pi * mpmath.mpf(a), 2 * pi * mpmath.mpf(r)
    level = hertz(z1) - z1 ** ((1 - k_) / 2)
    profile = B * z**m / (m * mpmath.beta(m / 2, (1 + k_) / 2) / 2)
    for n, even, odd in rows:
        profile += g * (even * (1 - mpmath.cos(n * z)) + odd * mpmath.sin(n * z))
    places = [0, *(z1 * mpmath.mpf(share) for share in (0.03, 0.15, 0.4, 0.7, 0.95, 1))]
    inside = mpmath.quad(lambda s: s**k_ * (level - hertz(s)) * (z * z - s * s) ** (-(1 + k_) / 2), places)
    return profile - level + 2 / pi * mpmath.cos(k_ * pi / 2) * inside


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("rows", [SHIFTED, MIXED], ids=["shifted", "mixed"])
@pytest.mark.parametrize(("m", "a", "r"), [(1.0, 0.4, 1.1), (1.5, 0.9, 1.0), (2.0, 0.4, 0.7), (3.0, 0.9, 3.3)])
def test_second_route(k: float, m: float, a: float, r: float, rows: Any) -> None:
    basis, curve = _scene(k, m, rows)
    c = 0.5 * (1.0 - k)
    z1, z = 2 * math.pi * a, 2 * math.pi * r
    scale = math.sin(math.pi * c) / (math.pi * c) * (z * z - z1 * z1) ** c / z1**c
    with mpmath.workdps(18):
        expected = _second_route(k, curve, rows, a, r)
    assert abs(scale * opening(basis, curve, edge_at(basis, curve, a), r) - expected) < 1e-11 * (1 + abs(expected))


@pytest.mark.parametrize("rows", [ONE, SHIFTED, MIXED], ids=["one", "shifted", "mixed"])
@pytest.mark.parametrize("m", [1.0, 2.6])
def test_at_k_1_it_is_local(m: float, rows: Any) -> None:
    """There depth_H is the profile, and the gap is depth_H(r) - depth(a)."""
    basis, curve = _scene(1.0, m, rows)

    def profile(z: float) -> float:
        waves = sum(even * (1 - math.cos(n * z)) + odd * math.sin(n * z) for n, even, odd in rows)
        return float(curve[0] * z**m + GAIN * waves)

    for a, r in [(0.4, 1.1), (0.9, 3.3), (2.37, 2.9)]:
        expected = profile(2 * math.pi * r) - profile(2 * math.pi * a) + 1
        assert math.isclose(opening(basis, curve, edge_at(basis, curve, a), r), expected, rel_tol=1e-11)


@pytest.mark.parametrize("k", [*EXPONENTS, 1.0])
def test_one_cosine_is_that_of_its_own_kind(k: float) -> None:
    basis, _ = _scene(k, 2.0, ONE)
    curve, own = Series(BEND / 2, 2.0, GAIN, 1.0, 0.0), Cosine(BEND, GAIN, 0.0)
    for a, r in [(0.4, 1.1), (0.9, 3.3), (2.37, 2.9), (7.7, 9.1)]:
        expected = opening(basis[0], own, edge_at(basis[0], own, a), r)
        assert math.isclose(opening(basis, curve, edge_at(basis, curve, a), r), expected, rel_tol=1e-11)


@pytest.mark.parametrize("k", [*EXPONENTS, 0.999])
@pytest.mark.parametrize("m", [1.0, 2.0, 6.5, 40.0])
def test_the_two_integrals_are_one(k: float, m: float) -> None:
    """From the contact outwards and over the contact; a power of 40 is steep, and gets panels of its own."""
    basis, _ = _scene(k, m, MIXED)
    curve = Series(1e-6 / (2 * math.pi) ** m, m, GAIN, 1.0, 0.0)
    for a, r in [(0.21, 0.45), (0.7, 1.5), (1.3, 2.9)]:
        edge = edge_at(basis, curve, a)
        size = max(abs(height(basis, curve, edge, x)) for x in np.linspace(a, r, 50))
        near, far = (integral(basis, curve, edge, r) for integral in (opening_near, opening_far))
        # (pi c)/sin pi c and the depths of 80 waves
        assert near == pytest.approx(far, abs=1e-11 * size)


@pytest.mark.parametrize("k", [*EXPONENTS, 1.0])
def test_at_the_edge_it_is_one(k: float) -> None:
    basis, curve = _scene(k, 2.3, MIXED)
    for a in (0.4, 2.37, 31.1):
        edge = edge_at(basis, curve, a)
        assert math.isclose(height(basis, curve, edge, a), 1.0, rel_tol=1e-14)
        assert math.isclose(opening(basis, curve, edge, a * (1 + 1e-9)), 1.0, abs_tol=1e-5)


@pytest.mark.parametrize("k", [*EXPONENTS, 1.0])
@pytest.mark.parametrize("a", [1.3, 6.7])
def test_windows(k: float, a: float) -> None:
    """Seventeen openings at once, to what a polynomial over a shortest wave leaves."""
    basis, curve = _scene(k, 2.0, MIXED)
    edge, high = edge_at(basis, curve, a), a + 1.1 * panels_of(basis, curve)[0]
    heights, openings = np.empty(16), np.empty(17)
    openings_between(basis, curve, edge, a, high, heights, openings)
    radii = np.sqrt(a * a + (high * high - a * a) * np.array([*NODES, 1.0]))
    expected = [opening(basis, curve, edge, r) for r in radii]
    assert np.abs(openings - expected).max() < 3e-9 * np.abs(heights).max()


def test_the_shortest_wave() -> None:
    basis, curve = _scene(0.3, 2.0, MIXED)
    assert panels_of(basis, curve)[0] == 1 / 3
    assert panels_of(basis._replace(series=rows_of(Profile())[:0]), curve)[0] == math.inf
