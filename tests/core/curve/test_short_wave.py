"""The leading form of short waves: its values, its slopes and its folds, against (5.15)-(5.17) in slow arithmetic."""

import math
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.general import Basis, coordinate, rise, slope, state
from gradhesion.core.curve.short_wave import MOST_WAVES, SMALLEST, ShortWave, folds_within, sizes_of, waves_of, window
from gradhesion.core.face import depth_of_point

EPS = 2.0**-52
ONE = ((1, 1.0, 0.0),)
SINE = ((1, 0.0, 1.0),)
TWO = ((1, 1.0, 0.1), (3, -0.2, 0.3))
PUNCHES = [(ONE, 2.0), (SINE, 1.0), (TWO, 1.0), (TWO, 2.0), (SINE, 3.0), (TWO, 4.7), (ONE, 8.0)]
GRADIENTS = [0.0, 0.37, 1.0]


class Paper:
    """Depth, load and their slopes over z in 30 digits, from zeta as printed; A = 1 and lambda = 2 pi."""

    def __init__(self, k: float, waves: Any, curve: ShortWave) -> None:
        self.k, self.waves = mpmath.mpf(k), waves
        self.B, self.m, self.g = (mpmath.mpf(value) for value in curve[:3])

    def parts(self, z: Any) -> tuple[Any, Any]:
        """The power, and what adhesion and waves add to the depth without the mean height."""
        k, c = self.k, (1 - self.k) / 2
        shift = (1 + k) * mpmath.pi / 4
        zeta = sum(  # a_n is -cos_n, b_n is sin_n
            (2 * mpmath.pi * n) ** c * (even * mpmath.sin(n * z - shift) + odd * mpmath.cos(n * z - shift))
            for n, even, odd in self.waves
        )
        wave = 2 ** ((k - 1) / 2) * mpmath.gamma((1 + k) / 2) / (2 * mpmath.pi) ** c * zeta
        return self.B * z**self.m, z**c * (self.g * wave - 1)

    def depth(self, z: Any) -> Any:
        power, rest = self.parts(z)
        return power + rest + self.g * sum(even for _, even, _ in self.waves)

    def load(self, z: Any) -> Any:
        power, rest = self.parts(z)
        return z ** (1 + self.k) * (power * self.m / (1 + self.k + self.m) + rest)


@kernel()
def slopes_of(basis: Any, curve: ShortWave, places: Any) -> Any:
    slopes = np.empty(places.size)
    for i in range(places.size):
        slopes[i], _, _ = slope(basis, curve, places[i], 0.0)
    return slopes


def short_wave(k: float, waves: Any, exponent: float, chi: float, fold: float) -> tuple[Any, ShortWave]:
    """Give a curve whose waves are chi of the adhesion, and that has no fold far beyond z = `fold`."""
    table, _ = tables_of(k)
    bend = 0.8 * chi / (exponent * fold ** (exponent - 1 - 0.5 * (1 - k)))
    basis = Basis(table, *waves_of(table, np.array(waves, dtype=float)))
    return basis, ShortWave(bend, exponent, chi / float(table["amplitude"]), 1.0, 0.0)


@pytest.mark.parametrize("k", GRADIENTS)
@pytest.mark.parametrize(("waves", "exponent"), PUNCHES)
def test_it_is_the_curve_of_the_paper(k: float, waves: Any, exponent: float) -> None:
    for chi in (0.3, 1.6):
        basis, by_depth = short_wave(k, waves, exponent, chi, 60.0)
        by_load = by_depth._replace(alpha=0.0, beta=1.0)
        paper = Paper(k, waves, by_depth)
        for x in (0.013, 0.4, 2.7, 11.3):
            z, stretch, front, depth, load = state(basis, by_depth, x)
            # of the phase n z, and of the powers
            size = 16 * EPS * (1 + z) * (by_depth.bend * z**exponent + (1 + 4 * chi) * (stretch + 1))
            place = 2 * mpmath.pi * mpmath.mpf(x)
            assert abs(depth - paper.depth(place)) <= size
            assert abs(load - paper.load(place)) <= front * size
            for curve, function, unit in ((by_depth, paper.depth, 1.0), (by_load, paper.load, front)):
                value, rate, whole = slope(basis, curve, x)
                first, second = (mpmath.diff(function, place, order) for order in (1, 2))
                steep = size * (4 + 4 / z)
                assert abs(whole - first) <= steep * unit
                assert whole == pytest.approx(value * unit, rel=4 * EPS)
                here, slope_of_it, bow = rise(basis, curve, x)
                assert here == pytest.approx(coordinate(basis, curve, x), rel=8 * EPS)
                assert slope_of_it == pytest.approx(whole, rel=8 * EPS)
                assert abs(bow - second) <= steep * unit * (12 + 4 / z)
                assert math.isfinite(rate)


@pytest.mark.parametrize("k", GRADIENTS)
@pytest.mark.parametrize(("waves", "exponent"), PUNCHES)
@pytest.mark.parametrize("chi", [0.03, 0.4, 1.7])
def test_the_folds_are_those_of_a_dense_scan(k: float, waves: Any, exponent: float, chi: float) -> None:
    basis, by_depth = short_wave(k, waves, exponent, chi, 40.0)
    for curve in (by_depth, by_depth._replace(alpha=0.0, beta=1.0)):
        count, rises, zeros = folds_within(basis, curve, 12.0)
        x = np.concatenate([np.geomspace(1e-6, 1e-2, 200), np.arange(1e-2, 12.0, 1e-3)])
        slopes = slopes_of(basis, curve, x)
        turns = np.flatnonzero((slopes[1:] > 0) != (slopes[:-1] > 0))
        assert rises == (slopes[0] > 0)
        assert count == turns.size
        for zero, turn in zip(zeros[:count], turns, strict=True):
            assert x[turn] <= zero <= x[turn + 1]
        first, last = window(basis, curve, sizes_of(basis, curve))
        assert first <= min(zeros[:count], default=math.inf)
        assert last >= max(zeros[:count], default=0.0)


def test_there_may_be_too_many() -> None:
    basis, curve = short_wave(0.2, TWO, 2.0, 0.4, math.inf)
    assert folds_within(basis, curve, 10.0)[0] > 10
    assert folds_within(basis, curve, MOST_WAVES / 3 + 10.0)[0] == -1
    assert folds_within(basis, curve, SMALLEST)[0] == -1
    assert folds_within(basis, curve, math.nan)[0] == -1


def test_the_folds_of_a_cone_need_not_end() -> None:
    """Its slope is the same everywhere, that of the waves in the depth grows as a^((1-k)/2)."""
    basis, curve = short_wave(0.2, ONE, 1.0, 0.4, 60.0)
    assert window(basis, curve, sizes_of(basis, curve))[1] == math.inf
    smooth = Basis(basis[0], *waves_of(basis[0], np.zeros((0, 3))))
    low, high = window(smooth, curve, sizes_of(smooth, curve))
    assert low == pytest.approx(high, rel=0.05)
    assert slope(smooth, curve, low)[0] <= 0.0 <= slope(smooth, curve, high)[0]


@pytest.mark.parametrize("k", GRADIENTS)
@pytest.mark.parametrize("waves", [ONE, SINE, TWO])
def test_the_depth_of_a_point_is_the_limit(k: float, waves: Any) -> None:
    basis, curve = short_wave(k, waves, 2.0, 0.7, 60.0)
    _, stretch, _, depth, _ = state(basis, curve, 1e-30)
    assert depth_of_point(basis, curve) == pytest.approx(depth, abs=3 * stretch if k < 1.0 else 8 * EPS)
