"""Values of other packages as a study has them: quantities of pint, astropy and unyt, arrays of xarray and pandas.

They are known by what they have, so that none of these packages is imported. A unit is never dropped: it stands behind
its number in a text, as a study has it.
"""

import math
from collections.abc import Mapping
from contextlib import suppress
from decimal import Decimal
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.study.text.quantities import LONGEST, factor_between, scaled

_PACKAGES: Final = (
    ("magnitude", "units", "to_base_units"),  # pint
    ("value", "unit", "si"),  # astropy
    ("value", "units", "in_mks"),  # unyt
)
"""What the quantities of each package have: their numbers, their unit, and themselves in base units."""
_DIGITS: Final = 26
"""Characters of the longest number, and a space."""
_AGREE: Final = 1e-9
"""Two registries mean the same by a unit where they differ by less: constants of nature are measured anew."""
_SHARES: Final = ("percent", "%")
_PLAIN: Final = (str, bool, int, float, type(None))


def apart(value: Any) -> tuple[Any, str]:
    """Take what has a unit apart: its numbers, and the unit as pint reads it; of all else there is none.

    >>> apart([1.0, 2.0])
    ([1.0, 2.0], '')
    """
    if isinstance(value, _PLAIN):
        return value, ""
    attributes = getattr(value, "attrs", None)
    written = attributes.get("units", "") if isinstance(attributes, Mapping) else getattr(value, "units", "")
    if hasattr(value, "dims") and hasattr(value, "coords"):  # xarray
        numbers, unit = apart(value.data)
        return numbers, unit or str(written)
    column = getattr(getattr(value, "array", None), "quantity", None)  # pandas with pint
    value = value if column is None else column
    for numbers, unit, base in _PACKAGES:
        if all(hasattr(value, name) for name in (numbers, unit, base)):
            return _in_a_known_unit(getattr(value, numbers), getattr(value, unit), base)
    return value, written if isinstance(written, str) else ""


def _in_a_known_unit(numbers: Any, unit: Any, base: str) -> tuple[Any, str]:
    """Give a quantity in its own unit, or in base units where its registry means something else by it than ours."""
    array = np.asanyarray(numbers)
    if array.dtype == object:  # of decimals or fractions
        with suppress(TypeError, ValueError):
            array = array.astype(np.float64)
    text = _text(unit)
    try:
        (nothing, _), (scale, base_text) = (_in_base(number * unit, base) for number in (0, 1))
    except (ArithmeticError, LookupError, TypeError, ValueError):
        return array, text
    if nothing or factor_between(base_text, base_text) is None:  # a scale with an offset, or a dimension of its own
        return array, text
    known = factor_between(text, base_text) if len(text) <= LONGEST - _DIGITS else None
    if array.dtype.kind not in "iuf" or (known and math.isclose(float(known), scale, rel_tol=_AGREE)):
        return array, text
    return scaled(array, Decimal(f"{scale:.15g}")), base_text


def _in_base(quantity: Any, base: str) -> tuple[float, str]:
    """Give the number and the unit of a quantity in base units."""
    own = getattr(quantity, base)
    own = own() if callable(own) else own
    number, unit = next((getattr(own, number), getattr(own, unit)) for number, unit, how in _PACKAGES if how == base)
    return float(number), _text(unit)


def _text(unit: Any) -> str:
    """Write a unit so that pint reads it."""
    return (f"{unit:C}" if hasattr(unit, "dimensionality") else str(unit)) or "dimensionless"


def as_written(value: Any, path: tuple[str, ...] = (), *, bare: bool = True) -> Any:
    """Turn a value made in Python into what TOML would give: quantities are texts, as "25 um"; all else stays as it is.

    `path` has the keys of a study that lead to it; quantities without a dimension become numbers if `bare`.

    >>> as_written({"A": np.float64(0.1), "k": (0.0, np.array([0.5]))})
    {'A': 0.1, 'k': [0.0, [0.5]]}
    """
    if type(value) in _PLAIN:
        return value
    if isinstance(value, Mapping):
        return {str(key): as_written(item, (*path, str(key)), bare=bare) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [as_written(item, path, bare=bare) for item in value]
    numbers, unit = apart(value)
    if not unit and not hasattr(numbers, "__array__"):
        return value
    array = filled(numbers)
    if array.dtype.kind in "mM":
        return array.astype(str if array.dtype.kind == "m" else "M8[us]").tolist()  # and no bare integers
    if array.dtype == object:
        return as_written(array.tolist(), path, bare=bare) if array.ndim else array.item()
    if not unit:
        return array.tolist()
    if unit in _SHARES and path[:1] == ("uncertainty",) and len(path) == 2:
        return _with(array.tolist(), "%")
    if bare and array.dtype.kind in "iuf" and (factor := factor_between(unit, "1")):
        return scaled(array, factor).tolist()
    return _with(array.tolist(), unit)


def filled(numbers: Any) -> NDArray[Any]:
    """Give an array whose missing values are NaN, which is out of range."""
    if not np.ma.isMaskedArray(numbers):
        return np.asarray(numbers)
    return np.ma.filled(numbers if numbers.dtype == object else numbers.astype(float), np.nan)


def _with(value: Any, unit: str) -> Any:
    """Write numbers with a unit."""
    return [_with(item, unit) for item in value] if isinstance(value, list) else f"{value!r} {unit}"
