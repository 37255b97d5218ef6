"""Energies of jumps of one cosine under load and machine control, against quadrature at their own coordinate."""

import math

import numpy as np
import pytest

from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve.general import Basis, Series, coordinate
from gradhesion.core.curve.general_energy import energy_from_zero, jump_energy
from gradhesion.core.curve.one_cosine_energy import jump_of_one_cosine, jump_of_one_cosine_from_zero
from gradhesion.core.numbers.circle import TWO_PI

EPS = 2.0**-52
EXPONENTS = [0.0, 0.41, 1.0]
SHARES = [0.0, 1e-3, 0.2, 5.0, 1e4, math.inf]
"""beta/alpha: displacement control, stiff to soft machines, load control."""
WORK = np.empty(64)
ONE_COSINE = np.array([[1.0, 1.0, 0.0]])


def _basis(k: float) -> Basis:
    return Basis(*tables_of(k, ONE_COSINE), ONE_COSINE)


def _curve(basis: Basis, x: float, chi: float, bend: float, share: float) -> Series:
    """A curve whose paraboloid takes a share of the stretch at x; the machine's part is told at x too."""
    k = float(basis[0]["k"])
    z = TWO_PI * x
    beta = share / z ** (1.0 + k)
    alpha, beta = (0.0, 1.0) if share == math.inf else (1.0 / (1.0 + beta), beta / (1.0 + beta))
    return Series(bend * z ** (-0.5 * (3.0 + k)), 2.0, chi / float(basis[0]["amplitude"]), alpha, beta)


@pytest.mark.parametrize("share", SHARES)
@pytest.mark.parametrize("k", EXPONENTS)
def test_jumps(k: float, share: float) -> None:
    rng = np.random.default_rng(3)
    basis, served = _basis(k), 0
    for _ in range(60):
        start = 10.0 ** rng.uniform(-0.7, 1.7)
        end = max(0.1, start + rng.uniform(-1.0, 1.0))
        curve = _curve(basis, start, 10.0 ** rng.uniform(-1.5, 0.2), rng.uniform(0.2, 3), share)
        serves, energy = jump_of_one_cosine(basis, curve, start, end)
        if serves:
            served += 1
            expected = jump_energy(basis, curve, start, end, 0.0)
            # at most a hundred of the terms is lost, and z of a load over its change
            assert abs(energy - expected) <= (500 + 20 * TWO_PI * start) * EPS * abs(expected), (curve, start, end)
    assert served > 30


@pytest.mark.parametrize("share", SHARES)
@pytest.mark.parametrize("k", EXPONENTS)
def test_jumps_from_zero_contact(k: float, share: float) -> None:
    """To a place on the curve, and to a rim where the contact is pinned above it."""
    rng = np.random.default_rng(4)
    basis, served = _basis(k), 0
    for _ in range(40):
        x = 10.0 ** rng.uniform(-0.7, 1.2)
        curve = _curve(basis, x, 10.0 ** rng.uniform(-1.5, 0.0), rng.uniform(0.2, 3), share)
        level = 0.0 if share == math.inf else coordinate(basis, curve, x) * rng.choice([1.0, 0.8])
        serves, energy = jump_of_one_cosine_from_zero(basis, curve, x, level)
        if serves:
            served += 1
            expected = energy_from_zero(basis, curve, x, level)
            assert abs(energy - expected) <= 2000 * EPS * max(abs(expected), 0.5 * (TWO_PI * x) ** 2), (curve, x)
    assert served > 20


def test_a_dead_load_has_no_bound() -> None:
    """Only at no load the jump between zero contact and a radius has an energy under load control."""
    basis = _basis(0.41)
    curve = _curve(basis, 0.7, 0.3, 1.0, math.inf)
    assert jump_of_one_cosine_from_zero(basis, curve, 0.7, 0.0)[0]
    assert not jump_of_one_cosine_from_zero(basis, curve, 0.7, -0.1)[0]


@pytest.mark.parametrize("share", [1e18, 1e28, 1e34, 1e120, 1e250])
@pytest.mark.parametrize("k", EXPONENTS)
def test_very_soft_machines_load_like_a_dead_load(k: float, share: float) -> None:
    """The first jump is at no load either way; what the machine keeps is the square of its last load over S."""
    basis = _basis(k)
    for x in (0.3, 2.7, 40.2):
        soft, dead = (_curve(basis, x, 0.4, 1.0, beta) for beta in (share, math.inf))
        expected = jump_of_one_cosine_from_zero(basis, dead, x, 0.0)
        serves, energy = jump_of_one_cosine_from_zero(basis, soft, x, 0.0)
        assert serves == expected[0]
        assert energy == pytest.approx(expected[1], rel=1e-14)


@pytest.mark.parametrize("share", [1e18, 1e28, 1e120])
def test_very_soft_machines_keep_their_spring(share: float) -> None:
    """From a load that pulls, Y = beta P/alpha is known as well as P; the energy is P^2/2S, in the units of a curve."""
    k = 0.41
    basis = _basis(k)
    curve = _curve(basis, 2.7, 0.4, 1.0, share)
    level = coordinate(basis, curve, 2.7)
    _, energy = jump_of_one_cosine_from_zero(basis, curve, 2.7, level)
    assert energy == pytest.approx(-level * level / ((1.0 + k) * curve.alpha * curve.beta), rel=1e-12)
