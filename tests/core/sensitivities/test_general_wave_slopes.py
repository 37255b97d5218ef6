"""Sums of slopes over waves, and long jumps: against every wave, and every panel."""

from typing import Any

import numpy as np
import pytest

from gradhesion.core.arrays.tables import changes_of, tables_of
from gradhesion.core.curve.general import Basis, Series, coordinate
from gradhesion.core.sensitivities.general_jump_slopes import NO_JUMP, NOTHING, add_drop, add_from_zero, parts_of
from gradhesion.core.sensitivities.general_wave_slopes import (
    WaveSlopes,
    add_jump,
    add_jump_from_zero,
    slopes_of_step,
)
from gradhesion.core.sensitivities.jump_slopes import SLOPES
from gradhesion.core.waves.general import DOWN, NOWHERE, UP, Waves, cut_of, room_for_waves
from gradhesion.core.waves.general_sum import add_waves

PAIR = np.array([[1.0, 1.0, 0.3], [3.0, 0.2, -0.1]])
CONTROLS = {"displacement": (1.0, 0.0), "machine": (0.999, 0.001), "load": (0.0, 1.0)}


def made(control: str) -> tuple[Any, Any, Any]:
    """Give the basis, a curve on which some thousand waves have folds, and the change of the tables."""
    k = 0.41
    return Basis(*tables_of(k, PAIR), PAIR), Series(3e-5, 2.0, 0.4, *CONTROLS[control]), changes_of(k, PAIR)


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize("kind", [UP, DOWN])
def test_a_sum_is_that_of_every_wave(control: str, kind: int) -> None:
    basis, curve, change = made(control)
    term = WaveSlopes(change, NO_JUMP)
    waves, found = Waves(kind, cut_of(basis.table, PAIR), NOWHERE, room_for_waves(PAIR)), np.zeros(SLOPES)
    first = next(
        low
        for low in np.arange(20.0, 20_000.0, 50.0)
        if all(
            slopes_of_step(basis, curve, term, waves, wave, found)[1] > 0 for wave in (low, low + 100.0, low + 250.0)
        )
    )
    last, every = first + 250.0, np.zeros(SLOPES)
    for wave in np.arange(first, last + 1.0):
        slopes_of_step(basis, curve, term, waves, wave, found)
        every += found
    total = np.zeros(SLOPES)
    add_waves(basis, curve, term, waves, first, last, total)
    np.testing.assert_allclose(total, every, rtol=0, atol=1e-9 * np.max(np.abs(every)))


@pytest.mark.parametrize("control", CONTROLS)
@pytest.mark.parametrize(("start", "end"), [(3.3, 900.7), (900.7, 20.3)])
def test_a_long_jump(control: str, start: float, end: float) -> None:
    basis, curve, change = made(control)
    sums, panels = np.zeros(SLOPES), np.zeros(SLOPES)
    add_jump(basis, curve, change, start, end, 0.0, sums)
    add_drop(basis, curve, change, start, 0.0, end, 1.0 if end > start else -1.0, panels)
    np.testing.assert_allclose(sums, panels, rtol=0, atol=1e-10 * np.max(np.abs(panels)))


@pytest.mark.parametrize("control", ["displacement", "machine"])
@pytest.mark.parametrize("inwards", [False, True])
def test_a_long_jump_of_zero_contact(control: str, inwards: bool) -> None:
    basis, curve, change = made(control)
    x, sums, panels = 900.7, np.zeros(SLOPES), np.zeros(SLOPES)
    add_jump_from_zero(basis, curve, change, x, 0.0, inwards, sums)
    level = coordinate(basis, curve, x) if inwards else 0.0
    parts = parts_of(basis, curve, change, x, 0.0) if inwards else NOTHING
    add_from_zero(basis, curve, change, parts, x, level, -1.0 if inwards else 1.0, panels)
    np.testing.assert_allclose(sums, panels, rtol=0, atol=1e-9 * np.max(np.abs(panels)))


def test_the_jump_out_under_a_dead_load_is_left_out() -> None:
    basis, curve, change = made("load")
    total = np.zeros(SLOPES)
    add_jump_from_zero(basis, curve, change, 5.3, 0.0, True, total)
    assert np.all(total == 0.0)
