"""Cycles that turn at a depth or a load: closed forms, the way of loading point by point, and the equality with a rim."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core import OUTPUTS, REPORTS, solve
from gradhesion.core.curve.cosine import curve_of, depth, force_unit, load
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.status import (
    CLOSE_TO_A_JUMP,
    JUMP_IN_TO_RIM,
    LOADING_NOT_ONE_DISC,
    NO_CONTACT,
    NO_VALUE,
    PULL_OFF_AT_RIM,
)

EPS = 2.0**-52
DEPTH, LOAD = "indentation_max_over_R", "load_max"
WAVY = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.02}
FREE = WAVY | {"a_max_over_R": math.inf}
STEPPED = FREE | {"A": 0.06, "lambda_over_R": 0.05}
"""Its loading has some folds at depths below 0.1."""


def drawn(seed: int, count: int, *, waves: tuple[float, float] = (-1.7, 0.0)) -> dict[str, np.ndarray]:
    """Scenes of all sorts, with rims and without."""
    rng = np.random.default_rng(seed)
    k = rng.choice([0.0, 0.1, 0.3, 0.5, 0.8, 1.0], count)
    return {
        "k": k,
        "nu": np.where(k == 1.0, 0.5, rng.uniform(-0.5, 0.5, count)),
        "modulus": 10.0 ** rng.uniform(0.0, 4.0, count),
        "c0_over_R": np.full(count, 0.01),
        "lambda_over_R": 10.0 ** rng.uniform(*waves, count),
        "A": 10.0 ** rng.uniform(-4.0, -1.0, count),
        "a_max_over_R": rng.choice([math.inf, 0.3, 1.0], count),
    }


def targets(turn: str, seed: int, count: int) -> np.ndarray:
    rng = np.random.default_rng(seed)
    return rng.uniform(-0.01, 0.5, count) if turn == DEPTH else 10.0 ** rng.uniform(-2.0, 2.0, count)


class Way:
    """The equilibrium curve of one scene, in the units of a study."""

    def __init__(self, scene: dict[str, float], table_of: Callable[[float], Any]) -> None:
        material = float(stiffness(scene["k"], scene["nu"], scene["modulus"], scene["c0_over_R"]))
        stretch = math.sqrt(2.0 ** (1.0 + scene["k"]) * math.pi / material)
        self.table, self.wavelength = table_of(scene["k"]), scene["lambda_over_R"]
        self.curve, length, self.unit = curve_of(scene["k"], stretch, self.wavelength, scene["A"] * self.wavelength)
        self.force = force_unit(scene["k"], length, self.unit)

    def depth(self, a: float) -> float:
        return float(depth(self.table, self.curve, a / self.wavelength)) * self.unit

    def load(self, a: float) -> float:
        return float(load(self.table, self.curve, a / self.wavelength)) * self.force


@pytest.mark.parametrize("turn", [DEPTH, LOAD])
def test_it_is_where_loading_first_is_there(turn: str, table_of: Callable[[float], Any]) -> None:
    count = 60
    scenes, wanted = drawn(1, count), targets(turn, 2, count)
    radii = solve({**scenes, turn: wanted}, ["turning_radius"])["turning_radius"]
    passed = 0
    for i in range(count):
        if turn == DEPTH and wanted[i] < 0.0:
            assert radii[i] == 0.0
            continue
        way = Way({name: float(values[i]) for name, values in scenes.items()}, table_of)
        rim = scenes["a_max_over_R"][i]
        a = np.linspace(0.0, radii[i] if radii[i] == rim else 1.5 * radii[i], 3001)[1:]
        depths, loads = np.array([way.depth(x) for x in a]), np.array([way.load(x) for x in a])
        visited = (depths >= np.maximum.accumulate(np.maximum(depths, 0.0))) & (depths >= 0.0)
        there = np.flatnonzero(visited & ((depths if turn == DEPTH else loads) >= wanted[i]))
        first = a[there[0]] if there.size else math.inf
        if radii[i] == rim:
            assert first >= rim - 2.0 * a[0]
            continue
        assert abs(first - radii[i]) <= 2.0 * a[0], "a step of the grid, and one more at a fold"
        own = way.depth(radii[i]) if turn == DEPTH else way.load(radii[i])
        passed += own > wanted[i] * (1.0 + 1e-11)
        assert own >= wanted[i] * (1.0 - 1e-11)
    assert passed <= (0 if turn == DEPTH else 5), "a depth is never passed within a jump at that depth, a load seldom"


@pytest.mark.parametrize("turn", [DEPTH, LOAD])
def test_all_else_is_that_of_a_rim_there(turn: str) -> None:
    count = 400
    scenes, wanted = drawn(3, count), targets(turn, 4, count)
    found = solve({**scenes, turn: wanted}, OUTPUTS)
    made = found["turning_radius"] > 0.0
    rim = {name: values[made] for name, values in scenes.items()} | {"a_max_over_R": found["turning_radius"][made]}
    same = solve(rim, OUTPUTS)
    for name in OUTPUTS:
        if name != "delta_max":
            np.testing.assert_array_equal(found[name][made], same[name])
    size = 1.0 + np.abs(same["delta_max"])
    np.testing.assert_allclose(found["delta_max"][made] / size, same["delta_max"] / size, atol=1e-12)
    assert not np.any(found["status"] & NO_VALUE)
    assert not np.any(found["status"][found["turning_radius"] < scenes["a_max_over_R"]] & JUMP_IN_TO_RIM)


@pytest.mark.parametrize("k", [0.0, 0.4, 1.0])
def test_a_smooth_punch_in_closed_form(k: float) -> None:
    scene = {"k": k, "nu": 0.5, "modulus": 300.0, "c0_over_R": 0.05, "lambda_over_R": 1.0, "A": 0.0}
    material = float(stiffness(k, 0.5, 300.0, 0.05))
    stretch, shape = math.sqrt(2.0 ** (1.0 + k) * math.pi / material), 1.0 + k
    a = np.geomspace(1.5 * (shape * stretch) ** (2.0 / (3.0 + k)), 3.0, 9)
    depths = a * a / shape - stretch * a ** (0.5 * (1.0 - k))
    spring = 2.0 ** (1.0 - k) * material / shape * a**shape
    loads = spring * (2.0 * a * a / (shape * (3.0 + k)) - stretch * a ** (0.5 * (1.0 - k))) / (1.5 * math.pi)
    for turn, wanted in ((DEPTH, depths), (LOAD, loads)):
        found = solve(scene | {"a_max_over_R": math.inf, turn: wanted}, ["turning_radius", "pull_off_force"])
        np.testing.assert_allclose(found["turning_radius"], a, rtol=100 * EPS)
        np.testing.assert_allclose(found["pull_off_force"], (3.0 + k) / 3.0, rtol=8 * EPS)


def test_no_contact() -> None:
    found = solve(FREE | {DEPTH: [-0.5, -1e-3]}, [*OUTPUTS, *REPORTS])
    for name in ("pull_off_force", "dissipated_energy", "loading_energy", "unloading_energy", "turning_radius"):
        assert found[name].tolist() == [0.0, 0.0]
    for name in ("loading_jumps", "unloading_jumps"):
        assert found[name].tolist() == [0, 0]
    for name in ("pull_off_radius", "delta_jump_out", "adhesion_gain"):
        assert np.isnan(found[name]).all()
    assert found["delta_max"].tolist() == [-0.5, -1e-3]
    assert found["status"].tolist() == [NO_CONTACT, NO_CONTACT]
    assert np.all(found["roughness_parameter"] > 0.0), "which belongs to the curve"
    both = solve(FREE | {DEPTH: [-1e-16, 0.0]}, ["turning_radius"])
    assert both["status"].tolist() == [NO_CONTACT | CLOSE_TO_A_JUMP, CLOSE_TO_A_JUMP]
    assert both["turning_radius"][0] == 0.0 < both["turning_radius"][1], "at the depth 0 it jumps into contact"


@pytest.mark.parametrize("turn", [DEPTH, LOAD])
def test_a_rim_that_is_met_before(turn: str) -> None:
    found = solve(WAVY | {"a_max_over_R": 0.2, turn: 50.0}, OUTPUTS)
    same = solve(WAVY | {"a_max_over_R": 0.2}, OUTPUTS)
    for name in (*OUTPUTS, "status"):
        np.testing.assert_array_equal(found[name], same[name])
    assert same["turning_radius"] == 0.2


def test_what_does_not_turn_has_its_rim() -> None:
    rims = [0.3, math.inf, -1.0]
    found = solve(WAVY | {"a_max_over_R": rims}, ["turning_radius"])
    np.testing.assert_array_equal(found["turning_radius"], [0.3, math.inf, math.nan])
    for solver in ("asymptotic", "envelope"):
        assert solve(WAVY | {"a_max_over_R": 0.3}, ["turning_radius"], solver=solver)["turning_radius"] == 0.3


def test_depth_and_load_agree() -> None:
    """Turned at a depth, and at the load there: the same place, unless the load was there before."""
    from gradhesion.core import draw_curves

    depths = np.linspace(0.01, 0.2, 40)
    at_depth = solve(FREE | {DEPTH: depths}, ["turning_radius"])["turning_radius"]
    same = 0
    for wanted, radius in zip(depths, at_depth, strict=True):
        path, _ = draw_curves(FREE | {DEPTH: float(wanted)}, ["path"])
        top = int(np.argmax(path["path_contact_radius"]))
        assert math.isclose(path["path_contact_radius"][top], radius, rel_tol=4 * EPS)
        assert math.isclose(path["path_indentation"][top], wanted, rel_tol=1e-12)
        if path["path_load"][top] <= 0.0:
            continue
        again = solve(FREE | {LOAD: float(path["path_load"][top])}, ["turning_radius"])["turning_radius"]
        assert again <= radius * (1.0 + 1e-12)
        same += math.isclose(again, radius, rel_tol=1e-9)
    assert same > 20


@pytest.mark.parametrize("turn", [DEPTH, LOAD])
def test_many_turning_points_are_each_for_itself(turn: str) -> None:
    wanted = np.linspace(0.002, 0.3, 50) if turn == DEPTH else np.geomspace(0.01, 100.0, 50)
    together = solve(FREE | {turn: wanted}, OUTPUTS)
    for i, one in enumerate(wanted):
        alone = solve(FREE | {turn: float(one)}, OUTPUTS)
        for name in OUTPUTS:
            assert math.isclose(together[name][i], alone[name], rel_tol=64 * EPS)


@pytest.mark.parametrize("turn", [DEPTH, LOAD])
def test_force_and_energy_are_steps(turn: str) -> None:
    """Between the values at which loading passes a fold the energy does not depend on where it turns."""
    wanted = np.linspace(0.002, 0.1, 300) if turn == DEPTH else np.linspace(0.1, 40.0, 300)
    found = solve(STEPPED | {turn: wanted}, ["dissipated_energy", "loading_jumps", "turning_radius"])
    jumps, energy = found["loading_jumps"], found["dissipated_energy"]
    assert np.all(np.diff(jumps) >= 0)
    assert np.unique(jumps).size >= 3
    for count in np.unique(jumps):
        own = energy[jumps == count]
        np.testing.assert_allclose(own, own[0], rtol=256 * EPS)
    assert np.all(np.diff(found["turning_radius"]) > 0.0)


def bracketed(scene: dict[str, float], low: float, high: float) -> tuple[float, float]:
    """Two neighbouring depths at which cycles of different counts turn."""
    count = solve(scene | {DEPTH: low}, ["loading_jumps"])["loading_jumps"]
    while high - low > 2.0 * np.spacing(high):
        middle = 0.5 * (low + high)
        if solve(scene | {DEPTH: middle}, ["loading_jumps"])["loading_jumps"] == count:
            low = middle
        else:
            high = middle
    return low, high


def test_a_step_is_said_to_be_near(table_of: Callable[[float], Any]) -> None:
    wanted = np.linspace(0.002, 0.1, 300)
    jumps = solve(STEPPED | {DEPTH: wanted}, ["loading_jumps"])["loading_jumps"]
    i = int(np.flatnonzero(np.diff(jumps))[0])
    low, high = bracketed(STEPPED, wanted[i], wanted[i + 1])
    near = solve(STEPPED | {DEPTH: [low, high, low * (1.0 + 1e-13)]}, ["pull_off_force", "dissipated_energy"])
    assert np.all(near["status"] & CLOSE_TO_A_JUMP)
    apart = solve(STEPPED | {DEPTH: [low - 1e-9, high + 1e-9]}, ["pull_off_force", "dissipated_energy"])
    assert not np.any(apart["status"] & CLOSE_TO_A_JUMP)
    assert apart["dissipated_energy"][1] > apart["dissipated_energy"][0] * 1.01
    way = Way(STEPPED, table_of)
    radius = float(solve(STEPPED | {DEPTH: low}, ["turning_radius"])["turning_radius"])
    assert abs(way.depth(radius * (1.0 + 1e-5)) - low) < 1e-8, "it is a fold: the depth is stationary there"


def test_the_steps_of_physics() -> None:
    """Of k = 0.1, E* R/dgamma = 500, c0/R = 0.01, lambda/R = 0.2, A = 0.055 both sides of the first fold are known."""
    scene = {"k": 0.1, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.2, "A": 0.055}
    scene["a_max_over_R"] = math.inf
    steps = bracketed(scene, 0.0, 0.05)
    found = solve(scene | {DEPTH: [steps[0] - 1e-9, steps[1] + 1e-9]}, ["pull_off_force", "dissipated_energy"])
    np.testing.assert_allclose(found["pull_off_force"], [0.213, 2.458], atol=2e-3)  # the first one rises to the fold
    np.testing.assert_allclose(found["dissipated_energy"], [0.0050, 0.3028], atol=5e-5)


@pytest.mark.parametrize("turn", [DEPTH, LOAD])
@pytest.mark.parametrize("k", [0.0, 0.6])
def test_long_curves(turn: str, k: float, table_of: Callable[[float], Any]) -> None:
    """Hundreds to millions of waves: the target is met there, and no place of loading before it has it."""
    scene = {"k": k, "nu": 0.3, "modulus": 2000.0, "c0_over_R": 0.01, "a_max_over_R": math.inf}
    for wavelength, height in ((1e-3, 0.01), (1e-4, 0.01), (1e-6, 0.003)):
        one = scene | {"lambda_over_R": wavelength, "A": height * (1e-3 / wavelength) ** 0.4}
        for target in (0.05, 0.6) if turn == DEPTH else (3.0, 300.0):
            found = solve(one | {turn: target}, ["turning_radius", "loading_jumps", "dissipated_energy"])
            radius, way = float(found["turning_radius"]), Way(one, table_of)
            assert radius > 20.0 * wavelength
            value = way.depth if turn == DEPTH else way.load
            size = 1.0 + abs(target)
            assert abs(value(radius) - target) <= 1e-9 * size
            a = radius - wavelength * np.linspace(3.0, 1e-3, 1500)
            depths = np.array([way.depth(x) for x in a])
            visited = depths >= np.maximum.accumulate(depths)
            visited[:500] = False  # of the wave before the first of these nothing is known
            assert np.all(np.array([value(x) for x in a])[visited] <= target + 1e-9 * size)


def test_scenes_that_are_alike() -> None:
    """Similarity: at fixed k and with lengths in L and depths in L^2/R, the modulus drops out."""
    k, factor = 0.4, 7.0
    length = factor ** (-1.0 / (3.0 + k))
    one = WAVY | {"k": k, "a_max_over_R": 0.4}
    other = one | {
        "modulus": one["modulus"] * factor,
        "lambda_over_R": one["lambda_over_R"] * length,
        "A": one["A"] * length,
        "a_max_over_R": 0.4 * length,
    }
    names = ["pull_off_force", "dissipated_energy", "turning_radius", "loading_jumps"]
    wanted = np.array([0.01, 0.03, 0.06])
    mine, theirs = solve(one | {DEPTH: wanted}, names), solve(other | {DEPTH: wanted * length**2}, names)
    np.testing.assert_allclose(theirs["turning_radius"], mine["turning_radius"] * length, rtol=1e-13)
    np.testing.assert_allclose(theirs["pull_off_force"], mine["pull_off_force"], rtol=1e-13)
    np.testing.assert_allclose(theirs["dissipated_energy"], mine["dissipated_energy"] * length**2, rtol=1e-12)
    np.testing.assert_array_equal(theirs["loading_jumps"], mine["loading_jumps"])


def test_the_contact_that_turns_may_be_no_disc() -> None:
    """A weak adhesion: the crest beyond the contact touches before the branch ends, which the check must see."""
    scene = {"k": 0.0, "nu": 0.3, "modulus": 1e7, "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.0116}
    wanted = np.linspace(1e-4, 0.02, 200)
    free = solve(scene | {"a_max_over_R": math.inf, DEPTH: wanted}, ["dissipated_energy", "turning_radius"])
    flagged = (free["status"] & LOADING_NOT_ONE_DISC) != 0
    rim = solve(scene | {"a_max_over_R": free["turning_radius"]}, ["dissipated_energy"])
    assert np.all(flagged | ((rim["status"] & LOADING_NOT_ONE_DISC) == 0)), "a rim there hides what stands beyond it"
    assert np.any(flagged & ((rim["status"] & LOADING_NOT_ONE_DISC) == 0))
    unchecked = solve(scene | {"a_max_over_R": math.inf, DEPTH: wanted}, ["dissipated_energy"], check_contact=False)
    assert not np.any(unchecked["status"] & LOADING_NOT_ONE_DISC)


def test_out_of_range() -> None:
    for turn, wrong in ((DEPTH, [math.nan, math.inf, -math.inf]), (LOAD, [math.nan, math.inf, 0.0, -1.0])):
        found = solve(FREE | {turn: wrong}, OUTPUTS)
        assert np.all(found["status"] == NO_VALUE)
        assert np.isnan(found["turning_radius"]).all()
        assert np.isnan(found["pull_off_force"]).all()
    found = solve(FREE | {"A": 0.0, LOAD: [-1.0, 2.0]}, ["pull_off_force"])
    assert found["status"].tolist() == [NO_VALUE, 0]
    with pytest.raises(ValueError, match="a cycle turns at one of them"):
        solve(FREE | {LOAD: 1.0, DEPTH: 0.1})
    with pytest.raises(ValueError, match="known of the exact solver only"):
        solve(FREE | {LOAD: 1.0}, solver="envelope")


def test_the_pull_off_may_be_where_it_turns() -> None:
    """Turned before the contact can pull its hardest, the force is that at the turn."""
    wanted = np.array([0.0005, 0.001])
    found = solve(FREE | {"A": 0.0, DEPTH: wanted}, ["pull_off_force", "pull_off_radius", "turning_radius"])
    assert np.all(found["pull_off_radius"] <= found["turning_radius"])
    deep = solve(FREE | {"A": 0.05, DEPTH: 1e-4}, ["pull_off_force", "pull_off_radius", "turning_radius"])
    assert deep["status"] & PULL_OFF_AT_RIM or deep["pull_off_radius"] < deep["turning_radius"]


def test_gains_are_over_the_smooth_punch_that_turns_there() -> None:
    found = solve(FREE | {DEPTH: 0.05}, ["adhesion_gain", "energy_gain", "pull_off_force", "dissipated_energy"])
    plain = solve(FREE | {"A": 0.0, DEPTH: 0.05}, ["pull_off_force", "dissipated_energy"])
    assert found["adhesion_gain"] == found["pull_off_force"] / plain["pull_off_force"]
    assert found["energy_gain"] == found["dissipated_energy"] / plain["dissipated_energy"]
