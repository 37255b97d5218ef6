"""Slopes to whatever gives a scene, against differences of what the solver gives."""

from typing import Any

import numpy as np
import pytest

from gradhesion.core import PARAMETERS, SENSITIVITIES, solve
from gradhesion.core.answers.slopes_to_keys import POWERS, slopes_to_keys
from gradhesion.core.closed.reduced import parameters_from, scales_in_si

PLAIN: dict[str, Any] = dict(zip(PARAMETERS, (0.31, 0.27, 430.0, 0.013, 0.31, 0.023, 0.7), strict=True))
REDUCED: dict[str, Any] = {
    "k": 0.31,
    "nu": 0.27,
    "modulus": 430.0,
    "c0_over_R": 0.013,
    "lambda_over_L": 2.1,
    "chi": 0.4,
    "a_max_over_L": 6.0,
}
UNITS: dict[str, Any] = {
    "k": 0.31,
    "nu": 0.27,
    "R": 1e-6,
    "E": 8e8,
    "work_of_adhesion": 0.05,
    "c0": 2e-8,
    "wavelength": 1.7e-7,
    "amplitude": 4e-9,
    "a_max": 7e-7,
}


@pytest.mark.parametrize("given", [PLAIN, REDUCED, UNITS])
@pytest.mark.parametrize("output", SENSITIVITIES)
def test_against_differences(given: dict[str, Any], output: str) -> None:
    value = output.removesuffix("_sensitivity")

    def values(scene: dict[str, Any]) -> Any:
        found = solve(parameters_from(scene), [value])[value]
        if "R" not in scene:
            return found
        return found * scales_in_si(scene["R"], scene["work_of_adhesion"])["N" if value == "pull_off_force" else "J"]

    slopes_of = solve(parameters_from(given), [output])[output]
    powers = POWERS[output] if "R" in given else {}
    slopes = slopes_to_keys(given, [*given], PARAMETERS, values(given), slopes_of, powers)
    for key, centre in given.items():
        step = 1e-4 * centre
        around = [float(values({**given, key: centre + i * step})) for i in (-2, -1, 1, 2)]
        exact = np.dot([1.0, -8.0, 8.0, -1.0], around) / (12.0 * step)
        # differences of fourth order are good to some 1e-11/1e-4 of the value
        assert slopes[key] * centre == pytest.approx(exact * centre, rel=1e-7, abs=1e-9 * abs(values(given)))


def test_what_is_zero_has_no_slope_and_what_has_no_influence_none() -> None:
    ball = PLAIN | {"k": 0.0, "A": 0.0, "a_max_over_R": np.inf}
    found = solve(ball, SENSITIVITIES[:1])[SENSITIVITIES[0]]
    slopes = slopes_to_keys(ball, ["A", "c0_over_R", "a_max_over_R"], PARAMETERS, 1.0, found, {})
    assert np.isnan(slopes["A"])
    assert slopes["c0_over_R"] == 0.0
    assert slopes["a_max_over_R"] == 0.0


def test_at_the_ends_of_k_slopes_are_inwards() -> None:
    """With lambda/L given, lambda follows from k too."""
    for k, nu in ((0.0, 0.3), (1.0, 0.5)):
        scene = REDUCED | {"k": k, "nu": nu}
        sensitivity = solve(parameters_from(scene), SENSITIVITIES[:1])[SENSITIVITIES[0]]
        force = solve(parameters_from(scene), ["pull_off_force"])["pull_off_force"]
        slope = slopes_to_keys(scene, ["k"], PARAMETERS, force, sensitivity, {})["k"]
        side, step = (1.0 if k == 0.0 else -1.0), 1e-3
        ahead = [
            float(solve(parameters_from(scene | {"k": k + side * i * step}), ["pull_off_force"])["pull_off_force"])
            for i in range(5)
        ]
        exact = side * np.dot([-25.0, 48.0, -36.0, 16.0, -3.0], ahead) / (12.0 * step)
        assert slope == pytest.approx(exact, rel=1e-6)
