"""One value of a call as numbers over named dimensions."""

from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray

from gradhesion.values import array_of, numbers_of


@pytest.mark.parametrize(
    ("value", "dims"),
    [
        (0.1, ()), (1, ()), (np.float32(0.1), ()), ([0.1], ("A",)), ((0.1, 0.2), ("A",)), (range(3), ("A",)), (np.zeros(2), ("A",)),
        (pd.Series([0.1, 0.2]), ("index",)), (xarray.DataArray([0.1], dims="x"), ("x",)),
        (xarray.DataArray([[0.1]], dims=["x", "y"], coords={"x": [1], "y": [2]}).stack(z=["x", "y"]), ("z",)),
    ],
)  # fmt: skip
def test_dimensions(value: Any, dims: tuple[str, ...]) -> None:
    array = array_of("A", value)
    assert array.dims == dims
    numbers = numbers_of("A", array)
    assert numbers is not None
    assert numbers.dtype == np.float64
    assert all(index.nlevels == 1 for index in array.indexes.values())


@pytest.mark.parametrize(
    "value", [True, [True], 1j, "0.1", ["0.1"], object(), {0.1}, np.array(["2020-01-01"], "datetime64[D]")]
)
def test_what_is_no_number(value: object) -> None:
    assert numbers_of("A", array_of("A", value)) is None


def test_what_is_masked_is_not_taken_for_a_number() -> None:
    numbers = numbers_of("A", array_of("A", np.ma.array([0.1, 0.2, 0.3], mask=[0, 1, 0])))
    assert numbers is not None
    assert np.isnan(numbers).tolist() == [False, True, False]


def test_quantities_are_in_si() -> None:
    assert numbers_of("R", array_of("R", ["1 um", "2 mm"])).tolist() == [1e-6, 2e-3]  # type: ignore[union-attr]
    named = xarray.DataArray([["1 um"], ["0.5 nm"]], dims=["x", "y"])
    assert numbers_of("c0", named).tolist() == [[1e-6], [5e-10]]  # type: ignore[union-attr]
    assert numbers_of("R", array_of("R", ["1 um", "2 s"])) is None
    milli = xarray.DataArray([20.0], dims="x", attrs={"units": "mJ/m^2"})
    assert numbers_of("work_of_adhesion", milli).tolist() == [0.02]  # type: ignore[union-attr]
    for name, units in (("R", "s"), ("R", "furlongs per"), ("A", "nm")):
        with pytest.raises(ValueError, match=r"is not (a unit of this quantity|known)"):
            numbers_of(name, milli.assign_attrs(units=units))


def test_arrays_without_names_or_shape() -> None:
    with pytest.raises(ValueError, match=r'an array of 1 x 2 x 1 values without names .* dims=\["x", "y", "z"\]'):
        array_of("A", [[[0.1], [0.2]]])
    with pytest.raises(ValueError, match="rows of different lengths"):
        array_of("A", [[0.1], [0.1, 0.2]])
