"""The path on two curves: its loop integral, its jumps, and the curve of closing."""

from typing import Any

import numpy as np
import pytest

from gradhesion.core import Harmonic, Loading, Profile, draw_curves, solve
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic

BALL: dict[str, Any] = {"k": 0.1, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.02}
CHORDS = 1e-3
"""Chords leave some 1e-4 of the drawn span in each plane, of which the loop is a part."""
DRIVEN: list[tuple[dict[str, float], dict[str, Any]]] = [
    ({"a_max_over_R": 0.5}, {}),
    ({"a_max_over_R": np.inf, "indentation_max_over_R": 0.05}, {}),
    ({"a_max_over_R": np.inf, "load_max": 2.0}, {}),
    ({"a_max_over_R": 0.6, "machine_stiffness": 0.05}, {"loading": Loading(control="machine")}),
    (
        {"a_max_over_R": 0.5, "toughness_wavelength_over_R": 0.15},
        {"toughness": Toughness((ToughnessHarmonic(n=1, cos=0.2, sin=0.1),))},
    ),
    ({"a_max_over_R": 0.7}, {"profile": Profile(exponent=3.0, harmonics=(Harmonic(n=1), Harmonic(n=2, sin=0.3)))}),
]


@pytest.mark.parametrize(("turn", "how"), DRIVEN)
@pytest.mark.parametrize("ratio", [0.0, 1e-6, 0.3, 1.0])
def test_the_path_loses_what_the_cycle_does(turn: dict[str, float], how: dict[str, Any], ratio: float) -> None:
    scene = BALL | turn | {"closing_ratio": ratio}
    drawn, _ = draw_curves(scene, ["path", "jumps"], **how)
    names = ["dissipated_energy", "loading_energy", "unloading_energy", "loading_jumps", "unloading_jumps"]
    solved = solve(scene, [*names, "pull_off_force", "turning_radius"], **how)
    load = 1.5 * np.pi * drawn["path_load"]
    coordinate = drawn["path_indentation"].copy()
    if "machine_stiffness" in scene:
        coordinate += load / (scene["machine_stiffness"] * scene["modulus"])
    loop = np.sum(0.5 * (load[1:] + load[:-1]) * np.diff(coordinate))
    span = np.ptp(load) * np.ptp(coordinate)
    assert loop == pytest.approx(float(solved["dissipated_energy"]), abs=CHORDS * span)
    lost = float(solved["loading_energy"] + solved["unloading_energy"])
    assert drawn["jump_energy"].sum() == pytest.approx(lost, rel=1e-12)
    assert drawn["jump_energy"].size == solved["loading_jumps"] + solved["unloading_jumps"]
    assert drawn["path_jump"].sum() == drawn["jump_energy"].size
    assert -drawn["path_load"].min() == pytest.approx(float(solved["pull_off_force"]), rel=1e-12)
    if ratio == 1.0:
        return
    pinned = (drawn["path_unloading"] == 1) & (drawn["path_jump"] == 0)
    assert drawn["path_contact_radius"][pinned][0] == pytest.approx(float(solved["turning_radius"]), rel=1e-12)


def test_the_closing_curve_is_that_of_a_punch_of_that_work() -> None:
    scene = BALL | {"a_max_over_R": 0.5}
    found, _ = draw_curves(scene | {"closing_ratio": 0.25}, ["closing_equilibrium", "equilibrium"])
    closing, _ = draw_curves(scene | {"modulus": 2000.0}, ["equilibrium"])
    opening, _ = draw_curves(scene, ["equilibrium"])
    assert np.array_equal(found["closing_load"], 0.25 * closing["load"])
    assert np.array_equal(found["closing_indentation"], closing["indentation"])
    assert np.array_equal(found["load"], opening["load"])


def test_envelopes_and_the_effective_path_close_at_the_work_of_closing() -> None:
    scene = BALL | {"a_max_over_R": 0.5, "closing_ratio": 0.49}
    found, _ = draw_curves(scene, ["envelope", "effective"])
    closing, _ = draw_curves(BALL | {"a_max_over_R": 0.5, "modulus": 500.0 / 0.49}, ["effective"])
    radii, loads = found["envelope_contact_radius"], found["loading_envelope_load"]
    climbs = np.arange(closing["effective_load"].size) < int(np.argmax(closing["effective_contact_radius"]))
    climbs &= closing["effective_jump"] == 0
    own = np.interp(closing["effective_contact_radius"][climbs][2:], radii, loads)
    np.testing.assert_allclose(0.49 * closing["effective_load"][climbs][2:], own, atol=CHORDS * np.ptp(loads))
    size = found["effective_load"].size
    assert np.array_equal(found["effective_load"][: climbs.sum()], 0.49 * closing["effective_load"][: climbs.sum()])
    assert size > climbs.sum()


def test_at_ratio_1_both_curves_are_one() -> None:
    scene = BALL | {"a_max_over_R": np.inf, "indentation_max_over_R": 0.05}
    plain, flags = draw_curves(scene, ["path", "equilibrium", "jumps", "envelope"])
    one, own = draw_curves(
        scene | {"closing_ratio": 1.0}, ["path", "equilibrium", "jumps", "envelope", "closing_equilibrium"]
    )
    assert flags == own
    for name, values in plain.items():
        assert np.array_equal(one[name], values)
    assert np.array_equal(one["closing_load"], one["load"])
