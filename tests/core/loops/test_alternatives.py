"""What else would explain a loop is said where no jump can be seen, with the numbers that fine waves act by."""

import numpy as np
import pytest

from gradhesion.core import solve
from gradhesion.core.closed.reduced import parameters_from
from gradhesion.core.loops.alternatives import alternatives
from tests.core.loops.models import SCENE, UNIT, Case, R, vector

FINE = Case({"chi": 0.2, "wavelength": 2e-3 * R})
"""Five hundred waves in a radius."""


def said(case: Case, names: tuple[str, ...], noise: float) -> tuple[str, ...]:
    model = case.model(names)
    drawn = model.path(vector(model, closing_ratio=0.25))
    assert drawn is not None
    return alternatives(model, drawn, np.array([noise * R, noise * UNIT]), np.ones(len(names)))


def test_a_closing_ratio_may_be_fine_waves() -> None:
    """The roots of the works are as 1 - chi to 1 + chi: 1/2 is that of chi = 1/3."""
    (sentence,) = said(Case({"A": 0.0}), ("E_star", "closing_ratio"), 1e-3)
    assert "chi = 0.333" in sentence
    assert "closing_ratio = 0.25" in sentence
    assert said(Case({"A": 0.0, "closing_ratio": 0.25}), ("E_star",), 1e-3) == (), "it is not fitted"


def test_fine_waves_may_be_a_closing_ratio() -> None:
    model = FINE.model(("wavelength",))
    model.fixed.pop("A")
    drawn = model.path(vector(model, wavelength=2e-3 * R))
    assert drawn is not None
    (sentence,) = alternatives(model, drawn, np.array([0.1 * R, 10.0 * UNIT]), np.array([1.0]))
    assert "closing_ratio = 0.444 " in sentence
    assert "1.44 times the work of adhesion" in sentence
    assert alternatives(model, drawn, np.array([1e-7 * R, 1e-7 * UNIT]), np.array([1.0])) == (), "the jumps are seen"
    assert alternatives(model, drawn, np.array([0.1 * R, 10.0 * UNIT]), np.array([1e-6])) == (), (
        "the wavelength is known"
    )


def test_so_they_pull_off() -> None:
    """The force of the fine waves is that of a smooth punch with (1 + chi)^2 times the work: 1.44 at k = 0."""
    wavy = {name: value for name, value in SCENE.items() if name != "A"} | {"chi": 0.2, "lambda_over_R": 1e-4}
    made = parameters_from(wavy | {"a_max_over_R": np.inf})
    force = float(solve(made, ["pull_off_force"], threads=1)["pull_off_force"])
    assert force == pytest.approx(1.44, rel=1e-2)
