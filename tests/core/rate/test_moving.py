"""Edges at a speed: against the reference, a second way, the slow laws, similarity, and where they have no value.

Opening is seen through a punch that closes at rest up to its rim a_t: its unloading_energy is int 2 pi a G da less
pi a_t^2.
"""

import itertools
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad

from gradhesion.core import Loading, Profile, solve
from gradhesion.core.problem.status import NO_VALUE, PULL_OFF_AT_RIM, TOLERANCE_NOT_MET, TOO_MANY_WAVES
from gradhesion.core.problem.toughness import MOST_WAVES, Rate
from tests.core.rate.second_way import Punch, opened
from tests.core.scene import ENDLESS, adhesion, material_of, profile_of, scene_of

BY_DEPTH, BY_MACHINE = Loading(), Loading(control="machine")
MOVING = json.loads((Path(__file__).parents[2] / "reference/moving_edge.json").read_text(encoding="utf-8"))
SMOOTH = scene_of(0.3, 0.3, 500.0, 0.01, 0.1, 0.0, 0.4)
WAVY = scene_of(0.37, 0.2, 700.0, 0.03, 0.17, 0.013, 0.5)
TURNED = SMOOTH | ENDLESS | {"A": 0.01, "indentation_max_over_R": 0.05}
OPENED = ["pull_off_force", "pull_off_radius", "unloading_energy", "delta_jump_out", "edge_speed_at_pull_off"]
CLOSED = ["turning_radius", "delta_max", "loading_energy", "pinned_depth"]


def stored(given: dict[str, float], **more: float) -> dict[str, Any]:
    """Parameters of a scene of the reference."""
    return scene_of(*(given[name] for name in ("k", "nu", "modulus", "c0", "lam", "A", "end")), **more)


def closing_energy(found: dict[str, Any], ratio: float) -> Any:
    """Return int 2 pi a G da of closing by the same law."""
    return ratio * math.pi * found["turning_radius"] ** 2 - found["loading_energy"]


def opening_cases() -> list[Any]:
    """Every case of the reference that opens: parameters, law, and a machine or another rim."""
    cases = [(one["input"], case, {}) for one in MOVING["rate"].values() for case in one["cases"]]
    of_machine = MOVING["rate_machine"]
    cases += [(of_machine["input"], case, {"machine_stiffness": case["S_over_E"]}) for case in of_machine["cases"]]
    more = MOVING["rate_more"]
    rims = [*more["closing_same"], *more["quasi_static_closing"]]
    return cases + [(case["input"], case, {"a_max_over_R": case["a_t"]}) for case in rims]


@pytest.mark.parametrize(("given", "case", "more"), opening_cases())
def test_opening_against_the_reference(given: dict[str, float], case: dict[str, Any], more: dict[str, float]) -> None:
    loading = BY_MACHINE if "machine_stiffness" in more else BY_DEPTH
    scene = stored(given, speed_over_reference=case["eps"]) | more
    found = solve(scene, [*OPENED, "rate_coefficient"], rate=Rate(exponent=case["n"]), loading=loading)
    assert not found["status"] & NO_VALUE
    assert found["pull_off_force"] == pytest.approx(case["pull_off_force"], rel=1e-12)
    assert found["pull_off_radius"] == pytest.approx(case["pull_off_radius"], rel=1e-11)
    work = found["unloading_energy"] + math.pi * scene["a_max_over_R"] ** 2
    assert work == pytest.approx(case["H_open"], rel=2e-12)
    separation = case["coordinate_at_separation" if more.keys() == {"machine_stiffness"} else "depth_at_separation"]
    assert found["delta_jump_out"] == pytest.approx(separation, rel=1e-12)
    if "small_rate" in case:
        slow = float(found["rate_coefficient"]) * case["eps"] ** case["n"]
        assert slow == pytest.approx(case["small_rate"], rel=1e-9)


@pytest.mark.parametrize("case", MOVING["rate_more"]["closing_same"], ids=lambda case: str(case["name"]))
def test_closing_and_a_turn_against_the_reference(case: dict[str, Any]) -> None:
    """The two ways of the reference differ by up to 7e-12."""
    given = {"closing_ratio": case["closing_ratio"], "speed_over_reference": case["eps"]}
    scene = stored(case["input"], **given) | ENDLESS | {"indentation_max_over_R": case["delta_max"]}
    found = solve(scene, [*CLOSED, "dissipated_energy"], rate=Rate(exponent=case["n"], closing="same"))
    assert found["turning_radius"] == pytest.approx(case["a_t"], rel=1e-11)
    assert closing_energy(found, case["closing_ratio"]) == pytest.approx(case["H_close"], rel=1e-11)
    assert found["delta_max"] == pytest.approx(case["delta_max"], rel=1e-13)
    assert found["dissipated_energy"] == pytest.approx(case["dissipated_energy"], rel=1e-11)
    apart = case["depth_edge_stops"] - case["depth_opening_starts"]
    assert float(found["pinned_depth"]) == pytest.approx(apart, rel=1e-11, abs=1e-15)


@pytest.mark.parametrize("name", ["k0", "k03", "smooth"])
def test_closing_to_the_rim_against_the_reference(name: str) -> None:
    for case in MOVING["rate"][name]["closing"]:
        scene = stored(MOVING["rate"][name]["input"], speed_over_reference=case["eps"], closing_ratio=1.0)
        law = Rate(exponent=case["exponent"], closing="same")
        found = solve(scene, CLOSED, rate=law)
        assert found["turning_radius"] == scene["a_max_over_R"]
        assert found["delta_max"] == pytest.approx(case["depth"], rel=1e-12)
        assert closing_energy(found, 1.0) == pytest.approx(case["H_close"], rel=1e-12)
        assert found["pinned_depth"] > 0.0
        below = scene | {"indentation_max_over_R": 0.1 * case["depth"]}
        assert solve(below, CLOSED, rate=law)["turning_radius"] < 0.5


def drawn(seed: int) -> tuple[dict[str, float], Profile, Loading, float, float]:
    """A scene at random, with eps and n; slower edges take explicit steps minutes."""
    rng = np.random.default_rng(seed)
    k, nu = float(rng.choice([0.0, 0.95, *rng.uniform(0.0, 1.0, 2)])), rng.uniform(-0.3, 0.5)
    material, wavelength = (
        (k, nu, 10.0 ** rng.uniform(1.0, 4.0), 10.0 ** rng.uniform(-2.0, 0.0)),
        rng.uniform(-1.7, -0.3),
    )
    scene = scene_of(*material, 10.0**wavelength, rng.uniform(0.0, 0.05), rng.uniform(0.1, 0.6))
    waves = ((1, 1.0, 0.3), (3, -0.2, 0.1)) if rng.random() < 0.5 else ((1, 1.0, 0.0),)
    loading = BY_DEPTH
    if rng.random() < 0.3:
        loading, scene["machine_stiffness"] = BY_MACHINE, 10.0 ** rng.uniform(-1.5, 1.0)
    profile, n = profile_of(float(rng.choice([1.0, 2.0, 2.5, 4.0])), *waves), float(rng.uniform(0.1, 2.0))
    return scene, profile, loading, float(10.0 ** rng.uniform(-2.5 / max(1.0, n), 2.0)), n


@pytest.mark.parametrize("seed", range(8))
def test_opening_a_second_way(seed: int) -> None:
    """DOP853 at 1e-12 leaves up to 1e-11 of the depth, and its dense output 1e-8 of where the trough is."""
    rough = {"delta_jump_out": 3e-11, "pull_off_radius": 1e-8, "edge_speed_at_pull_off": 1e-8}
    scene, profile, loading, eps, n = drawn(seed)
    law, radius = Rate(exponent=n), scene["a_max_over_R"]
    found = solve(scene | {"speed_over_reference": eps}, OPENED, profile=profile, loading=loading, rate=law)
    expected = opened(Punch(scene, profile, loading), eps, n, radius)
    work = float(found["unloading_energy"]) + math.pi * radius**2
    assert work == pytest.approx(expected.pop("opening_energy"), rel=1e-11)
    for name, value in expected.items():
        assert found[name] == pytest.approx(value, rel=rough.get(name, 1e-11)), name


@pytest.mark.parametrize("n", [0.1, 1.3])
def test_similarity(n: float) -> None:
    """With L = M^(-1/(3+k)) lengths go as L, depths and energies as L^2, speeds as L."""
    speeds, factor = np.array([1e-5, 1e-2, 1.0, 50.0]), 3.7 ** (-1.0 / 3.37)
    one = solve(WAVY | {"speed_over_reference": speeds}, [*OPENED, "rate_coefficient"], rate=Rate(exponent=n))
    stiffer = WAVY | {name: factor * WAVY[name] for name in ("lambda_over_R", "A", "a_max_over_R")}
    stiffer |= {"modulus": 3.7 * WAVY["modulus"], "speed_over_reference": factor * speeds}
    other = solve(stiffer, [*OPENED, "rate_coefficient"], rate=Rate(exponent=n))
    for name, power in zip([*OPENED, "rate_coefficient"], [0, 1, 2, 2, 0, -n], strict=True):
        np.testing.assert_allclose(other[name], factor**power * one[name], rtol=1e-10, err_msg=name)


@pytest.mark.parametrize("A", [0.0, 0.01])
@pytest.mark.parametrize("n", [0.6, 1.0])
def test_a_slow_force_follows_the_slow_law(A: float, n: float) -> None:
    """F/F_0 - 1 = c eps^n, and the next term of eps^2n."""
    scene, eps = SMOOTH | {"A": A}, 1e-6
    names = ["pull_off_force", "rate_coefficient"]
    found = solve(scene | {"speed_over_reference": [0.0, eps]}, names, rate=Rate(exponent=n))
    gain = float(found["pull_off_force"][1] / found["pull_off_force"][0] - 1.0)
    assert gain == pytest.approx(float(found["rate_coefficient"][1]) * eps**n, rel=3.0 * eps ** (0.5 * n))


@pytest.mark.parametrize("n", [0.6, 1.0, 1.5])
def test_a_slow_edge_overruns_a_fold_by_its_constant(n: float) -> None:
    """The depth at separation is below that of the fold by D_n delta'' X^2, and the energy above by that times -P."""
    constant = MOVING["rate_more"]["delay_constants"][str(n)]
    if n == 1.0:
        assert constant == pytest.approx(2.0 ** (1.0 / 3.0) * 2.338107410459767, rel=1e-7)  # a zero of Airy's Ai
    k, eps = SMOOTH["k"], 1e-10
    c = 0.5 * (1.0 - k)
    M = material_of(SMOOTH)
    s, K = adhesion(k, M), 2.0 ** (1.0 - k) * M / (1.0 + k)
    fold = (0.5 * c * (1.0 + k) * s) ** (1.0 / (2.0 - c))
    bend = 2.0 / (1.0 + k) - c * (c - 1.0) * s * fold ** (c - 2.0)
    depth = fold**2 / (1.0 + k) - s * fold**c
    load = K * (2.0 * fold ** (3.0 + k) / ((1.0 + k) * (3.0 + k)) - fold ** (1.0 + k + c) * s)
    reach = ((eps / bend) ** n * s * fold**c / (2.0 * bend)) ** (1.0 / (n + 2.0))
    found = solve(SMOOTH | {"speed_over_reference": [0.0, eps]}, OPENED, rate=Rate(exponent=n))
    overrun = constant * bend * reach**2
    rest = 4.0 * (reach / fold) ** min(1.0, 2.0 / n - 1.0)
    assert depth - float(found["delta_jump_out"][1]) == pytest.approx(overrun, rel=rest)
    if n >= 1.0:  # below, the work of the slow edge outweighs that of the overrun for long
        still, moved = found["unloading_energy"]
        assert moved - still == pytest.approx(-load * overrun, rel=rest)


@pytest.mark.parametrize("n", [0.6, 1.0])
def test_a_slow_edge_gains_the_share_of_its_lag_after_the_turn(n: float) -> None:
    """It stops (1 - c_n) l behind the radius at rest, c_n = int_0^1 x^(1/n)/(1 + x^(1/n)) dx, l being its lag."""
    share = quad(lambda x: x ** (1.0 / n) / (1.0 + x ** (1.0 / n)), 0.0, 1.0)[0]
    assert share == pytest.approx({0.6: 0.238745, 1.0: 1.0 - math.log(2.0)}[n], abs=1e-6)
    eps, k, root = 1e-6 ** (0.6 / n), SMOOTH["k"], math.sqrt(0.6)
    scene = TURNED | {"A": 0.0, "closing_ratio": 0.6, "speed_over_reference": [0.0, eps]}
    rest, a = solve(scene, CLOSED, rate=Rate(exponent=n, closing="same"))["turning_radius"]
    c = 0.5 * (1.0 - k)
    pull = root * adhesion(k, material_of(SMOOTH)) * a**c
    slope = 2.0 * a / (1.0 + k) - c * pull / a
    behind = pull * (eps / slope) ** n / (2.0 * slope)
    assert rest - a == pytest.approx((1.0 - share) * behind, rel=10.0 * eps**n + 1e-2)


@pytest.mark.parametrize("speed", [1e-3, 0.1, 10.0])
def test_a_rim_on_the_way_after_the_turn(speed: float) -> None:
    law = Rate(exponent=0.6, closing="same")
    scene = TURNED | {"closing_ratio": 0.6, "speed_over_reference": speed}
    free = solve(scene, CLOSED, rate=law)
    rim = float(free["turning_radius"]) * (1.0 - 1e-6)
    found = solve(scene | {"a_max_over_R": rim}, CLOSED, rate=law)
    assert found["turning_radius"] == rim
    assert found["delta_max"] == pytest.approx(0.05, rel=1e-13)
    assert found["pinned_depth"] > free["pinned_depth"]
    assert closing_energy(found, 0.6) < closing_energy(free, 0.6)


def test_a_depth_that_is_not_met_before_the_rim_changes_nothing() -> None:
    """One step may pass the rim and, beyond it, the depth: this cycle once turned there."""
    scene = scene_of(0.0, -0.1, 118.0, 0.012, 0.136, 0.0156, 0.3265, speed_over_reference=2e-6, closing_ratio=0.28)
    law = Rate(exponent=0.3, closing="same")
    at_rim = solve(scene, CLOSED, rate=law)
    for share in (1.0 + 1e-3, 1.0 + 1e-2, 1.1):
        found = solve(scene | {"indentation_max_over_R": share * at_rim["delta_max"]}, CLOSED, rate=law)
        for name in CLOSED:
            assert found[name] == pytest.approx(float(at_rim[name]), rel=1e-12), name


def test_where_the_edge_hardly_moves_before_the_pull_off() -> None:
    scene = SMOOTH | {"a_max_over_R": 0.05, "speed_over_reference": [0.0, 1e-6]}
    found = solve(scene, ["pull_off_force", "rate_coefficient"], rate=Rate(exponent=2.0))
    assert found["status"][1] & PULL_OFF_AT_RIM
    assert np.isnan(found["rate_coefficient"]).all()
    assert found["pull_off_force"][1] == pytest.approx(float(found["pull_off_force"][0]), rel=1e-9)


def test_ten_thousand_waves_are_followed_and_tend_to_none() -> None:
    """Waves of 1e-5 and of amplitude 1e-7 of that count for nothing; all of them are followed."""
    waves = SMOOTH | {"a_max_over_R": 0.5, "lambda_over_R": 5e-5, "A": [0.0, 1e-7], "speed_over_reference": 0.1}
    found = solve(waves, ["pull_off_force"], rate=Rate(exponent=0.6), check_contact=False)
    assert found["pull_off_force"][1] == pytest.approx(float(found["pull_off_force"][0]), rel=1e-5)


def test_waves_are_counted_by_the_shortest() -> None:
    many = SMOOTH | {"lambda_over_R": 4.0 * 0.4 / MOST_WAVES, "A": 1e-3, "speed_over_reference": 0.1}
    short, law = profile_of(2.0, (1, 1.0, 0.0), (5, 0.1, 0.0)), Rate(exponent=0.6, closing="same")
    assert solve(many, OPENED, profile=short, rate=law)["status"] & TOO_MANY_WAVES
    smooth = many | {"A": 0.0, "lambda_over_R": 1e-9}
    assert solve(smooth, OPENED, profile=short, rate=law)["status"] == 0


def test_what_has_no_value() -> None:
    scene, law = SMOOTH | {"A": 0.01, "speed_over_reference": 0.1}, Rate(exponent=0.6, closing="same")
    found = solve(scene | {"a_max_over_R": [0.4, math.inf, -1.0, math.nan]}, OPENED, rate=law)
    assert (found["status"] & NO_VALUE != 0).tolist() == [False, True, True, True]
    for name in OPENED:
        assert np.isnan(found[name]).tolist() == [False, True, True, True], name
    for change in ({"speed_over_reference": -1.0}, {"k": 1.5}, {"k": math.nan}, {"modulus": -1.0}, {"A": -0.1}):
        assert solve(scene | change, OPENED, rate=law)["status"] & NO_VALUE
    assert solve(scene | {"closing_ratio": 0.0}, OPENED, rate=law)["status"] & NO_VALUE
    with pytest.raises(ValueError, match="turns at a depth"):
        solve(scene | {"load_max": 0.1}, OPENED, rate=law)


def test_an_edge_that_is_too_slow_says_so() -> None:
    slow = SMOOTH | {"A": 0.01, "speed_over_reference": 1e-9}
    assert solve(slow, OPENED, rate=Rate(exponent=2.0))["status"] & TOLERANCE_NOT_MET
    assert not solve(slow, OPENED, rate=Rate(exponent=1.0))["status"] & TOLERANCE_NOT_MET


def test_scenes_of_any_shape_are_those_of_one_each() -> None:
    law, names = Rate(exponent=0.6, closing="same"), [*OPENED, *CLOSED]
    found = solve(SMOOTH | {"A": [[0.0], [0.01]], "speed_over_reference": [0.01, 0.1, 1.0]}, names, rate=law, threads=2)
    for (i, A), (j, eps) in itertools.product(enumerate([0.0, 0.01]), enumerate([0.01, 0.1, 1.0])):
        one = solve(SMOOTH | {"A": A, "speed_over_reference": eps}, names, rate=law)
        assert all(one[name] == found[name][i, j] for name in one)
