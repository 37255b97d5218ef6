"""Starts lie near the truth wherever contact is, and in the valley of the right number of waves."""

import math

import numpy as np
import pytest

from gradhesion.core.loops.paths.misfit import Data, Misfit
from gradhesion.core.loops.paths.model import WAVES
from gradhesion.core.loops.starts import matched, spectrum, starts
from tests.core.loops.models import CASES, TRUE, TURN, UNIT, Array, R, vector

NOISE = (1e-4 * R, 0.01 * UNIT)


def loop(name: str, names: tuple[str, ...], zero: float = 0.0, load: float = 0.0) -> tuple[Misfit, Array]:
    """A loop with noise whose contact is at a depth, its ranges two decades wide and aside of the truth; the truth."""
    model = CASES[name].model(names)
    model.furthest = (TURN * R + zero, -math.inf)
    model.first = zero - 0.1 * R
    here = vector(model, indentation_offset=zero, load_offset=load)
    drawn = model.path(here)
    assert drawn is not None
    places = drawn.places + np.random.default_rng(2).standard_normal(drawn.places.shape) * NOISE
    back = np.arange(len(places)) > drawn.turn
    known = {"indentation_offset": R, "load_offset": 10.0 * UNIT, "wavelength": 1.15, "A": 1.15}
    wide = np.array([known.get(one, 2.3) for one in names])
    low, high = here - wide * 1.1, here + wide * 0.8
    return Misfit(Data(places, back, NOISE, np.ones(back.size)), model, low, high), here


@pytest.mark.parametrize("zero", [0.0, 40.0 * R])
@pytest.mark.parametrize("known", [True, False])
def test_of_a_smooth_punch_the_best_start_is_near_the_truth_wherever_contact_is(zero: float, known: bool) -> None:
    names = ("E_star", "work_of_adhesion", "indentation_offset", "load_offset")
    own, here = loop("smooth", names, zero, -3.0 * UNIT)
    best = starts(own, -3.0 * UNIT, zero if known else math.nan, 16, 0)[0]
    np.testing.assert_allclose(best[:2], here[:2], atol=0.2)
    assert abs(best[2] - zero) < 100.0 * NOISE[0]


def test_the_largest_load_gives_the_modulus() -> None:
    """Contact without adhesion is 4/3 E* sqrt(R) delta^(3/2)."""
    own, here = loop("smooth", ("E_star", "work_of_adhesion"))
    depth, load = own.data.points[int(np.argmax(own.data.points[:, 0]))]
    found = matched(own, here + np.array([0.5, 0.0]), -3.0 * UNIT)
    assert math.exp(found[0]) == pytest.approx((load + 3.0 * UNIT) / (4.0 / 3.0 * math.sqrt(R) * depth**1.5), rel=1e-12)


def test_the_wavelength_is_among_the_peaks_and_a_start_ends_at_the_truth() -> None:
    own, here = loop("wavy", ("E_star", "work_of_adhesion", "wavelength", "A"))
    smooth = own.without(WAVES, A=0.0)
    assert smooth.names == ("E_star", "work_of_adhesion")
    ends = math.exp(own.low[2]), math.exp(own.high[2])
    peaks = spectrum(smooth, starts(smooth, 0.0, 0.0, 16, 0)[0], ends)
    assert np.abs(np.log(peaks[:6]) - here[2]).min() < 0.15
    assert np.all((peaks >= ends[0]) & (peaks <= ends[1]))
    found = own.refined(starts(own, 0.0, 0.0, 16, 0)[0], most=100).x
    np.testing.assert_allclose(found, here, atol=0.05)
    assert math.exp(found[2]) == pytest.approx(TRUE["wavelength"], rel=0.01)
