"""Jumps of a path beyond z = 40: where they land and what they lose against jumps found and integrated one by one."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core.curve.branches import (
    ARRIVAL,
    END,
    END_DEPTH,
    LANDING,
    LOADING_LOSS,
    NEXT,
    ROWS,
    START,
    START_DEPTH,
    UNLOADING_LOSS,
    ends,
    find_depth,
)
from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.curve.cosine_energy import energy_by_panels, energy_from_zero
from gradhesion.core.path import cosine as cycle
from gradhesion.core.path.unloading import descend

EXPONENTS = [0.0, 0.37, 0.8]


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize(("chi", "waves"), [(0.4, 40.0), (0.9, 25.0), (1.4, 60.0)])
def test_places_and_losses(k: float, chi: float, waves: float, table_of: Callable[[float], Any]) -> None:
    """From zero contact to beyond z = 40, against places found and jumps integrated one by one."""
    table = table_of(k)
    curve = Cosine(chi / (2 * math.pi * waves) ** (0.5 * (1 + k)), chi / table["amplitude"], 0.0)
    count, trace = cycle.walk(table, curve, cycle.extent(table, curve), 30.0, np.empty((ROWS, 192)), True)
    work, before, loss, far = np.empty(16), -1, 0.0, 0
    for branch in np.flatnonzero(trace[ARRIVAL, :count] < math.inf):
        left, level = (trace[END, before], trace[END_DEPTH, before]) if before >= 0 else (0.0, 0.0)
        x = trace[ARRIVAL, branch]
        assert abs(x - find_depth(table, curve, level, ends(trace, branch))) < 1e-7 * max(1.0, x)
        lost = energy_from_zero(table, curve, x, 0.0) if before < 0 else energy_by_panels(table, curve, left, x, work)
        loss += lost
        assert abs(trace[LOADING_LOSS, branch] - loss) < 1e-13 * abs(loss) + 1e-14 * x
        far += 2 * math.pi * left >= 40.0
        before = branch
    descend(table, curve, trace, before, True)
    while trace[NEXT, before] >= 0:
        lower = int(trace[NEXT, before])
        x, left = trace[LANDING, before], trace[START, before]
        found = find_depth(table, curve, trace[START_DEPTH, before], ends(trace, lower))
        assert abs(x - found) < 1e-7 * max(1.0, x)
        lost = trace[UNLOADING_LOSS, before] - trace[UNLOADING_LOSS, lower]
        expected = energy_by_panels(table, curve, left, x, work)
        assert abs(lost - expected) < 1e-13 * trace[UNLOADING_LOSS, before] + 1e-14 * left
        far += 2 * math.pi * x >= 40.0
        before = lower
    assert far > 12


@pytest.mark.parametrize("k", EXPONENTS)
def test_values_do_not_depend_on_the_reach(k: float, table_of: Callable[[float], Any]) -> None:
    """Jumps within a reach have the same bits with others beyond it."""
    table = table_of(k)
    curve = Cosine(0.9 / (2 * math.pi * 40.0) ** (0.5 * (1 + k)), 0.9 / table["amplitude"], 0.0)
    arches = cycle.extent(table, curve)
    _, everything = cycle.walk(table, curve, arches, 35.0, np.empty((ROWS, 192)), True)
    for furthest in (6.9, 9.3, 14.2, 23.7):
        count, trace = cycle.walk(table, curve, arches, furthest, np.empty((ROWS, 192)), True)
        np.testing.assert_array_equal(
            trace[: LOADING_LOSS + 1, : count - 1], everything[: LOADING_LOSS + 1, : count - 1]
        )
