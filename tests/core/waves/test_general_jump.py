"""Long jumps from zero contact: of one cosine against its antiderivative, of other profiles against similar places."""

import math

import numpy as np
import pytest

from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.curve.general_energy import jump_energy
from gradhesion.core.curve.one_cosine_energy import jump_of_one_cosine_from_zero
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.waves.general_jump import jump_between, jump_from_zero

pytestmark = pytest.mark.slow

EPS = 2.0**-52
ONE_COSINE = np.array([[1.0, 1.0, 0.0]])


@pytest.mark.parametrize("waves", [1e6, 1e10, 1e13, 9e13])
@pytest.mark.parametrize("k", [0.0, 0.5, 0.9, 1.0])
@pytest.mark.parametrize("beta", [0.0, 1e-3, 1.0])
def test_from_zero_contact_to_a_rim(k: float, waves: float, beta: float) -> None:
    """At no load and at no depth, where the contact at the rim is pinned: its energy is some z^2/2."""
    table, bins = tables_of(k, ONE_COSINE)
    basis = Basis(table, bins, ONE_COSINE)
    z = TWO_PI * waves
    for chi, bend in ((0.3, 1e-3), (1e-6, 1e-5), (2.0, 0.1)):
        share = beta * z ** -(1.0 + k) if beta < 1.0 else 1.0
        curve = Series(bend * z ** (-0.5 * (3.0 + k)), 2.0, chi / float(table["amplitude"]), 1.0 - beta, share)
        for place in (0.0, 0.3):
            serves, expected = jump_of_one_cosine_from_zero(basis, curve, waves + place, 0.0)
            found = jump_from_zero(basis, curve, (waves + place) - math.floor(waves), 0.0, math.floor(waves))
            assert serves
            assert abs(found - expected) <= 40 * EPS * 0.5 * z * z * (1.0 + chi) ** 2, (chi, place)


@pytest.mark.parametrize("k", [0.0, 1.0])
def test_from_beyond_whole_waves_to_before_them(k: float) -> None:
    """A place at z < 40 has no whole waves: those beyond which the jump is told are no part of it then."""
    series = np.array([[1.0, 0.6, -0.3], [2.0, -0.2, 0.25]])
    table, bins = tables_of(k, series)
    curve = Series(1e-6, 2.0, 0.3, 1.0, 0.0)
    basis = Basis(table, bins, series)
    for start, end, whole in ((0.41, -22.6, 24.0), (0.3, -297.7, 300.0), (-297.7, 0.3, 300.0)):
        expected = jump_energy(basis, curve, whole + start, whole + end, 0.0)
        assert jump_between(basis, curve, start, end, whole) == pytest.approx(expected, rel=1e-12)
