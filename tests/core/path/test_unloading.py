"""Unloading on traces made by hand, plain and jitted, and against the running minimum of the depth."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core.curve.branches import (
    LANDING,
    LAST_DEPTH,
    NEXT,
    ROWS,
    START,
    START_DEPTH,
    UNLOADING_JUMPS,
    UNLOADING_LOSS,
    append_branches,
    room_for,
)
from gradhesion.core.curve.cosine import Cosine, depth
from gradhesion.core.curve.cosine_folds import last_arch
from gradhesion.core.path.unloading import leave, leave_rim, next_lower, unloading_from

KINDS = [lambda f: f, lambda f: f.py_func]
CURVES = [
    Cosine(0.03, 0.31, 0.0),
    Cosine(0.9, 3.1, 0.0),
    Cosine(0.07, 0.4, 0.0),
    Cosine(0.3, 8.0, 0.0),
    Cosine(2.7, 0.01, 0.0),
]


def _trace(table: Any, curve: Any) -> tuple[int, Any]:
    final = last_arch(table, curve, 0.5 * (1 - table["k"]))
    trace = room_for(np.zeros((ROWS, 400)), final + 8)
    return append_branches(table, curve, 0, final, math.inf, trace, 0), trace


@pytest.mark.parametrize("kind", KINDS)
def test_next_lower(kind: Callable[[Any], Any]) -> None:
    trace = np.zeros((ROWS, 5))
    trace[START_DEPTH] = [-3.0, -1.0, -2.0, -2.0, 0.5]
    lower = kind(next_lower)
    assert lower(trace, 4, 1.0) == 4
    assert lower(trace, 4, 0.5) == 3  # one as low is not lower
    assert lower(trace, 3, -2.0) == 0
    assert lower(trace, 4, -3.0) == -1
    assert lower(trace, -1, 5.0) == -1


@pytest.mark.parametrize("kind", KINDS)
def test_leave(kind: Callable[[Any], Any]) -> None:
    trace = np.zeros((ROWS, 3))
    kind(leave)(trace, 2, 0.7, 3.0, -1.1)
    assert [trace[UNLOADING_LOSS, 2], trace[UNLOADING_JUMPS, 2], trace[LAST_DEPTH, 2]] == [0.7, 3.0, -1.1]


@pytest.mark.parametrize("k", [0.0, 0.29, 0.64, 1.0])
@pytest.mark.parametrize("curve", CURVES)
def test_it_follows_the_running_minimum(k: float, curve: Any, table_of: Callable[[float], Any]) -> None:
    """A jump is a stretch on which depth lies above its running minimum from the rim inwards; the last one ends at 0."""
    table = table_of(k)
    count, trace = _trace(table, curve)
    x = np.concatenate([np.geomspace(1e-6, 3.9e-3, 300), np.arange(1, 6000) * 0.004])
    depths = np.array([depth(table, curve, place) for place in x])
    for rim in [0.1, 0.65, 1.3, 2.9, 7.7, 15.1, 23.9]:
        inside = depths[x <= rim]
        lowest = np.minimum.accumulate(inside[::-1])[::-1]
        stable = inside <= lowest
        leaves = int(np.sum(stable[1:] & ~stable[:-1]))  # outwards: unstable, then stable
        expected = leaves + int(not stable[-1])
        _, jumps, last = unloading_from(table, curve, count, trace, rim, depth(table, curve, rim), False)
        assert jumps == expected
        assert last <= lowest[0] + 1e-12
        assert last >= lowest[0] - 0.02 * (1 + abs(lowest[0]))


@pytest.mark.parametrize("k", [0.0, 0.29, 1.0])
def test_loss_of_a_branch_is_kept(k: float, table_of: Callable[[float], Any]) -> None:
    """From whichever rim, a branch loses what it loses; the second time it is only read."""
    table = table_of(k)
    for curve in CURVES:
        count, trace = _trace(table, curve)
        alone = []
        for rim in (4.4, 23.9, 9.1):
            fresh_count, fresh = _trace(table, curve)
            alone.append(unloading_from(table, curve, fresh_count, fresh, rim, depth(table, curve, rim), True))
        shared = [
            unloading_from(table, curve, count, trace, rim, depth(table, curve, rim), True) for rim in (4.4, 23.9, 9.1)
        ]
        np.testing.assert_allclose(alone, shared, rtol=1e-15)


def test_every_loss_is_positive(table_of: Callable[[float], Any]) -> None:
    """Inwards rho >= 1 all the way: what lies inside is closed more strongly than equilibrium asks for."""
    for k in (0.0, 0.29, 0.64, 1.0):
        for curve in CURVES:
            count, trace = _trace(table_of(k), curve)
            loss, jumps, _ = unloading_from(
                table_of(k), curve, count, trace, 23.9, depth(table_of(k), curve, 23.9), True
            )
            assert loss > 0.0 or (jumps == 0 and loss == 0.0)
            losses = trace[UNLOADING_LOSS, :count][trace[UNLOADING_JUMPS, :count] >= 0.0]
            assert (np.diff(losses) >= 0.0).all()


@pytest.mark.parametrize("k", [0.0, 0.29, 1.0])
@pytest.mark.parametrize("curve", CURVES)
def test_the_way_is_kept_with_the_branches(k: float, curve: Any, table_of: Callable[[float], Any]) -> None:
    """From branch to branch: each landing is at the depth of the start before, and as many as the jumps are counted."""
    table = table_of(k)
    count, trace = _trace(table, curve)
    for rim in [0.65, 2.9, 7.7, 23.9]:
        rim_depth = depth(table, curve, rim)
        _, jumps, last = unloading_from(table, curve, count, trace, rim, rim_depth, True)
        now, landing = leave_rim(table, curve, count, trace, rim, rim_depth)
        level, found, start = rim_depth, 0, rim
        while now >= 0:
            found += landing != rim
            # found to half its digits (curve/branches.py), where the depth rises by the size of the stretch a wave
            size = (2 * math.pi * landing) ** (0.5 * (1 - k)) + abs(level)
            assert abs(depth(table, curve, landing) - level) <= 1e-6 * size
            level, start = trace[START_DEPTH, now], trace[START, now]
            now, landing = int(trace[NEXT, now]), trace[LANDING, now]
        assert found + (start > 0.0) == jumps
        assert level == last
