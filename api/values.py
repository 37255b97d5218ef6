"""A value of a call as numbers over named dimensions: from lists, arrays and quantities, with or without units."""

from typing import Any

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.study.text.quantities import apart, as_written, factor_of, filled, scaled, si_value
from gradhesion.core.problem.inputs import INPUTS, PHYSICAL


def array_of(name: str, value: Any) -> xarray.DataArray:
    """Give the value of a parameter as an array; plain arrays of one dimension are axes of its name.

    ValueError says that it has no shape, or more dimensions than have names.

    >>> array_of("A", [0.1, 0.2]).dims, array_of("A", 0.1).dims
    (('A',), ())
    """
    if isinstance(value, list | tuple):  # of quantities, of which numpy would drop the units
        value = as_written(value, bare=name not in PHYSICAL)
    numbers, unit = apart(value)
    attributes = {"units": unit} if unit else {}
    if hasattr(value, "to_xarray"):  # pandas
        value = (value.astype(float) if numbers is not value else value).to_xarray().assign_attrs(attributes)
    if isinstance(value, xarray.DataArray):
        several = [dim for dim in value.dims if dim in value.xindexes and value.xindexes.is_multi(dim)]
        return _plain(name, value.reset_index(several) if several else value)
    try:
        values = filled(numbers)
    except ValueError:
        raise ValueError("rows of different lengths; give a number or one list of them") from None
    if values.dtype.kind in "mM":  # of which a bare one would become an integer
        values = np.asarray(as_written(values))
    if values.ndim > 1:
        shape = " x ".join(map(str, values.shape))
        names = ", ".join(f'"{letter}"' for letter in "xyzuvw"[: values.ndim])
        raise ValueError(
            f"an array of {shape} values without names for its dimensions; write for example "
            f"xarray.DataArray({name}, dims=[{names}]), and arrays with equal names vary together"
        )
    return _plain(name, xarray.DataArray(values, dims=(name,)[: values.ndim], attrs=attributes))


def _plain(name: str, array: xarray.DataArray) -> xarray.DataArray:
    """Give an array whose quantities, in itself and in its coordinates, are numbers with the attribute `units`."""
    coordinates = {key: (one, *apart(one.variable.data)) for key, one in array.coords.items()}
    plain = {
        key: (one.dims, np.asarray(numbers), one.attrs | {"units": unit})
        for key, (one, numbers, unit) in coordinates.items()
        if unit
    }
    if plain:
        array = array.drop_indexes([key for key in plain if key in array.xindexes]).assign_coords(plain)
    numbers, unit = apart(array.data)
    if unit:
        return array.copy(data=filled(numbers)).assign_attrs(units=unit)
    if array.dtype == object:  # an array of quantities, each with its own unit
        return array.copy(data=np.asarray(as_written(array.values, bare=name not in PHYSICAL)))
    return array


def numbers_of(name: str, array: xarray.DataArray) -> NDArray[np.float64] | None:
    """Give the values of a parameter as plain numbers, those of quantities in SI units; None if they are neither.

    Strings have their units with them, an array may have them as its attribute `units`; numbers without are in SI.
    ValueError says that the unit is not known, or has another dimension.

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
    unit = str(array.attrs.get("units", ""))
    if unit in ("", INPUTS[name].unit):
        return np.asarray(values, dtype=np.float64) + 0.0  # no negative zeros
    return scaled(values, factor_of(unit, name))
