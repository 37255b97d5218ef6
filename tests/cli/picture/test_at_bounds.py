"""Optima at a bound of what was searched are marked in pictures, each parameter's at its own bounds."""

from typing import Any

import numpy as np
import pytest
import xarray

from gradhesion.cli.dataset.dataset import compute
from gradhesion.cli.picture.doubts import BOUND
from gradhesion.cli.picture.values.picture import drawn
from gradhesion.cli.study.reading import study_from


@pytest.fixture(scope="module")
def optima() -> xarray.Dataset:
    """Best amplitudes and wavelengths, of which some are at a bound: those flagged here, whatever they are."""
    study: dict[str, Any] = {
        "kind": "optimum",
        "optimum": {"maximise": "pull_off_force", "over": ["A", "lambda_over_R"], "resolution": 12},
        "parameters": {
            "k": [0.0, 0.2, 0.4, 0.6],
            "nu": 0.3,
            "modulus": 500.0,
            "c0_over_R": 0.01,
            "A": {"start": 0.001, "stop": 0.02},
            "lambda_over_R": {"start": 0.1, "stop": 1.0},
            "a_max_over_R": 0.5,
        },
    }
    dataset = compute(study_from(study), threads=1)
    meanings = dataset["on_bound"].attrs["flag_meanings"].split()
    bits = {word: 1 << place for place, word in enumerate(meanings)}
    upper, lower = bits["A_at_its_upper_bound"], bits["lambda_over_R_at_its_lower_bound"]
    dataset["on_bound"] = dataset["on_bound"].copy(data=np.array([upper, 0, lower, upper | lower], np.int8))
    return dataset


@pytest.mark.parametrize(
    ("name", "expected"),
    [("best_A", [0.0, 0.6]), ("best_lambda_over_R", [0.4, 0.6]), ("best_pull_off_force", [0.0, 0.4, 0.6])],
)
def test_marks_stand_where_the_flags_are(name: str, expected: list[float], optima: xarray.Dataset) -> None:
    figure = drawn(optima, [name])
    (marks,) = [line for line in figure.axes[0].get_lines() if line.get_marker() == BOUND.mark]
    np.testing.assert_array_equal(marks.get_xdata(), expected)
    assert BOUND.words in [text.get_text() for legend in figure.legends for text in legend.get_texts()]


def test_nothing_is_marked_where_no_optimum_is_at_a_bound(optima: xarray.Dataset) -> None:
    within = optima.assign(on_bound=0 * optima["on_bound"].assign_attrs(optima["on_bound"].attrs))
    within["on_bound"].attrs = optima["on_bound"].attrs
    figure = drawn(within, ["best_A"])
    assert not [line for line in figure.axes[0].get_lines() if line.get_marker() == BOUND.mark]
    assert not figure.legends
