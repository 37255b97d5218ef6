"""Slopes to whatever gives a scene, against differences of what the solver gives."""

from typing import Any

import numpy as np
import pytest

from gradhesion.core import PARAMETERS, SENSITIVITIES, solve
from gradhesion.core.answers.slopes_to_keys import POWERS, slopes_to_keys
from gradhesion.core.closed.reduced import parameters_from, scales_in_si
from tests.core.scene import ENDLESS, Scene, scene_of

FORCE = SENSITIVITIES[0]
PLAIN = scene_of(0.31, 0.27, 430.0, 0.013, 0.31, 0.023, 0.7)
REDUCED = dict(zip((*PARAMETERS[:4], "lambda_over_L", "chi", "a_max_over_L"), (0.31, 0.27, 430.0, 0.013, 2.1, 0.4, 6.0), strict=True))  # fmt: skip
UNITS = {"k": 0.31, "nu": 0.27, "R": 1e-6, "E": 8e8, "work_of_adhesion": 0.05, "c0": 2e-8}
UNITS |= {"wavelength": 1.7e-7, "amplitude": 4e-9, "a_max": 7e-7}


@pytest.mark.parametrize("given", [REDUCED, UNITS], ids=["reduced", "units"])
@pytest.mark.parametrize("output", SENSITIVITIES)
def test_against_differences(given: Scene, output: str) -> None:
    value = output.removesuffix("_sensitivity")

    def values(scene: Scene) -> Any:
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
    ball = PLAIN | ENDLESS | {"k": 0.0, "A": 0.0}
    slopes = slopes_to_keys(ball, ["A", "c0_over_R", "a_max_over_R"], PARAMETERS, 1.0, solve(ball, [FORCE])[FORCE], {})
    assert np.isnan(slopes["A"])
    assert slopes["c0_over_R"] == slopes["a_max_over_R"] == 0.0


@pytest.mark.parametrize(("k", "nu", "side"), [(0.0, 0.3, 1.0), (1.0, 0.5, -1.0)])
def test_at_the_ends_of_k_slopes_are_inwards(k: float, nu: float, side: float) -> None:
    """With lambda/L given, lambda follows from k too."""
    scene, step = REDUCED | {"k": k, "nu": nu}, 1e-3
    ahead = solve(parameters_from(scene | {"k": k + side * step * np.arange(5)}), ["pull_off_force"])["pull_off_force"]
    own = solve(parameters_from(scene), [FORCE])[FORCE]
    slope = slopes_to_keys(scene, ["k"], PARAMETERS, ahead[0], own, {})["k"]
    exact = side * np.dot([-25.0, 48.0, -36.0, 16.0, -3.0], ahead) / (12.0 * step)
    assert slope == pytest.approx(exact, rel=1e-6)
