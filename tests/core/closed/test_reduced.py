"""Scenes in reduced variables and in SI units are the scenes in the parameters of `solve`."""

from typing import Any

import numpy as np
import pytest

from gradhesion.core import PARAMETERS
from gradhesion.core.closed.reduced import parameters_from, scales_in_si, sources_of
from gradhesion.core.closed.similarity import amplitude_of_ratio, jump_in_radius_of_envelope, similarity_length
from tests.core.scene import scene_of

EPS = float(np.finfo(float).eps)
PLAIN = scene_of(0.37, 0.21, 610.0, 0.043, 0.019, 0.031, 1.7)


def without(*names: str) -> dict[str, Any]:
    return {name: value for name, value in PLAIN.items() if name not in names}


def test_what_is_given_stays_bit_for_bit() -> None:
    made = parameters_from(PLAIN | {"machine_stiffness": 3.0})
    assert {name: float(values) for name, values in made.items()} == PLAIN | {"machine_stiffness": 3.0}


@pytest.mark.parametrize("R", [1e-6, 0.0137, 3.3])
def test_si_units_are_ratios(R: float) -> None:
    lengths = {"c0": 0.043 * R, "wavelength": 0.019 * R, "amplitude": 0.031 * 0.019 * R, "a_max": 1.7 * R}
    made = parameters_from({"k": 0.37, "nu": 0.21, "R": R, "E_star": 30.5 / R, "work_of_adhesion": 0.05} | lengths)
    assert tuple(made) == PARAMETERS
    for name, values in made.items():  # one rounding more for each product and quotient
        assert values == pytest.approx(PLAIN[name], rel=4 * EPS)


def test_reduced_variables_follow_one_from_the_other() -> None:
    reduced = {"lambda_over_L": 0.3, "chi": 0.7, "a_max_over_L": 5.0}
    made = parameters_from(without("lambda_over_R", "A", "a_max_over_R") | reduced)
    material = tuple(PLAIN[name] for name in PARAMETERS[:4])
    length = similarity_length(*material)
    assert made["lambda_over_R"] == 0.3 * length
    assert made["A"] == amplitude_of_ratio(*material, made["lambda_over_R"], 0.7)
    assert made["a_max_over_R"] == 5.0 * length
    for ratio, closing in ((1.0, {}), (0.81, {"closing_ratio": 0.81})):  # of the work of closing
        made = parameters_from(without("A", "a_max_over_R") | {"chi": 0.7, "a_max_over_a2": 2.0} | closing)
        own = made | {"modulus": made["modulus"] / ratio}
        assert made["a_max_over_R"] == 2.0 * jump_in_radius_of_envelope(*(own[name] for name in PARAMETERS[:6]))


def test_arrays_vary_along_what_they_follow_from() -> None:
    given = without("k", "modulus", "lambda_over_R") | {"k": np.array([0.1, 0.2])[:, None, None]}
    given |= {"R": np.array([1.0, 2.0, 3.0])[None, :, None], "E_star": 5.0, "work_of_adhesion": 0.5}
    given |= {"lambda_over_L": np.array([0.3, 0.4, 0.5, 0.6])}
    made = parameters_from(given)
    assert made["modulus"].shape == (1, 3, 1)
    assert made["lambda_over_R"].shape == (2, 3, 4)
    assert made["c0_over_R"].shape == ()
    assert sources_of("modulus", given) == ("E_star", "R", "work_of_adhesion")
    assert {"k", "R", "lambda_over_L"} <= {*sources_of("lambda_over_R", given)}


@pytest.mark.parametrize("name", PARAMETERS)
def test_what_nothing_tells_is_missed(name: str) -> None:
    for call in (parameters_from, lambda given: sources_of(name, given)):
        with pytest.raises(ValueError, match=name):
            call(without(name))


def test_the_scales_are_those_of_the_normalisation() -> None:
    scales = scales_in_si([2.0, 3.0], 0.5)
    np.testing.assert_allclose(scales["N"], [1.5 * np.pi, 2.25 * np.pi], rtol=2 * EPS)
    assert scales["J"].tolist() == [2.0, 4.5]
    assert scales["m"].tolist() == [2.0, 3.0]
