"""Sums of slopes over waves: wave by wave, and against the polynomial that the sum of losses is."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.curve.cosine_folds import first_arch, last_arch
from gradhesion.core.sensitivities.jump_slopes import BEND, GAIN, SLOPES
from gradhesion.core.sensitivities.wave_slopes import ROOM, add_slopes_of_waves, slopes_of_wave
from gradhesion.core.waves.cosine_sum import branch_points

GOOD = 1e-9
"""Of the slopes: at a branch point they have one power less than losses, whose sum is good to 1e-12."""


@pytest.mark.parametrize("k", [0.0, 0.37, 0.9])
@pytest.mark.parametrize("chi", [1e-2, 0.1, 0.6, 3.0])
@pytest.mark.parametrize("outwards", [True, False])
def test_a_sum_is_that_of_every_wave(k: float, chi: float, outwards: bool, table_of: Callable[[float], Any]) -> None:
    table = table_of(k)
    amplitude = 2 ** (0.5 * (k - 1)) * math.gamma(0.5 * (k + 1))
    near = (np.array([table]), np.zeros((1, 2)), np.zeros(0))
    work, found = np.empty(ROOM), np.empty(SLOPES)
    for waves in (200.0, 1000.0):
        curve = Cosine(chi / (2 * math.pi * waves) ** (0.5 * (1 + k)), chi / amplitude, 0.0)
        final = last_arch(table, curve, 0.5 * (1 - k))
        inner, outer = branch_points(table, curve, final, outwards)
        first = math.ceil(max(inner + 1.0, 0.5 * first_arch(table, curve, 0.5 * (1 - k)) + 16.0, 16.0))
        for low, high in [(first, outer - 11), (first, 0.3 * outer)]:
            high = math.floor(high)
            if high <= low + 60:
                continue
            every = np.zeros(SLOPES)
            for wave in np.arange(low, high + 1.0):
                slopes_of_wave(table, curve, near, wave, outwards, work, found)
                every += found
            total = np.zeros(SLOPES)
            add_slopes_of_waves(table, curve, near, (float(low), float(high)), outwards, final, work, total)
            for row in (BEND, GAIN):
                assert total[row] == pytest.approx(every[row], rel=GOOD)
