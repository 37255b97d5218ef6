"""What is said of a minimum: other ones, ends of intervals, what has no effect, its status, and what else explains it."""

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from gradhesion.core import solve
from gradhesion.core.loops.fitted import FittedLoop
from gradhesion.core.loops.paths.misfit import Misfit
from gradhesion.core.loops.results import (
    alternatives,
    covariance_of,
    is_on_bound,
    others,
    profile_interval,
    results_at,
    status_of,
)
from gradhesion.core.problem.status import ANOTHER_MINIMUM, JUMP_IN_TO_RIM, POOR_FIT
from tests.core.loops.models import CASES, NOISE, SCENE, UNIT, Array, Case, R, misfit_of, path_of, vector

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


def results(own: Misfit, minima: list[Any], *, widened: bool = False) -> FittedLoop:
    ends = own.named(own.low), own.named(own.high)
    return results_at(own, minima, "linear", {name: (ends[0][name], ends[1][name]) for name in NAMES}, widened=widened)


def test_another_minimum_is_named_with_its_values() -> None:
    own, here = loop()
    best = own.refined(here)
    other = SimpleNamespace(x=best.x + np.array([1.0, 0.0]), cost=best.cost + 0.5)
    found = results(own, [best, other])
    assert found.status & ANOTHER_MINIMUM
    assert not found.status & POOR_FIT
    (named,) = found.others
    assert named.values["E_star"] == pytest.approx(math.e * found.values["E_star"], rel=1e-12)
    assert named.chi_square == pytest.approx(found.chi_square + 1.0, rel=1e-12)
    assert not results(own, [best]).status & ANOTHER_MINIMUM


@pytest.mark.parametrize(("places", "unit", "kept"), VALLEYS)
def test_minima_are_those_that_the_noise_allows_in_other_valleys(places: Any, unit: float, kept: list[float]) -> None:
    found = [SimpleNamespace(x=np.array([x, y]), cost=50.0 + 0.5 * rise) for x, y, rise in [(0.0, 0.0, 0.0), *places]]
    assert [one.x[0] for one in others(found, np.diag([1.0, 4.0]), unit)] == kept


def test_noise_that_was_estimated_widens_intervals() -> None:
    own, here = loop(error=2.0)
    best = own.refined(here)
    given, estimated = (results(own, [best], widened=widened) for widened in (False, True))
    assert given.status & POOR_FIT
    assert estimated.widening == pytest.approx(math.sqrt(given.chi_square / given.degrees_of_freedom), rel=1e-12)
    for name in NAMES:
        expected = estimated.widening * given.standard_deviations[name]
        assert estimated.standard_deviations[name] == pytest.approx(expected, rel=1e-12)


def test_profile_intervals_are_where_the_misfit_has_grown_so_far() -> None:
    """A fit of the rest there has a sum of squares that is larger by the square of the factor, linear or not."""
    own, here = loop(error=8.0)
    best = own.refined(here, tolerance=1e-12).x
    covariance = covariance_of(own, best)
    for number in range(2):
        along = covariance[number] / math.sqrt(covariance[number, number])
        ends = profile_interval(own, best, number, along, 12.0, 1.0)
        assert ends[0] < best[number] < ends[1]
        for end in ends:
            moved = best.copy()
            moved[number] = end
            rise = 2.0 * own.refined(moved, held=[number]).cost - np.sum(own.residual(best) ** 2)
            assert math.sqrt(rise) == pytest.approx(12.0, rel=0.02)
            linear = best[number] + math.copysign(12.0 * along[number], end - best[number])
            assert end == pytest.approx(linear, rel=0.0, abs=2.0 * along[number])


@pytest.mark.parametrize(("value", "ends", "bound"), BOUNDS)
def test_a_bound_is_a_hundredth_of_the_range_wide(value: float, ends: tuple[float, float], *, bound: bool) -> None:
    """Of its logarithm, beyond a factor of 10."""
    assert is_on_bound(value, ends) == bound


def test_the_status_is_that_of_the_scene_and_of_the_rim_that_is_met() -> None:
    """Deep waves touch the surface before they should; a jump that reaches the rim is cut short, at the turn it is not."""
    model = CASES["wavy"].model(("A",))
    for height in (0.012, 0.2):
        scene = SCENE | {"A": height, "a_max_over_R": 0.3}
        expected = int(solve(scene, ["dissipated_energy", "loading_jumps", "unloading_jumps"])["status"])
        assert status_of(model, np.array([math.log(height)]), 0.3) == expected & ~JUMP_IN_TO_RIM
    assert expected != 0
    assert status_of(model, np.array([math.log(0.2)]), 0.0) == 0, "out of contact"
    rim = CASES["rim"].model(("A",), {"a_max": 0.02 * R})
    here = vector(rim)
    for radius in (0.02, np.nextafter(0.02, 0.0)):  # a radius in m, over R, is rounded
        assert status_of(rim, here, radius) & JUMP_IN_TO_RIM
    assert not status_of(model, here, 0.02) & JUMP_IN_TO_RIM


@pytest.mark.parametrize(("case", "names", "noise", "spread", "numbers"), ALIKE)
def test_a_closing_ratio_may_be_fine_waves_and_these_a_closing_ratio(
    case: Case, names: tuple[str, ...], noise: float, spread: float, numbers: tuple[str, ...]
) -> None:
    model = case.model(names)
    if "chi" in case.own:
        model.fixed = {name: value for name, value in model.fixed.items() if name != "A"}
    drawn = path_of(model, vector(model, closing_ratio=0.25, wavelength=2e-3 * R))
    found = alternatives(model, drawn, noise * np.array([R, UNIT]), np.full(len(names), spread))
    assert len(found) == bool(numbers)
    assert all(number in found[0] for number in numbers)
