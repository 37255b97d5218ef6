"""What a jump on a patterned interface loses, against quadrature of its definition."""

import math
from itertools import pairwise

import numpy as np
import pytest

from gradhesion.core.curve.general import coordinate
from gradhesion.core.curve.patterned import toughness_at
from gradhesion.core.curve.patterned_energy import energy_between, energy_to
from gradhesion.core.struve.circle import TWO_PI
from tests.core.curve.test_patterned import CASES, K, curve_of

NODES, SHARES = np.polynomial.legendre.leggauss(40)


@pytest.mark.parametrize(("of_work", "shares", "gain"), CASES)
def test_jumps_by_quadrature(of_work: bool, shares: tuple[float, float], gain: float) -> None:
    basis, curve = curve_of(of_work, shares, gain)

    def density(x: float, level: float) -> float:
        z = TWO_PI * x
        kappa, _, _ = toughness_at(basis, x)
        scale = (curve.alpha + curve.beta * z ** (1.0 + K)) * z ** (0.5 * (1.0 - K))
        rho = kappa + (coordinate(basis, curve, x) - level) / scale
        return TWO_PI * z * (kappa * kappa - rho * rho)

    def total(low: float, high: float, level: float) -> float:
        ends = [*np.arange(low, high, 0.1).tolist(), high]
        parts = [
            0.5 * (b - a) * share * density(0.5 * (a + b) + 0.5 * (b - a) * node, level)
            for a, b in pairwise(ends if low > 0.0 else ends[1:])
            for node, share in zip(NODES, SHARES, strict=True)
        ]
        if low == 0.0:  # powers of the radius
            end = ends[1]
            places = 0.5 * (1.0 + NODES)
            parts += (0.5 * SHARES * [9.0 * end * t**8 * density(end * t**9, level) for t in places]).tolist()
        return math.fsum(parts)

    for start, end in ((1.3, 4.1), (4.1, 1.3), (3.3, 3.31)):
        level = coordinate(basis, curve, start)
        sign = 1.0 if end > start else -1.0
        expected = sign * total(min(start, end), max(start, end), level)
        assert energy_between(basis, curve, start, end) == pytest.approx(expected, rel=1e-12)
    for x, level in ((2.7, 0.0), (0.4, 0.02 if curve.alpha > 0.0 else 0.0)):  # a dead load has no bound
        assert energy_to(basis, curve, x, level) == pytest.approx(total(0.0, x, level), rel=1e-12)
    assert energy_to(basis, curve, 0.0, 0.3) == 0.0
