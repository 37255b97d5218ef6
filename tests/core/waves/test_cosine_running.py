"""Running sums over waves: wave by wave, against sums of one rim at every power of ten, and the samples that they take."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.curve.cosine_folds import first_arch, last_arch
from gradhesion.core.waves.cosine import jump_of_wave
from gradhesion.core.waves.cosine_at_once import room_for_batch
from gradhesion.core.waves.cosine_running import begin_sums, room_for_sums, sum_up_to
from gradhesion.core.waves.cosine_sum import branch_points, sum_of_waves

WORK, ROOM = np.zeros(22), room_for_batch()
GOOD = 1e-12
"""What sums are promised to, in parts of the loss."""
BEFORE_OUTER = 8.0


def _run(k: float, chi: float, waves: float, outwards: bool, table: Any) -> tuple[Any, float, float, float]:
    """Give a curve whose folds end at a given wave, about, the first and the last wave of its sums, and its last arch."""
    amplitude = 2 ** (0.5 * (k - 1)) * math.gamma(0.5 * (k + 1))
    curve = Cosine(chi / (2 * math.pi * waves) ** (0.5 * (1 + k)), chi / amplitude, 0.0)
    final = last_arch(table, curve, 0.5 * (1 - k))
    inner, outer = branch_points(table, curve, final, outwards)
    first = math.ceil(max(inner + 0.02, 0.5 * first_arch(table, curve, 0.5 * (1 - k)) + 16.0, 16.0))
    return curve, first, math.floor(outer - BEFORE_OUTER), final


@pytest.mark.slow
@pytest.mark.parametrize("k", [0.0, 0.37, 0.9, 1.0])
@pytest.mark.parametrize("chi", [1e-3, 0.03, 0.6, 3.0])
@pytest.mark.parametrize("outwards", [True, False])
def test_a_sum_up_to_any_wave(k: float, chi: float, outwards: bool, table_of: Callable[[float], Any]) -> None:
    table = table_of(k)
    sums = 0
    for waves in (150.0, 1000.0, 20000.0):
        curve, first, last, final = _run(k, chi, waves, outwards, table)
        if last - first < 20.0:
            continue
        losses = np.array(
            [jump_of_wave(table, curve, wave, outwards, WORK)[1] for wave in np.arange(first, last + 1.0)]
        )
        exact, size = np.cumsum(losses.astype(np.longdouble)), np.cumsum(np.abs(losses))
        of_all = room_for_sums()[0]
        begin_sums(table, curve, of_all, first, outwards, final)
        for i in {*range(15), *np.geomspace(15, losses.size, 60).astype(int) - 1, losses.size - 1}:
            found = sum_up_to(table, curve, of_all, first + i, outwards, final, ROOM)
            assert abs(found - float(exact[i])) <= GOOD * size[i]
            sums += 1
    assert sums > 60


@pytest.mark.parametrize("k", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("outwards", [True, False])
def test_a_sum_at_every_power_of_ten(k: float, outwards: bool, table_of: Callable[[float], Any]) -> None:
    """Against the sum of one rim, which has other places."""
    table = table_of(k)
    curve, first, _, final = _run(k, 0.3, 1e15, outwards, table)
    of_all = room_for_sums()[0]
    begin_sums(table, curve, of_all, first, outwards, final)
    for last in np.floor(10.0 ** np.arange(2.0, 15.0)):
        found = sum_up_to(table, curve, of_all, first + last, outwards, final, ROOM)
        alone = sum_of_waves(table, curve, first, first + last, outwards, final, ROOM)
        assert math.isclose(found, alone, rel_tol=GOOD)


@pytest.mark.parametrize("waves", [1e3, 1e6])
def test_many_sums_take_the_samples_of_a_few(waves: float, table_of: Callable[[float], Any]) -> None:
    """Twelve first waves, sixteen places a panel: what comes after that is read. No sum depends on those before it."""
    table = table_of(0.3)
    curve, first, last, final = _run(0.3, 0.3, waves, True, table)
    ends = np.floor(np.linspace(first + 20.0, last, 1000))
    of_all = room_for_sums()[0]
    begin_sums(table, curve, of_all, first, True, final)
    together = [sum_up_to(table, curve, of_all, end, True, final, ROOM) for end in ends]
    assert of_all["samples"] <= 12 + 16 * of_all["count"]
    for i in (0, 17, 500, 999):
        alone = room_for_sums()[0]
        begin_sums(table, curve, alone, first, True, final)
        assert sum_up_to(table, curve, alone, ends[i], True, final, ROOM) == together[i]
        assert 0 < alone["samples"] <= 12 + 16 * 3
