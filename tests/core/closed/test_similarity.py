"""The similarity length, the ratio of strengths and the jump-in radius: their formulae at 40 digits, and what they mean."""

import math
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core import solve
from gradhesion.core.closed.similarity import amplitude_of_ratio, jump_in_radius_of_envelope, similarity_length
from gradhesion.core.problem.material import stiffness
from tests.core.scene import scene_of

EPS = float(np.finfo(float).eps)
GOOD = (0.37, 0.21, 610.0, 0.043, 0.019, 0.031)
BAD = [(-0.1, 1.1), (-1.0, 0.6), (0.0, -3.0), (0.0, math.nan), (0.0, -1.0), (-0.1, math.nan)]


def test_they_are_their_formulae_on_random_scenes() -> None:
    rng, exist = np.random.default_rng(12), 0
    for _ in range(100):
        k = float(rng.choice([0.0, 0.17, 0.5, 0.93, 1.0]))
        material = (k, 0.5 if k == 1.0 else rng.uniform(-0.9, 0.5), 10 ** rng.uniform(-2, 6), 10 ** rng.uniform(-3, 2))
        wavelength, chi, A = 10 ** rng.uniform(-5, 0), 10 ** rng.uniform(-3, 1), 10 ** rng.uniform(-5, 0)
        radius = float(jump_in_radius_of_envelope(*material, wavelength, A))
        with mpmath.workdps(40):
            one, m, pi = mpmath.mpf(k), mpmath.mpf(float(stiffness(*material))), mpmath.pi
            s = mpmath.sqrt(2 ** (1 + one) * pi / m)
            n = (1 + one) / 2
            wave = pi ** (1 - n) * mpmath.gamma(n) * mpmath.mpf(wavelength) ** n
            rest = 1 - A * wave / s
            assert similarity_length(*material) == pytest.approx(float(m ** (-1 / (3 + one))), rel=4 * EPS)
            # powers and a gamma function
            amplitude = amplitude_of_ratio(*material, wavelength, chi)
            assert amplitude == pytest.approx(float(chi * s / wave), rel=16 * EPS)
            if rest > 0:  # (5.34); the error is that of the difference
                expected = float(((1 + one) * s * rest) ** (2 / (3 + one)))
                assert radius == pytest.approx(expected, rel=30 * EPS / float(rest))
            else:
                assert math.isnan(radius)
        exist += rest > 0
    assert 30 < exist < 100, "both cases are met"


def test_the_loading_envelope_is_at_zero_depth_at_the_jump_in() -> None:
    scene = scene_of(*GOOD, float(jump_in_radius_of_envelope(*GOOD)))
    # the depth of that envelope at its rim, with the mean height of the wave on top
    assert solve(scene, ["delta_max"], solver="envelope")["delta_max"] == pytest.approx(GOOD[5] * GOOD[4], rel=1e-12)
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
    assert function([], *good[1:]).shape == (0,)
    for place, values in enumerate(BAD[:count]):
        for value in values:
            assert np.isnan(function(*good[:place], value, *good[place + 1 :])), (place, value)
