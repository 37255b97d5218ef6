"""One value of a call as numbers over named dimensions: of lists, numpy, xarray and pandas, with or without units."""

from typing import Any

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.keys import INPUTS, PHYSICAL
from gradhesion.cli.study.quantities import si_value


def of_xarray(value: Any) -> Any:
    """Give what pandas has as what xarray has, over the dimension of its index; everything else stays as it is."""
    return value.to_xarray() if hasattr(value, "to_xarray") else value


def array_of(name: str, value: Any) -> xarray.DataArray:
    """
    Give the value of a parameter as an array; plain arrays of one dimension are axes of its name.

    Raises
    ------
    ValueError
        It has no shape, or more dimensions than have names.

    Examples
    --------
    >>> array_of("A", [0.1, 0.2]).dims, array_of("A", 0.1).dims
    (('A',), ())
    """
    value = of_xarray(value)
    if isinstance(value, xarray.DataArray):
        several = [dim for dim in value.dims if dim in value.indexes and value.indexes[dim].nlevels > 1]
        return value.reset_index(several) if several else value
    if np.ma.isMaskedArray(value):
        value = np.ma.filled(value.astype(float), np.nan)  # which is out of range
    try:
        values = np.asarray(value)
    except ValueError:
        raise ValueError("rows of different lengths; give a number or one list of them") from None
    if values.ndim > 1:
        shape = " x ".join(map(str, values.shape))
        names = ", ".join(f'"{letter}"' for letter in "xyzuvw"[: values.ndim])
        raise ValueError(
            f"an array of {shape} values without names for its dimensions; write for example "
            f"xarray.DataArray({name}, dims=[{names}]), and arrays with equal names go together"
        )
    return xarray.DataArray(values, dims=(name,)[: values.ndim])


def numbers_of(name: str, array: xarray.DataArray) -> NDArray[np.float64] | None:
    """
    Give the values of a parameter as plain numbers, those of quantities in SI units; None if they are neither.

    Strings have their units with them, an array may have them as its attribute `units`.

    Raises
    ------
    ValueError
        The attribute `units` is not of what is expected.

    Examples
    --------
    >>> numbers_of("R", array_of("R", ["1 um", "2 mm"])), numbers_of("A", array_of("A", True))
    (array([1.e-06, 2.e-03]), None)
    """
    values = array.values
    if values.dtype.kind not in "iuf":
        if name not in PHYSICAL or values.dtype.kind not in "UO":
            return None
        try:
            return np.array([si_value(value, name) for value in values.ravel().tolist()]).reshape(values.shape)
        except ValueError:
            return None  # a study says why, item by item
    numbers = np.asarray(values, dtype=np.float64) + 0.0  # no negative zeros
    units = str(array.attrs.get("units", ""))
    if units in ("", INPUTS[name].unit):
        return numbers
    if name not in PHYSICAL:
        raise ValueError(f'its attribute units = "{units}", where a number without a unit is expected; convert it')
    try:
        return numbers * si_value(f"1 {units}", name)
    except ValueError as error:
        raise ValueError(f'its attribute units = "{units}": {error}') from None
