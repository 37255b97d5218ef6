"""Edges at a speed against the reference, slow laws, similarity and rest; their cycles, paths, and where they have no value.

Opening is seen through a punch that closes at rest up to its rim a_t: its unloading_energy is int 2 pi a G da less
pi a_t^2.
"""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gradhesion.core import FLAGS, Loading, Profile, draw_curves, solve
from gradhesion.core.problem.names import EDGE, RATE
from gradhesion.core.problem.status import NO_VALUE, PULL_OFF_AT_RIM, TOLERANCE_NOT_MET, TOO_MANY_WAVES
from gradhesion.core.problem.toughness import MOST_WAVES, Rate
from gradhesion.core.rate.cycle import KNOWN
from tests.core.scene import ENDLESS, EPS, adhesion, material_of, profile_of, scene_of

MOVING = json.loads((Path(__file__).parents[2] / "reference/moving_edge.json").read_text(encoding="utf-8"))
SMOOTH = scene_of(0.3, 0.3, 500.0, 0.01, 0.1, 0.0, 0.4)
WAVY = scene_of(0.37, 0.2, 700.0, 0.03, 0.17, 0.013, 0.5)
TURNED = SMOOTH | ENDLESS | {"A": 0.01, "indentation_max_over_R": 0.05}
ROUGH = profile_of(2.5, (1, 1.0, 0.3), (3, -0.2, 0.1))
OPENED = ["pull_off_force", "pull_off_radius", "unloading_energy", "delta_jump_out", "edge_speed_at_pull_off"]
PARTS = ["dissipated_energy", "loading_energy", "unloading_energy", "front_energy"]
CLOSED = ["turning_radius", "delta_max", "loading_energy", "pinned_depth"]
SAME = Rate(exponent=0.6, closing="same")


def stored(given: dict[str, float], **more: float) -> dict[str, Any]:
    return scene_of(*(given[name] for name in ("k", "nu", "modulus", "c0", "lam", "A", "end")), **more)


def closing_energy(found: dict[str, Any], ratio: float) -> Any:
    """Return int 2 pi a G da of closing by the same law."""
    return ratio * math.pi * found["turning_radius"] ** 2 - found["loading_energy"]


def opening_cases() -> list[Any]:
    """Every case of the reference that opens: parameters, law, and a machine or another rim."""
    cases = [(one["input"], case, {}) for one in MOVING["rate"].values() for case in one["cases"]]
    of_machine, more = MOVING["rate_machine"], MOVING["rate_more"]
    cases += [(of_machine["input"], case, {"machine_stiffness": case["S_over_E"]}) for case in of_machine["cases"]]
    cases += [(one["input"], one, {"closing_ratio": one["closing_ratio"]}) for one in more["quasi_static_closing"]]
    return cases + [(case["input"], case, {"a_max_over_R": case["a_t"]}) for case in more["closing_same"]]


@pytest.mark.parametrize(("given", "case", "more"), opening_cases())
def test_opening_against_the_reference(given: dict[str, float], case: dict[str, Any], more: dict[str, float]) -> None:
    machine = "machine_stiffness" in more
    scene = stored(given, speed_over_reference=case["eps"]) | more
    how: dict[str, Any] = {"loading": Loading(control="machine")} if machine else {}
    found = solve(scene, [*OPENED, *PARTS, "rate_coefficient"], rate=Rate(exponent=case["n"]), **how)
    assert not found["status"] & NO_VALUE
    work = found["unloading_energy"] + math.pi * scene["a_max_over_R"] ** 2
    separation = case["coordinate_at_separation" if machine else "depth_at_separation"]
    assert found["pull_off_force"] == pytest.approx(case["pull_off_force"], rel=1e-12)
    assert found["pull_off_radius"] == pytest.approx(case["pull_off_radius"], rel=1e-11)
    assert work == pytest.approx(case["H_open"], rel=2e-12)
    assert found["delta_jump_out"] == pytest.approx(separation, rel=1e-12)
    if more.keys() <= {"closing_ratio"}:  # the whole cycle is stored, whose closing is at rest
        assert found["dissipated_energy"] == pytest.approx(case["dissipated_energy"], rel=1e-11)
        assert found["dissipated_energy"] == pytest.approx(sum(found[name] for name in PARTS[1:]), rel=8 * EPS)
    if "small_rate" in case:
        slow = float(found["rate_coefficient"]) * case["eps"] ** case["n"]
        assert slow == pytest.approx(case["small_rate"], rel=1e-9)


@pytest.mark.parametrize("case", MOVING["rate_more"]["closing_same"], ids=lambda case: str(case["name"]))
def test_closing_and_a_turn_against_the_reference(case: dict[str, Any]) -> None:
    """The two ways of the reference differ by up to 7e-12."""
    given = {"closing_ratio": case["closing_ratio"], "speed_over_reference": case["eps"]}
    scene = stored(case["input"], **given) | ENDLESS | {"indentation_max_over_R": case["delta_max"]}
    found = solve(scene, [*CLOSED, *PARTS], rate=Rate(exponent=case["n"], closing="same"))
    assert found["turning_radius"] == pytest.approx(case["a_t"], rel=1e-11)
    assert closing_energy(found, case["closing_ratio"]) == pytest.approx(case["H_close"], rel=1e-11)
    assert found["delta_max"] == pytest.approx(case["delta_max"], rel=1e-13)
    assert found["dissipated_energy"] == pytest.approx(case["dissipated_energy"], rel=1e-11)
    assert found["dissipated_energy"] == pytest.approx(sum(found[name] for name in PARTS[1:]), rel=8 * EPS)
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


@pytest.mark.parametrize(("profile", "n"), [(Profile(), 0.1), (Profile(), 1.3), (ROUGH, 0.6)])
def test_similarity_and_another_wavelength(profile: Profile, n: float) -> None:
    """Radii go as c, depths as c^m and energies as c^2; an edge has the same speed where depths have one of c^(m-1)."""
    speeds, c, m, names = np.array([1e-5, 1e-2, 1.0, 50.0]), 0.74, profile.exponent, [*OPENED, "rate_coefficient"]
    how: dict[str, Any] = {"rate": Rate(exponent=n), "profile": profile}
    one = solve(WAVY | {"speed_over_reference": speeds}, names, **how)
    powers = {"lambda_over_R": 1.0, "A": m - 1.0, "a_max_over_R": 1.0, "modulus": 1.0 - WAVY["k"] - 2.0 * m}
    scaled = {key: value * c ** powers.get(key, 0.0) for key, value in WAVY.items()}
    other = solve(scaled | {"speed_over_reference": c ** (m - 1.0) * speeds}, names, **how)
    for name, power in zip(names, [2.0 - m, 1, 2, m, 0, -n * (m - 1.0)], strict=True):
        np.testing.assert_allclose(other[name], c**power * one[name], rtol=1e-10, err_msg=name)
    how["profile"] = profile_of(m, *((2 * wave.n, wave.cos, wave.sin) for wave in profile.harmonics))
    longer = WAVY | {"lambda_over_R": 2.0 * WAVY["lambda_over_R"], "A": 0.5 * WAVY["A"], "speed_over_reference": speeds}
    for name, values in solve(longer, names, **how).items():
        np.testing.assert_allclose(values, one[name], rtol=1e-10, err_msg=name)


@pytest.mark.parametrize(("A", "profile"), [(0.0, Profile()), (0.01, Profile()), (0.01, ROUGH)])
@pytest.mark.parametrize("n", [0.6, 1.0])
def test_a_slow_force_follows_the_slow_law(A: float, profile: Profile, n: float) -> None:
    """F/F_0 - 1 = c eps^n, and the next term of eps^2n."""
    scene, eps = SMOOTH | {"A": A}, 1e-6
    names = ["pull_off_force", "rate_coefficient"]
    found = solve(scene | {"speed_over_reference": [0.0, eps]}, names, rate=Rate(exponent=n), profile=profile)
    gain = float(found["pull_off_force"][1] / found["pull_off_force"][0] - 1.0)
    assert gain == pytest.approx(float(found["rate_coefficient"][1]) * eps**n, rel=3.0 * eps ** (0.5 * n))


@pytest.mark.parametrize("n", [0.6, 1.0, 1.5])
def test_a_slow_edge_overruns_a_fold_by_its_constant(n: float) -> None:
    """The depth at separation is below that of the fold by D_n delta'' X^2, and the energy above by that times -P."""
    k, M, eps = SMOOTH["k"], material_of(SMOOTH), 1e-10
    c, s, K = 0.5 * (1.0 - k), adhesion(k, M), 2.0 ** (1.0 - k) * M / (1.0 + k)
    fold = (0.5 * c * (1.0 + k) * s) ** (1.0 / (2.0 - c))
    bend = 2.0 / (1.0 + k) - c * (c - 1.0) * s * fold ** (c - 2.0)
    depth = fold**2 / (1.0 + k) - s * fold**c
    load = K * (2.0 * fold ** (3.0 + k) / ((1.0 + k) * (3.0 + k)) - fold ** (1.0 + k + c) * s)
    reach = ((eps / bend) ** n * s * fold**c / (2.0 * bend)) ** (1.0 / (n + 2.0))
    found = solve(SMOOTH | {"speed_over_reference": [0.0, eps]}, OPENED, rate=Rate(exponent=n))
    overrun = MOVING["rate_more"]["delay_constants"][str(n)] * bend * reach**2
    rest = 4.0 * (reach / fold) ** min(1.0, 2.0 / n - 1.0)
    assert depth - float(found["delta_jump_out"][1]) == pytest.approx(overrun, rel=rest)
    if n >= 1.0:  # below, the work of the slow edge outweighs that of the overrun for long
        still, moved = found["unloading_energy"]
        assert moved - still == pytest.approx(-load * overrun, rel=rest)


@pytest.mark.parametrize(("n", "share"), [(0.6, 0.238745), (1.0, 1.0 - math.log(2.0))])
def test_a_slow_edge_gains_the_share_of_its_lag_after_the_turn(n: float, share: float) -> None:
    """It stops (1 - c_n) l behind the radius at rest, c_n = int_0^1 x^(1/n)/(1 + x^(1/n)) dx, l being its lag."""
    eps, k = 1e-6 ** (0.6 / n), SMOOTH["k"]
    scene = TURNED | {"A": 0.0, "closing_ratio": 0.6, "speed_over_reference": [0.0, eps]}
    rest, a = solve(scene, CLOSED, rate=Rate(exponent=n, closing="same"))["turning_radius"]
    c = 0.5 * (1.0 - k)
    pull = math.sqrt(0.6) * adhesion(k, material_of(SMOOTH)) * a**c
    slope = 2.0 * a / (1.0 + k) - c * pull / a
    behind = pull * (eps / slope) ** n / (2.0 * slope)
    assert rest - a == pytest.approx((1.0 - share) * behind, rel=10.0 * eps**n + 1e-2)


@pytest.mark.parametrize("speed", [1e-3, 0.1, 10.0])
def test_a_rim_on_the_way_after_the_turn(speed: float) -> None:
    scene = TURNED | {"closing_ratio": 0.6, "speed_over_reference": speed}
    free = solve(scene, CLOSED, rate=SAME)
    rim = float(free["turning_radius"]) * (1.0 - 1e-6)
    found = solve(scene | {"a_max_over_R": rim}, CLOSED, rate=SAME)
    assert found["turning_radius"] == rim
    assert found["delta_max"] == pytest.approx(0.05, rel=1e-13)
    assert found["pinned_depth"] > free["pinned_depth"]
    assert closing_energy(found, 0.6) < closing_energy(free, 0.6)


def test_a_depth_that_is_not_met_before_the_rim_changes_nothing() -> None:
    """One step may pass the rim and, beyond it, the depth: this cycle once turned there."""
    scene = scene_of(0.0, -0.1, 118.0, 0.012, 0.136, 0.0156, 0.3265, speed_over_reference=2e-6, closing_ratio=0.28)
    law = Rate(exponent=0.3, closing="same")
    at_rim = solve(scene, CLOSED, rate=law)
    depths = np.array([1.0 + 1e-3, 1.0 + 1e-2, 1.1]) * at_rim["delta_max"]
    found = solve(scene | {"indentation_max_over_R": depths}, CLOSED, rate=law)
    for name in CLOSED:
        np.testing.assert_allclose(found[name], at_rim[name], rtol=1e-12, err_msg=name)


def test_where_the_edge_hardly_moves_before_the_pull_off() -> None:
    scene = SMOOTH | {"a_max_over_R": 0.05, "speed_over_reference": [0.0, 1e-6]}
    found = solve(scene, ["pull_off_force", "rate_coefficient"], rate=Rate(exponent=2.0))
    assert found["status"][1] & PULL_OFF_AT_RIM
    assert np.isnan(found["rate_coefficient"]).all()
    assert found["pull_off_force"][1] == pytest.approx(float(found["pull_off_force"][0]), rel=1e-9)


def test_waves_are_followed_to_ten_thousand_and_counted_by_the_shortest() -> None:
    """Waves of 5e-5 and of amplitude 1e-7 of that count for nothing; all of them are followed."""
    waves = SMOOTH | {"a_max_over_R": 0.5, "lambda_over_R": 5e-5, "A": [0.0, 1e-7], "speed_over_reference": 0.1}
    found = solve(waves, ["pull_off_force"], rate=Rate(exponent=0.6), check_contact=False)
    assert found["pull_off_force"][1] == pytest.approx(float(found["pull_off_force"][0]), rel=1e-5)
    many = SMOOTH | {"lambda_over_R": 4.0 * 0.4 / MOST_WAVES, "A": 1e-3, "speed_over_reference": 0.1}
    short = profile_of(2.0, (1, 1.0, 0.0), (5, 0.1, 0.0))
    assert solve(many, OPENED, profile=short, rate=SAME)["status"] & TOO_MANY_WAVES
    assert solve(many | {"A": 0.0, "lambda_over_R": 1e-9}, OPENED, profile=short, rate=SAME)["status"] == 0


def test_what_has_no_value_and_what_is_too_slow() -> None:
    scene = SMOOTH | {"A": 0.01, "speed_over_reference": 0.1}
    found = solve(scene | {"a_max_over_R": [0.4, math.inf, -1.0, math.nan]}, OPENED, rate=SAME)
    assert (found["status"] & NO_VALUE != 0).tolist() == [False, True, True, True]
    for name in OPENED:
        assert np.isnan(found[name]).tolist() == [False, True, True, True], name
    for change in ({"speed_over_reference": -1.0}, {"k": 1.5}, {"k": math.nan}, {"modulus": -1.0}, {"A": -0.1}):
        assert solve(scene | change, OPENED, rate=SAME)["status"] & NO_VALUE
    assert solve(scene | {"closing_ratio": 0.0}, OPENED, rate=SAME)["status"] & NO_VALUE
    with pytest.raises(ValueError, match="turns at a depth"):
        solve(scene | {"load_max": 0.1}, OPENED, rate=SAME)
    slow = scene | {"speed_over_reference": 1e-9}
    assert solve(slow, OPENED, rate=Rate(exponent=2.0))["status"] & TOLERANCE_NOT_MET
    assert not solve(slow, OPENED, rate=Rate(exponent=1.0))["status"] & TOLERANCE_NOT_MET


def test_scenes_of_any_shape_are_those_of_one_each() -> None:
    names, heights, speeds = [*OPENED, *CLOSED], [0.0, 0.01], [0.01, 0.1, 1.0]
    both = {"A": np.array(heights)[:, None], "speed_over_reference": speeds}
    found = solve(SMOOTH | both, names, rate=SAME, threads=2)
    for i, j in np.ndindex(2, 3):
        one = solve(SMOOTH | {"A": heights[i], "speed_over_reference": speeds[j]}, names, rate=SAME)
        assert all(one[name] == found[name][i, j] for name in one)


REST = [name for name in KNOWN if name not in RATE]
BOTH = pytest.mark.parametrize("closing", ["quasi-static", "same"])
REFUSED: list[tuple[str, dict[str, Any]]] = [("loading_jumps", {}), ("dissipated_energy_sensitivity", {})]


@BOTH
@pytest.mark.parametrize("control", ["displacement", "machine"])
def test_at_speed_0_every_bit_is_that_of_an_edge_at_rest(closing: str, control: str) -> None:
    scene = TURNED | ({"machine_stiffness": 0.3} if control == "machine" else {}) | {"closing_ratio": 0.5}
    loading = Loading(control=control)
    plain = solve(scene, REST, loading=loading)
    moving = scene | {"speed_over_reference": np.array([0.0, 0.1])}
    found = solve(moving, KNOWN, loading=loading, rate=Rate(exponent=0.6, closing=closing))
    for name in REST:
        assert np.array_equal(found[name][0], plain[name], equal_nan=True), name
    assert found["edge_speed_at_pull_off"][0] == 0.0
    assert found["edge_speed_at_pull_off"][1] > 0.0
    assert found["pull_off_force"][1] > found["pull_off_force"][0]


def test_a_machine_that_turns_at_a_depth_reaches_it() -> None:
    scene = TURNED | {"machine_stiffness": 0.05, "closing_ratio": 0.5, "speed_over_reference": np.array([0.01, 1.0])}
    how: dict[str, Any] = {"rate": Rate(exponent=0.6, closing="same"), "loading": Loading(control="machine")}
    found = solve(scene, ["delta_max", "turning_radius"], **how)
    np.testing.assert_allclose(found["delta_max"], 0.05, rtol=1e-13)
    assert found["turning_radius"][0] > found["turning_radius"][1]


@BOTH
def test_a_cycle_without_contact_has_nothing(closing: str) -> None:
    scene = TURNED | {"indentation_max_over_R": -0.01, "speed_over_reference": 0.1}
    names = ["pull_off_force", "dissipated_energy", "pull_off_radius", *EDGE]
    found = solve(scene, names, rate=Rate(exponent=0.6, closing=closing))
    assert int(found["status"]) == FLAGS["no_contact"]
    assert found["dissipated_energy"] == found["pull_off_force"] == found["front_energy"] == 0.0
    assert np.isnan(found["pull_off_radius"])


@pytest.mark.parametrize(("output", "how"), [*REFUSED, ("pull_off_force", {"loading": Loading(control="load")})])
def test_what_is_not_known_of_a_moving_edge_is_refused(output: str, how: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match="an edge with a speed needs"):
        solve(TURNED | ENDLESS | {"speed_over_reference": 0.1}, [output], rate=Rate(exponent=0.6), **how)


LONG = SMOOTH | {"lambda_over_R": 0.2, "A": 0.01}
DRIVEN: list[dict[str, float]] = [
    ENDLESS | {"indentation_max_over_R": 0.05},
    {"a_max_over_R": 0.5},
    {"a_max_over_R": 0.5, "machine_stiffness": 0.05},
    ENDLESS | {"indentation_max_over_R": 0.04, "machine_stiffness": 0.05},
]
CHORDS = 3e-3
"""Chords between the points, of the energy of the loop: most where the contact closes at rest, over few points."""


@pytest.mark.parametrize("turn", DRIVEN)
@pytest.mark.parametrize("closing", ["quasi-static", "same"])
@pytest.mark.parametrize("speed", [1e-3, 1.0])
def test_the_path_encloses_the_energy(turn: dict[str, float], closing: str, speed: float) -> None:
    scene = LONG | turn | {"closing_ratio": 0.5, "speed_over_reference": speed}
    how: dict[str, Any] = {"loading": Loading(control="machine")} if "machine_stiffness" in turn else {}
    how["rate"] = Rate(exponent=0.6, closing=closing)
    drawn, status = draw_curves(scene, ["path"], **how)
    found = solve(scene, ["dissipated_energy", "pull_off_force", "delta_jump_out", "turning_radius"], **how)
    assert status == found["status"] == 0
    load = 1.5 * np.pi * drawn["path_load"]
    coordinate = drawn["path_indentation"].copy()
    if "machine_stiffness" in scene:
        coordinate += load / (scene["machine_stiffness"] * scene["modulus"])
    loop = np.sum(0.5 * (load[1:] + load[:-1]) * np.diff(coordinate))
    assert loop == pytest.approx(float(found["dissipated_energy"]), rel=CHORDS)
    assert -drawn["path_load"].min() == pytest.approx(float(found["pull_off_force"]), rel=CHORDS)
    assert drawn["path_indentation"][-1] == found["delta_jump_out"]
    assert drawn["path_contact_radius"].max() == pytest.approx(float(found["turning_radius"]), rel=1e-12)
    opening = drawn["path_contact_radius"][drawn["path_unloading"] == 1]
    assert (np.diff(opening) <= np.finfo(float).eps).all()


def test_at_speed_0_it_is_the_path_of_an_edge_at_rest_and_has_no_jumps_beyond() -> None:
    scene = LONG | DRIVEN[0]
    rest, _ = draw_curves(scene, ["path", "jumps"])
    still, _ = draw_curves(scene | {"speed_over_reference": 0.0}, ["path", "jumps"], rate=Rate(exponent=0.6))
    for name, values in rest.items():
        assert np.array_equal(still[name], values)
    with pytest.raises(ValueError, match="has no jumps"):
        draw_curves(LONG | DRIVEN[0] | {"speed_over_reference": 0.1}, ["jumps", "path"], rate=Rate(exponent=0.6))
