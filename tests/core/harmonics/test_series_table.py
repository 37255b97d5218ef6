"""The table of a series: against mpmath's Struve and Bessel functions, and against the sum over its harmonics."""

import math
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core import Harmonic, Profile
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.harmonics.series import sums
from gradhesion.core.harmonics.series_table import COSINES, FEWEST, HIGHEST, has_table
from gradhesion.core.problem.shape import rows_of

pytestmark = pytest.mark.slow

EPS = float(np.finfo(float).eps)
SERIES = {
    "full": [(n, math.cos(n * n) / n**1.5, math.sin(n * n) / n**1.5) for n in range(1, 13)],
    "sparse": [(2, 0.3, -0.2), (3, 0.0, 0.7), (7, 0.1, 0.0), (31, -0.05, 0.03), (40, 0.01, 0.05), (64, 0.02, 0.01)],
    "flat": [(n, 1.0, -1.0) for n in range(1, HIGHEST + 1)],
}
EXPONENTS = [0.0, 0.37, 0.9, 1.0]


def _sizes(k: float, rows: Any, z: float) -> list[float]:
    """Give the sums of the sizes of all terms of w0, w1, v and v1."""
    n, h = rows[:, 0], np.hypot(rows[:, 1], rows[:, 2])
    y = n * z
    amplitude = 2 ** (0.5 * (k - 1)) * math.gamma(0.5 * (1 + k))
    once = np.minimum(2.0, amplitude * y ** (-0.5 * (1 + k)) + 1 / y)
    steep = once * np.maximum(1.0, y)
    return [float((w * h * part).sum()) for w, part in ((n, once), (n, once), (n, steep), (n * n, steep))]


def _exact(k: float, rows: Any, x: float, whole: int) -> list[float]:
    """Give the sums from Struve's and Bessel's functions."""
    with mpmath.workdps(40):
        k_, z = mpmath.mpf(k), 2 * mpmath.pi * (mpmath.mpf(x) + whole)
        total = [mpmath.mpf(0)] * 4

        def pair(function: Any, y: Any, order: int) -> Any:
            nu = k_ / 2 + order
            front = mpmath.sqrt(mpmath.pi) / 2 * mpmath.gamma((1 + k_) / 2 + order) * (2 / y) ** nu
            return front * function(nu, y)

        for n, even, odd in rows.tolist():
            y = n * z
            s0, s1 = (pair(mpmath.struveh, y, order) for order in (0, 1))
            t0, t1 = (pair(mpmath.besselj, y, order) for order in (0, 1))
            d0, fall = (1 - y * s1) / (1 + k_), -y * t1 / (1 + k_)
            terms = [
                n * (even * s0 + odd * t0),
                n * (even * (s0 - s1) + odd * (t0 - t1)),
                n * (even * (s0 + y * d0) + odd * (t0 + y * fall)),
                n * n * (even * (2 * d0 + y * (s1 - s0)) + odd * (2 * fall + y * (t1 - t0))),
            ]
            total = [a + b for a, b in zip(total, terms, strict=True)]
        return [float(value) for value in total]


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("name", ["full", "sparse"])
def test_sums(k: float, name: str) -> None:
    rows = np.array(SERIES[name], dtype=float)
    table, waves = tables_of(k, rows)
    assert waves.size > COSINES
    rng = np.random.default_rng(5)
    places = [(x, 0) for x in [*rng.uniform(0.001, 6.5, 8), 6.499, 6.501, *rng.uniform(6.5, 40.0, 6), 333.25, 4000.7]]
    places += [(0.37, 10), (1.93, 20_000), (0.02, 1_000_000)]
    for x, whole in places:
        sizes = _sizes(k, rows, 2 * math.pi * (x + whole))
        found = sums(table, waves, rows, float(x), float(whole))
        for value, expected, size in zip(found, _exact(k, rows, float(x), whole), sizes, strict=True):
            assert abs(value - expected) <= 8 * EPS * size


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("name", list(SERIES))
def test_the_table_is_the_sum(k: float, name: str) -> None:
    rows = np.array(SERIES[name], dtype=float)
    (table, waves), (_, none) = tables_of(k, rows), tables_of(k)
    assert none.size == COSINES
    rng = np.random.default_rng(6)
    edges = np.arange(1, 60) / (7 * rows[-1, 0])  # where bins meet
    orders = np.array([65.0, 110.0, 240.0, 900.0, 16000.0]) / (2 * math.pi)
    places = np.concatenate([rng.uniform(0.0, 8.0, 300), rng.uniform(8.0, 500.0, 300), edges, orders, 3.0 + edges])
    for x in places.tolist():
        sizes = np.array(_sizes(k, rows, 2 * math.pi * x))
        difference = np.array(sums(table, waves, rows, x, 0.0)) - np.array(sums(table, none, rows, x, 0.0))
        assert (np.abs(difference) <= 10 * EPS * sizes).all()


def test_which_series_have_a_table() -> None:
    few = rows_of(Profile(harmonics=tuple(Harmonic(n=n, cos=0.1) for n in range(1, FEWEST))))
    high = rows_of(Profile(harmonics=tuple(Harmonic(n=n, cos=0.1) for n in range(HIGHEST, HIGHEST + FEWEST))))
    assert not has_table(few)
    assert not has_table(high)
    assert not has_table(np.zeros((0, 3)))
    assert has_table(np.array(SERIES["full"], dtype=float))
    assert tables_of(0.3, few)[1].size == COSINES
    _, waves = tables_of(0.3, np.array(SERIES["flat"]))
    assert waves.nbytes < 4.1 * 2**20
