"""The energy of a jump from zero contact, by 30-digit quadrature of the smooth punch under any control."""

import math

import mpmath
import numpy as np
import pytest

from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve.general import Basis, Series, coordinate
from gradhesion.core.curve.general_energy import energies_in, energy_from_zero
from gradhesion.core.struve.circle import TWO_PI

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
    for share in (0.0, *(10.0 ** rng.uniform(-3, 4, 8))):
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
