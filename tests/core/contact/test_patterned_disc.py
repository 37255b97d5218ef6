"""Is the contact one disc on a patterned interface? The gap by its integral, outside what loading leaves by a jump."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from gradhesion.core import draw_curves, solve
from gradhesion.core.problem.status import LOADING_NOT_ONE_DISC
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic
from tests.core.slow_pattern import SlowScene

PHASES = np.random.default_rng(5).uniform(0.0, 2.0 * math.pi, 12)


def least_gap(slow: SlowScene, radius: float, end: float, depth: float) -> float:
    """Return the least int_a^r s^k (delta_H - depth) (r^2 - s^2)^(-(1+k)/2) ds at radii up to where the jump lands."""
    power = -0.5 * (1.0 + slow.k)

    def gap(r: float) -> float:
        def smooth(s: float) -> float:
            return float(s**slow.k * (slow.pair(s)[0] - depth) * (r + s) ** power)

        middle = max(radius, r - 0.5 * slow.wavelength)
        last = quad(smooth, middle, r, weight="alg", wvar=(0.0, power), limit=200)[0]
        ends = np.linspace(radius, middle, 2 + int((middle - radius) / slow.wavelength)) if middle > radius else []
        parts = [quad(lambda s: smooth(s) * (r - s) ** power, a, b)[0] for a, b in pairwise(ends)]
        return float(last + sum(parts))

    return min(gap(r) for r in radius + (end - radius) * np.linspace(0.004, 1.0, 60))


@pytest.mark.parametrize("seed", range(12))
def test_the_gap(seed: int) -> None:
    """Some of these stay one disc and others do not; of 100 such scenes none was told wrong."""
    rng = np.random.default_rng(seed)
    k, modulus, amplitude, length = (
        rng.uniform(0.0, 0.9),
        10 ** rng.uniform(4.0, 7.0),
        10 ** rng.uniform(-2.2, -1.5),
        0.07,
    )
    even, odd = 0.8 * math.cos(PHASES[seed]), 0.8 * math.sin(PHASES[seed])
    pattern = Toughness((ToughnessHarmonic(n=1, cos=even, sin=odd),), ("toughness", "work")[seed % 2])
    scene = {"k": k, "nu": 0.3, "modulus": modulus, "c0_over_R": 0.1, "lambda_over_R": 0.1, "A": amplitude}
    scene |= {"a_max_over_R": 0.45, "toughness_wavelength_over_R": length}
    slow = SlowScene(k, 0.3, modulus, 0.1, 0.1, amplitude, [(1, even, odd)], length, pattern.of)
    jumps, _ = draw_curves(scene, ["jumps"], toughness=pattern)
    names = ("jump_radius_before", "jump_radius_after", "jump_indentation")
    loading = [
        jump for jump in zip(*(jumps[name] for name in names), jumps["jump_unloading"], strict=True) if not jump[3]
    ]
    apart = any(least_gap(slow, a, b, depth) < 0.0 for a, b, depth, _ in loading if a > 0.0)
    status = int(solve(scene, ["dissipated_energy"], toughness=pattern)["status"])
    assert bool(status & LOADING_NOT_ONE_DISC) == apart
