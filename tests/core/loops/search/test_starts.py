"""Parts of loops without waves or speeds, and values evenly within a range."""

import numpy as np

from gradhesion.core.loops.paths.misfit import Data, Misfit
from gradhesion.core.loops.paths.model import WAVES
from gradhesion.core.loops.search.speed import NAMES_OF_SPEED
from gradhesion.core.loops.search.starts import shares_of, without
from tests.core.loops.models import CASES, UNIT, R, vector


def test_without_waves_only_the_material_is_searched() -> None:
    fixed, names = without(CASES["wavy"].model(("E_star", "work_of_adhesion", "wavelength")), WAVES)
    assert names == ("E_star", "work_of_adhesion")
    assert not {"A", "wavelength"} & fixed.keys()
    assert fixed["R"] == R


def test_at_rest_there_is_no_speed() -> None:
    model = CASES["smooth"].model(("E_star", "speed", "exponent"), {"reference_speed": 1e-6})
    fixed, names = without(model, NAMES_OF_SPEED)
    assert names == ("E_star",)
    assert "reference_speed" not in fixed


def test_shares_are_even_and_within_the_range() -> None:
    model = CASES["smooth"].model(("E_star",))
    data = Data(np.zeros((2, 2)), np.zeros(2, bool), (R, UNIT), np.ones(2))
    here = vector(model)
    found = shares_of(Misfit(data, model, here - 1.0, here + 3.0), 0, 2)
    np.testing.assert_allclose(found, [here[0], here[0] + 2.0], rtol=1e-14)
