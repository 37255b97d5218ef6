"""Rims among the regular waves of a long curve, eight at a time, against branches of their own and against walking."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.branches import ROWS
from gradhesion.core.curve.cosine import Cosine, depth, slope
from gradhesion.core.curve.cosine_folds import CLOSE
from gradhesion.core.numbers.lanes import LANES, lane_of, load
from gradhesion.core.path import cosine as cycle
from gradhesion.core.path.cosine_long import begin_long, ends_folds, stride
from gradhesion.core.path.cosine_rims import cycle_among, is_close_among, stand_at_once
from gradhesion.core.path.loading import highest_depth, loading_to
from gradhesion.core.path.unloading import unloading_from

EPS = 2.0**-52
SIZE = ROWS, 192
AMONG, LOADED, LOADING, UNLOADED, UNLOADING, LAST, DEEPEST, _WAVE, IS_CLOSE, ON, REACHED = range(11)


@kernel()
def follow_eight(table: Any, curve: Any, arches: Any, rims: Any, scratch: Any, out: Any) -> None:
    """Put into the rows of `out` what `cycle_among` returns for eight rims, and how they stand."""
    long = begin_long(table, curve, arches, scratch, True, 1.0)
    stands = stand_at_once(table, curve, load(rims, 0), True)
    for lane in range(LANES):
        among, cycle, wave = cycle_among(table, curve, stands, lane, rims[lane], long, True)
        out[0, lane], out[1, lane], out[2, lane] = 1.0 if among else 0.0, cycle.loaded, cycle.loading_jumps
        out[3, lane], out[4, lane], out[5, lane] = cycle.unloaded, cycle.unloading_jumps, cycle.last
        out[6, lane], out[7, lane] = cycle.highest, wave
        if among:
            out[8, lane] = 1.0 if is_close_among(table, curve, stands, lane, rims[lane], long, False) else 0.0
        out[9, lane], out[10, lane] = lane_of(stands.on, lane), lane_of(stands.reached, lane)


def _curve(table: Any, chi: float, waves: float) -> Cosine:
    """Give the curve of a given C g whose folds end at a given wave."""
    return Cosine(chi / (2 * math.pi * waves) ** (0.5 * (1 + table["k"])), chi / table["amplitude"], 0.0)


def _eight(table: Any, curve: Any, arches: Any, rims: np.ndarray) -> np.ndarray:
    out = np.full((11, LANES), np.nan)
    follow_eight(table, curve, arches, rims, np.zeros(SIZE), out)
    return out


@pytest.mark.parametrize("k", [0.0, 0.37, 0.8, 1.0])
@pytest.mark.parametrize("chi", [0.05, 0.4, 1.0, 6.0])
def test_as_walked(k: float, chi: float, table_of: Callable[[float], Any]) -> None:
    """The losses of both ways, counts and depths of walking every wave, wherever between two waves a rim stands."""
    table = table_of(k)
    curve = _curve(table, chi, 600.0)
    arches = cycle.extent(table, curve)
    count, trace = cycle.walk(table, curve, arches, 400.0, np.zeros(SIZE), True)
    rims = 150.0 + 200.0 * np.arange(40) / 39 + np.arange(40) * 0.137
    ways = set()
    for first in range(0, rims.size, LANES):
        some = rims[first : first + LANES]
        found = _eight(table, curve, arches, some)
        assert found[AMONG].all()
        assert not found[IS_CLOSE].any()
        for lane, rim in enumerate(some):
            here = depth(table, curve, rim)
            loaded, loading = loading_to(table, curve, count, trace, rim, True)
            unloaded, unloading, last = unloading_from(table, curve, count, trace, rim, here, True)
            assert [loading, unloading] == found[[LOADING, UNLOADING], lane].tolist()
            np.testing.assert_allclose(found[[LOADED, UNLOADED], lane], [loaded, unloaded], rtol=1e-12)
            deepest = highest_depth(count, trace, rim, here)
            # depths are differences of terms of this size
            terms = curve[0] * (2 * math.pi * rim) ** 2 + (1 + chi) * (2 * math.pi * rim) ** (0.5 * (1 - k))
            np.testing.assert_allclose(found[[LAST, DEEPEST], lane], [last, deepest], rtol=0, atol=16 * EPS * terms)
            ways.add((found[ON, lane], found[REACHED, lane]))
    assert ways >= {(1.0, 1.0), (0.0, 0.0)}, "on branches and between them"


def test_a_rim_that_loading_jumps_to(table_of: Callable[[float], Any]) -> None:
    """On a branch, but nearer than where loading would arrive on it: the rim is reached by a jump, and not left by one."""
    table = table_of(0.3)
    curve = _curve(table, 1.0, 600.0)
    arches = cycle.extent(table, curve)
    count, trace = cycle.walk(table, curve, arches, 260.0, np.zeros(SIZE), True)
    branch = next(i for i in range(count) if trace[0, i] > 200.0)
    start, arrival = trace[0, branch], trace[4, branch]
    found = _eight(table, curve, arches, np.linspace(start, arrival, LANES + 2)[1:-1])
    assert found[ON].all()
    assert not found[REACHED].any()
    loaded = [loading_to(table, curve, count, trace, rim, True) for rim in np.linspace(start, arrival, LANES + 2)[1:-1]]
    np.testing.assert_allclose(found[[LOADED, LOADING]].T, loaded, rtol=1e-12)


@pytest.mark.parametrize("chi", [0.4, 1.3])
def test_each_is_what_it_is_alone(chi: float, table_of: Callable[[float], Any]) -> None:
    """To the bit, whatever the others are."""
    table = table_of(0.3)
    curve = _curve(table, chi, 1e5)
    arches = cycle.extent(table, curve)
    rims = np.random.default_rng(4).uniform(100.0, 9e4, LANES)
    together = _eight(table, curve, arches, rims)
    for lane, rim in enumerate(rims):
        alone = _eight(table, curve, arches, np.full(LANES, rim))
        np.testing.assert_array_equal(alone, np.broadcast_to(together[:, lane, None], alone.shape))


def test_an_edge_on_a_fold_is_close_to_a_jump(table_of: Callable[[float], Any]) -> None:
    table = table_of(0.3)
    curve = _curve(table, 0.7, 600.0)
    arches = cycle.extent(table, curve)
    count, trace = cycle.walk(table, curve, arches, 260.0, np.zeros(SIZE), False)
    fold = trace[2, next(i for i in range(count) if trace[0, i] > 200.0)]
    value, rate, _, _ = slope(table, curve, 0.5 * (1 - 0.3), fold)
    fold -= value / rate / (2 * math.pi)
    rims = fold * (1.0 + CLOSE * np.array([-100.0, -9.0, -0.5, 0.0, 0.5, 9.0, 100.0, 1000.0]))
    found = _eight(table, curve, arches, rims)
    among = found[AMONG] > 0.0  # next to the fold, landing takes longer
    assert among[:4].all()
    assert among[-1]
    np.testing.assert_array_equal(found[IS_CLOSE, among], np.array([0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0])[among])


def test_where_waves_are_not_regular_a_rim_has_branches_of_its_own(table_of: Callable[[float], Any]) -> None:
    """Before the wave that starts lowest, and before the one that loading enters by its long first jump."""
    table = table_of(0.3)
    curve = _curve(table, 0.02, 5e4)
    arches = cycle.extent(table, curve)
    inner = 0.5 * arches[0] + 90.0
    rims = inner * (0.4 * arches[1] / inner) ** (np.arange(LANES) / (LANES - 1.0))
    assert all(cycle.is_long(table, arches, rim) and not ends_folds(table, arches, rim) for rim in rims)
    found = _eight(table, curve, arches, rims)
    for lane, rim in enumerate(rims):
        long = begin_long(table, curve, arches, np.zeros(SIZE), True, 1.0)
        count = stride(table, curve, rim, long, True, 1.0)
        loaded, loading = loading_to(table, curve, count, long.trace, rim, True)
        if found[AMONG, lane]:
            assert loading == found[LOADING, lane]
            assert math.isclose(loaded, found[LOADED, lane], rel_tol=1e-13)
    assert 0 < found[AMONG].sum() < LANES
