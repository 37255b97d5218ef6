"""The loop integral against what the jumps add up to, and against the closed form of a smooth punch."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core.closed import smooth
from gradhesion.core.curve.branches import ARRIVAL, END, END_DEPTH, ROWS, START, START_DEPTH
from gradhesion.core.curve.cosine import Cosine, depth, load
from gradhesion.core.path import cosine as cycle
from gradhesion.core.path.cosine_loop import loop_energy
from gradhesion.core.path.loading import loading_to
from gradhesion.core.path.unloading import unloading_from

EPS = 2.0**-52
EXPONENTS = [0.0, 0.37, 0.82, 1 - 1e-12, 1.0]


def _walked(table: Any, curve: Any, rim: float) -> tuple[int, Any, float]:
    """Walk a curve to its rim; give also the depth there."""
    arches = cycle.extent(table, curve)
    count, trace = cycle.walk(table, curve, arches, rim, np.empty((ROWS, 192)), True)
    return count, trace, depth(table, curve, rim) if rim < math.inf else math.inf


def _size(table: Any, curve: Any, count: int, trace: Any, rim: float, rim_depth: float) -> float:
    """Give about the integral of |load d depth|, of which rounding leaves some units."""
    total = 0.0
    for branch in range(count):
        start, end = trace[START, branch], min(trace[END, branch], rim, max(trace[START, branch], 1.0) * 4)
        top = trace[END_DEPTH, branch] if end == trace[END, branch] else max(rim_depth, 0.0)
        if not math.isfinite(top):
            top = depth(table, curve, end)
        loads = [abs(load(table, curve, x)) for x in np.linspace(max(start, 1e-9), end, 5)]
        total += max(loads) * abs(top - trace[START_DEPTH, branch])
    if rim < math.inf:
        total += abs(load(table, curve, rim)) * abs(rim_depth) + (2 * math.pi * rim) ** (1 + table["k"]) * rim_depth**2
    return total


@pytest.mark.parametrize("k", EXPONENTS)
def test_it_is_what_the_jumps_lose(k: float, table_of: Callable[[float], Any]) -> None:
    table = table_of(k)
    rng = np.random.default_rng(90)
    several = 0
    for _ in range(150):
        gain, waves = 10 ** rng.uniform(-2, 0.4), 10 ** rng.uniform(0.2, 1.2)
        curve = Cosine(gain / (2 * math.pi * waves) ** (0.5 * (1 + k)), gain, 0.0)
        rim = 10 ** rng.uniform(-0.7, 1.2) if rng.uniform() < 0.8 else math.inf
        count, trace, rim_depth = _walked(table, curve, rim)
        lost, jumps = loading_to(table, curve, count, trace, rim, True)
        unloading, _, _ = unloading_from(table, curve, count, trace, rim, rim_depth, True)
        loop = loop_energy(table, curve, count, trace, rim, rim_depth)
        size = _size(table, curve, count, trace, rim, rim_depth) + abs(lost) + abs(unloading)
        assert abs(loop - (lost + unloading)) <= 64 * EPS * size
        several += jumps > 2
    assert several > 20


@pytest.mark.parametrize("k", EXPONENTS)
def test_smooth(k: float, table_of: Callable[[float], Any]) -> None:
    """With b = 1 and waves of no height the loop is that of Johnson, Kendall & Roberts."""
    table = table_of(k)
    for z_rim in (0.7, 1.9, 4.0, math.inf):
        rim = z_rim / (2 * math.pi)
        count, trace, rim_depth = _walked(table, Cosine(1.0, 1e-300, 0.0), rim)
        stretch = 2.0 / (1.0 + k)
        abscissa = smooth.smooth_abscissa(k, stretch, z_rim)
        loaded = smooth.smooth_loading(k, abscissa, z_rim, smooth.smooth_square(k, stretch, 2.0))
        last = smooth.smooth_square(k, stretch, smooth.abscissa_of_jump_out(k))
        expected = (loaded + smooth.smooth_unloading(k, abscissa, z_rim, last)) / (2.0 * math.pi)
        assert math.isclose(
            loop_energy(table, Cosine(1.0, 1e-300, 0.0), count, trace, rim, rim_depth), expected, rel_tol=256 * EPS
        )


def test_a_landing_that_is_off_does_not_matter(table_of: Callable[[float], Any]) -> None:
    """Places of landing come with half their digits; the integral must have all of them."""
    table = table_of(0.37)
    curve = Cosine(0.05, 0.9, 0.0)
    count, trace, rim_depth = _walked(table, curve, 6.2)
    exact = loop_energy(table, curve, count, trace, 6.2, rim_depth)
    trace[ARRIVAL, :count] = np.where(trace[ARRIVAL, :count] < math.inf, trace[ARRIVAL, :count] * (1 + 1e-7), math.inf)
    assert math.isclose(loop_energy(table, curve, count, trace, 6.2, rim_depth), exact, rel_tol=1e-13)
