"""The wavelength of a loop is among those in which the residual of a smooth punch repeats, and waves are found."""

import math

import numpy as np
import pytest

from gradhesion.core.loops.paths.misfit import Data, Misfit
from gradhesion.core.loops.paths.model import WAVES
from gradhesion.core.loops.search.smooth_search import smooth_starts
from gradhesion.core.loops.search.starts import without
from gradhesion.core.loops.search.wave_search import spectrum, wavy_starts
from tests.core.loops.models import CASES, TRUE, UNIT, Array, R, vector

NOISE = (1e-4 * R, 0.01 * UNIT)
NAMES = ("E_star", "work_of_adhesion", "wavelength", "A")
OFF = np.array([0.3, -0.4, 0.5, -0.2])


@pytest.fixture
def loops() -> tuple[Misfit, Misfit, Array]:
    """A wavy loop with ranges of two decades that lie aside of the truth, the same of a smooth punch, and the truth."""
    model = CASES["wavy"].model(NAMES)
    here = vector(model)
    drawn = model.path(here)
    assert drawn is not None
    places = drawn.places + np.random.default_rng(2).standard_normal(drawn.places.shape) * NOISE
    back = np.arange(len(places)) > drawn.turn
    wide = math.log(10.0) * np.array([1.0, 1.0, 0.5, 0.5])
    low, high = here + OFF - wide, here + OFF + wide
    data = Data(places, back, NOISE, np.ones(back.size))
    fixed, names = without(model, WAVES)
    bare = CASES["smooth"].model(names)
    bare.fixed = fixed | {"A": 0.0}
    return Misfit(data, model, low, high), Misfit(data, bare, low[:2], high[:2]), here


def test_the_wavelength_is_among_the_peaks(loops: tuple[Misfit, Misfit, Array]) -> None:
    wavy, smooth, here = loops
    best = smooth_starts(smooth, 0.0, 0.0, seed=0)[0]
    ends = math.exp(wavy.low[2]), math.exp(wavy.high[2])
    peaks = spectrum(smooth, best, ends)
    assert np.abs(np.log(peaks[:6]) - here[2]).min() < 0.15
    assert np.all((peaks >= ends[0]) & (peaks <= ends[1]))


def test_one_of_the_starts_ends_at_the_truth(loops: tuple[Misfit, Misfit, Array]) -> None:
    wavy, smooth, here = loops
    starts = wavy_starts(wavy, smooth, smooth_starts(smooth, 0.0, 0.0, seed=0)[:1], 16)
    found = wavy.refined(starts[0], most=100).x
    np.testing.assert_allclose(found, here, atol=0.05)
    assert math.exp(found[2]) == pytest.approx(TRUE["wavelength"], rel=0.01)
