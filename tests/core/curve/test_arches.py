"""The folds of one cosine under any control: arches and cells find the same ones, and so does a dense grid."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve.arches import folds_by_arches, is_one_cosine
from gradhesion.core.curve.general import Basis, Series, slope
from gradhesion.core.curve.general_folds import find_folds, room
from gradhesion.core.curve.window import first_fold_bound, last_fold_bound
from gradhesion.core.numbers.circle import TWO_PI

pytestmark = pytest.mark.slow

COSINE = np.array([[1.0, 1.0, 0.0]])


def _draw(rng: Any, k: float, share: float | None) -> tuple[Any, Any, float, float]:
    """A basis, a curve and the bounds of its folds; `share` is beta, none for a machine of any stiffness."""
    beta = rng.uniform() ** 3 * 10.0 ** rng.uniform(-6, 0) if share is None else share
    waves = TWO_PI * 10.0 ** rng.uniform(-0.3, 1.5)
    gain = 10.0 ** rng.uniform(-2, 1)
    bend = gain * waves ** (-0.5 * (1.0 + k))
    basis = Basis(*tables_of(k), COSINE)
    curve = Series(bend, 2.0, gain, 1.0 - beta, beta)
    first, last = (bound(basis, curve) / TWO_PI for bound in (first_fold_bound, last_fold_bound))
    return basis, curve, first, min(last, 60.0)


@pytest.mark.parametrize("share", [0.0, 1.0, None])
@pytest.mark.parametrize("k", [0.0, 0.3, 0.7, 0.95, 1.0])
def test_arches_and_cells_find_the_same_folds(k: float, share: float | None) -> None:
    rng = np.random.default_rng(int(100 * k) + 7)
    by_arches, by_cells = np.empty(1000), np.empty(1000)
    found = 0
    for _ in range(150):
        basis, curve, first, last = _draw(rng, k, share)
        if not first < last:
            continue
        count, rises, tangency = folds_by_arches(basis, curve, first, last, room(), by_arches)
        other, other_rises, near = find_folds(basis, curve, first, last, room(), by_cells, 0.0)
        if min(tangency, near) < math.inf:
            continue
        assert (count, rises) == (other, other_rises)
        # a fold of the order of the pair's distance off has a slope of rounding alone
        np.testing.assert_allclose(by_arches[:count], by_cells[:count], rtol=1e-9)
        found += count
    assert found > 300


@pytest.mark.parametrize("k", [0.0, 0.5, 0.9])
def test_none_is_missed(k: float) -> None:
    """The sign of D changes on a grid of 400 radii a wave where there is a fold, and only there."""
    rng = np.random.default_rng(int(100 * k) + 8)
    zeros = np.empty(1000)
    for share in (1.0, None):
        for _ in range(8):
            basis, curve, first, last = _draw(rng, k, share)
            last = min(last, 12.0)
            if not first < last:
                continue
            count, rises, _ = folds_by_arches(basis, curve, first, last, room(), zeros)
            grid = np.geomspace(first, last, 200 + int(400 * (last - first)))
            falls = np.array([slope(basis, curve, x, 0.0)[0] < 0.0 for x in grid])
            passed = np.searchsorted(zeros[:count], grid)
            # no two grid points around a pair of folds: the number of folds passed has the parity that the sign tells
            assert not rises
            assert np.array_equal(passed % 2 == 0, falls)
            changes = np.flatnonzero(falls[1:] != falls[:-1])
            assert changes.size <= count


@pytest.mark.parametrize("k", [0.0, 0.4, 1.0])
def test_folds_of_a_machine_are_zeros(k: float) -> None:
    """By Halley's method on what `slope` of the general curve gives: its value there is rounding."""
    rng = np.random.default_rng(int(100 * k) + 9)
    zeros, seen = np.empty(1000), 0
    for _ in range(60):
        basis, curve, first, last = _draw(rng, k, None)
        if not first < last:
            continue
        count, _, _ = folds_by_arches(basis, curve, first, last, room(), zeros)
        for x in zeros[:count]:
            value, rate, _ = slope(basis, curve, x, 0.0)
            size = curve[2] * max(1.0, (TWO_PI * x) ** (0.5 * (1.0 - k))) + 2.0 * (TWO_PI * x) ** (-0.5 * (1.0 + k))
            # the last step leaves 1e-12 of the length on which the slope changes, a wave at most
            assert abs(value) <= 32 * 2.0**-52 * size + 1e-11 * abs(rate)
            seen += 1
    assert seen > 100


def test_which_profiles_have_arches() -> None:
    assert is_one_cosine(COSINE, 2.0)
    assert not is_one_cosine(COSINE, 2.5)
    for rows in ([[2.0, 1.0, 0.0]], [[1.0, -1.0, 0.0]], [[1.0, 1.0, 0.1]], [[1.0, 1.0, 0.0], [2.0, 0.1, 0.0]]):
        assert not is_one_cosine(np.array(rows), 2.0)
