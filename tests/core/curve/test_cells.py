"""Isolation of zeros: every zero of a polynomial is found, and a pair however close."""

import math
from collections.abc import Callable
from itertools import pairwise
from typing import TypeAlias

import numpy as np
import pytest

from gradhesion.core.curve.cells import DEGREE, HALVINGS, MATRIX, MOST, NODES, NOISE, PLACES, STACK, isolate

Row: TypeAlias = tuple[float, ...]


def _isolate(function: Callable[[np.ndarray], np.ndarray], rate: Callable[[np.ndarray], np.ndarray]) -> list[Row]:
    found = np.empty((MOST, 5))
    values = np.concatenate([function(NODES), rate(NODES[1:])])
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
        polynomial = np.poly1d(np.concatenate([zeros, away]), r=True)
        rows = _isolate(polynomial, polynomial.deriv())
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
    turn = 1.5 * np.pi
    rows = _isolate(lambda u: np.cos(turn * u + phase), lambda u: -turn * np.sin(turn * u + phase))
    zeros = np.array([(j + 0.5) / 1.5 - phase / (1.5 * np.pi) for j in range(4)])
    zeros = zeros[(zeros > 0.0) & (zeros < 1.0)]
    assert [row[4] for row in rows] == pytest.approx(zeros.tolist(), abs=1e-6)


def test_a_pair_is_told_apart_or_handed_on() -> None:
    for gap in 10.0 ** np.arange(-1, -6, -1.0):
        polynomial = np.poly1d([0.3, 0.3 + gap, -1.0], r=True)
        rows = _isolate(polynomial, polynomial.deriv())
        assert [row[3] for row in rows] == [1.0, 1.0]
    rows = _isolate(lambda u: (u - 0.3) ** 2, lambda u: 2.0 * (u - 0.3))
    # a part that is not halved any more, which rounding moves by the root of its size
    assert all(abs(row[0] - 0.3) < 2.0**-HALVINGS + 2.0 * NOISE**0.5 for row in rows)


def test_nothing_where_there_is_no_zero() -> None:
    assert _isolate(np.ones_like, np.zeros_like) == []
    assert _isolate(lambda u: 2.0 + np.cos(2.0 * u), lambda u: -2.0 * np.sin(2.0 * u)) == []
    assert _isolate(lambda u: -1e-3 - (u - 0.4) ** 2, lambda u: -2.0 * (u - 0.4)) == []


def test_the_nodes_are_the_best_there_are() -> None:
    """Between any two of them the product of the distances is the same, but for the first, and no other set's is less.

    That is Chebyshev's alternation: a change of the seven inner nodes that lessens one of the eight maxima raises
    another one.
    """
    assert NODES.size == PLACES == (DEGREE + 2) // 2
    highest = []
    for low, high in pairwise(NODES):
        u = np.linspace(low, high, 4001)
        highest.append(np.max(u * np.prod((u[:, None] - NODES[1:]) ** 2, axis=1)))
    np.testing.assert_allclose(highest, max(highest), rtol=1e-3)


@pytest.mark.parametrize("phase", np.linspace(0.0, 2.0 * np.pi, 9).tolist())
def test_how_good_the_interpolant_of_the_shortest_wave_is(phase: float) -> None:
    turn = 1.5 * np.pi
    values = np.concatenate([np.cos(turn * NODES + phase), -turn * np.sin(turn * NODES[1:] + phase)])
    coefficients = values @ MATRIX
    u = np.linspace(0.0, 1.0, 500)
    found = sum(coefficients[j] * math.comb(DEGREE, j) * u**j * (1.0 - u) ** (DEGREE - j) for j in range(DEGREE + 1))
    assert np.abs(found - np.cos(turn * u + phase)).max() <= 3e-13 + NOISE
