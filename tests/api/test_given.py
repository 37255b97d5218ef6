"""What a call gives is taken apart into arrays, other values and settings."""

import numpy as np
import pandas as pd
import pytest
import xarray

from gradhesion.cli.errors import StudyError
from gradhesion.given import Given, given_in

PUNCH = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.2, "a_max_over_R": 0.7}


def given(**values: object) -> Given:
    """Take apart what `gr.solve` would get."""
    return given_in("gr.solve", PUNCH, values, {"outputs": "pull_off_force"})


def test_values_go_where_they_belong() -> None:
    taken = given(A=[0.1, 0.2], k=xarray.DataArray([[0.0]], dims=["x", "y"]), nu=np.float32(0.25))
    assert {name: array.dims for name, array in taken.arrays.items()} == {"A": ("A",), "k": ("x", "y")}
    assert taken.fixed["nu"] == 0.25
    assert taken.settings == {"outputs": ["pull_off_force"], "title": "pull_off_force"}
    assert (taken.is_grid, taken.is_points) == (False, False)


def test_a_long_array_is_checked_by_its_ends() -> None:
    values = np.linspace(0.0, 0.1, 1_000_001)
    taken = given(A=values)
    assert taken.study().parameters["A"].tolist() == [0.0, 0.1]  # type: ignore[union-attr]
    array = taken.parameters(taken.study())["A"]
    assert isinstance(array, xarray.DataArray)
    assert array.values is not values
    assert array.size == values.size
    for wrong in (np.nan, -1e-300, np.inf):
        values[123_456] = wrong
        with pytest.raises(StudyError, match=r"gr\.solve: A\[123456\] = .*: out of range"):
            given(A=values).study()


def test_points_are_all_over_all_points() -> None:
    taken = given(A=xarray.DataArray([0.1, 0.2], dims="scene"))
    assert taken.is_points
    parameters = taken.parameters(taken.study())
    assert {xarray.DataArray(array).dims for array in parameters.values()} == {("scene",)}
    assert 'layout = "points"' in taken.text(taken.study())


def test_a_range_beside_points_is_an_axis_of_its_own() -> None:
    taken = given(A=xarray.DataArray([0.1, 0.2], dims="scene"), nu={"start": 0.1, "stop": 0.3, "num": 2})
    arrays = taken.parameters(taken.study())
    dims = {name: array.dims for name, array in arrays.items() if isinstance(array, xarray.DataArray)}
    assert dims == {"A": ("scene",), "nu": ("nu",)}
    assert not taken.text(taken.study()), "a study would pair them"


def test_a_table_of_pandas_has_a_scene_a_row() -> None:
    frame = pd.DataFrame({"A": [0.0, 0.01], "k": [0.1, 0.2]}, index=pd.Index([7, 8], name="test"))
    for taken in (
        given(**{name: frame[name] for name in frame}),
        given_in("gr.solve", frame, {"nu": 0.3}, {"outputs": []}),
    ):
        assert {name: array.dims for name, array in taken.arrays.items()} == {"A": ("test",), "k": ("test",)}
        assert taken.arrays["A"]["test"].values.tolist() == [7, 8]


def test_parameters_are_a_mapping() -> None:
    with pytest.raises(StudyError, match="parameters: a mapping from names to values is expected, not a list"):
        given_in("gr.solve", [0.1], {}, {"outputs": []}).study()


def test_a_value_that_cannot_be_read_is_not_missing_as_well() -> None:
    with pytest.raises(StudyError) as refused:
        given(A=[[0.1], [0.1, 0.2]]).study()
    assert refused.value.mistakes == ("gr.solve: A: rows of different lengths; give a number or one list of them",)


def test_negative_zeros_are_zeros() -> None:
    assert not np.signbit(given(A=[-0.0, 0.1]).arrays["A"]).any()


def test_too_many_scenes_are_refused_before_they_are_made() -> None:
    axes = {name: np.linspace(0.1, 0.2, 2_000) for name in ("A", "k", "nu")}
    with pytest.raises(StudyError, match="they make 8,000,000,000 scenes, more than 2,147,483,648"):
        given(**axes).study()
