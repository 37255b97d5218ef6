"""Cycles that open at a larger work of adhesion than they close at, against stored cycles and closed forms."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gradhesion.core import Harmonic, Loading, Profile, solve
from gradhesion.core.problem.names import EDGE, OUTPUTS, REPORTS
from gradhesion.core.problem.status import FLAGS
from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic
from gradhesion.twin import stated
from gradhesion.twin.general import PLAIN, Shape

KEYS = {"k": "k", "nu": "nu", "modulus": "modulus", "c0": "c0_over_R", "lam": "lambda_over_R", "A": "A"}
KEYS |= {"ratio": "closing_ratio", "S": "machine_stiffness", "turn": "indentation_max_over_R", "turn_load": "load_max"}
BALL: dict[str, Any] = {"k": 0.1, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.02}
CYCLE = [name for name in (*OUTPUTS, *EDGE) if name != "delta_jump_out"]


def given(case: dict[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the parameters of a stored cycle, and how it is driven."""
    scene = {KEYS[name]: value for name, value in case.items() if name in KEYS}
    scene["a_max_over_R"] = case.get("end", math.inf)
    how: dict[str, Any] = {}
    if "S" in case or case.get("load"):
        how["loading"] = Loading(control="machine" if "S" in case else "load")
    if "series" in case:
        waves = (Harmonic(n=int(n), cos=even, sin=odd) for n, even, odd in case["series"])
        how["profile"] = Profile(exponent=case["m"], harmonics=tuple(waves))
    return scene, how


def stored(root: Path) -> dict[str, Any]:
    cases: dict[str, Any] = json.loads((root / "tests/reference/moving_edge.json").read_text())["works"]
    return cases


@pytest.mark.parametrize("number", range(9))
def test_cycles_are_those_of_another_solver(root: Path, number: int) -> None:
    cases = stored(root)
    assert len(cases) == 9
    case = [*cases.values()][number]
    scene, how = given(case["input"])
    found = solve(scene, CYCLE, **how)
    for name in CYCLE:
        expected = case["result"][name]
        if expected is None:
            assert np.isnan(found[name]), name
        else:
            assert float(found[name]) == pytest.approx(float(expected), rel=1e-12, abs=1e-15), name


@pytest.mark.parametrize("number", range(9))
def test_losses_are_the_loop_integral(root: Path, number: int) -> None:
    case = [*stored(root).values()][number]
    if (loop := case["result"]["loop_integral"]) is not None:  # a dead load closes none
        scene, how = given(case["input"])
        assert float(solve(scene, ["dissipated_energy"], **how)["dissipated_energy"]) == pytest.approx(
            float(loop), rel=1e-13
        )


def drawn(count: int, seed: int) -> list[tuple[dict[str, Any], dict[str, Any], Shape]]:
    """Draw scenes of every control, turn and ratio, with the shape by which the reference solver knows them."""
    rng = np.random.default_rng(seed)
    made = []
    for number in range(count):
        control = ("displacement", "load", "machine")[number % 3]
        scene: dict[str, Any] = {
            "k": float(rng.choice([0.0, 1.0, rng.uniform(), rng.uniform()])),
            "modulus": 10 ** rng.uniform(1.0, 4.0),
            "c0_over_R": 10 ** rng.uniform(-2.0, 0.0),
            "lambda_over_R": 10 ** rng.uniform(-1.0, -0.2),
            "A": float(rng.choice([0.0, 10 ** rng.uniform(-3.0, -1.3)])),
            "a_max_over_R": float(rng.uniform(0.2, 0.7)),
            "closing_ratio": float(rng.choice([0.0, 1e-12, 1e-6, rng.uniform(), rng.uniform(), 1.0])),
        }
        scene["nu"] = 0.5 if scene["k"] == 1.0 else rng.uniform(0.0, 0.5)
        if control == "machine":
            scene["machine_stiffness"] = 10 ** rng.uniform(-2.0, 1.0)
        turn = rng.integers(3)
        if turn == 1:
            scene["indentation_max_over_R"] = rng.uniform(-0.005, 0.08)
        elif turn == 2:
            scene["load_max"] = 10 ** rng.uniform(-0.5, 1.0)
        exponent, waves = 2.0, ((1, 1.0, 0.0),)
        if number % 4 == 3:
            exponent, waves = (
                float(rng.choice([1.0, 1.5, 3.0])),
                ((1, 1.0, 0.0), (3, 0.1, float(rng.uniform(-0.2, 0.2)))),
            )
        plain = control == "displacement" and number % 4 != 3
        shape = PLAIN if plain else Shape(exponent=exponent, harmonics=waves, control=control)
        profile = Profile(exponent=exponent, harmonics=tuple(Harmonic(n=n, cos=c, sin=s) for n, c, s in waves))
        made.append((scene, {"profile": profile, "loading": Loading(control=control)}, shape))
    return made


def test_cycles_drawn_at_random_are_those_of_the_reference_solver() -> None:
    names, compared = [*OUTPUTS, *EDGE], 0
    for scene, how, shape in drawn(48, 20261123):
        try:
            expected = stated.expected(scene, names, "exact", shape)
        except ArithmeticError:  # one of the folds that 51 digits do not tell apart
            continue
        found = solve(scene, names, **how)
        for name in names:
            one = expected[name]
            assert stated.deviation(float(found[name]), one) <= one.error or one.near, (name, scene)
        compared += 1
    assert compared > 40


@pytest.mark.parametrize("control", ["displacement", "load", "machine"])
@pytest.mark.parametrize("turn", [{}, {"indentation_max_over_R": 0.03}, {"load_max": 2.0}])
def test_at_ratio_1_every_bit_stays(control: str, turn: dict[str, float]) -> None:
    scene = BALL | {"A": np.array([0.0, 0.005, 0.03]), "a_max_over_R": 0.5} | turn
    scene |= {"machine_stiffness": 0.3} if control == "machine" else {}
    names = [*OUTPUTS, *(name for name in REPORTS if name != "energy_residual")]
    plain = solve(scene, names, loading=Loading(control=control))
    ratios = np.array([0.5, 1.0])[:, None]
    for ratio in (1.0, ratios):
        found = solve(scene | {"closing_ratio": ratio}, [*names, *EDGE], loading=Loading(control=control))
        for name in (*names, "status"):
            assert found[name].dtype == plain[name].dtype
            own = found[name] if np.ndim(ratio) == 0 else found[name][1]
            assert np.array_equal(own, plain[name], equal_nan=True), name
        last = found["front_energy"] if np.ndim(ratio) == 0 else found["front_energy"][1]
        assert np.array_equal(last, np.zeros(3))


def test_axes_stand_where_they_are_given() -> None:
    """The ratio may vary along any axis, beside rims or with other parameters in points."""
    rims, ratios, moduli = np.array([0.3, 0.5, 0.7]), np.array([0.2, 0.6, 1.0, 0.0]), np.array([100.0, 1000.0])
    grid = BALL | {"modulus": moduli[:, None, None], "a_max_over_R": rims[:, None], "closing_ratio": ratios}
    names = ["dissipated_energy", "loading_jumps", "pull_off_force", "snap_in_force"]
    whole = solve(grid, names)
    assert whole["dissipated_energy"].shape == (2, 3, 4)
    columns = [axis.ravel() for axis in np.meshgrid(moduli, rims, ratios, indexing="ij")]
    points = solve(BALL | dict(zip(("modulus", "a_max_over_R", "closing_ratio"), columns, strict=True)), names)
    for name in names:
        assert np.array_equal(whole[name].ravel(), points[name], equal_nan=True)


@pytest.mark.parametrize("k", [0.0, 0.3, 0.9])
def test_a_smooth_punch_snaps_in_at_its_closed_form(k: float) -> None:
    """F_in = 8 (1+k) Gamma/(3 (3+k)) for every modulus, and F_out = (3+k)/3."""
    ratio = np.array([0.1, 0.5, 1.0])
    scene = BALL | {
        "k": k,
        "A": 0.0,
        "modulus": np.array([[30.0], [3000.0]]),
        "a_max_over_R": 2.0,
        "closing_ratio": ratio,
    }
    found = solve(scene, ["snap_in_force", "pull_off_force"])
    expected = np.broadcast_to(8.0 * (1.0 + k) * ratio / (3.0 * (3.0 + k)), (2, 3))
    np.testing.assert_allclose(found["snap_in_force"], expected, rtol=2e-13)  # of a place to rounding, no extremum
    np.testing.assert_allclose(
        found["pull_off_force"], np.full((2, 3), (3.0 + k) / 3.0), rtol=64.0 * np.finfo(float).eps
    )


def test_short_waves_add_to_the_toughness_of_opening_and_take_from_that_of_closing() -> None:
    """Waves of chi on a pair (1, Gamma) are a smooth pair ((1 + chi)^2, (sqrt(Gamma) - chi)^2)."""
    wavelength, ratio = 1e-5, 0.64
    chi = 0.3
    scene = BALL | {"k": 0.0, "lambda_over_R": wavelength, "a_max_over_R": math.inf, "closing_ratio": ratio}
    strength = math.sqrt(2.0 * math.pi / 500.0)  # s at k = 0; r = chi s is that of A = chi s sqrt(l)/(lambda C), C = 1
    amplitude = solve(scene | {"A": 1.0, "a_max_over_R": 0.5}, ["roughness_parameter"])["roughness_parameter"]
    scene["A"] = chi / float(amplitude)
    mean = wavelength * scene["A"]
    wavy = solve(scene | {"indentation_max_over_R": 0.05 + mean}, ["turning_radius", "pull_off_force"])
    smooth = scene | {"A": 0.0, "modulus": 500.0 / (1.0 + chi) ** 2, "closing_ratio": ((0.8 - chi) / (1.0 + chi)) ** 2}
    even = solve(smooth | {"indentation_max_over_R": 0.05}, ["turning_radius", "pull_off_force"])
    size = math.sqrt(wavelength) * strength  # what is left is of the order of a wave over the radius
    assert float(wavy["turning_radius"]) == pytest.approx(float(even["turning_radius"]), rel=size)
    assert float(wavy["pull_off_force"]) == pytest.approx((1.0 + chi) ** 2 * float(even["pull_off_force"]), rel=size)


def test_without_adhesion_on_approach_contact_grows_as_hertz_has_it() -> None:
    """A paraboloid at the depth d touches within a = sqrt((1+k) d) (Hertz at k = 0)."""
    depth = np.array([0.001, 0.02, 0.3])
    scene = BALL | {"A": 0.0, "a_max_over_R": math.inf, "indentation_max_over_R": depth, "closing_ratio": 0.0}
    found = solve(scene, ["turning_radius", "loading_jumps", "loading_energy", "snap_in_force"])
    np.testing.assert_allclose(found["turning_radius"], np.sqrt(1.1 * depth), rtol=4.0 * np.finfo(float).eps)
    assert not found["loading_jumps"].any()
    assert not found["loading_energy"].any()
    assert np.isnan(found["snap_in_force"]).all()


@pytest.mark.parametrize("control", ["displacement", "load", "machine"])
@pytest.mark.parametrize("exponent", [1.0, 1.3, 2.0])
def test_without_adhesion_on_approach_a_pattern_of_toughness_changes_nothing(exponent: float, control: str) -> None:
    """Loading follows the contact without adhesion; at k = 0 its first jump is within 1e-30 of a tip with a slope."""
    profile = Profile(
        exponent=exponent, harmonics=(Harmonic(n=1, cos=-0.94, sin=0.33), Harmonic(n=4, cos=-0.56, sin=0.15))
    )
    scenes: dict[str, Any] = {"k": np.array([[0.0], [0.3]]), "nu": 0.5, "modulus": np.array([1e-3, 16.0, 1e6]), "c0_over_R": 0.015, "lambda_over_R": 0.0075, "A": 0.011, "a_max_over_R": 0.022}  # fmt: skip
    scenes |= {"closing_ratio": 0.0}
    scenes |= {"machine_stiffness": 1.0} if control == "machine" else {}
    loading = Loading(control=control)
    names = ("loading_jumps", "loading_energy", "delta_max")
    plain = solve(scenes, names, profile=profile, loading=loading)
    pattern = {"toughness_wavelength_over_R": 0.03, "toughness_amplitude": 0.3}
    found = solve(scenes | pattern, names, profile=profile, loading=loading, toughness=Toughness((ToughnessHarmonic(n=1, cos=1.0, sin=0.5),)))  # fmt: skip
    assert (plain["loading_jumps"] > 0).any()
    np.testing.assert_array_equal(found["loading_jumps"], plain["loading_jumps"])
    np.testing.assert_allclose(found["loading_energy"], plain["loading_energy"], rtol=1e-9)
    np.testing.assert_allclose(found["delta_max"], plain["delta_max"], rtol=1e-12)


def test_what_has_no_bound_is_infinite() -> None:
    scene = BALL | {"a_max_over_R": math.inf, "closing_ratio": np.array([0.5, 1.0])}
    found = solve(scene, ["dissipated_energy", "front_energy", "pinned_depth", "pull_off_force", "loading_energy"])
    for name in ("dissipated_energy", "front_energy", "pinned_depth"):
        assert found[name][0] == math.inf
        assert np.isfinite(found[name][1])
    assert found["pull_off_force"][0] == found["pull_off_force"][1]
    assert np.isfinite(found["loading_energy"]).all()


@pytest.mark.parametrize("ratio", [-0.1, 1.1, math.nan])
def test_a_ratio_out_of_range_has_no_value(ratio: float) -> None:
    found = solve(BALL | {"a_max_over_R": 0.5, "closing_ratio": [0.5, ratio]}, ["dissipated_energy", "loading_jumps"])
    assert found["status"].tolist() == [0, FLAGS["no_value"]]
    assert np.isnan(found["dissipated_energy"][1])
    assert found["loading_jumps"][1] == -1


def test_a_cycle_without_contact_has_nothing() -> None:
    scene = BALL | {"a_max_over_R": math.inf, "indentation_max_over_R": -0.01, "closing_ratio": 0.3}
    found = solve(scene, [*OUTPUTS, *EDGE])
    assert int(found["status"]) == FLAGS["no_contact"]
    for name in ("dissipated_energy", "front_energy", "pinned_depth", "pull_off_force", "turning_radius"):
        assert found[name] == 0.0
    assert np.isnan(found["snap_in_force"])


def test_gains_are_over_the_smooth_punch_of_the_same_ratio() -> None:
    scene = BALL | {"a_max_over_R": 0.5, "closing_ratio": 0.4}
    found = solve(scene, ["adhesion_gain", "energy_gain", "dissipated_energy", "pull_off_force"])
    even = solve(scene | {"A": 0.0}, ["dissipated_energy", "pull_off_force"])
    assert float(found["energy_gain"]) == float(found["dissipated_energy"] / even["dissipated_energy"])
    assert float(found["adhesion_gain"]) == float(found["pull_off_force"] / even["pull_off_force"])
