"""Eight jumps at once, against each by itself; of any waves, in any order, near branch points and far from them."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.curve.cosine_folds import first_arch, last_arch
from gradhesion.core.waves.cosine import jump_of_wave
from gradhesion.core.waves.cosine_at_once import (
    BATCH,
    LOSSES,
    WAVES,
    jumps_in_a_row,
    jumps_of_batch,
    room_for_batch,
)
from gradhesion.core.waves.cosine_sum import branch_points

EPS = 2.0**-52
WORK, ROOM = np.zeros(22), room_for_batch()


def _curve(k: float, chi: float, waves: float) -> Cosine:
    """Give a curve whose folds end at a given wave, about."""
    amplitude = 2 ** (0.5 * (k - 1)) * math.gamma(0.5 * (k + 1))
    return Cosine(chi / (2 * math.pi * waves) ** (0.5 * (1 + k)), chi / amplitude, 0.0)


def _losses(table: Any, curve: Any, waves: NDArray[np.float64], outwards: bool) -> NDArray[np.float64]:
    """Give what the jumps of a batch lose."""
    ROOM[WAVES : WAVES + BATCH] = waves
    jumps_of_batch(table, curve, outwards, ROOM)
    return ROOM[LOSSES : LOSSES + BATCH].copy()


@pytest.mark.parametrize("k", [0.0, 0.37, 0.9, 1.0])
@pytest.mark.parametrize("chi", [1e-3, 0.1, 0.6, 3.0])
@pytest.mark.parametrize("outwards", [True, False])
def test_each_is_what_it_is_alone(k: float, chi: float, outwards: bool, table_of: Callable[[float], Any]) -> None:
    """To 64 roundings of the largest of a curve: of a float's digits, a phase of 10^9 waves keeps the half."""
    table = table_of(k)
    jumps = 0
    for waves in (30.0, 300.0, 1e4, 1e6, 1e9):
        curve = _curve(k, chi, waves)
        final = last_arch(table, curve, 0.5 * (1 - k))
        inner, outer = branch_points(table, curve, final, outwards)
        first = max(inner + 0.1, 0.5 * first_arch(table, curve, 0.5 * (1 - k)) + 9.0, 9.0)
        if first + 1.0 > outer - 4.0:
            continue
        places = np.geomspace(first, outer - 4.0, 4 * BATCH)
        alone = np.array([jump_of_wave(table, curve, wave, outwards, WORK)[1] for wave in places])
        together = np.concatenate(
            [_losses(table, curve, places[i : i + BATCH], outwards) for i in range(0, 4 * BATCH, BATCH)]
        )
        assert np.abs(together - alone).max() <= 64 * EPS * np.abs(alone).max()
        jumps += np.count_nonzero(alone)
    assert jumps > 2 * BATCH


@pytest.mark.parametrize("outwards", [True, False])
def test_neighbours_make_no_difference(outwards: bool, table_of: Callable[[float], Any]) -> None:
    """A search that goes on for another wave moves this one by rounding alone: the loss is stationary at both ends."""
    table, curve = table_of(0.3), _curve(0.3, 0.4, 5000.0)
    waves = np.geomspace(20.0, 4900.0, BATCH)
    together = _losses(table, curve, waves, outwards)
    for i in range(BATCH):
        alone = _losses(table, curve, np.full(BATCH, waves[i]), outwards)
        assert math.isclose(alone[0], together[i], rel_tol=256 * EPS)
        assert (alone == alone[0]).all()


@pytest.mark.parametrize("outwards", [True, False])
def test_a_jump_that_has_no_place_to_land_is_that_of_its_wave(outwards: bool, table_of: Callable[[float], Any]) -> None:
    """Within the inner branch point, and beyond the folds: what one wave gives, to the bit."""
    table, curve = table_of(0.0), _curve(0.0, 0.1, 1e6)
    inner, outer = branch_points(table, curve, last_arch(table, curve, 0.5), outwards)
    waves = np.concatenate([np.linspace(9.0, 0.3 * inner, BATCH // 2), outer + np.arange(3.0, 3.0 + BATCH // 2)])
    alone = [jump_of_wave(table, curve, wave, outwards, WORK)[1] for wave in waves]
    np.testing.assert_array_equal(_losses(table, curve, waves, outwards), alone)


def test_waves_in_a_row(table_of: Callable[[float], Any]) -> None:
    """The last one fills what is left."""
    table, curve = table_of(0.3), _curve(0.3, 0.4, 5000.0)
    jumps_in_a_row(table, curve, 40.0, 47.0, True, ROOM)
    assert ROOM[WAVES : WAVES + BATCH].tolist() == [*np.arange(40.0, 48.0), *[47.0] * 8]
    assert (ROOM[LOSSES + 7 : LOSSES + BATCH] == ROOM[LOSSES + 7]).all()
    assert (np.diff(ROOM[LOSSES : LOSSES + 8]) != 0.0).all()
