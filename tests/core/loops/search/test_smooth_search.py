"""Starts of smooth punches: contact anywhere in the data, and the modulus that the largest load asks for."""

import math

import numpy as np
import pytest

from gradhesion.core.loops.paths.misfit import Data, Misfit
from gradhesion.core.loops.search.smooth_search import held_start, matched, smooth_starts
from tests.core.loops.models import CASES, TURN, UNIT, Array, R, vector

NOISE = (1e-4 * R, 0.01 * UNIT)
NAMES = ("E_star", "work_of_adhesion", "indentation_offset", "load_offset")


def loop(zero: float) -> tuple[Misfit, Array]:
    """A smooth loop whose contact is at a depth, with the ranges of a decade either way."""
    model = CASES["smooth"].model(NAMES)
    model.furthest = (TURN * R + zero, -math.inf)
    model.first = zero - 0.1 * R
    here = vector(model, indentation_offset=zero, load_offset=-3.0 * UNIT)
    drawn = model.path(here)
    assert drawn is not None
    places = drawn.places + np.random.default_rng(1).standard_normal(drawn.places.shape) * NOISE
    back = np.arange(len(places)) > drawn.turn
    wide = np.array([math.log(10.0), math.log(10.0), R, 10.0 * UNIT])
    data = Data(places, back, NOISE, np.ones(back.size))
    return Misfit(data, model, here - wide * [1.4, 0.6, 0.3, 1.0], here + wide * [0.6, 1.4, 1.7, 1.0]), here


@pytest.mark.parametrize("zero", [0.0, 40.0 * R])
def test_the_best_start_is_near_the_truth_wherever_contact_is(zero: float) -> None:
    own, here = loop(zero)
    for contact in (zero, math.nan):
        best = smooth_starts(own, -3.0 * UNIT, contact, seed=0)[0]
        np.testing.assert_allclose(best[:2], here[:2], atol=0.2)
        assert abs(best[2] - zero) < 100.0 * NOISE[0]


def test_the_largest_load_gives_the_modulus() -> None:
    """Contact without adhesion is 4/3 E* sqrt(R) delta^(3/2)."""
    own, here = loop(0.0)
    deepest = int(np.argmax(own.points[:, 0]))
    depth, load = own.points[deepest] * own.scale
    found = matched(own, here + np.array([0.5, 0.0, 0.0, 0.0]), -3.0 * UNIT)
    expected = (load + 3.0 * UNIT) / (4.0 / 3.0 * math.sqrt(R) * depth**1.5)
    assert math.exp(found[0]) == pytest.approx(expected, rel=1e-12)


def test_what_is_held_stays_at_the_base_line() -> None:
    own, here = loop(0.0)
    found = held_start(own, here, -3.1 * UNIT, 1e-3 * R)
    assert (found[2], found[3]) == (1e-3 * R, -3.1 * UNIT)
