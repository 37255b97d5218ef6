"""One wave far from zero contact: its folds and its jump, against the walk, neighbours, and the solver of any profile."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve.branches import END, END_DEPTH, ROWS, START, START_DEPTH, append_branches
from gradhesion.core.curve.cosine import Cosine, slope
from gradhesion.core.curve.cosine_folds import last_arch
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.waves.cosine import FAR, branch_of_wave, end_of_wave, jump_of_wave
from gradhesion.core.waves.general import DOWN, NOWHERE, UP, Waves, cut_of, room_for_waves, step_of_wave

EPS = 2.0**-52
EXPONENTS = [0.0, 0.37, 0.8, 1 - 1e-12, 1.0]
WORK = np.zeros(22)


def _curve(k: float, chi: float, waves: float) -> Cosine:
    """Give the curve of a given C g whose folds end at a given wave, about."""
    amplitude = 2 ** (0.5 * (k - 1)) * math.gamma(0.5 * (k + 1))
    return Cosine(chi / (2 * math.pi * waves) ** (0.5 * (1 + k)), chi / amplitude, 0.0)


@pytest.mark.parametrize("k", EXPONENTS)
def test_branches_of_waves_are_branches(k: float, table_of: Callable[[float], Any]) -> None:
    table = table_of(k)
    curve = _curve(k, 0.5, 200.0)
    trace = np.zeros((ROWS, 400))
    count = append_branches(table, curve, 0, last_arch(table, curve, 0.5 * (1 - k)), math.inf, trace, 0)
    shift = table["phase"] / (2 * math.pi)
    for branch in range(40, count - 1):
        wave = math.floor(trace[START, branch] - shift + 0.75)
        expected = trace[[START, START_DEPTH, END, END_DEPTH], branch]
        np.testing.assert_allclose(branch_of_wave(table, curve, wave), expected, rtol=2e-13, atol=1e-12)


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("outwards", [True, False])
def test_the_loss_is_smooth_in_the_index(k: float, outwards: bool, table_of: Callable[[float], Any]) -> None:
    """A polynomial through what whole waves lose meets what lies between them."""
    table = table_of(k)
    curve = _curve(k, 0.5, 3000.0)
    waves = np.arange(500.0, 510.0)
    losses = [jump_of_wave(table, curve, wave, outwards, WORK)[1] for wave in waves]
    fit = np.polynomial.Polynomial.fit(waves, losses, 7)
    for wave in (504.5, 505.31):
        half = jump_of_wave(table, curve, wave, outwards, WORK)[1]
        assert math.isclose(half, fit(wave), rel_tol=1e-11)


@pytest.mark.parametrize("k", [0.0, 0.4, 1.0])
@pytest.mark.parametrize("chi", [1e-7, 1e-3, 0.3, 3.0])
@pytest.mark.parametrize("waves", [1e4, 1e8, 1e13])
def test_the_loss_is_that_of_any_profile(k: float, chi: float, waves: float, table_of: Callable[[float], Any]) -> None:
    """Another solver finds folds by interpolation, and takes every term's difference by functions of its own.

    No digit is lost to the number of waves, nor to 1/chi: 64 eps, of some twenty roundings and a sum of sixteen terms;
    where folds are about to end, the loss is the cube of a jump of half the length.
    """
    if k < 1.0 and chi * waves < 2.0:
        pytest.skip("no folds")
    curve = _curve(k, chi, waves)
    rows = np.array([[1.0, 1.0, 0.0]])
    table, cosine_bins = tables_of(k)
    basis, other = Basis(table, cosine_bins, rows), Series(0.5 * curve[0], 2.0, curve[1], 1.0, 0.0)
    room, cut = room_for_waves(rows), cut_of(table, rows)
    for part in (0.3, 0.9):
        wave = round(part * waves) + 0.37
        outwards, _, _ = step_of_wave(basis, other, Waves(UP, cut, NOWHERE, room), wave, True)
        inwards, _, _ = step_of_wave(basis, other, Waves(DOWN, cut, NOWHERE, room), wave, True)
        # the cut stands beyond the centre of wave 0, so that both count waves alike
        assert math.isclose(jump_of_wave(table_of(k), curve, wave, True, WORK)[1], outwards, rel_tol=64 * EPS)
        assert math.isclose(jump_of_wave(table_of(k), curve, wave + 1.0, False, WORK)[1], inwards, rel_tol=64 * EPS)


def test_landings_are_on_the_curve(table_of: Callable[[float], Any]) -> None:
    for k in EXPONENTS:
        table = table_of(k)
        curve = _curve(k, 0.5, 300.0)
        for wave in (60.0, 171.0, 250.0):
            for outwards in (True, False):
                landing, _ = jump_of_wave(table, curve, wave, outwards, WORK)
                x = wave + landing
                start, low, end, high = branch_of_wave(table, curve, wave)
                level = high if outwards else low
                d, _, _, found = slope(table, curve, 0.5 * (1 - k), x)
                z = 2 * math.pi * x
                assert d > 0.0
                # of the size of the stretch; the loss is stationary there
                assert abs(found - level) <= 1e-6 * z ** (0.5 * (1 - k))
                assert (x > end) if outwards else (x < start)


@pytest.mark.parametrize("k", [0.0, 0.5, 0.99])
@pytest.mark.parametrize("wave", [3.0e6, 3.0e9])
def test_neighbouring_waves_lose_evenly(k: float, wave: float, table_of: Callable[[float], Any]) -> None:
    """At three million waves the phase of a float is told to 10^-9; what a jump loses must not show it."""
    curve = Cosine(0.4 / (2 * math.pi * wave) ** (0.5 * (1 + k)), 1.0, 0.0)
    losses = [jump_of_wave(table_of(k), curve, wave + i, True, WORK)[1] for i in range(40)]
    noise = np.diff(losses, 3)
    assert np.abs(noise).max() <= 64 * EPS * abs(losses[0])


@pytest.mark.parametrize("wave", [1000.0, 1000.37, 4.0 * FAR])
def test_a_curve_that_lags_ends_a_branch_where_the_wave_does(wave: float, table_of: Callable[[float], Any]) -> None:
    table = table_of(0.3)
    curve = _curve(0.3, 0.8, 3.0 * wave)
    shifted, x = end_of_wave(table, curve, wave)
    d, d1, _, _ = slope(table, shifted, 0.35, x)
    assert shifted[2] == wave - math.floor(wave)
    # a step of Newton's method from there: the fold is the square of this
    assert abs(d / d1) <= 1e-9 * (1.0 + x * EPS / 1e-10)
