"""The twin against closed forms, a second quadrature, other programs, loop integrals, its own stored values; and the solver of the core."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from flint import arb

from gradhesion.twin import bounds, stated
from gradhesion.twin.curve import Curve
from gradhesion.twin.energy import dissipated, double_exponential, loop
from gradhesion.twin.integrals import Integral
from gradhesion.twin.path import cycle
from gradhesion.twin.pattern import Pattern
from gradhesion.twin.scene import PARAMETERS, solve, waves_to_follow
from gradhesion.twin.series import Series
from gradhesion.twin.shape import PLAIN, Shape
from gradhesion.twin.special import s0_series, s1_series
from tests.conformance.theory import jump_density
from tests.core.scene import Waves, scene_of
from tests.stress.draw import eventful, hostile

from .compare import Case, compare, of_any_kind, of_one_cosine
from .generate import row

HERE = Path(__file__).parent
REFERENCE = {name: json.loads((HERE.parent / f"reference/{name}.json").read_text()) for name in ("scenes", "general")}
CASES = [*(REFERENCE["scenes"]["scenes"][i] for i in (3, 8, 30, 33, 34, 44, 47)), *REFERENCE["general"]["scenes"]]
"""Seven of one cosine, with k = 0.247, 0.109, 1, 0.999, 1e-6, 0.5, 1e-6, and 24 of any profile and control."""
ULP = 2.0**-52
DRAWS = {
    "hostile": (of_one_cosine(hostile(5, 120)), 30),
    "eventful": (of_one_cosine(eventful(5, 120)), 30),
    "of any kind": (of_any_kind(7, 10), 4),
}


def stored() -> list[dict[str, object]]:
    file = json.loads((HERE / "scenes.json").read_text(encoding="utf-8"))
    return [dict(zip(file["columns"], row, strict=True)) for row in file["scenes"]]


def expected(value: arb, size: float) -> bool:
    """Whether a value is below 1e-40 of a size."""
    return bool(abs(value) < arb("1e-40") * size)


@pytest.mark.parametrize("case", CASES, ids=range(len(CASES)))
def test_reference(case: dict[str, Any]) -> None:
    """To the last bits of doubles."""
    given, shape = dict(case["parameters"]), PLAIN
    if "harmonics" in given:
        waves = tuple((wave["n"], wave["cos"], wave["sin"]) for wave in given.pop("harmonics"))
        shape = Shape(given.pop("exponent"), waves, given.pop("control"))
    solution = solve(given, shape)
    for name in case["expected"].keys() - {"theta", "M"}:
        value = case["expected"][name]
        assert abs(float(getattr(solution, name)) - value) <= 2 * ULP * abs(value), name


@pytest.mark.parametrize("k", [0.0, 2.0**-53, 1e-9, 0.37, 1 - 1e-12, 1.0])
@pytest.mark.parametrize("y", [0.013, 0.25, 3.3, 41.7, 201.0, 438.5])
def test_the_integrals_are_their_definitions(k: float, y: float) -> None:
    """Taylor bins against the series; those of the sine and the cosine by quadrature, k = 1 by elementary functions.

    Beyond 200 Struve's expansion takes over from the series, next to integer orders as well.
    """
    exponent, z = arb(k), arb(y)
    s0, s1 = Series(k, ((1, 1.0, 0.0),)).pair(z)
    value, slope = Integral(exponent, sine=False).at(z)
    assert expected(s0 - s0_series(exponent, z), 1)
    assert expected(s1 - s1_series(exponent, z), 1)
    if k == 1.0:
        assert expected(s0 - (1 - z.cos()) / z, 1)
        assert abs(value - z.sin() / z) < 1e-40
        assert abs(slope - (z.cos() / z - z.sin() / z**2)) < 1e-40
    elif y < 10:  # with t = 1 - u: (1 - t^2)^((k-1)/2) = (u (2 - u))^((k-1)/2)
        rule = [(w * (u * (2 - u)) ** ((exponent - 1) / 2), 1 - u) for u, w in double_exponential()]
        ends = 1e-12 if k > 0 else 1e-18  # the rule ends at u = 1e-40
        assert abs(s0 - sum((w * (z * t).sin() for w, t in rule), arb(0))) < ends
        assert abs(s1 - sum((w * (1 - t * t) * (z * t).sin() for w, t in rule), arb(0))) < 1e-28
        assert abs(value - sum((w * (z * t).cos() for w, t in rule), arb(0))) < ends
        assert abs(slope + sum((w * t * (z * t).sin() for w, t in rule), arb(0))) < ends


def loop_scenes(group: str) -> list[tuple[dict[str, float], Shape]]:
    """Eight scenes: stored ones, or of any kind with few waves and an end of their loops."""
    if group != "general":
        rows = [one for one in stored() if one["group"] == group][::20][:8]
        return [({name: float(str(one[name])) for name in PARAMETERS}, PLAIN) for one in rows]
    made = [(scene, shape) for scene, _, shape in of_any_kind(31, 60, most_harmonics=3)]
    ended = (one for one in made if one[1].control != "load" and one[0]["a_max_over_R"] < math.inf)
    return [one for one in ended if waves_to_follow(*one, cycle=True) <= 20][:8]


@pytest.mark.parametrize(("group", "error"), [("random", "1e-24"), ("hard", "1e-24"), ("general", "1e-30")])
def test_loop_integral(group: str, error: str) -> None:
    """The drops at the jumps sum to the loop integral, also where adhesion is weak and some are negative.

    Of P over what is prescribed, a spring's other end too.
    """
    for scene, shape in loop_scenes(group):
        curve = Curve(scene, shape)
        path, _ = cycle(curve)
        drops = [dissipated(curve, jump) for jump in path.loading + path.unloading]
        size = float(sum((abs(drop) for drop in drops), arb(0)))
        assert abs(sum(drops, arb(0)) - loop(curve, path)) < arb(error) * size


def test_stored_values() -> None:
    """Some stored rows, solved again, give the same doubles, pairs of folds next to each other too; then come margins."""
    pairs = [scene for scene in stored() if str(scene["note"]).endswith("off its tangency by 1e-09")]
    assert len(pairs) == 4
    for scene in (*stored()[:2100:300], *pairs):
        assert row(scene)[:16] == [*scene.values()][:16]


@pytest.mark.parametrize(("k", "nu"), [(0.0, 0.3), (0.45, -0.4), (1.0, 0.5)])
def test_smooth_punch_of_any_wavelength(k: float, nu: float) -> None:
    """Without amplitude the wavelength is nothing, and rim, modulus and depth may be of any size: closed forms."""
    for wavelength, rim in ((1e-12, math.inf), (1e6, 1e9), (0.3, 3e-9)):
        scene = dict(zip(PARAMETERS, (k, nu, 1e9, 1e-7, wavelength, 0.0, rim), strict=True))
        solution = solve(scene)
        curve = Curve(scene)
        s, x = curve.adhesion, arb(k)
        q, first = (1 - x) / 4, ((1 + x) * curve.adhesion) ** (2 / (3 + x))
        if rim > first:
            part = [jump_density(x, p) for p in (q, 1)]
            last = (q * (1 + x) * s) ** (2 / (3 + x)) if k < 1 else arb(0)
            energy = arb.pi() * (part[0] * last * last - part[1] * first * first)
            assert abs(solution.dissipated_energy / energy - 1) < arb("1e-35")
            assert abs(solution.pull_off_force / ((3 + x) / 3) - 1) < arb("1e-35")
        else:
            assert [solution.loading_jumps, solution.unloading_jumps] == [1, 1 if k < 1 else 0]
            assert float(solution.pull_off_radius) == rim


@pytest.mark.parametrize("of", ["toughness", "work"])
def test_slopes_of_kappa_are_those_of_differences(of: str) -> None:
    lengths = {"toughness_wavelength_over_R": 0.13, "toughness_amplitude": 0.9}
    pattern = Pattern(lengths, Shape(pattern=((1, 0.2, -0.1), (3, 0.05, 0.1)), pattern_of=of))
    a, step = arb(0.37), arb(2) ** -40
    around = [pattern.at(a * (1 + sign * step)) for sign in (-1, 0, 1)]
    (low, below, _), (kappa, first, second), (high, above, _) = around
    assert float((high - low) / (2 * step)) == pytest.approx(float(first), rel=1e-10)
    assert float((above - below) / (2 * step)) == pytest.approx(float(second), rel=1e-10)
    assert abs(float(kappa)) <= pattern.greatest


@pytest.mark.parametrize(("m", "waves"), [(1.0, ((2, 3.0, 0.0), (5, 0.0, 2.0))), (1.3, ((1, 4.0, 0.0),))])
def test_the_last_phase_is_one_beyond_which_nothing_pulls(m: float, waves: Waves) -> None:
    """And it is not far beyond: of strong waves on a blunt tip, whose folds may have no end."""
    curve = Curve(scene_of(0.2, 0.3, 500.0, 0.1, 0.1, 0.1, math.inf), Shape(m, waves))
    end = bounds.last(curve, curve.trough)
    places = (np.linspace(*ends, 200).tolist() for ends in ((end, 3 * end), (0.8 * end, end)))
    far, near = ([curve.force(arb(z)) for z in own] for own in places)
    assert all(force > 0 for force in far)
    assert any(force < 0 for force in near)


def test_what_is_solved_does_not_depend_on_the_outputs() -> None:
    """The pull-off alone is that of the whole scene, and each output comes with an error in proportion to its size."""
    scene = {name: float(str(stored()[5][name])) for name in PARAMETERS}
    alone = stated.expected(scene, ["pull_off_force"], "exact")
    everything = stated.expected(scene, sorted(stated.KNOWN), "exact")
    assert set(everything) == stated.KNOWN
    assert float(alone.pop("pull_off_force").value) == float(everything["pull_off_force"].value)
    assert not alone
    depth = everything["delta_max"]
    assert stated.deviation(float(depth.value), depth) <= depth.error
    assert stated.deviation(math.nan, depth) == math.inf
    assert stated.deviation(math.inf, stated.Expected(arb("inf"), 0.0)) == 0.0


def test_what_is_out_of_reach_is_told() -> None:
    """1,000 waves are a bound on the time; the waves of an endless cone never cease to fold, but its pull-off has a value."""
    scene = scene_of(0.3, 0.3, 500.0, 0.01, 1e-3, 0.2, 0.9)
    long, energy = scene | {"lambda_over_R": 5e-4}, ["dissipated_energy"]
    assert stated.within_reach(scene, energy, "exact")
    assert not stated.within_reach(long, energy, "exact")
    assert stated.within_reach(long, energy, "envelope")
    endless, cone = scene_of(0.3, 0.2, 100.0, 0.1, 0.1, 0.1, math.inf), Shape(1.0, ((1, 1.0, 0.0),))
    with pytest.raises(ArithmeticError, match="no end"):
        solve(endless, cone)
    assert not stated.within_reach(endless, energy, "exact", cone)
    assert stated.within_reach(endless, ["pull_off_force"], "exact", cone)
    assert stated.expected(endless, ["pull_off_force"], "exact", cone)["pull_off_force"].value > 0


@pytest.mark.parametrize(("cases", "fewest"), DRAWS.values(), ids=DRAWS)
def test_stated_errors_are_kept(cases: list[Case], fewest: int) -> None:
    made = compare(cases, (0.0, 20.0))
    assert made.scenes >= fewest
    assert made.unsure == 0
    assert made.near <= 4
    assert made.worst <= 1.0
