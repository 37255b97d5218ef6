"""Depths that loading reaches among the waves of a long curve, eight at a time: against walking every wave."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.branches import END, END_DEPTH, ROWS, START, START_DEPTH
from gradhesion.core.curve.cosine import Cosine, depth
from gradhesion.core.numbers.lanes import LANES, load, store
from gradhesion.core.path import cosine as cycle
from gradhesion.core.turning.cosine_at_once import turns_at_once

EPS = 2.0**-52


@kernel()
def turn_eight(table: Any, curve: Any, targets: Any, out: Any) -> None:
    """Put what `turns_at_once` returns into the rows of `out`."""
    found = turns_at_once(table, curve, load(targets, 0))
    for row in range(5):
        store(out[row], 0, found[row])


def _turn(table: Any, curve: Any, targets: np.ndarray) -> np.ndarray:
    out = np.full((5, LANES), np.nan)
    turn_eight(table, curve, targets, out)
    return out


def _curve(table: Any, chi: float, waves: float) -> Cosine:
    """Give the curve of a given C g whose folds end at a given wave."""
    return Cosine(chi / (2 * math.pi * waves) ** (0.5 * (1 + table["k"])), chi / table["amplitude"], 0.0)


@pytest.mark.parametrize("k", [0.0, 0.37, 0.8, 1.0])
@pytest.mark.parametrize("chi", [0.05, 0.6, 1.0, 4.0])
def test_as_walked(k: float, chi: float, table_of: Callable[[float], Any]) -> None:
    """The first branch that ends deeper, and the place on it where the curve is as deep as the target."""
    table = table_of(k)
    curve = _curve(table, chi, 600.0)
    arches = cycle.extent(table, curve)
    count, trace = cycle.walk(table, curve, arches, 500.0, np.zeros((ROWS, 8)), False)
    tops = np.maximum.accumulate(trace[END_DEPTH, :count])
    far = np.flatnonzero((trace[START, :count] > 200.0) & (tops == trace[END_DEPTH, :count]) & (tops > 0.0))[:-1]
    assert far.size > 200
    some = np.random.default_rng(8).choice(far, 40)
    targets = tops[some - 1] + np.linspace(0.03, 0.97, 40) * (tops[some] - tops[some - 1])
    for first in range(0, 40, LANES):
        place, wave, end, top, before = _turn(table, curve, targets[first : first + LANES])
        branch = some[first : first + LANES]
        assert np.isfinite(place).all()
        assert np.all((trace[START, branch] < place) & (place < trace[END, branch]))
        np.testing.assert_allclose(wave, np.round(place - table["phase"] / (2 * math.pi)), rtol=0, atol=0)
        np.testing.assert_allclose(end, trace[END, branch], rtol=1e-9)
        for lane in range(LANES):
            z = 2 * math.pi * place[lane]
            terms = curve[0] * z * z + (1 + chi) * z ** (0.5 * (1 - k))
            target = targets[first + lane]
            assert abs(depth(table, curve, place[lane]) - target) <= 8 * EPS * terms
            assert abs(top[lane] - trace[END_DEPTH, branch[lane]]) <= 8 * EPS * terms
            assert abs(before[lane] - trace[END_DEPTH, branch[lane] - 1]) <= 8 * EPS * terms
            assert trace[START_DEPTH, branch[lane]] < target


def test_each_is_what_it_is_alone(table_of: Callable[[float], Any]) -> None:
    """To the bit, whatever the others are; a depth that the first wave does not reach is none of these."""
    table = table_of(0.3)
    curve = _curve(table, 0.9, 1e5)
    targets = np.array([depth(table, curve, x) for x in (100.0, 777.7, 9e3, 2e4, 3e4, 5e4, 8e4)] + [-1.0])
    together = _turn(table, curve, targets)
    assert np.isfinite(together[0, :-1]).all()
    assert math.isnan(together[0, -1])
    for lane, target in enumerate(targets):
        alone = _turn(table, curve, np.full(LANES, target))
        np.testing.assert_array_equal(alone, np.broadcast_to(together[:, lane, None], alone.shape))
