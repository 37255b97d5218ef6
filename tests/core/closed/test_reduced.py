"""Scenes in reduced variables and in SI units are the scenes in the parameters of `solve`; the lengths and ratios that they need."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import PARAMETERS
from gradhesion.core.closed import reduced
from gradhesion.core.problem.material import stiffness
from tests.core.scene import EPS, adhesion, scene_of, waviness

PLAIN = scene_of(0.37, 0.21, 610.0, 0.043, 0.019, 0.031, 1.7)
GOOD = tuple(PLAIN.values())[:6]
BAD = [(-0.1, 1.1), (-1.0, 0.6), (0.0, -3.0), (0.0, math.nan), (0.0, -1.0), (-0.1, math.nan)]


def without(*names: str) -> dict[str, Any]:
    return {name: value for name, value in PLAIN.items() if name not in names}


@pytest.mark.parametrize("R", [1e-6, 0.0137, 3.3])
def test_si_units_are_ratios_and_what_is_given_stays_bit_for_bit(R: float) -> None:
    lengths = {"c0": 0.043 * R, "wavelength": 0.019 * R, "amplitude": 0.031 * 0.019 * R, "a_max": 1.7 * R}
    made = reduced.parameters_from(
        {"k": 0.37, "nu": 0.21, "R": R, "E_star": 30.5 / R, "work_of_adhesion": 0.05} | lengths
    )
    assert tuple(made) == PARAMETERS
    for name, values in made.items():  # one rounding more for each product and quotient
        assert values == pytest.approx(PLAIN[name], rel=4 * EPS)
    same = reduced.parameters_from(PLAIN | {"machine_stiffness": R})
    assert {name: float(values) for name, values in same.items()} == PLAIN | {"machine_stiffness": R}
    scales = reduced.scales_in_si([2.0 * R, 3.0], 0.5)
    for unit, expected in {"N": [1.5 * np.pi * R, 2.25 * np.pi], "J": [2.0 * R**2, 4.5], "m": [2.0 * R, 3.0]}.items():
        np.testing.assert_allclose(scales[unit], expected, rtol=2 * EPS)


def test_reduced_variables_follow_one_from_the_other() -> None:
    given = {"lambda_over_L": 0.3, "chi": 0.7, "a_max_over_L": 5.0}
    made = reduced.parameters_from(without("lambda_over_R", "A", "a_max_over_R") | given)
    length = reduced.similarity_length(*GOOD[:4])
    assert made["lambda_over_R"] == 0.3 * length
    assert made["A"] == reduced.amplitude_of_ratio(*GOOD[:4], made["lambda_over_R"], 0.7)
    assert made["a_max_over_R"] == 5.0 * length
    for ratio, closing in ((1.0, {}), (0.81, {"closing_ratio": 0.81})):  # of the work of closing
        made = reduced.parameters_from(without("A", "a_max_over_R") | {"chi": 0.7, "a_max_over_a2": 2.0} | closing)
        own = made | {"modulus": made["modulus"] / ratio}
        assert made["a_max_over_R"] == 2.0 * reduced.jump_in_radius_of_envelope(*(own[name] for name in PARAMETERS[:6]))


def test_arrays_vary_along_what_they_follow_from() -> None:
    given = without("k", "modulus", "lambda_over_R") | {"k": np.array([0.1, 0.2])[:, None, None]}
    given |= {"R": np.array([1.0, 2.0, 3.0])[None, :, None], "E_star": 5.0, "work_of_adhesion": 0.5}
    given |= {"lambda_over_L": np.array([0.3, 0.4, 0.5, 0.6])}
    made = reduced.parameters_from(given)
    shapes = {name: made[name].shape for name in ("modulus", "lambda_over_R", "c0_over_R")}
    assert shapes == {"modulus": (1, 3, 1), "lambda_over_R": (2, 3, 4), "c0_over_R": ()}
    assert reduced.sources_of("modulus", given) == ("E_star", "R", "work_of_adhesion")
    assert {"k", "R", "lambda_over_L"} <= {*reduced.sources_of("lambda_over_R", given)}


@pytest.mark.parametrize("name", PARAMETERS)
def test_what_nothing_tells_is_missed(name: str) -> None:
    for call in (reduced.parameters_from, lambda given: reduced.sources_of(name, given)):
        with pytest.raises(ValueError, match=name):
            call(without(name))


def test_lengths_and_ratios_are_their_formulae_on_random_scenes() -> None:
    rng, exist = np.random.default_rng(12), 0
    for _ in range(100):
        k = float(rng.choice([0.0, 0.17, 0.5, 0.93, 1.0]))
        material = (k, 0.5 if k == 1.0 else rng.uniform(-0.9, 0.5), 10 ** rng.uniform(-2, 6), 10 ** rng.uniform(-3, 2))
        wavelength, chi, A = 10 ** rng.uniform(-5, 0), 10 ** rng.uniform(-3, 1), 10 ** rng.uniform(-5, 0)
        radius = float(reduced.jump_in_radius_of_envelope(*material, wavelength, A))
        M = float(stiffness(*material))
        s, wave = adhesion(k, M), waviness(k, wavelength, 1.0)
        rest = 1 - A * wave / s
        assert reduced.similarity_length(*material) == pytest.approx(M ** (-1 / (3 + k)), rel=4 * EPS)
        assert reduced.amplitude_of_ratio(*material, wavelength, chi) == pytest.approx(chi * s / wave, rel=16 * EPS)
        if rest > 0:  # (5.34); the error is that of the difference
            assert radius == pytest.approx(((1 + k) * s * rest) ** (2 / (3 + k)), rel=30 * EPS / rest)
        else:
            assert math.isnan(radius)
        exist += rest > 0
    assert 30 < exist < 100, "both cases are met"
    assert reduced.amplitude_of_ratio(*GOOD[:5], 0.0) == 0.0
    assert math.isnan(reduced.amplitude_of_ratio(*GOOD[:4], 1e-300, 1e300)), "no amplitude of a float"


@pytest.mark.parametrize("name", ["similarity_length", "amplitude_of_ratio", "jump_in_radius_of_envelope"])
def test_shapes_broadcast_and_what_is_out_of_range_has_no_value(name: str) -> None:
    function, count = getattr(reduced, name), 4 if name == "similarity_length" else 6
    good = GOOD[:count]
    found = function([[0.37], [0.0]], 0.21, [610.0, 1220.0, 1830.0], *good[3:])
    assert found.shape == (2, 3)
    assert found[0, 0] == function(*good)
    assert function([], *good[1:]).shape == (0,)
    for place, values in enumerate(BAD[:count]):
        for value in values:
            assert np.isnan(function(*good[:place], value, *good[place + 1 :])), (place, value)
