"""What is said of a minimum: other ones with their values, ends within the ranges, and what has no effect."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from gradhesion.core.loops.fitted import CannotTellApartError
from gradhesion.core.loops.paths.misfit import Data, Misfit
from gradhesion.core.loops.results import covariance_of, results_at
from gradhesion.core.problem.status import ANOTHER_MINIMUM, POOR_FIT
from tests.core.loops.models import CASES, UNIT, Array, R, vector

NOISE = (1e-4 * R, 0.01 * UNIT)
NAMES = ("E_star", "work_of_adhesion")


def loop(error: float = 1.0, low: float = 2.0) -> tuple[Misfit, Array]:
    """A smooth loop with noise, and the numbers it was made with."""
    model = CASES["smooth"].model(NAMES)
    here = vector(model)
    drawn = model.path(here)
    assert drawn is not None
    places = drawn.places + error * np.random.default_rng(3).standard_normal(drawn.places.shape) * NOISE
    data = Data(places, np.arange(len(places)) > drawn.turn, NOISE, np.ones(len(places)))
    return Misfit(data, model, here - low, here + 2.0), here


def ranges(own: Misfit) -> dict[str, tuple[float, float]]:
    ends = own.named(own.low), own.named(own.high)
    return {name: (ends[0][name], ends[1][name]) for name in own.names}


def test_another_minimum_is_named_with_its_values() -> None:
    own, here = loop()
    best = own.refined(here)
    other = SimpleNamespace(x=best.x + np.array([1.0, 0.0]), cost=best.cost + 0.5)
    found = results_at(own, [best, other], "linear", ranges(own), widened=False)
    assert found.status & ANOTHER_MINIMUM
    assert not found.status & POOR_FIT
    (named,) = found.others
    assert named.values["E_star"] == pytest.approx(math.e * found.values["E_star"], rel=1e-12)
    assert named.chi_square == pytest.approx(found.chi_square + 1.0, rel=1e-12)
    alone = results_at(own, [best], "linear", ranges(own), widened=False)
    assert not alone.status & ANOTHER_MINIMUM


def test_noise_that_was_estimated_widens_intervals() -> None:
    own, here = loop(error=2.0)
    best = own.refined(here)
    given, estimated = (results_at(own, [best], "linear", ranges(own), widened=widened) for widened in (False, True))
    assert given.status & POOR_FIT
    assert estimated.widening == pytest.approx(math.sqrt(given.chi_square / given.degrees_of_freedom), rel=1e-12)
    for name in NAMES:
        expected = estimated.widening * given.standard_deviations[name]
        assert estimated.standard_deviations[name] == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("intervals", ["linear", "profile"])
def test_an_interval_ends_at_the_range(intervals: str) -> None:
    own, here = loop(low=1e-5)
    best = own.refined(here)
    found = results_at(own, [best], intervals, ranges(own), widened=False)
    assert found.low["E_star"] >= ranges(own)["E_star"][0] * (1.0 - 1e-12)
    assert "E_star" in found.on_bound


def test_what_acts_alike_has_no_covariance() -> None:
    model = CASES["smooth"].model(("E_star", "c0"), {"k": 0.3})
    here = vector(model, c0=0.1 * R)
    drawn = model.path(here)
    assert drawn is not None
    data = Data(drawn.places, np.arange(len(drawn.places)) > drawn.turn, NOISE, np.ones(len(drawn.places)))
    with pytest.raises(CannotTellApartError, match="E_star and c0"):
        covariance_of(Misfit(data, model, here - 1.0, here + 1.0), here)


def test_one_number_without_effect_is_refused() -> None:
    """A rim that is not met, searched alone: all derivatives are 0."""
    model = CASES["smooth"].model(("a_max",))
    here = vector(model, a_max=10.0 * R)
    drawn = model.path(here)
    assert drawn is not None
    data = Data(drawn.places, np.arange(len(drawn.places)) > drawn.turn, NOISE, np.ones(len(drawn.places)))
    with pytest.raises(ValueError, match="a_max: without effect on this loop; fix it"):
        covariance_of(Misfit(data, model, here - 1.0, here + 1.0), here)
