"""The similarity length and the ratio of strengths against their formulae at high precision, and as what they mean."""

import math

import mpmath
import numpy as np
import pytest

from gradhesion.core import solve
from gradhesion.core.closed.similarity import amplitude_of_ratio, similarity_length
from gradhesion.core.problem.material import stiffness

EPS = float(np.finfo(float).eps)
GOOD = (0.37, 0.21, 610.0, 0.043, 0.019)
NAMES = ("k", "nu", "modulus", "c0_over_R", "lambda_over_R")


def test_both_are_their_formulae_on_random_scenes() -> None:
    rng = np.random.default_rng(12)
    k = rng.choice([0.0, 0.17, 0.5, 0.93, 1.0], 200)
    nu = np.where(k == 1.0, 0.5, rng.uniform(-0.9, 0.5, 200))
    modulus, c0 = 10 ** rng.uniform(-2, 6, 200), 10 ** rng.uniform(-3, 2, 200)
    wavelength, chi = 10 ** rng.uniform(-5, 0, 200), 10 ** rng.uniform(-3, 1, 200)
    lengths = similarity_length(k, nu, modulus, c0)
    amplitudes = amplitude_of_ratio(k, nu, modulus, c0, wavelength, chi)
    M = stiffness(k, nu, modulus, c0)
    for i in range(200):
        with mpmath.workdps(40):
            one, m = mpmath.mpf(k[i]), mpmath.mpf(M[i])
            length = (1 / m) ** (1 / (3 + one))
            s = mpmath.sqrt(2 ** (1 + one) * mpmath.pi / m)
            wave = (
                mpmath.pi ** ((1 - one) / 2)
                * mpmath.gamma((1 + one) / 2)
                * mpmath.mpf(wavelength[i]) ** ((1 + one) / 2)
            )
            amplitude = mpmath.mpf(chi[i]) * s / wave
        assert lengths[i] == pytest.approx(float(length), rel=4 * EPS)
        assert amplitudes[i] == pytest.approx(float(amplitude), rel=16 * EPS)  # a few powers and a gamma function


def test_scenes_of_the_same_reduced_variables_are_the_same_in_units_of_l() -> None:
    """At one k, nu, E* and c0 act through M alone: force over R dgamma, energy over dgamma L^2, radius over L."""
    nu, modulus, c0 = np.array([0.2, -0.4, 0.45]), np.array([100.0, 2e4, 3e6]), np.array([0.5, 0.01, 3.0])
    length = similarity_length(0.37, nu, modulus, c0)
    material = {"k": 0.37, "nu": nu, "modulus": modulus, "c0_over_R": c0, "lambda_over_R": 0.31 * length}
    amplitude = amplitude_of_ratio(**material, chi=0.6)
    outputs = ["pull_off_force", "pull_off_radius", "dissipated_energy", "unloading_jumps"]
    found = solve(material | {"A": amplitude, "a_max_over_R": 3.1 * length}, outputs)
    assert np.ptp(np.log(length)) > 1, "the scenes are not the same in R"
    size = {"pull_off_force": 1.0, "pull_off_radius": length, "dissipated_energy": length**2, "unloading_jumps": 1}
    for name in outputs:
        reduced = found[name] / size[name]
        np.testing.assert_allclose(reduced, reduced[0], rtol=1e-8 if name == "pull_off_radius" else 1e-12)


def test_the_limits_of_the_ratio() -> None:
    assert amplitude_of_ratio(*GOOD, 0.0) == 0.0
    assert amplitude_of_ratio(*GOOD, 0.5) == pytest.approx(0.5 * amplitude_of_ratio(*GOOD, 1.0), rel=2 * EPS)
    assert math.isnan(amplitude_of_ratio(*GOOD[:4], 1e-300, 1e300)), "no amplitude of a float"


def test_shapes_broadcast_and_what_is_out_of_range_has_no_value() -> None:
    k, nu, modulus, c0, wavelength = GOOD
    assert similarity_length([[k], [0.0]], nu, [modulus, 1.0, 2.0], c0).shape == (2, 3)
    assert amplitude_of_ratio([[k], [0.0]], nu, modulus, c0, wavelength, [0.1, 0.2, 0.3]).shape == (2, 3)
    assert similarity_length([], nu, modulus, c0).shape == (0,)
    for place, values in enumerate(
        [(-0.1, 1.1), (-1.0, 0.6), (0.0, -3.0), (0.0, math.nan), (0.0, -1.0), (-0.1, math.nan)]
    ):
        for value in values:
            scene = [*GOOD, 0.5]
            scene[place] = value
            assert np.isnan(amplitude_of_ratio(*scene)), scene
            if place < 4:
                assert np.isnan(similarity_length(*scene[:4])), scene
