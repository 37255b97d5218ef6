"""Edges at a speed: against the reference, a second way, and the slow laws."""

import json
import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import Harmonic, Loading, Profile, solve
from gradhesion.core.arrays.rate import OPENING, close_at_speed, open_at_speed, rate_coefficient
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.profile import WAVY
from gradhesion.core.problem.rate import Rate
from gradhesion.core.problem.status import NO_CONTACT, NO_VALUE, PULL_OFF_AT_RIM, TOO_MANY_WAVES
from tests.core.conftest import REFERENCE
from tests.core.rate.second_way import Punch, closed, opened

BY_DEPTH, BY_MACHINE = Loading(), Loading(control="machine")
MOVING = json.loads((REFERENCE / "moving_edge.json").read_text(encoding="utf-8"))
SMOOTH = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.0, "a_max_over_R": 0.4}


def scene_of(given: dict[str, float], **more: float) -> dict[str, Any]:
    """Parameters of a scene of the reference."""
    names = {"k": "k", "nu": "nu", "modulus": "modulus", "c0": "c0_over_R", "lam": "lambda_over_R", "A": "A"}
    return {names[name]: given[name] for name in names} | {"a_max_over_R": given["end"]} | more


def opening_cases() -> list[Any]:
    """Every case of the reference that opens: parameters, law, control, what is expected, and the second way's force."""
    cases = [(one["input"], case, {}) for one in MOVING["rate"].values() for case in one["cases"]]
    of_machine = MOVING["rate_machine"]
    cases += [(of_machine["input"], case, {"machine_stiffness": case["S_over_E"]}) for case in of_machine["cases"]]
    more = MOVING["rate_more"]
    rims = [*more["closing_same"], *more["quasi_static_closing"]]
    cases += [(case["input"], case, {"a_max_over_R": case["a_t"]}) for case in rims]
    return cases


@pytest.mark.parametrize(("given", "case", "more"), opening_cases())
def test_opening_against_the_reference(given: dict[str, float], case: dict[str, Any], more: dict[str, float]) -> None:
    """To how well two ways of the reference agree, some 1e-13."""
    loading = BY_MACHINE if "machine_stiffness" in more else BY_DEPTH
    scene = scene_of(given, speed_over_reference=case["eps"]) | more
    found = open_at_speed(scene, Rate(exponent=case["n"]), WAVY, loading, 1)
    assert found["status"] == 0
    assert found["pull_off_force"] == pytest.approx(case["pull_off_force"], rel=1e-12)
    assert found["pull_off_radius"] == pytest.approx(case["pull_off_radius"], rel=1e-11)
    assert found["opening_energy"] == pytest.approx(case["H_open"], rel=1e-12)
    separation = case["coordinate_at_separation" if more.keys() == {"machine_stiffness"} else "depth_at_separation"]
    assert found["delta_jump_out"] == pytest.approx(separation, rel=1e-12)
    if "small_rate" in case:
        slow = float(found["rate_coefficient"]) * case["eps"] ** case["n"]
        assert slow == pytest.approx(case["small_rate"], rel=1e-9)


@pytest.mark.parametrize("case", MOVING["rate_more"]["closing_same"], ids=lambda case: str(case["name"]))
def test_closing_and_a_turn_against_the_reference(case: dict[str, Any]) -> None:
    """The two ways of the reference differ by up to 7e-12."""
    law, turn = Rate(exponent=case["n"], closing="same"), {"delta_max": case["delta_max"], "a_max_over_R": math.inf}
    given = {"closing_ratio": case["closing_ratio"], "speed_over_reference": case["eps"]}
    scene = scene_of(case["input"], **given, **turn)
    found = close_at_speed(scene, law, WAVY, BY_DEPTH, 1)
    for name, expected in [
        ("turning_radius", "a_t"),
        ("closing_energy", "H_close"),
        ("radius_at_turn", "radius_at_turn"),
        ("depth_edge_stops", "depth_edge_stops"),
        ("depth_at_turn", "delta_max"),
    ]:
        assert found[name] == pytest.approx(case[expected], rel=1e-11)
    assert found["load_at_turn"] * 1.5 * math.pi == pytest.approx(case["load_at_turn"], rel=1e-12)
    assert found["rho_edge_stops"] == pytest.approx(math.sqrt(case["closing_ratio"]), rel=1e-15)
    opening = open_at_speed(scene | {"a_max_over_R": found["turning_radius"]}, law, WAVY, BY_DEPTH, 1)
    loop = float(opening["opening_energy"] - found["closing_energy"])  # the loop integral of the load over the depth
    assert loop == pytest.approx(case["dissipated_energy"], rel=1e-11)


@pytest.mark.parametrize("name", ["k0", "k03", "smooth"])
def test_closing_to_the_rim_against_the_reference(name: str) -> None:
    for case in MOVING["rate"][name]["closing"]:
        scene = scene_of(MOVING["rate"][name]["input"], speed_over_reference=case["eps"], closing_ratio=1.0)
        found = close_at_speed(scene, Rate(exponent=case["exponent"]), WAVY, BY_DEPTH, 1)
        assert found["turning_radius"] == scene["a_max_over_R"]
        assert found["depth_edge_stops"] == pytest.approx(case["depth"], rel=1e-12)
        assert found["closing_energy"] == pytest.approx(case["H_close"], rel=1e-12)
        assert found["rho_edge_stops"] < 1.0
        below = scene | {"delta_max": 0.1 * case["depth"]}
        assert close_at_speed(below, Rate(exponent=case["exponent"]), WAVY, BY_DEPTH, 1)["turning_radius"] < 0.5


def drawn(seed: int) -> tuple[dict[str, float], Profile, Loading, float, float]:
    """A scene at random, with eps and n; slower edges take explicit steps minutes."""
    rng = np.random.default_rng(seed)
    scene = {
        "k": float(rng.choice([0.0, 0.95, *rng.uniform(0.0, 1.0, 2)])),
        "nu": float(rng.uniform(-0.3, 0.5)),
        "modulus": float(10.0 ** rng.uniform(1.0, 4.0)),
        "c0_over_R": float(10.0 ** rng.uniform(-2.0, 0.0)),
        "lambda_over_R": float(10.0 ** rng.uniform(-1.7, -0.3)),
        "A": float(rng.uniform(0.0, 0.05)),
        "a_max_over_R": float(rng.uniform(0.1, 0.6)),
    }
    two = (Harmonic(n=1, cos=1.0, sin=0.3), Harmonic(n=3, cos=-0.2, sin=0.1))
    waves = two if rng.random() < 0.5 else (Harmonic(n=1),)
    loading = BY_DEPTH
    if rng.random() < 0.3:
        loading, scene["machine_stiffness"] = BY_MACHINE, float(10.0 ** rng.uniform(-1.5, 1.0))
    profile = Profile(exponent=float(rng.choice([1.0, 2.0, 2.5, 4.0])), harmonics=waves)
    n = float(rng.uniform(0.1, 2.0))
    return scene, profile, loading, float(10.0 ** rng.uniform(-2.5 / max(1.0, n), 2.0)), n


@pytest.mark.parametrize("seed", range(20))
def test_opening_a_second_way(seed: int) -> None:
    """DOP853 at 1e-12 leaves up to 1e-11 of the depth, and its dense output 1e-8 of where the trough is."""
    rough = {"delta_jump_out": 3e-11, "pull_off_radius": 1e-8, "edge_speed_at_pull_off": 1e-8}
    scene, profile, loading, eps, n = drawn(seed)
    found = open_at_speed(scene | {"speed_over_reference": eps}, Rate(exponent=n), profile, loading, 1)
    expected = opened(Punch(scene, profile, loading), eps, n, scene["a_max_over_R"])
    for name, value in expected.items():
        assert found[name] == pytest.approx(value, rel=rough.get(name, 1e-11)), name
    assert found["pull_off_force_error"] < 1e-10 * abs(found["pull_off_force"])
    assert found["opening_energy_error"] < 1e-10 * found["opening_energy"]


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(6))
def test_closing_a_second_way(seed: int) -> None:
    scene, profile, loading, eps, n = drawn(seed + 100)
    given = {"speed_over_reference": eps, "closing_ratio": 0.6, "delta_max": 0.03, "a_max_over_R": math.inf}
    found = close_at_speed(scene | given, Rate(exponent=0.5 * n), profile, loading, 1)
    for name, value in closed(Punch(scene, profile, loading), eps, 0.5 * n, 0.6, 0.03).items():
        assert found[name] == pytest.approx(value, rel=1e-9), name


@pytest.mark.parametrize("A", [0.0, 0.01])
@pytest.mark.parametrize("n", [0.6, 1.0])
def test_a_slow_force_follows_the_slow_law(A: float, n: float) -> None:
    """F/F_0 - 1 = c eps^n, and the next term of eps^2n."""
    scene, eps = SMOOTH | {"A": A}, 1e-6
    found = open_at_speed(scene | {"speed_over_reference": eps}, Rate(exponent=n), WAVY, BY_DEPTH, 1)
    still = solve(scene, ["pull_off_force"])
    gain = float(found["pull_off_force"] / still["pull_off_force"] - 1.0)
    assert gain == pytest.approx(float(found["rate_coefficient"]) * eps**n, rel=3.0 * eps ** (0.5 * n))


@pytest.mark.parametrize("n", [0.6, 1.0, 1.5])
def test_a_slow_edge_overruns_a_fold_by_its_constant(n: float) -> None:
    """The depth at separation is below that of the fold by D_n delta'' X^2, and the energy above by that times -P."""
    constant = MOVING["rate_more"]["delay_constants"][str(n)]
    if n == 1.0:
        assert constant == pytest.approx(2.0 ** (1.0 / 3.0) * 2.338107410459767, rel=1e-7)  # a zero of Airy's Ai
    k, eps = SMOOTH["k"], 1e-10
    c = 0.5 * (1.0 - k)
    M = float(stiffness(k, SMOOTH["nu"], SMOOTH["modulus"], SMOOTH["c0_over_R"]))
    s, K = math.sqrt(2.0 ** (1.0 + k) * math.pi / M), 2.0 ** (1.0 - k) * M / (1.0 + k)
    fold = (0.5 * c * (1.0 + k) * s) ** (1.0 / (2.0 - c))
    bend = 2.0 / (1.0 + k) - c * (c - 1.0) * s * fold ** (c - 2.0)
    depth = fold**2 / (1.0 + k) - s * fold**c
    load = K * (2.0 * fold ** (3.0 + k) / ((1.0 + k) * (3.0 + k)) - fold ** (1.0 + k + c) * s)
    reach = ((eps / bend) ** n * s * fold**c / (2.0 * bend)) ** (1.0 / (n + 2.0))
    found = open_at_speed(SMOOTH | {"speed_over_reference": eps}, Rate(exponent=n), WAVY, BY_DEPTH, 1)
    overrun = constant * bend * reach**2
    rest = 4.0 * (reach / fold) ** min(1.0, 2.0 / n - 1.0)
    assert depth - float(found["delta_jump_out"]) == pytest.approx(overrun, rel=rest)
    if n < 1.0:
        return  # the work of the slow edge outweighs that of the overrun for long
    still = float(solve(SMOOTH, ["unloading_energy"])["unloading_energy"])
    assert float(found["unloading_energy"]) - still == pytest.approx(-load * overrun, rel=rest)


def test_what_has_no_value() -> None:
    law, scene = Rate(exponent=0.6), SMOOTH | {"A": 0.01, "speed_over_reference": 0.1}
    found = open_at_speed(scene | {"a_max_over_R": [0.4, math.inf, -1.0, math.nan]}, law, WAVY, BY_DEPTH, 1)
    assert found["status"].tolist() == [0, NO_VALUE, NO_VALUE, NO_VALUE]
    assert found["status"].dtype == np.int16
    for name in OPENING:
        assert np.isnan(found[name]).tolist() == [False, True, True, True], name
    for change in ({"speed_over_reference": 0.0}, {"k": 1.5}, {"k": math.nan}, {"modulus": -1.0}, {"A": -0.1}):
        assert open_at_speed(scene | change, law, WAVY, BY_DEPTH, 1)["status"] & NO_VALUE
    far = open_at_speed(scene | {"lambda_over_R": 1e-6}, law, WAVY, BY_DEPTH, 1)
    assert far["status"] == NO_VALUE | TOO_MANY_WAVES
    closing = scene | {"closing_ratio": 1.0, "delta_max": [-0.01, 0.02, math.inf], "a_max_over_R": math.inf}
    closed_ = close_at_speed(closing, law, WAVY, BY_DEPTH, 1)
    assert closed_["status"].tolist() == [NO_CONTACT, 0, NO_VALUE]
    assert closed_["closing_energy"][0] == 0.0
    assert np.isnan(closed_["turning_radius"][0])
    with pytest.raises(ValueError, match="no bound"):
        open_at_speed(scene, law, WAVY, Loading(control="load"), 1)


def test_scenes_of_any_shape_are_those_of_one_each() -> None:
    law = Rate(exponent=0.6)
    scene = SMOOTH | {"A": [[0.0], [0.01]], "k": [[0.3], [0.5]], "speed_over_reference": [0.01, 0.1, 1.0]}
    found = open_at_speed(scene, law, WAVY, BY_DEPTH, 2)
    for i, (k, A) in enumerate([(0.3, 0.0), (0.5, 0.01)]):
        for j, eps in enumerate([0.01, 0.1, 1.0]):
            one = open_at_speed(SMOOTH | {"A": A, "k": k, "speed_over_reference": eps}, law, WAVY, BY_DEPTH, 1)
            assert all(one[name] == found[name][i, j] for name in one)


def test_where_the_edge_hardly_moves_before_the_pull_off() -> None:
    scene, law = SMOOTH | {"a_max_over_R": 0.05, "speed_over_reference": 1e-6}, Rate(exponent=2.0)
    found = open_at_speed(scene, law, WAVY, BY_DEPTH, 1)
    assert found["status"] == PULL_OFF_AT_RIM
    assert np.isnan(rate_coefficient(scene, law, WAVY, BY_DEPTH, 1))
    still = solve(scene, ["pull_off_force"])["pull_off_force"]
    assert found["pull_off_force"] == pytest.approx(float(still), rel=1e-9)
