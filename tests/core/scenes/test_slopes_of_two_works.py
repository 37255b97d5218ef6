"""Sensitivities of cycles of two works, against differences of fourth order."""

from typing import Any

import numpy as np
import pytest

from gradhesion.core import Harmonic, Loading, Profile, solve
from gradhesion.core.problem.names import PARAMETERS, SENSITIVITIES, TURNS

STEP = 1e-4
WEIGHTS = {-2: 1.0 / 12.0, -1: -2.0 / 3.0, 1: 2.0 / 3.0, 2: -1.0 / 12.0}
TOLERANCE = 3e-7
"""The differences leave their fifth derivative, which is large where a wave is short, and rounding over the step."""
CASES = [
    (control, turn, general)
    for control in ("displacement", "load", "machine")
    for turn in range(3)
    for general in (0, 1)
]


def drawn(control: str, turn: int, general: int) -> tuple[dict[str, Any], dict[str, Any]]:
    rng = np.random.default_rng(100 * turn + 10 * general + len(control))
    scene: dict[str, Any] = {
        "k": rng.uniform(0.1, 0.8),
        "nu": rng.uniform(0.0, 0.45),
        "modulus": 10 ** rng.uniform(1.5, 3.5),
        "c0_over_R": 10 ** rng.uniform(-2.0, 0.0),
        "lambda_over_R": rng.uniform(0.1, 0.4),
        "A": rng.uniform(0.002, 0.03),
        "a_max_over_R": rng.uniform(0.3, 0.7) if turn == 0 else np.inf,
    }
    if control == "machine":
        scene["machine_stiffness"] = 10 ** rng.uniform(-2.0, 1.0)
    if turn == 1:
        scene["indentation_max_over_R"] = rng.uniform(0.02, 0.08)
    elif turn == 2:
        scene["load_max"] = 10 ** rng.uniform(0.0, 1.0)
    scene["closing_ratio"] = rng.uniform(0.1, 0.9)
    waves = (Harmonic(n=1), Harmonic(n=3, cos=0.1, sin=0.1)) if general else (Harmonic(n=1),)
    profile = Profile(exponent=float(rng.choice([1.5, 3.0])) if general else 2.0, harmonics=waves)
    return scene, {"profile": profile, "loading": Loading(control=control)}


@pytest.mark.parametrize(("control", "turn", "general"), CASES)
def test_slopes_are_those_of_differences(control: str, turn: int, general: int) -> None:
    scene, how = drawn(control, turn, general)
    found = solve(scene, SENSITIVITIES, **how)
    keys = [name for name in (*PARAMETERS, "machine_stiffness", *TURNS, "closing_ratio") if name in scene]
    names, compared = ["pull_off_force", "dissipated_energy", "loading_jumps", "unloading_jumps"], 0
    for item, key in enumerate(keys):
        plain = key in PARAMETERS[:2]
        steps = STEP * np.array([*WEIGHTS])
        near = solve(scene | {key: scene[key] + steps if plain else scene[key] * np.exp(steps)}, names, **how)
        if any(np.unique(near[name]).size > 1 for name in names[2:]):  # a fold is passed
            continue
        for name in names[:2]:
            slope = float(np.array([*WEIGHTS.values()]) @ np.log(near[name])) / STEP if np.isfinite(scene[key]) else 0.0
            own = float(found[f"{name}_sensitivity"][item])
            assert own == pytest.approx(slope, rel=TOLERANCE, abs=TOLERANCE), (key, name)
            compared += 1
    assert compared >= 8


def test_at_ratio_1_the_other_slopes_stay_and_that_to_the_ratio_is_one_sided() -> None:
    scene, how = drawn("displacement", 0, 0)
    del scene["closing_ratio"]
    plain, one = solve(scene, SENSITIVITIES, **how), solve(scene | {"closing_ratio": 1.0}, SENSITIVITIES, **how)
    for name in SENSITIVITIES:
        assert np.array_equal(one[name][:-1], plain[name])
    inside = np.exp(-1e-4 * np.arange(5))
    energies = np.log(solve(scene | {"closing_ratio": inside}, ["dissipated_energy"], **how)["dissipated_energy"])
    slope = -float(np.array([-25.0 / 12.0, 4.0, -3.0, 4.0 / 3.0, -0.25]) @ energies) / 1e-4
    assert float(one["dissipated_energy_sensitivity"][-1]) == pytest.approx(slope, rel=1e-6)


def test_at_ratio_0_nothing_depends_on_the_logarithm_of_the_ratio() -> None:
    scene, how = drawn("displacement", 1, 0)
    found = solve(scene | {"closing_ratio": 0.0}, SENSITIVITIES, **how)
    for name in SENSITIVITIES:
        assert found[name][-1] == 0.0
        assert np.isfinite(found[name]).all()


def test_the_energy_of_an_unbounded_punch_has_no_slope_at_ratio_1() -> None:
    scene, how = drawn("displacement", 0, 0)
    found = solve(scene | {"a_max_over_R": np.inf, "closing_ratio": [0.5, 1.0]}, SENSITIVITIES, **how)
    slopes = found["dissipated_energy_sensitivity"]
    assert np.isnan(slopes[0]).all()
    assert np.isnan(slopes[1, -1])
    assert np.isfinite(slopes[1, :-1]).all()
    assert (found["pull_off_force_sensitivity"][:, -1] == 0.0).all()
