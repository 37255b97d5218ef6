"""The asymptotic form itself: its slopes and folds against dense scans of its curve, and its lowest load."""

import math

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core.curve.short_wave import (
    ShortWave,
    depth,
    depth_slope,
    folds_of_half,
    half_at,
    load,
    lowest_load,
    outer_edge,
)

EPS = 2.0**-52
EXPONENTS = [0.0, 0.29, 0.74, 1.0]
CURVES = [(0.4, 0.3), (0.03, 0.9), (0.02, 1.6), (0.005, 0.12), (1.3, 4.0)]
"""b and chi."""


def wave_of(k: float, b: float, chi: float) -> ShortWave:
    return ShortWave(k, b, chi, 0.83 * chi, (1 + k) * math.pi / 4)


def loads(wave: ShortWave, z: NDArray[np.float64]) -> NDArray[np.float64]:
    k, b, chi, _, phi = wave
    values: NDArray[np.float64] = z ** ((3 + k) / 2) * (b * z ** ((3 + k) / 2) / (3 + k) - 1 + chi * np.sin(z - phi))
    return values


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize(("b", "chi"), CURVES)
def test_the_slope_is_that_of_the_depth(k: float, b: float, chi: float) -> None:
    wave = wave_of(k, b, chi)

    def slow(z: mpmath.mpf) -> mpmath.mpf:
        power = z ** ((1 - mpmath.mpf(k)) / 2)
        return mpmath.mpf(b) * z * z / 2 + wave[3] - power * (1 - mpmath.mpf(chi) * mpmath.sin(z - mpmath.mpf(wave[4])))

    for z in (0.013, 0.9, 4.4, 31.7):
        size = 1.0 + b * z * z + (1 + chi) * z ** ((1 - k) / 2)
        assert depth(wave, z) == pytest.approx(float(slow(mpmath.mpf(z))), abs=16 * EPS * size)
        expected = float(mpmath.diff(slow, mpmath.mpf(z)))
        size = b * z + (1 + chi) * z ** ((1 - k) / 2) * (1 + 1 / z)
        assert depth_slope(wave, z) == pytest.approx(expected, abs=32 * EPS * size)


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize(("b", "chi"), CURVES)
def test_the_folds_are_those_of_a_dense_scan(k: float, b: float, chi: float) -> None:
    wave = wave_of(k, b, chi)
    level = 0.5 * (1 - k)
    found = []
    for i in range(40):
        count, inner, outer, rising = folds_of_half(wave, level, float(i))
        folds = [(inner, rising), (outer, not rising)][:count]
        edges = (outer_edge(wave, level, i - 1.0), outer_edge(wave, level, float(i)))
        assert all(edges[0] <= z <= edges[1] and half_at(wave, level, z) == i for z, _ in folds)
        found += folds
    z = np.arange(1e-3, found[-1][0] + 5.0 if found else 60.0, 1e-3)
    z = z[z < outer_edge(wave, level, 39.0)]
    slopes = np.array([depth_slope(wave, place) for place in z])
    turns = np.flatnonzero((slopes[1:] > 0) != (slopes[:-1] > 0))
    assert len(found) == turns.size
    for (place, rising), turn in zip(found, turns, strict=True):
        assert z[turn] <= place <= z[turn + 1]
        assert rising == (slopes[turn + 1] > 0)


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize(("b", "chi"), CURVES)
@pytest.mark.parametrize("rim", [0.7, 9.3, math.inf])
def test_nothing_is_lower_than_the_lowest_load(k: float, b: float, chi: float, rim: float) -> None:
    wave = wave_of(k, b, chi)
    lowest, place = lowest_load(wave, rim)
    assert 0.0 < place <= rim
    assert lowest == pytest.approx(load(wave, place), rel=4 * EPS)
    end = ((3 + k) * (1 + chi) / b) ** (2 / (3 + k))  # beyond, every load is positive
    scan = loads(wave, np.linspace(0, min(end, rim), 200_001)[1:])
    assert lowest <= scan.min() + 16 * EPS * abs(scan.min())
    assert lowest == pytest.approx(scan.min(), rel=1e-5)
