"""The energy of a jump: from zero contact by 30-digit quadrature of the smooth punch, of a pattern by its definition."""

import math
from itertools import pairwise

import mpmath
import numpy as np
import pytest

from gradhesion.core import face
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve.general import Basis, Series, coordinate
from gradhesion.core.curve.general_energy import energies_in, energy_from_zero
from gradhesion.core.curve.patterned import toughness_at
from gradhesion.core.numbers.circle import TWO_PI
from tests.core.curve.test_patterned import CASES, K
from tests.core.curve.test_patterned import curve_of as patterned_curve

NODES, SHARES = np.polynomial.legendre.leggauss(40)
EPS = 2.0**-52


def _exact(k: float, numbers: tuple[float, ...], place: float, held: float) -> mpmath.mpf:
    """The integral of z (1 - rho^2) from zero contact to a z, at a coordinate."""
    c, n = (1 - mpmath.mpf(k)) / 2, 1 + mpmath.mpf(k)
    bend, power, _, alpha, beta = map(mpmath.mpf, numbers)
    end, level = mpmath.mpf(place), mpmath.mpf(held)

    def integrand(z: mpmath.mpf) -> mpmath.mpf:
        depth = bend * z**power - z**c
        load = z**n * (bend * z**power * power / (n + power) - z**c)
        rise = (alpha * depth + beta * load - level) / ((alpha + beta * z**n) * z**c)
        return -z * rise * (2 + rise)

    return mpmath.quad(integrand, [0, *(end / mpmath.mpf(3) ** j for j in range(24, -1, -1))])


@pytest.mark.parametrize("k", [0.0, 0.1, 0.37, 0.7, 0.98])
def test_energy_from_zero(k: float) -> None:
    """Its powers of z have a branch point at 0, and the stiffness of a soft machine changes its balance near by."""
    rng = np.random.default_rng(int(100 * k))
    basis = Basis(*tables_of(k), np.zeros((0, 3)))
    for share in (0.0, *(10.0 ** rng.uniform(-3, 4, 5))):
        m = float(rng.choice([1.0, 1.5, 2.0, 3.0]))
        x = 10.0 ** rng.uniform(-1, 2) / TWO_PI
        bend = (TWO_PI * x) ** (0.5 * (1.0 - k) - m) * rng.uniform(0.3, 1.5)
        curve = Series(bend, m, 0.0, 1.0 / (1.0 + share), share / (1.0 + share))
        level = coordinate(basis, curve, x)
        with mpmath.workdps(30):
            end = TWO_PI * mpmath.mpf(x)
            expected = _exact(k, curve, end, level)
            error = abs(energy_from_zero(basis, curve, x, level) - expected)
        # rounding of some 50 terms that are of the size of the square and of the result
        assert error <= 8 * EPS * (end**2 + abs(expected)), (share, m, x)


WAVES = {
    "none": np.zeros((0, 3)),
    "two": np.array([[1.0, 1.0, 0.0], [3.0, 0.2, 0.1]]),
    "one": np.array([[2.0, 0.0, 1.0]]),
}


@pytest.mark.parametrize("share", [0.0, 0.01, 1.0, 1e4])
@pytest.mark.parametrize("waves", WAVES)
@pytest.mark.parametrize("k", [0.0, 0.37, 0.98])
def test_energy_of_a_jump_between_any_rim_and_zero_contact(k: float, waves: str, share: float) -> None:
    """With stations it is that of panels from the rim inwards, whatever the stations hold already."""
    rng = np.random.default_rng(3)
    basis = Basis(*tables_of(k), WAVES[waves])
    curve = Series(0.02, 2.0, 0.3, 1.0 / (1.0 + share), share / (1.0 + share))
    rims = rng.permutation(np.geomspace(1e-3, 20.0, 60))
    kept, few = (np.full((4, n), math.inf) for n in (64, 3))
    for x in rims.tolist():
        levels = 0.0, coordinate(basis, curve, x)
        energies = energies_in(basis, curve, x, *levels, kept)
        for level, energy in zip(levels, energies, strict=True):
            # rounding of the square, and of waves and a bend that are some times as large as the stretch
            size = (TWO_PI * x) ** 2 + abs(energy)
            assert abs(energy - energy_from_zero(basis, curve, x, level)) <= 16 * EPS * size, x
            for stations in (few, np.full((4, 1), math.inf)):
                assert energies_in(basis, curve, x, level, level, stations) == (energy, energy)
    assert np.isfinite(kept[0]).sum() > 3 or not WAVES[waves].size


@pytest.mark.parametrize(("of_work", "shares", "gain"), CASES)
def test_jumps_on_a_patterned_interface_by_quadrature(of_work: bool, shares: tuple[float, float], gain: float) -> None:
    basis, curve = patterned_curve(of_work, shares, gain)

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
        assert face.loss_between(basis, curve, start, end, np.empty(16)) == pytest.approx(expected, rel=1e-12)
    for x, level in ((2.7, 0.0), (0.4, 0.02 if curve.alpha > 0.0 else 0.0)):  # a dead load has no bound
        assert energy_from_zero(basis, curve, x, level) == pytest.approx(total(0.0, x, level), rel=1e-12)
    assert energy_from_zero(basis, curve, 0.0, 0.3) == 0.0
