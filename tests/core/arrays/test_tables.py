"""Tables are made for what is asked, once: by their number, and by what of them is read."""

from typing import Any

import numpy as np
import pytest

from gradhesion.core import OUTPUTS, solve
from gradhesion.core.arrays import tables

SCENES = {
    "k": 0.3,
    "nu": 0.3,
    "modulus": 430.0,
    "c0_over_R": 0.013,
    "lambda_over_R": 0.11,
    "A": 0.023,
    "a_max_over_R": 1.7,
}
OF_THE_MATERIAL = ("k", "rounding", "amplitude", "phase", "cos_phase", "sin_phase", "theta", "theta_front", "recipes")
"""Fields of a table that do not belong to the waves."""


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """The exponents whose tables are made, none being kept from before."""
    exponents: list[float] = []
    really = tables.build_table

    def build_table(k: float) -> Any:
        exponents.append(k)
        return really(k)

    monkeypatch.setattr(tables, "build_table", build_table)
    tables._own.cache_clear()
    return exponents


@pytest.mark.parametrize("outputs", [["pull_off_force"], OUTPUTS])
def test_one_exponent_has_one_table(outputs: list[str], made: list[float]) -> None:
    rims = np.linspace(0.1, 1.7, 40)
    for modulus in (430.0, 431.0):
        solve(SCENES | {"modulus": modulus, "lambda_over_R": np.array([[0.1], [0.2]]), "a_max_over_R": rims}, outputs)
    assert made == [0.3]


def test_each_exponent_has_a_table(made: list[float]) -> None:
    exponents = np.array([0.1, 0.5, 0.1, 0.0, 0.5])
    solve(SCENES | {"k": exponents}, ["pull_off_force"])
    assert sorted(made) == [0.0, 0.1, 0.5]


def test_a_smooth_scene_reads_nothing_of_the_waves(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where all that belongs to waves is NaN, every output of a smooth punch is the same, bit by bit."""
    smooth = SCENES | {
        "A": 0.0,
        "modulus": np.geomspace(1.0, 1e4, 9),
        "a_max_over_R": np.array([[0.05], [1.0], [np.inf]]),
    }
    expected = solve(smooth, OUTPUTS)
    really = tables.build_table

    def without_waves(k: float) -> Any:
        table = really(k)
        for name in table.dtype.names:
            if name not in OF_THE_MATERIAL:
                table[name] = 1 if np.asarray(table[name]).dtype.kind == "i" else np.nan  # also: all is lacking
        return table

    monkeypatch.setattr(tables, "build_table", without_waves)
    tables._own.cache_clear()
    try:
        found = solve(smooth, OUTPUTS)
    finally:
        tables._own.cache_clear()
    assert np.isfinite(expected["pull_off_force"]).all()
    for name, values in expected.items():
        np.testing.assert_array_equal(found[name], values, err_msg=name)
