"""The lowest load of the leading form of short waves: none of a dense scan is lower, however far out it stands."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.general import Basis, state
from gradhesion.core.curve.short_wave import ShortWave, waves_of
from gradhesion.core.pull_off.general import deepest_wave
from gradhesion.core.pull_off.short_wave import lowest_load

EPS = 2.0**-52
ONE = ((1, 1.0, 0.0),)
TWO = ((1, 1.0, 0.1), (3, -0.2, 0.3))
MANY = tuple((n, math.cos(3.0 * n) / n, math.sin(3.0 * n) / n) for n in range(1, 13))


def curve_of(k: float, waves: Any, exponent: float, size: float, lowest: float) -> tuple[Any, ShortWave, float]:
    """Give a curve whose parabola from below is lowest at x = `lowest`, and its chi."""
    table, _ = tables_of(k)
    rows = np.array(waves, dtype=float)
    gain = size / float(table["amplitude"])
    chi = gain * float(table["amplitude"]) * deepest_wave(table, rows)
    power = exponent - 0.5 * (1 - k)
    bend = 0.5 * (3 + k) * (1 + chi) / (exponent * (2 * math.pi * lowest) ** power)
    return Basis(table, *waves_of(table, rows)), ShortWave(bend, exponent, gain, 1.0, 0.0), chi


@kernel()
def lowest_of(basis: Any, curve: ShortWave, places: Any) -> float:
    lowest = math.inf
    for x in places:
        _, _, _, _, load = state(basis, curve, x, 0.0)
        lowest = min(lowest, load)
    return lowest


@pytest.mark.parametrize("k", [0.0, 0.37, 1.0])
@pytest.mark.parametrize(("waves", "exponent"), [(ONE, 2.0), (TWO, 1.0), (TWO, 5.0), (MANY, 2.4)])
@pytest.mark.parametrize("size", [0.02, 0.3, 1.9])
def test_nothing_is_lower(k: float, waves: Any, exponent: float, size: float) -> None:
    for place in (0.6, 5.3, 41.7):
        basis, curve, chi = curve_of(k, waves, exponent, size, place)
        for rim in (0.3 * place, 0.98 * place, math.inf):
            lowest, x = lowest_load(basis, curve, chi, rim)
            assert 0.0 < x <= rim
            scan = lowest_of(basis, curve, np.linspace(0.0, min(rim, 1.6 * place + 1.0), 40_001)[1:])
            scan = min(scan, 0.0)  # where it is positive everywhere there is no pull-off
            assert lowest <= scan + 64 * EPS * (1 + place) * abs(scan)
            assert lowest == pytest.approx(scan, rel=1e-3)
            if lowest < 0.0:
                assert lowest == pytest.approx(state(basis, curve, x)[4], rel=8 * EPS)


@pytest.mark.parametrize("waves", [ONE, TWO])
def test_far_out_it_is_that_of_the_envelope(waves: Any) -> None:
    """A wave beside the best one is off by the square of its share of the radius."""
    values = []
    for place in (1e3, 1e5, 1e9, 1e13):
        basis, curve, chi = curve_of(0.3, waves, 2.0, 0.4, place)
        lowest, x = lowest_load(basis, curve, chi, math.inf)
        assert x == pytest.approx(place, rel=2 / place)
        values.append(lowest / ((2 * math.pi * place) ** 1.65 * (1 + chi)))
    assert values[0] == pytest.approx(values[3], rel=20 / 1e6)
    assert values[1:3] == pytest.approx([values[3]] * 2, rel=1e-9)


def test_what_cannot_be_found() -> None:
    basis, curve, chi = curve_of(0.3, ONE, 2.0, 0.4, 5.0)
    assert math.isnan(lowest_load(basis, curve, chi, 1e-120)[0])
    assert lowest_load(*curve_of(0.0, ((1, -1.0, 0.0),), 2.0, 3.0, 5.0), 1e-3)[0] == 0.0
