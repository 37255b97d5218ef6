"""Isolation of zeros: every zero of a polynomial is found, and a pair however close."""

import numpy as np
import pytest

from gradhesion.core.curve.cells import DEGREE, HALVINGS, MOST, NODES, NOISE, STACK, isolate


def _isolate(values: np.ndarray) -> list[tuple[float, ...]]:
    found = np.empty((MOST, 5))
    count, nearest = isolate(values, np.empty((STACK, DEGREE + 1)), np.empty((STACK, 3)), found)
    assert nearest >= 0.0
    return [tuple(row) for row in found[:count].tolist()]


@pytest.mark.parametrize("count", range(8))
def test_zeros_of_polynomials(count: int) -> None:
    rng = np.random.default_rng(count)
    for _ in range(50):
        zeros = np.sort(rng.random(count))
        if count > 1 and np.diff(zeros).min() < 1e-2:
            continue
        away = rng.choice([-1.0, 1.0], 4) * rng.uniform(1.1, 3.0, 4) + 0.5
        values = np.prod(NODES[:, None] - np.concatenate([zeros, away]), axis=1)
        rows = _isolate(values)
        single = [row for row in rows if row[3] == 1.0]
        assert len(single) == count == len(rows)
        for zero, (left, right, sign, _, guess) in zip(zeros, single, strict=True):
            assert left <= zero <= right
            assert left <= guess <= right
            inside = np.prod(left - 1e-9 - np.concatenate([zeros, away]))
            assert sign * inside > 0.0 or left == 0.0


@pytest.mark.parametrize("phase", [0.0, 0.7, 1.9, 2.4])
def test_guesses_of_a_wave(phase: float) -> None:
    """Newton's method on the curve begins where its interpolant is zero."""
    rows = _isolate(np.cos(1.5 * np.pi * NODES + phase))
    zeros = np.array([(j + 0.5) / 1.5 - phase / (1.5 * np.pi) for j in range(4)])
    zeros = zeros[(zeros > 0.0) & (zeros < 1.0)]
    assert [row[4] for row in rows] == pytest.approx(zeros.tolist(), abs=1e-6)


def test_a_pair_is_told_apart_or_handed_on() -> None:
    for gap in 10.0 ** np.arange(-1, -6, -1.0):
        rows = _isolate((NODES - 0.3) * (NODES - 0.3 - gap) * (NODES + 1.0))
        assert [row[3] for row in rows] == [1.0, 1.0]
    rows = _isolate((NODES - 0.3) ** 2)
    # a part that is not halved any more, which rounding moves by the root of its size
    assert all(abs(row[0] - 0.3) < 2.0**-HALVINGS + 2.0 * NOISE**0.5 for row in rows)


def test_nothing_where_there_is_no_zero() -> None:
    assert _isolate(np.ones(DEGREE + 1)) == []
    assert _isolate(2.0 + np.cos(2.0 * NODES)) == []
    assert _isolate(-1e-3 - (NODES - 0.4) ** 2) == []
