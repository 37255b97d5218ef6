"""Long runs of waves: their folds, their jumps and their sums against walking them one by one."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core import regular
from gradhesion.core.branches import END, END_DEPTH, ROWS, START, START_DEPTH, append_branches
from gradhesion.core.curve import slope
from gradhesion.core.folds import last_arch
from gradhesion.core.regular import branch_of_wave, jump_of_wave, sum_of_waves

EPS = 2.0**-52
EXPONENTS = [0.0, 0.37, 0.8, 1 - 1e-12, 1.0]
SCRATCH = np.zeros((ROWS, 400))


def _waves_of(curve: Any, k: float) -> float:
    """Give the wave at which folds end, about."""
    amplitude = 2 ** (0.5 * (k - 1)) * math.gamma(0.5 * (k + 1))
    return float((curve[1] * amplitude / curve[0]) ** (2 / (1 + k)) / (2 * math.pi))


def _curve(k: float, gain: float, waves: float) -> tuple[float, float, float]:
    amplitude = 2 ** (0.5 * (k - 1)) * math.gamma(0.5 * (k + 1))
    return gain * amplitude / (2 * math.pi * waves) ** (0.5 * (1 + k)), gain, 0.0


@pytest.mark.parametrize("k", EXPONENTS)
def test_branches_of_waves_are_branches(k: float, table_of: Callable[[float], Any]) -> None:
    table = table_of(k)
    curve = _curve(k, 0.6, 200.0)
    trace = np.zeros((ROWS, 400))
    count = append_branches(table, curve, 0, last_arch(table, curve, 0.5 * (1 - k)), math.inf, trace, 0)
    shift = table["phase"] / (2 * math.pi)
    for branch in range(40, count - 1):
        wave = math.floor(trace[START, branch] - shift + 0.75)
        expected = trace[[START, START_DEPTH, END, END_DEPTH], branch]
        np.testing.assert_allclose(branch_of_wave(table, curve, wave), expected, rtol=2e-13, atol=1e-12)


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("outwards", [True, False])
def test_a_lag_is_a_part_of_a_wave(k: float, outwards: bool, table_of: Callable[[float], Any]) -> None:
    """What a jump loses is smooth in the number of the wave: a polynomial through whole waves meets the halves."""
    table = table_of(k)
    curve = _curve(k, 0.6, 3000.0)
    waves = np.arange(500.0, 510.0)
    losses = [jump_of_wave(table, curve, wave, outwards, SCRATCH)[1] for wave in waves]
    fit = np.polynomial.Polynomial.fit(waves, losses, 7)
    for wave in (504.5, 505.31):
        half = jump_of_wave(table, curve, wave, outwards, SCRATCH)[1]
        assert math.isclose(half, fit(wave), rel_tol=1e-11)


@pytest.mark.parametrize("k", EXPONENTS)
@pytest.mark.parametrize("outwards", [True, False])
@pytest.mark.parametrize("gain", [0.05, 0.6, 3.0])
def test_sums(k: float, outwards: bool, gain: float, table_of: Callable[[float], Any]) -> None:
    """Runs of waves near the beginning, in the middle, and to the end of the folds."""
    table = table_of(k)
    curve = _curve(k, gain, 1500.0)
    level = 0.5 * (1 - k)
    final = 0.5 * last_arch(table, curve, level) + 1.0
    # from where there are folds at all: level/z < g C
    amplitude = gain * float(table["amplitude"])
    first = max(25.0, math.ceil(2 * level / amplitude / (2 * math.pi)) + 25.0)
    last = math.floor(_waves_of(curve, k)) - 17.0
    for low, high in [(first, first + 10), (first, first + 100), (first + 300, last - 500), (first, last)]:
        walked = sum(jump_of_wave(table, curve, wave, outwards, SCRATCH)[1] for wave in np.arange(low, high + 1))
        size = sum(abs(jump_of_wave(table, curve, wave, outwards, SCRATCH)[1]) for wave in np.arange(low, high + 1))
        total = sum_of_waves(table, curve, low, high, outwards, final, SCRATCH)
        # sixteen points of the integral and three terms of Euler and Maclaurin; energies are promised to 1e-9
        assert abs(total - walked) <= 1e-10 * size


@pytest.mark.parametrize("k", EXPONENTS)
def test_far_waves_tend_to_a_limit(k: float, table_of: Callable[[float], Any]) -> None:
    """z e_j at a given place of the window no longer changes: on either side of the wave where the limit is taken."""
    table = table_of(k)
    near = _curve(k, 0.6, 2.5 * regular.FAR)
    for outwards in (True, False):
        values = [jump_of_wave(table, near, wave, outwards, SCRATCH)[1] for wave in (regular.FAR, regular.FAR + 1)]
        assert math.isclose(*values, rel_tol=2e-6)


def test_landings_are_on_the_curve(table_of: Callable[[float], Any]) -> None:
    for k in EXPONENTS:
        table = table_of(k)
        curve = _curve(k, 0.6, 300.0)
        for wave in (60.0, 171.0, 250.0):
            for outwards in (True, False):
                x, _ = jump_of_wave(table, curve, wave, outwards, SCRATCH)
                start, low, end, high = branch_of_wave(table, curve, wave)
                level = high if outwards else low
                d, _, _, found = slope(table, curve, 0.5 * (1 - k), x)
                z = 2 * math.pi * x
                assert d > 0.0
                # of the size of the stretch; the loss is stationary there
                assert abs(found - level) <= 1e-6 * z ** (0.5 * (1 - k))
                assert (x > end) if outwards else (x < start)


@pytest.mark.parametrize("k", [0.0, 0.5, 0.99])
def test_neighbouring_waves_lose_evenly(k: float, table_of: Callable[[float], Any]) -> None:
    """At three million waves the phase of a float is told to 10^-9; what a jump loses must not show it."""
    wave = 3.0e6
    curve = (0.4 / (2 * math.pi * wave) ** (0.5 * (1 + k)), 1.0, 0.0)
    trace = np.empty((ROWS, 64))
    losses = [jump_of_wave(table_of(k), curve, wave + i, True, trace)[1] for i in range(40)]
    noise = np.diff(losses, 3)
    assert np.abs(noise).max() <= 64 * EPS * abs(losses[0])
