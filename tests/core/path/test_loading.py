"""Loading on traces made by hand, plain and jitted, and against the running maximum of the depth."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core.curve.branches import (
    ARRIVAL,
    END,
    END_DEPTH,
    HIGHEST,
    LOADING_JUMPS,
    ROWS,
    START,
    append_branches,
    room_for,
)
from gradhesion.core.curve.cosine import Cosine, depth
from gradhesion.core.curve.cosine_folds import last_arch
from gradhesion.core.path.loading import arrive, highest_depth, load_up, loading_to, next_higher
from gradhesion.core.path.ties import note_loading

KINDS = [lambda f: f, lambda f: f.py_func]


def _trace(*tops: float) -> Any:
    trace = np.zeros((ROWS, len(tops) + 1))
    trace[END_DEPTH, : len(tops)] = tops
    trace[END, : len(tops)] = np.arange(len(tops)) + 0.5
    trace[START] = np.arange(len(tops) + 1)
    return trace


@pytest.mark.parametrize("kind", KINDS)
def test_next_higher(kind: Callable[[Any], Any]) -> None:
    trace = _trace(-1.0, 2.0, 1.0, 2.0, 3.0, math.inf)
    higher = kind(next_higher)
    assert higher(trace, 0, 6, -2.0) == 0
    assert higher(trace, 0, 6, 0.0) == 1
    assert higher(trace, 2, 6, 2.0) == 4  # one as high is not higher
    assert higher(trace, 2, 4, 2.0) == 4
    assert higher(trace, 0, 6, 1e300) == 5


@pytest.mark.parametrize("kind", KINDS)
def test_highest_depth(kind: Callable[[Any], Any]) -> None:
    trace = _trace(-1.0, 2.0, 1.0, 5.0)
    trace[HIGHEST] = np.maximum.accumulate(np.maximum(trace[END_DEPTH], 0.0))
    highest = kind(highest_depth)
    assert highest(4, trace, 0.4, -3.0) == 0.0
    assert highest(4, trace, 1.7, 1.2) == 2.0
    assert highest(4, trace, 3.4, 4.0) == 4.0
    assert highest(4, trace, 9.0, 4.0) == 5.0
    assert highest(0, trace, math.inf, math.inf) == math.inf


@pytest.mark.parametrize("kind", KINDS)
def test_arrive(kind: Callable[[Any], Any]) -> None:
    trace = _trace(1.0, 2.0)
    kind(arrive)(trace, 1, 1.2, 0.3, 2.0)
    assert (trace[ARRIVAL, 1], trace[LOADING_JUMPS, 1]) == (1.2, 2.0)


@pytest.mark.parametrize("k", [0.0, 0.29, 0.64, 1.0])
@pytest.mark.parametrize(
    "curve", [Cosine(0.03, 0.31, 0.0), Cosine(0.9, 3.1, 0.0), Cosine(0.07, 0.4, 0.0), Cosine(0.3, 8.0, 0.0)]
)
def test_it_follows_the_running_maximum(k: float, curve: Any, table_of: Callable[[float], Any]) -> None:
    """A jump is a stretch on which depth lies below its running maximum (from 0 on)."""
    table = table_of(k)
    final = last_arch(table, curve, 0.5 * (1 - k))
    trace = room_for(np.zeros((ROWS, 400)), final + 8)
    count = append_branches(table, curve, 0, final, math.inf, trace, 0)
    load_up(table, curve, count, trace, math.inf, False)
    x = np.arange(1, 6000) * 0.004
    depths = np.array([depth(table, curve, place) for place in x])
    highest = np.maximum.accumulate(np.maximum(depths, 0.0))
    stable = depths >= highest
    for rim in [0.1, 0.65, 1.3, 2.9, 7.7, 15.1, 23.9]:
        # a jump starts where the curve leaves its maximum, or at zero contact
        inside = x <= rim
        lands = inside[1:] & stable[1:] & ~stable[:-1]
        expected = int(lands.sum()) + int(not stable[inside][-1])
        _, jumps = loading_to(table, curve, count, trace, rim, False)
        assert jumps == expected
        note_loading(table, curve, count, trace, rim)
        deepest = highest_depth(count, trace, rim, depth(table, curve, rim))
        # between two points of the grid depth changes by less than its steepest slope says
        steps = np.abs(np.diff(depths[inside])).max()
        assert highest[inside][-1] <= deepest + 1e-12 * (1 + deepest)
        assert deepest <= highest[inside][-1] + steps


def test_arrivals_rise(table_of: Callable[[float], Any]) -> None:
    table = table_of(0.29)
    curve = Cosine(0.02, 1.1, 0.0)
    trace = room_for(np.zeros((ROWS, 400)), last_arch(table, curve, 0.355) + 8)
    count = append_branches(table, curve, 0, last_arch(table, curve, 0.355), math.inf, trace, 0)
    last = load_up(table, curve, count, trace, math.inf, True)
    visited = np.flatnonzero(trace[ARRIVAL, :count] < math.inf)
    assert visited[-1] == last == count - 1
    arrivals = trace[ARRIVAL, visited]
    assert (np.diff(arrivals) > 0.0).all()
    assert (arrivals > trace[START, visited]).all()
    assert (arrivals < trace[END, visited]).all()
    assert trace[LOADING_JUMPS, visited].tolist() == list(range(1, visited.size + 1))
