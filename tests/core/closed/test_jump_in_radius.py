"""The jump-in radius of the envelope against (5.34) at high precision, and against what it is meant to be."""

import math

import mpmath
import numpy as np
import pytest

from gradhesion.core import solve
from gradhesion.core.closed.similarity import jump_in_radius_of_envelope
from gradhesion.core.problem.material import stiffness

EPS = float(np.finfo(float).eps)
GOOD = (0.37, 0.21, 610.0, 0.043, 0.019, 0.031)


def radius_534(k: float, M: float, wavelength: float, amplitude: float) -> mpmath.mpf:
    """Evaluate (5.34) with R = dgamma = 1, as printed."""
    with mpmath.workdps(40):
        k, wavelength = mpmath.mpf(k), mpmath.mpf(wavelength)
        s = mpmath.sqrt(2 ** (1 + k) * mpmath.pi / mpmath.mpf(M))
        r = mpmath.pi ** ((1 - k) / 2) * mpmath.gamma((1 + k) / 2) * amplitude * wavelength ** ((1 + k) / 2)
        return ((1 + k) * (s - r)) ** (2 / (3 + k)) if r < s else mpmath.nan


def test_it_is_5_34_on_random_scenes() -> None:
    rng = np.random.default_rng(11)
    k = rng.choice([0.0, 0.17, 0.5, 0.93, 1.0], 300)
    nu = np.where(k == 1.0, 0.5, rng.uniform(-0.9, 0.5, 300))
    modulus, c0 = 10 ** rng.uniform(-2, 6, 300), 10 ** rng.uniform(-3, 2, 300)
    wavelength, amplitude = 10 ** rng.uniform(-5, 0, 300), 10 ** rng.uniform(-5, 0, 300)
    found = jump_in_radius_of_envelope(k, nu, modulus, c0, wavelength, amplitude)
    M = stiffness(k, nu, modulus, c0)
    exists = 0
    for i, one in enumerate(found.tolist()):
        expected = radius_534(k[i], M[i], wavelength[i], amplitude[i])
        if mpmath.isnan(expected):
            assert math.isnan(one)
            continue
        exists += 1
        chi = 1 - expected ** ((3 + k[i]) / 2) / (1 + k[i]) / math.sqrt(2 ** (1 + k[i]) * math.pi / M[i])
        assert one == pytest.approx(float(expected), rel=30 * EPS / float(1 - chi))
    assert 100 < exists < 300, "both cases are met"


def test_the_loading_envelope_is_at_zero_depth_there() -> None:
    *_, wavelength, amplitude = GOOD
    names = ("k", "nu", "modulus", "c0_over_R", "lambda_over_R", "A")
    a_2 = float(jump_in_radius_of_envelope(*GOOD))
    beyond = solve(dict(zip(names, GOOD, strict=True)) | {"a_max_over_R": a_2}, ["delta_max"], solver="envelope")
    # the depth of that envelope at its rim, with the mean height of the wave on top
    assert beyond["delta_max"] == pytest.approx(amplitude * wavelength, rel=1e-12)


def test_it_does_not_exist_where_waves_are_stronger_than_adhesion() -> None:
    k, nu, modulus, c0, wavelength, _ = GOOD
    s = math.sqrt(2 ** (1 + k) * math.pi / float(stiffness(k, nu, modulus, c0)))
    limit = s / (math.pi ** ((1 - k) / 2) * math.gamma((1 + k) / 2) * wavelength ** ((1 + k) / 2))
    found = jump_in_radius_of_envelope(k, nu, modulus, c0, wavelength, [0.999 * limit, 1.001 * limit, 7.0 * limit])
    assert np.isnan(found).tolist() == [False, True, True]


def test_shapes_broadcast_and_what_is_out_of_range_has_no_value() -> None:
    k, nu, modulus, c0, wavelength, amplitude = GOOD
    found = jump_in_radius_of_envelope([[k], [0.0]], nu, [modulus, 2 * modulus, 3 * modulus], c0, wavelength, amplitude)
    assert found.shape == (2, 3)
    assert found[0, 0] == jump_in_radius_of_envelope(*GOOD)
    assert (np.diff(found) < 0).all(), "stiffer, smaller"
    for place, values in enumerate(
        [(-0.1, 1.1), (-1.0, 0.6), (0.0, -3.0), (0.0, math.nan), (0.0, math.inf), (-0.1, math.nan)]
    ):
        for value in values:
            scene = (*GOOD[:place], value, *GOOD[place + 1 :])
            assert np.isnan(jump_in_radius_of_envelope(*scene)), scene
    assert jump_in_radius_of_envelope([], nu, modulus, c0, wavelength, amplitude).shape == (0,)
