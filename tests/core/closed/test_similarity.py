"""The similarity length, the ratio of strengths and the jump-in radius: their formulae at 40 digits, and what they mean."""

import math
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core import PARAMETERS, solve
from gradhesion.core.closed.similarity import amplitude_of_ratio, jump_in_radius_of_envelope, similarity_length
from gradhesion.core.problem.material import stiffness

EPS = float(np.finfo(float).eps)
GOOD = (0.37, 0.21, 610.0, 0.043, 0.019, 0.031)
BAD = [(-0.1, 1.1), (-1.0, 0.6), (0.0, -3.0), (0.0, math.nan), (0.0, -1.0), (-0.1, math.nan)]


def test_they_are_their_formulae_on_random_scenes() -> None:
    rng = np.random.default_rng(12)
    k = rng.choice([0.0, 0.17, 0.5, 0.93, 1.0], 300)
    nu = np.where(k == 1.0, 0.5, rng.uniform(-0.9, 0.5, 300))
    modulus, c0 = 10 ** rng.uniform(-2, 6, 300), 10 ** rng.uniform(-3, 2, 300)
    wavelength, chi, A = 10 ** rng.uniform(-5, 0, 300), 10 ** rng.uniform(-3, 1, 300), 10 ** rng.uniform(-5, 0, 300)
    lengths = similarity_length(k, nu, modulus, c0)
    amplitudes = amplitude_of_ratio(k, nu, modulus, c0, wavelength, chi)
    radii = jump_in_radius_of_envelope(k, nu, modulus, c0, wavelength, A)
    M, exist = stiffness(k, nu, modulus, c0), 0
    for i in range(300):
        with mpmath.workdps(40):
            one, m = mpmath.mpf(k[i]), mpmath.mpf(M[i])
            s = mpmath.sqrt(2 ** (1 + one) * mpmath.pi / m)
            wave = (
                mpmath.pi ** ((1 - one) / 2)
                * mpmath.gamma((1 + one) / 2)
                * mpmath.mpf(wavelength[i]) ** ((1 + one) / 2)
            )
            rest = 1 - A[i] * wave / s
            assert lengths[i] == pytest.approx(float(m ** (-1 / (3 + one))), rel=4 * EPS)
            assert amplitudes[i] == pytest.approx(float(chi[i] * s / wave), rel=16 * EPS)  # powers and a gamma function
            if rest > 0:  # (5.34); the error is that of the difference
                expected = float(((1 + one) * s * rest) ** (2 / (3 + one)))
                assert radii[i] == pytest.approx(expected, rel=30 * EPS / float(rest))
            else:
                assert math.isnan(radii[i])
            exist += rest > 0
    assert 100 < exist < 300, "both cases are met"


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


def test_the_loading_envelope_is_at_zero_depth_at_the_jump_in() -> None:
    scene = dict(zip(PARAMETERS, (*GOOD, float(jump_in_radius_of_envelope(*GOOD))), strict=True))
    beyond = solve(scene, ["delta_max"], solver="envelope")
    # the depth of that envelope at its rim, with the mean height of the wave on top
    assert beyond["delta_max"] == pytest.approx(GOOD[5] * GOOD[4], rel=1e-12)
    limit = float(amplitude_of_ratio(*GOOD[:5], 1.0))
    found = jump_in_radius_of_envelope(*GOOD[:5], [0.999 * limit, 1.001 * limit, 7.0 * limit])
    assert np.isnan(found).tolist() == [False, True, True], "waves as strong as adhesion end it"
    assert amplitude_of_ratio(*GOOD[:5], 0.0) == 0.0
    assert math.isnan(amplitude_of_ratio(*GOOD[:4], 1e-300, 1e300)), "no amplitude of a float"


@pytest.mark.parametrize(
    ("function", "count"), [(similarity_length, 4), (amplitude_of_ratio, 6), (jump_in_radius_of_envelope, 6)]
)
def test_shapes_broadcast_and_what_is_out_of_range_has_no_value(function: Callable[..., Any], count: int) -> None:
    good = GOOD[:count]
    found = function([[0.37], [0.0]], 0.21, [610.0, 1220.0, 1830.0], *good[3:])
    assert found.shape == (2, 3)
    assert found[0, 0] == function(*good)
    assert (np.diff(found) < 0).all(), "stiffer, smaller"
    assert function([], *good[1:]).shape == (0,)
    for place, values in enumerate(BAD[:count]):
        for value in values:
            assert np.isnan(function(*good[:place], value, *good[place + 1 :])), (place, value)
