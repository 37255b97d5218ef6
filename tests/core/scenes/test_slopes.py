"""Sensitivities where they are known: limits, one-sided ratios, absent parameters, the order of the last axis, slopes to whatever gives a scene.

Stored values, sum rules and central differences of random scenes of every kind are in tests/conformance.
"""

from typing import Any

import numpy as np
import pytest

from gradhesion.core import PARAMETERS, SENSITIVITIES, Loading, solve
from gradhesion.core.answers.slopes_to_keys import POWERS, slopes_to_keys
from gradhesion.core.closed.reduced import parameters_from, scales_in_si
from tests.core.scene import ENDLESS, Scene, pattern_of, profile_of, scene_of

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
        np.testing.assert_array_equal(solve(scene, [slopes], **how)[slopes], found[slopes])  # asked for alone
        scale = float(np.abs(expected).max())
        np.testing.assert_allclose(found[slopes], expected, rtol=1e-7, atol=(2e-8 + 4e-16 / step) * (1.0 + scale))


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


OF_FORCE = SENSITIVITIES[0]
BASE = scene_of(0.31, 0.27, 430.0, 0.013, 0.31, 0.023, 0.7)
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
    ball = BASE | ENDLESS | {"k": 0.0, "A": 0.0}
    names, found = ["A", "c0_over_R", "a_max_over_R"], solve(ball, [OF_FORCE])[OF_FORCE]
    slopes = slopes_to_keys(ball, names, PARAMETERS, 1.0, found, {})
    assert np.isnan(slopes["A"])
    assert slopes["c0_over_R"] == slopes["a_max_over_R"] == 0.0


@pytest.mark.parametrize(("k", "nu", "side"), [(0.0, 0.3, 1.0), (1.0, 0.5, -1.0)])
def test_at_the_ends_of_k_slopes_are_inwards(k: float, nu: float, side: float) -> None:
    """With lambda/L given, lambda follows from k too."""
    scene, step = REDUCED | {"k": k, "nu": nu}, 1e-3
    ahead = solve(parameters_from(scene | {"k": k + side * step * np.arange(5)}), ["pull_off_force"])["pull_off_force"]
    own = solve(parameters_from(scene), [OF_FORCE])[OF_FORCE]
    slope = slopes_to_keys(scene, ["k"], PARAMETERS, ahead[0], own, {})["k"]
    exact = side * np.dot([-25.0, 48.0, -36.0, 16.0, -3.0], ahead) / (12.0 * step)
    assert slope == pytest.approx(exact, rel=1e-6)
