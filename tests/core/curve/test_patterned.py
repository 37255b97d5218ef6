"""The curve of a patterned interface: kappa and its slopes, its folds, and where they can stand."""

import math
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core import face
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve.general import Basis, coordinate, rise, slope
from gradhesion.core.curve.general_folds import MOST_FOLDS
from gradhesion.core.curve.patterned import (
    Patterned,
    folds_up_to,
    pattern_of,
    smooth_part,
    toughness_at,
    window,
)
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.types import Harmonics

K = 0.37
WAVES = np.array([[1.0, 1.0, 0.0], [2.0, 0.2, 0.15]])
PATTERN = np.array([[1.7, 0.15, -0.2], [5.1, 0.0, 0.1]])


def curve_of(of_work: bool, shares: tuple[float, float], gain: float = 0.3, rows: Harmonics = PATTERN) -> Any:
    """Return a basis and a curve; gain 0 is a smooth punch."""
    table, bins = tables_of(K, WAVES)
    waves = WAVES if gain > 0.0 else np.zeros((0, 3))
    u = np.linspace(0.0, 1.0 / rows[:, 0].min(), 20_001)
    t = 1.0 + sum(even * np.cos(TWO_PI * n * u) + odd * np.sin(TWO_PI * n * u) for n, even, odd in rows)
    pattern, finest = pattern_of(bins, waves, gain, rows, of_work, 0.99 * float(t.min()))
    return Basis(table, pattern, finest), Patterned(0.02, 2.0, 1.0, *shares)


CASES = [
    (of_work, shares, gain)
    for of_work in (False, True)
    for shares in ((1.0, 0.0), (0.6, 0.4), (0.0, 1.0))
    for gain in (0.0, 0.3)
]


@pytest.mark.parametrize("of_work", [False, True])
@pytest.mark.parametrize("x", [0.013, 0.7, 12.3, 1e5 + 0.21])
def test_kappa_is_the_series_or_its_root(of_work: bool, x: float) -> None:
    basis, _ = curve_of(of_work, (1.0, 0.0))
    with mpmath.workdps(30):

        def kappa(z: Any) -> Any:
            t = 1 + sum(
                mpmath.mpf(even) * mpmath.cos(n * z) + mpmath.mpf(odd) * mpmath.sin(n * z)
                for n, even, odd in PATTERN.tolist()
            )
            return mpmath.sqrt(t) if of_work else t

        expected = [float(one) for one in mpmath.taylor(kappa, 2 * mpmath.pi * mpmath.mpf(x), 2)]
    value, rate, bend = toughness_at(basis, x)
    assert value == pytest.approx(expected[0], rel=1e-14)
    assert [rate, bend] == pytest.approx([expected[1], 2.0 * expected[2]], rel=1e-12, abs=1e-13)


@pytest.mark.parametrize(("of_work", "shares", "gain"), CASES)
def test_slopes_are_those_of_the_coordinate(of_work: bool, shares: tuple[float, float], gain: float) -> None:
    basis, curve = curve_of(of_work, shares, gain)
    step = 1e-4
    for x in (0.4, 3.3, 9.1):
        here = [float(coordinate(basis, curve, x + i * step)) for i in (-2, -1, 1, 2)]
        value, rate, bend = rise(basis, curve, x)
        assert value == pytest.approx(coordinate(basis, curve, x), rel=1e-14)
        assert rate == pytest.approx(np.dot([1, -8, 8, -1], here) / (12 * step * TWO_PI), rel=1e-7, abs=1e-8)
        rates = [float(slope(basis, curve, x + i * step)[2]) for i in (-2, -1, 1, 2)]
        assert bend == pytest.approx(np.dot([1, -8, 8, -1], rates) / (12 * step * TWO_PI), rel=1e-7, abs=1e-8)
        turns = [float(slope(basis, curve, x + i * step)[0]) for i in (-2, -1, 1, 2)]
        assert slope(basis, curve, x)[1] == pytest.approx(
            np.dot([1, -8, 8, -1], turns) / (12 * step * TWO_PI), rel=1e-7, abs=1e-8
        )


@pytest.mark.parametrize(("of_work", "shares", "gain"), CASES)
def test_all_folds_are_found_and_stand_in_the_window(of_work: bool, shares: tuple[float, float], gain: float) -> None:
    basis, curve = curve_of(of_work, shares, gain)
    first, last = window(basis, curve)
    dense = np.concatenate([np.geomspace(1e-8, 0.1, 2_000, endpoint=False), np.linspace(0.1, 1.3 * last, 40_000)])
    rising = np.array([slope(basis, curve, x)[0] >= 0.0 for x in dense])
    changes = dense[np.flatnonzero(rising[1:] != rising[:-1])]
    zeros = np.empty(MOST_FOLDS)
    count, rises, _ = folds_up_to(basis, curve, first, last, zeros)
    assert count == changes.size > 2
    assert rises == rising[0]
    assert zeros[:count] == pytest.approx(changes, abs=2.0 * 1.3 * last / 40_000)


@pytest.mark.parametrize("depth", [0.2, 0.9, 0.999])
def test_a_root_is_smooth_as_far_as_one_wave_lets_it(depth: float) -> None:
    """1 + d cos z is zero where cosh(Im z) = 1/d."""
    rows = np.array([[1.0, 0.6 * depth, 0.8 * depth]])
    assert smooth_part(rows, 1.0 - depth) == pytest.approx(math.acosh(1.0 / depth), rel=2e-3)


def test_a_deep_root_has_all_its_folds() -> None:
    """Where the work nearly vanishes its root is sharp: cells are as short."""
    basis, curve = curve_of(True, (1.0, 0.0), 0.0, np.array([[1.0, -0.9999, 0.0]]))
    zeros = np.empty(MOST_FOLDS)
    count, _, _ = folds_up_to(basis, curve, window(basis, curve)[0], 6.5, zeros)
    dense = np.concatenate(
        [i + np.geomspace(1e-7, 0.5, 4000) for i in range(7)]
        + [1 + i - np.geomspace(1e-7, 0.5, 4000) for i in range(7)]
    )
    dense = np.sort(dense[dense < 6.5])
    rising = np.array([slope(basis, curve, x)[0] >= 0.0 for x in dense])
    assert count == np.count_nonzero(rising[1:] != rising[:-1])


def test_a_point_has_the_depth_of_its_own_toughness() -> None:
    table, bins = tables_of(1.0, WAVES)
    pattern, finest = pattern_of(bins, WAVES, 0.1, PATTERN, True, 0.3)
    basis, curve = Basis(table, pattern, finest), Patterned(0.02, 2.0, 1.0, 1.0, 0.0)
    assert face.depth_of_point(basis, curve) == -math.sqrt(1.15)
    assert coordinate(basis, curve, 1e-9) == pytest.approx(-math.sqrt(1.15), rel=1e-7)
