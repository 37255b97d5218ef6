"""What the tests of answers share: random scenes, and differences of the solver that do not pass a kink."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core import PARAMETERS, solve

VALUES = ("pull_off_force", "dissipated_energy")
_COUNTS = ("loading_jumps", "unloading_jumps")
_PLACE = "pull_off_radius"
_STEP = 2e-5
_WEIGHTS = {-2: 1 / 12, -1: -2 / 3, 1: 2 / 3, 2: -1 / 12}


@pytest.fixture
def random_scenes() -> Callable[..., dict[str, NDArray[np.float64]]]:
    """Give scenes over sensible ranges, with wavelengths between two powers of ten."""

    def scenes(count: int, seed: int, low: float = -2.0, high: float = 0.0) -> dict[str, NDArray[np.float64]]:
        rng = np.random.default_rng(seed)
        drawn = {
            "k": rng.uniform(0.01, 0.95, count),
            "nu": rng.uniform(-0.2, 0.48, count),
            "modulus": 10 ** rng.uniform(1.5, 3.5, count),
            "c0_over_R": 10 ** rng.uniform(-2.5, -1, count),
            "lambda_over_R": 10 ** rng.uniform(low, high, count),
            "A": 10 ** rng.uniform(-3, -1, count),
            "a_max_over_R": 10 ** rng.uniform(-1.5, 0.3, count),
        }
        drawn["a_max_over_R"][::7] = np.inf
        return drawn

    return scenes


@pytest.fixture
def differences() -> Callable[..., tuple[dict[str, NDArray[np.float64]], NDArray[np.bool_]]]:
    """Give d ln(value)/d ln p by fourth-order differences of the solver, and where jumps and trough stay the same.

    Settings are those of `solve`: another profile or control.
    """

    def differences(
        scenes: Mapping[str, Any], name: str, **settings: Any
    ) -> tuple[dict[str, NDArray[np.float64]], NDArray[np.bool_]]:
        outputs = [*VALUES, *_COUNTS, _PLACE]
        middle = solve(scenes, outputs, check_contact=False, **settings)
        found = {value: np.zeros(middle["status"].shape) for value in VALUES}
        same = np.full(middle["status"].shape, True)
        for place, weight in _WEIGHTS.items():
            other = scenes[name] + place * _STEP if name in PARAMETERS[:2] else scenes[name] * np.exp(place * _STEP)
            solved = solve({**scenes, name: other}, outputs, check_contact=False, **settings)
            for value in VALUES:
                found[value] += weight / _STEP * solved[value] / middle[value]
            for count in _COUNTS:
                same &= solved[count] == middle[count]
            same &= np.isclose(solved[_PLACE], middle[_PLACE], rtol=1e-3)
        return found, same

    return differences
