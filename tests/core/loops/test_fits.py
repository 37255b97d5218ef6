"""Loops with known parameters give them back wherever their zeros are, or the fit says that it is not to be trusted.

What is said of a minimum: other ones, ends of intervals, what has no effect, its status, and what else explains it.
"""

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from gradhesion.core import Loading, draw_curves, solve
from gradhesion.core.loops import results
from gradhesion.core.loops.fit import fit_loop
from gradhesion.core.loops.fitted import CannotTellApartError, FittedLoop, Offsets, poor_from
from gradhesion.core.loops.paths.misfit import Misfit
from gradhesion.core.problem.status import ANOTHER_MINIMUM, JUMP_IN_TO_RIM, POOR_FIT
from gradhesion.core.problem.toughness import Rate
from tests.core.loops.models import CASES, NOISE, SCENE, TURN, UNIT, Array, Case, R, misfit_of, path_of, vector

NU, E_STAR, WORK = 0.3, 1e7, 0.03
FREE = {"E_star": (1e6, 1e8), "work_of_adhesion": (5e-3, 0.2)}
SMOOTH = {"k": 0.0, "nu": NU, "A": 0.0, "R": R}
PULL = 1.5 * math.pi * R * WORK
TRUE = {"E_star": E_STAR, "work_of_adhesion": WORK}
RATE = Rate(exponent=0.6)
NO_OFFSETS = Offsets(indentation=False, load=False)


def ball(
    seed: int, *, points: int = 400, zero: tuple[float, float] = (0.0, 0.0), tilt: float = 0.0, pressed: float = 3.0,
    noise: float = 0.01, stiffness: float = math.inf,
) -> tuple[Array, Array, Any, tuple[float, float]]:  # fmt: skip
    """A loop of a smooth ball by the closed forms of Johnson, Kendall & Roberts (1971), evenly spaced in displacement."""
    a = np.linspace(1e-8, R, 400_001)
    along = a**2 / R - np.sqrt(2.0 * math.pi * a * WORK / E_STAR)
    force = 4.0 * E_STAR * a**3 / (3.0 * R) - np.sqrt(8.0 * math.pi * WORK * E_STAR * a**3)
    along = along + force / stiffness
    along, force = (row[int(np.argmin(along)) :] for row in (along, force))
    deepest = float(np.interp(pressed * PULL, force, along))
    up = np.linspace(4.0 * along[0] - 0.2 * deepest, deepest, points // 2)
    depth, back = np.concatenate([up, up[::-1]]), np.arange(2 * (points // 2)) >= points // 2
    load = np.where(depth > np.where(back, along[0], 0.0), np.interp(depth, along, force), 0.0)
    sizes = (-0.01 * float(along[0]), noise * PULL)
    errors = np.random.default_rng(seed).standard_normal((2, depth.size))
    load = load + sizes[1] * errors[1] + zero[1]
    depth = depth + sizes[0] * errors[0] + zero[0]
    return depth, load + tilt * depth, back, sizes


def holds(found: FittedLoop, true: dict[str, float], sigmas: float = 4.5) -> None:
    """The fit has what the loop was made with, and says that it is sound."""
    assert found.converged
    assert not found.status & (POOR_FIT | ANOTHER_MINIMUM)
    assert found.on_bound == ()
    for name, value in true.items():
        assert abs(found.values[name] - value) < sigmas * found.standard_deviations[name], name
        assert found.ranges[name][0] <= found.low[name] < found.values[name] < found.high[name] <= found.ranges[name][1]
    assert found.chi_square == pytest.approx(found.degrees_of_freedom, rel=6.0 * math.sqrt(2.0 / found.residual.size))


@pytest.mark.parametrize("zero", [(0.0, 0.0), (7e-6, -5e-6), (-3e-7, 40.0 * PULL)])
def test_zeros_may_be_anywhere(zero: tuple[float, float]) -> None:
    *points, noise = ball(3, zero=zero)
    found = fit_loop(*points, SMOOTH, FREE, noise=noise)
    holds(found, TRUE | {"indentation_offset": zero[0], "load_offset": zero[1]})
    assert found.standard_deviations["E_star"] < 0.02 * E_STAR, "the bound means something"


def test_a_largest_load_of_300_times_the_pull_off_force_and_one_branch_alone() -> None:
    *points, noise = ball(4, zero=(2e-7, 3e-7), pressed=300.0, points=800)
    holds(fit_loop(*points, SMOOTH, FREE, noise=noise), TRUE | {"indentation_offset": 2e-7})
    *points, noise = ball(5, zero=(1e-6, 1e-6))
    for own in (points[2], ~points[2]):
        found = fit_loop(*(row[own] for row in points), SMOOTH, FREE, noise=noise)
        holds(found, TRUE | {"indentation_offset": 1e-6})


def test_the_zero_of_depth_at_the_contact_point_and_a_tilt() -> None:
    *points, noise = ball(6, zero=(4e-7, 0.0), tilt=0.02)
    found = fit_loop(*points, SMOOTH, FREE, noise=noise, offsets=Offsets(slope=True))
    holds(found, TRUE | {"load_slope": 0.02})
    found = fit_loop(*points, SMOOTH, FREE, noise=noise, offsets=Offsets(indentation="contact", slope=True))
    assert found.contact is not None
    level = found.values["load_offset"] + found.values["load_slope"] * found.contact.depth
    assert level == pytest.approx(0.02 * 4e-7, abs=2e-9), "the tilt is that of the measured depth"
    *points, noise = ball(6, zero=(4e-7, 0.0))
    found = fit_loop(*points, SMOOTH, FREE, noise=noise, offsets=Offsets(indentation="contact"))
    assert found.contact is not None
    assert found.contact.depth == pytest.approx(4e-7, abs=3e-9)
    assert found.names == (*FREE, "load_offset")
    # an error of the point counts as much as an error of the zero would
    at_zero, nearer = (
        fit_loop(points[0] - zero, *points[1:], SMOOTH, FREE, noise=noise, offsets=Offsets(indentation=False))
        for zero in (4e-7, 4e-7 + found.contact.deviation)
    )
    move = nearer.values["E_star"] - at_zero.values["E_star"]
    expected = math.hypot(move, at_zero.standard_deviations["E_star"])
    assert found.standard_deviations["E_star"] == pytest.approx(expected, rel=0.02)
    assert found.high["E_star"] > TRUE["E_star"] > found.low["E_star"]
    assert found.loading[:, 0].max() == pytest.approx(points[0].max(), abs=20.0 * noise[0]), "the path lies on the data"
    with pytest.raises(ValueError, match="loading has no base line"):
        fit_loop(*(row[points[2]] for row in points), SMOOTH, FREE, noise=noise, offsets=Offsets(indentation="contact"))


def test_a_contact_of_one_work_closes_at_no_more_than_it_opens_at() -> None:
    for seed in (20, 24):  # noise has the minimum on the other side
        *points, noise = ball(seed, zero=(4e-7, 0.0))
        found = fit_loop(*points, SMOOTH, FREE | {"work_of_adhesion_closing": (1e-3, 1.0)}, noise=noise)
        assert found.values["work_of_adhesion_closing"] == found.values["work_of_adhesion"]
        holds(found, TRUE | {"work_of_adhesion_closing": TRUE["work_of_adhesion"]})


def test_means_weigh_as_much_as_their_points() -> None:
    *points, noise = ball(7)
    one = fit_loop(*points, SMOOTH, FREE, noise=noise)
    four = fit_loop(*points, SMOOTH, FREE, noise=(2 * noise[0], 2 * noise[1]), counts=np.full(points[0].size, 4.0))
    for name in FREE:
        assert four.values[name] == pytest.approx(one.values[name], rel=1e-6)
        assert four.standard_deviations[name] == pytest.approx(one.standard_deviations[name], rel=1e-6)


def test_a_model_that_does_not_hold_is_a_poor_fit() -> None:
    *points, noise = ball(8)
    bad = fit_loop(*points, SMOOTH, {"E_star": FREE["E_star"]}
                   | {"work_of_adhesion": (0.1, 0.2)}, noise=noise, offsets=NO_OFFSETS)  # fmt: skip
    assert bad.status & POOR_FIT
    assert "work_of_adhesion" in bad.on_bound
    assert bad.reduced_chi_square > poor_from(bad.degrees_of_freedom)
    assert bad.low["work_of_adhesion"] >= 0.1


def test_valleys_of_a_poor_fit_are_not_all_searched(monkeypatch: pytest.MonkeyPatch) -> None:
    """Loads in a wrong unit: noise has no say in which of hundreds of minima is the lowest."""
    begun, really = [], results.profile_intervals
    monkeypatch.setattr(results, "profile_intervals", lambda *given: begun.append(given) or really(*given))
    (depth, load, back, noise), waves = ball(9, points=200), {"wavelength": (3e-7, 3e-6), "amplitude": (1e-9, 6e-8)}
    punch = {name: value for name, value in SMOOTH.items() if name != "A"}
    bad = fit_loop(depth, load / 1000.0, back, punch, FREE | waves, noise=(noise[0], noise[1] / 1000.0))
    assert bad.status & POOR_FIT
    assert len(begun) < 4


@pytest.mark.parametrize(("high", "flagged"), [(1.004e7, True), (1.5e7, False)])
def test_within_1_per_cent_of_the_range_is_on_its_bound(high: float, flagged: bool) -> None:
    *points, noise = ball(9, noise=1e-3)
    found = fit_loop(*points, SMOOTH, FREE | {"E_star": (5e6, high)}, noise=noise, intervals="profile")
    assert ("E_star" in found.on_bound) == flagged
    assert found.high["E_star"] <= high


def wavy(name: str, seed: int, noise: float, count: int) -> tuple[Array, Array, Any, tuple[float, float]]:
    """A wavy loop of a kind, its points evenly along the path of `draw_curves`, with zeros."""
    drawn = CASES[name].drawn()
    x, y = drawn["x"], drawn["y"]
    way = np.append(0.0, np.cumsum(np.hypot(np.diff(x) / np.ptp(x), np.diff(y) / np.ptp(y))))
    at = np.linspace(0.0, way[-1], count)
    back = drawn["path_unloading"][np.clip(np.searchsorted(way, at), 0, way.size - 1)] > 0
    sizes = (0.1 * noise * float(np.ptp(x)), -noise * float(y.min()))
    errors = np.random.default_rng(seed).standard_normal((2, count))
    return (np.interp(at, way, x) + sizes[0] * errors[0] + 2e-6, np.interp(at, way, y) + sizes[1] * errors[1] - 3e-7,
            back, sizes)  # fmt: skip


WAVES = FREE | {"wavelength": (0.2e-6, 1.5e-6), "A": (0.002, 0.05)}


def test_waves_zeros_and_material_at_once() -> None:
    *points, noise = wavy("wavy", 1, 0.01, 500)
    found = fit_loop(*points, {"k": 0.0, "nu": NU, "R": R}, WAVES, noise=noise)
    holds(found, TRUE | {"wavelength": 0.5e-6, "A": 0.012, "indentation_offset": 2e-6, "load_offset": -3e-7}, 5.0)
    np.testing.assert_allclose(found.correlation, found.correlation.T, atol=1e-12)
    np.testing.assert_allclose(np.diag(found.correlation), 1.0, rtol=1e-12)
    assert found.alike == ()


def test_the_intervals_of_smooth_loops_cover_the_truth() -> None:
    """Of 20 loops the 95 % intervals of each number hold it in 15 or more: fewer have a chance of 3e-4."""
    covered = dict.fromkeys(FREE, 0)
    for seed in range(20):
        *points, noise = ball(seed, points=150)
        found = fit_loop(*points, SMOOTH, FREE, noise=noise, offsets=NO_OFFSETS)
        for name in FREE:
            covered[name] += found.low[name] <= TRUE[name] <= found.high[name]
    assert min(covered.values()) >= 15


@pytest.mark.parametrize("pair", [("E_star", "c0"), ("E_star", "nu"), ("c0", "nu")])
def test_what_a_loop_cannot_tell_apart_is_refused(pair: tuple[str, str]) -> None:
    ranges = {"E_star": (1e6, 1e8), "c0": (1e-7, 1e-5), "nu": (0.1, 0.5)}
    fixed = {"k": 0.3, "nu": NU, "A": 0.0, "R": R, "E_star": 1e7, "c0": 1e-6, "work_of_adhesion": 0.03}
    *points, noise = ball(0)
    with pytest.raises(CannotTellApartError, match=f"cannot tell {pair[0]} and {pair[1]} apart") as caught:
        fit_loop(*points, {n: v for n, v in fixed.items() if n not in pair}, {n: ranges[n] for n in pair}, noise=noise)
    assert caught.value.names == pair


def test_what_one_scale_locks_together_and_what_has_no_effect_is_refused_by_name() -> None:
    """R times s, work over s and E* over the root of s are the same loop of a smooth ball."""
    *points, noise = ball(0)
    free = FREE | {"R": (0.2 * R, 4.0 * R)}
    with pytest.raises(CannotTellApartError) as caught:
        fit_loop(*points, {"k": 0.0, "nu": NU, "A": 0.0}, free, noise=noise)
    assert set(free) <= set(caught.value.names)
    with pytest.raises(ValueError, match="wavelength: without effect on this loop; fix it"):
        fit_loop(*points, SMOOTH, FREE | {"wavelength": (1e-7, 1e-6)}, noise=noise)


def test_a_gradient_may_be_searched_from_0() -> None:
    *points, noise = ball(0)
    found = fit_loop(*points, {"nu": NU, "A": 0.0, "R": R, "c0": R}, FREE | {"k": (0.0, 0.9)}, noise=noise)
    assert found.converged
    assert found.low["k"] >= 0.0
    assert found.values["k"] < 0.02
    assert "k" in found.on_bound


def test_a_turn_between_points_leaves_what_is_found_with_unequal_works() -> None:
    """The deepest point is 3 nm short of the turn, ten times the noise: the edge is pinned 3 nm deeper."""
    depth, load, back, noise = wavy("closing ratio 0.3", 1, 0.01, 500)
    own = depth < depth.max() - 3e-9
    free = WAVES | {"closing_ratio": (0.01, 1.0)}
    found = fit_loop(depth[own], load[own], back[own], {"k": 0.0, "nu": NU, "R": R}, free, noise=noise)
    holds(found, TRUE | {"wavelength": 0.5e-6, "A": 0.012, "closing_ratio": 0.3})
    assert abs(found.values["E_star"] - E_STAR) < 3.0 * found.standard_deviations["E_star"], "4 if it is the deepest"
    assert found.names == (*free, "indentation_offset", "load_offset")
    assert found.residual.size == np.count_nonzero(own)


@pytest.mark.slow
@pytest.mark.parametrize("one", ["speed_over_reference", "exponent"])
def test_the_speed_of_the_edge_or_its_exponent_comes_back_with_the_material(one: str) -> None:
    """From an eighth of the points of a drawn path, and a base line."""
    value, ends = (0.6, (0.3, 0.9)) if one == "exponent" else (0.3, (0.01, 10.0))
    scene = SCENE | {"A": 0.0, "a_max_over_R": math.inf, "indentation_max_over_R": TURN, "speed_over_reference": 0.3}
    path = {name.removeprefix("path_"): row[::8] for name, row in draw_curves(scene, ["path"], rate=RATE)[0].items()}
    line = R * (path["indentation"].min() + np.linspace(-0.02, 0.0, 20))
    depth, load = np.append(line, R * path["indentation"]), np.append(0.0 * line, UNIT * path["load"])
    back, noise = np.append(line > 0.0, path["unloading"] == 1), (2e-5 * R, 0.01 * UNIT)
    errors = np.random.default_rng(4).standard_normal((2, depth.size))
    fixed = SMOOTH if one == "speed_over_reference" else SMOOTH | {"speed_over_reference": 0.3}
    found = fit_loop(
        depth + noise[0] * errors[0], load + noise[1] * errors[1], back, fixed, FREE | {one: ends},
        noise=noise, offsets=NO_OFFSETS, rate=RATE,
    )  # fmt: skip
    holds(found, TRUE | {one: value})
    assert all(found.standard_deviations[name] < 0.2 * found.values[name] for name in found.names)


NAMES = ("E_star", "work_of_adhesion")
FINE = Case({"chi": 0.2, "wavelength": 2e-3 * R})
VALLEYS = [
    ([(20.0, 0.0, 2.0)], 1.0, [20.0]),
    ([(2.0, 2.0, 2.0)], 1.0, []),  # the same valley
    ([(4.0, 0.0, 5.0)], 1.0, []),  # a parabola has risen by 16: on its slope
    ([(40.0, 0.0, 6.5)], 1.0, []),  # 95 % of chi square of two numbers are below 5.99
    ([(40.0, 0.0, 6.5)], 1.2, [40.0]),
    ([(20.0, 0.0, 1.0), (20.5, 0.0, 1.1), (-20.0, 0.0, 1.2)], 1.0, [20.0, -20.0]),  # one of two alike
]
BOUNDS = [(1.009, (1.0, 2.0), True), (1.011, (1.0, 2.0), False), (1.04, (1.0, 100.0), True), (1.05, (1.0, 100.0), False),
 (96.0, (1.0, 100.0), True), (-0.99, (-1.0, 1.0), True), (0.0, (-1.0, 1.0), False)]  # fmt: skip
ALIKE = [
    # the roots of the works are as 1 - chi to 1 + chi: 1/2 is that of chi = 1/3
    (Case({"A": 0.0}), ("E_star", "closing_ratio"), 1e-3, 1.0, ("chi = 0.333", "closing_ratio = 0.25")),
    (Case({"A": 0.0, "closing_ratio": 0.25}), ("E_star",), 1e-3, 1.0, ()),  # it is not fitted
    (FINE, ("wavelength",), 10.0, 1.0, ("closing_ratio = 0.444 ", "1.44 times the work of adhesion")),
    (FINE, ("wavelength",), 1e-7, 1.0, ()),  # the jumps are seen
    (FINE, ("wavelength",), 10.0, 1e-6, ()),  # the wavelength is known
]


def loop(error: float = 1.0) -> tuple[Misfit, Array]:
    """A loop of a smooth ball with noise, and the numbers it was made with."""
    model = CASES["smooth"].model(NAMES)
    here = vector(model)
    drawn = path_of(model, here)
    places = drawn.places + error * np.random.default_rng(3).standard_normal(drawn.places.shape) * NOISE
    return misfit_of(model, here, places, np.arange(len(places)) > drawn.turn, wide=2.0), here


def found_at(own: Misfit, minima: list[Any], *, widened: bool = False) -> FittedLoop:
    low, high = own.named(own.low), own.named(own.high)
    ends = {name: (low[name], high[name]) for name in NAMES}
    return results.results_at(own, minima, "linear", ends, widened=widened)


def test_another_minimum_is_named_with_its_values() -> None:
    own, here = loop()
    best = own.refined(here)
    other = SimpleNamespace(x=best.x + np.array([1.0, 0.0]), cost=best.cost + 0.5)
    found = found_at(own, [best, other])
    assert found.status & ANOTHER_MINIMUM
    assert not found.status & POOR_FIT
    (named,) = found.others
    assert named.values["E_star"] == pytest.approx(math.e * found.values["E_star"], rel=1e-12)
    assert named.chi_square == pytest.approx(found.chi_square + 1.0, rel=1e-12)
    assert not found_at(own, [best]).status & ANOTHER_MINIMUM


@pytest.mark.parametrize(("places", "unit", "kept"), VALLEYS)
def test_minima_are_those_that_the_noise_allows_in_other_valleys(places: Any, unit: float, kept: list[float]) -> None:
    found = [SimpleNamespace(x=np.array([x, y]), cost=50.0 + 0.5 * rise) for x, y, rise in [(0.0, 0.0, 0.0), *places]]
    assert [one.x[0] for one in results.others(found, np.diag([1.0, 4.0]), unit)] == kept


def test_noise_that_was_estimated_widens_intervals() -> None:
    own, here = loop(error=2.0)
    best = own.refined(here)
    given, estimated = (found_at(own, [best], widened=widened) for widened in (False, True))
    assert given.status & POOR_FIT
    assert estimated.widening == pytest.approx(math.sqrt(given.chi_square / given.degrees_of_freedom), rel=1e-12)
    for name in NAMES:
        expected = estimated.widening * given.standard_deviations[name]
        assert estimated.standard_deviations[name] == pytest.approx(expected, rel=1e-12)


def test_profile_intervals_are_where_the_misfit_has_grown_so_far() -> None:
    """A fit of the rest there has a sum of squares that is larger by the square of the factor, linear or not."""
    own, here = loop(error=8.0)
    least = own.refined(here, tolerance=1e-12)
    best = least.x
    covariance = results.covariance_of(own, best)
    ways = covariance / np.sqrt(np.diag(covariance))[:, None]
    both, _ = results.profile_intervals(own, least, ways, 12.0, 1.0)
    for number, (along, ends) in enumerate(zip(ways, both.T, strict=True)):
        assert ends[0] < best[number] < ends[1]
        for end in ends:
            moved = best.copy()
            moved[number] = end
            rise = 2.0 * own.refined(moved, held=[number]).cost - np.sum(own.residual(best) ** 2)
            assert math.sqrt(rise) == pytest.approx(12.0, rel=0.02)
            linear = best[number] + math.copysign(12.0 * along[number], end - best[number])
            assert end == pytest.approx(linear, rel=0.0, abs=2.0 * along[number])


@pytest.mark.parametrize("ends", [(1.2 * E_STAR, 10.0 * E_STAR), (0.1 * E_STAR, 0.9 * E_STAR)])
def test_an_interval_ends_where_its_range_does(ends: tuple[float, float]) -> None:
    *points, noise = ball(3)
    found = fit_loop(*points, SMOOTH, FREE | {"E_star": ends}, noise=noise, intervals="profile")
    assert found.on_bound == ("E_star",)
    assert ends[0] <= found.low["E_star"] <= found.values["E_star"] <= found.high["E_star"] <= ends[1]
    assert found.high["E_star"] - found.low["E_star"] < 1e-3 * E_STAR


@pytest.mark.parametrize("seed", [9, 16, 36])
def test_what_the_noise_allows_is_within_its_profile_interval(seed: int) -> None:
    """Jumps pass few points as the zero of depth moves, so that the misfit has corners, and plateaus beside them."""
    fixed = SMOOTH | {"spring_constant": 0.2 * E_STAR * R}
    depth, load, back, noise = ball(seed, points=80, stiffness=fixed["spring_constant"])
    before = slice(0, int(np.argmin(np.where(back, load, np.inf))) - 6)  # the retraction ends before the pull-off
    points, how = (depth[before], load[before], back[before]), {"noise": noise, "loading": Loading(control="machine")}
    found = fit_loop(*points, fixed, FREE, intervals="profile", **how)
    at_zero = fit_loop(*points, fixed, FREE, offsets=Offsets(indentation=False), **how)
    assert 0.0 < at_zero.chi_square - found.chi_square < 3.0
    assert found.low["indentation_offset"] < 0.0 < found.high["indentation_offset"]


@pytest.mark.parametrize(("value", "ends", "bound"), BOUNDS)
def test_a_bound_is_a_hundredth_of_the_range_wide(value: float, ends: tuple[float, float], *, bound: bool) -> None:
    """Of its logarithm, beyond a factor of 10."""
    assert results.is_on_bound(value, ends) == bound


def test_the_status_is_that_of_the_scene_and_of_the_rim_that_is_met() -> None:
    """Deep waves touch the surface before they should; a jump that reaches the rim is cut short, at the turn it is not."""
    model = CASES["wavy"].model(("A",))
    for height in (0.012, 0.2):
        scene = SCENE | {"A": height, "a_max_over_R": 0.3}
        expected = int(solve(scene, ["dissipated_energy", "loading_jumps", "unloading_jumps"])["status"])
        assert results.status_of(model, np.array([math.log(height)]), 0.3) == expected & ~JUMP_IN_TO_RIM
    assert expected != 0
    assert results.status_of(model, np.array([math.log(0.2)]), 0.0) == 0, "out of contact"
    rim = CASES["rim"].model(("A",), {"a_max": 0.02 * R})
    here = vector(rim)
    for radius in (0.02, np.nextafter(0.02, 0.0)):  # a radius in m, over R, is rounded
        assert results.status_of(rim, here, radius) & JUMP_IN_TO_RIM
    assert not results.status_of(model, here, 0.02) & JUMP_IN_TO_RIM


@pytest.mark.parametrize(("case", "names", "noise", "spread", "numbers"), ALIKE)
def test_a_closing_ratio_may_be_fine_waves_and_these_a_closing_ratio(
    case: Case, names: tuple[str, ...], noise: float, spread: float, numbers: tuple[str, ...]
) -> None:
    model = case.model(names)
    if "chi" in case.own:
        model.fixed = {name: value for name, value in model.fixed.items() if name != "A"}
    drawn = path_of(model, vector(model, closing_ratio=0.25, wavelength=2e-3 * R))
    found = results.alternatives(model, drawn, noise * np.array([R, UNIT]), np.full(len(names), spread))
    assert len(found) == bool(numbers)
    assert all(number in found[0] for number in numbers)
