"""Sensitivities where they are known: limits, one-sided ratios, absent parameters, and the order of the last axis.

Stored values, sum rules and central differences of random scenes of every kind are in tests/conformance.
"""

from typing import Any

import numpy as np
import pytest

from gradhesion.core import PARAMETERS, SENSITIVITIES, Loading, solve
from tests.core.scene import ENDLESS, pattern_of, profile_of, scene_of

FORCE, ENERGY = VALUES = ("pull_off_force", "dissipated_energy")
SCENE = scene_of(0.3, 0.3, 500.0, 0.1, 0.1, 0.03, 0.57)
STEPS, WEIGHTS = np.array([-2, -1, 1, 2]), np.array([1, -8, 8, -1]) / 12
PATTERN = pattern_of("toughness", (1, 0.4, 0.2), (2, 0.1, 0.0))
OF_WORK = pattern_of("work", (1, 0.2, 0.1), (2, 0.0, 0.1))
BOTH = profile_of(2.0, (1, 0.8, 0.2), (3, 0.1, 0.25))
BY_LOAD, BY_MACHINE = Loading(control="load"), Loading(control="machine")
LENGTH = {"toughness_wavelength_over_R": 0.113, "toughness_amplitude": 0.8}
AT_TURN = ENDLESS | LENGTH | {"lambda_over_R": 0.2, "A": 0.055, "c0_over_R": 0.01, "k": 0.1, "toughness_amplitude": 0.2}
LANDING = ENDLESS | {"indentation_max_over_R": 1e-3, "closing_ratio": 0.4}
KINDS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "unbounded": (ENDLESS, {}),
    "two harmonics under a load, two works": ({"closing_ratio": 0.4}, {"profile": BOTH, "loading": BY_LOAD}),
    "two works, turned where a jump lands": (LANDING | {"machine_stiffness": 0.05}, {"loading": BY_MACHINE}),
    "a pattern, a load": (LENGTH, {"toughness": PATTERN, "loading": BY_LOAD}),
    "a pull-off at the turn": (AT_TURN | {"indentation_max_over_R": 0.005}, {"toughness": OF_WORK}),
    "600 waves": ({"lambda_over_R": 0.57 / 600.3, "A": 0.01}, {}),
}


@pytest.mark.parametrize(("change", "how"), KINDS.values(), ids=KINDS)
def test_against_differences_of_fourth_order(change: dict[str, Any], how: dict[str, Any]) -> None:
    """Of cases between the kinds of tests/conformance; none passes a fold within the steps."""
    scene = SCENE | change
    names = [*PARAMETERS, *(name for name in scene if name not in PARAMETERS)]
    order = ["machine_stiffness", "indentation_max_over_R", "load_max", "closing_ratio", *LENGTH]
    names[len(PARAMETERS) :] = sorted(names[len(PARAMETERS) :], key=order.index)
    found = solve(scene, (*VALUES, *SENSITIVITIES), **how)
    step = 2e-5 if scene["lambda_over_R"] > 0.01 else 2e-7
    points = {name: np.full((len(names), 4), value) for name, value in scene.items()}
    for row, name in enumerate(names):
        moved = scene[name] + step * STEPS if name in PARAMETERS[:2] else scene[name] * np.exp(step * STEPS)
        points[name][row] = moved
    beside = solve(points, (*VALUES, "loading_jumps", "unloading_jumps"), **how)
    for count in ("loading_jumps", "unloading_jumps"):
        assert np.unique(beside[count]).size == 1
    for value, slopes in zip(VALUES, SENSITIVITIES, strict=True):
        expected = beside[value] @ WEIGHTS / step / float(found[value])
        assert found[slopes].shape == (len(names),)
        scale = float(np.abs(expected).max())
        np.testing.assert_allclose(found[slopes], expected, rtol=1e-7, atol=(2e-8 + 4e-16 / step) * (1.0 + scale))


@pytest.mark.parametrize(("change", "how"), KINDS.values(), ids=KINDS)
def test_each_is_the_same_alone(change: dict[str, Any], how: dict[str, Any]) -> None:
    both = solve(SCENE | change, SENSITIVITIES, **how)
    for name in SENSITIVITIES:
        np.testing.assert_array_equal(solve(SCENE | change, [name], **how)[name], both[name])


def test_the_smooth_cycle_and_what_has_no_influence() -> None:
    """The energy is a number of k times M^(-2/(3+k)), and the force (3+k)/3 (section 3 of docs/theory.md)."""
    k, found = SCENE["k"], solve(SCENE | ENDLESS | {"A": 0.0}, SENSITIVITIES)
    force, energy = (dict(zip(PARAMETERS, found[name], strict=True)) for name in SENSITIVITIES)
    assert energy["modulus"] == pytest.approx(-2.0 / (3.0 + k), rel=1e-12)
    assert abs(force["modulus"]) < 1e-12
    assert force["k"] == pytest.approx(1.0 / (3.0 + k), rel=1e-9)
    nothing = [({"A": 0.0}, ("lambda_over_R", "A")), ({"k": 0.0}, ("c0_over_R", "nu")), (ENDLESS, ("a_max_over_R",))]
    for change, names in nothing:
        for slopes in list(solve(SCENE | change, SENSITIVITIES).values())[:2]:
            assert [slopes[PARAMETERS.index(name)] for name in names] == [0.0] * len(names)


def test_the_softest_gradient() -> None:
    """At k = 1 only nu = 1/2 has a stiffness."""
    found, near = (solve(SCENE | {"k": k, "nu": 0.5}, SENSITIVITIES) for k in (1.0, 1.0 - 1e-7))
    for name in SENSITIVITIES:
        assert np.isnan(found[name]).tolist() == [parameter == "nu" for parameter in PARAMETERS]
        own, other = (np.delete(one[name], 1) for one in (found, near))
        np.testing.assert_allclose(own, other, rtol=1e-4, atol=1e-4)


def test_at_equal_works_the_slope_is_that_from_below_and_the_others_stay() -> None:
    plain, one = solve(SCENE, SENSITIVITIES), solve(SCENE | {"closing_ratio": 1.0}, SENSITIVITIES)
    for name in SENSITIVITIES:
        assert np.array_equal(one[name][:-1], plain[name])
    inside = np.log(solve(SCENE | {"closing_ratio": np.exp(-1e-4 * np.arange(5))}, [ENERGY])[ENERGY])
    slope = -float(np.array([-25.0 / 12.0, 4.0, -3.0, 4.0 / 3.0, -0.25]) @ inside) / 1e-4
    assert float(one[f"{ENERGY}_sensitivity"][-1]) == pytest.approx(slope, rel=1e-6)
    endless = solve(SCENE | ENDLESS | {"closing_ratio": [0.5, 1.0]}, SENSITIVITIES)  # the first loses without bound
    assert endless[f"{FORCE}_sensitivity"][:, -1].tolist() == [0.0, 0.0]
    assert np.isnan(endless[f"{ENERGY}_sensitivity"]).tolist() == [[True] * 8, [False] * 7 + [True]]


def test_closing_without_adhesion_and_beside_other_ratios() -> None:
    ratios = [0.0, 1e-12, 0.5, 1.0]
    found = solve(SCENE | {"closing_ratio": ratios}, SENSITIVITIES)
    for name in SENSITIVITIES:
        assert found[name][0, -1] == 0.0
        np.testing.assert_allclose(found[name][0], found[name][1], rtol=1e-4, atol=1e-4)
        for i, ratio in enumerate(ratios):
            alone = solve(SCENE | {"closing_ratio": ratio}, SENSITIVITIES)[name]
            np.testing.assert_allclose(found[name][i], alone, rtol=1e-8, err_msg=str(ratio))


def test_without_a_value_there_is_no_sensitivity() -> None:
    none = solve(SCENE | {"indentation_max_over_R": -0.1}, SENSITIVITIES)
    wrong = solve(SCENE | {"nu": [0.3, 0.7]}, SENSITIVITIES)
    for name in SENSITIVITIES:
        assert np.isnan(none[name]).all()
        assert np.isnan(wrong[name]).tolist() == [[False] * 7, [True] * 7]
    with pytest.raises(ValueError, match="pull_off_force_sensitivity"):
        solve(SCENE, SENSITIVITIES, solver="asymptotic")


def test_the_last_axis_has_what_is_given_in_order() -> None:
    further = {"machine_stiffness": 0.4, "indentation_max_over_R": 0.02, "closing_ratio": 0.4}
    further |= {"toughness_wavelength_over_R": 0.3, "toughness_amplitude": [[0.3], [0.5]]}
    outputs, how = [SENSITIVITIES[1], "delta_max", SENSITIVITIES[0]], {"toughness": PATTERN, "loading": BY_MACHINE}
    found = solve(SCENE | further | {"A": [0.01, 0.02, 0.03]}, outputs, **how)
    assert list(found) == [*outputs, "status"]
    assert found[SENSITIVITIES[0]].shape == found[SENSITIVITIES[1]].shape == (2, 3, 12)
    alone = solve(SCENE | further | {"toughness_amplitude": 0.5, "A": 0.02}, outputs, **how)
    for name in SENSITIVITIES:
        np.testing.assert_array_equal(found[name][1, 1], alone[name])
    del further["toughness_amplitude"]
    assert solve(SCENE | further, SENSITIVITIES, **how)[SENSITIVITIES[0]].shape == (11,)
