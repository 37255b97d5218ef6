"""Columns of numbers in a file in NetCDF: its variables of one dimension."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.tables.cells import number
from gradhesion.cli.tables.columns import Columns, ColumnsError, Wanted, tidy

MAGIC = (b"\x89HDF\r\n\x1a\n", b"CDF")
"""How such files begin."""


def of_netcdf(content: bytes, sha256: str, wanted: Wanted) -> Columns:
    """Read the variables of one dimension."""
    import netCDF4  # noqa: PLC0415 (180 ms that a table in text does not need)

    only = wanted.only
    try:
        with netCDF4.Dataset("columns", memory=content) as file:
            variables = dict(zip(wanted.named([*file.variables]), file.variables.values(), strict=True))
            others = tuple(name for name in variables if only is not None and name not in only)
            found = {
                name: variable[...]
                for name, variable in variables.items()
                if variable.ndim == 1
                and name not in others
                and (getattr(variable.dtype, "kind", "") in tuple("iuf") or name in wanted.words)
            }
            units = {name: tidy(str(getattr(variables[name], "units", ""))) for name in found}
    except (OSError, RuntimeError, ValueError, AttributeError, MemoryError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise ColumnsError(f"the file cannot be read as NetCDF ({reason}); write it again") from None
    if others and not found:
        return Columns(values={}, units={}, sha256=sha256, place=str, others=others)
    if not any(column.size for column in found.values()):
        raise ColumnsError("the file has no variable of numbers along one dimension; write columns into it")
    if len({column.size for column in found.values()}) > 1:
        sizes = ", ".join(f"{name} {column.size:,}" for name, column in list(found.items())[:8])
        raise ColumnsError(f"the columns differ in length ({sizes}); leave one dimension in the file")
    values = {name: _values(name, column, wanted) for name, column in found.items()}
    units = {name: unit for name, unit in units.items() if unit}
    return Columns(values=values, units=units, sha256=sha256, place=_place, others=others)


def _place(row: int) -> str:
    """Say where a row is."""
    return f"row {row}, counted from 0"


def _values(name: str, column: Any, wanted: Wanted) -> NDArray[np.float64]:
    """Give the numbers of a column."""
    read = wanted.reader(name)
    if read is number:
        return np.ma.filled(column.astype(np.float64), np.nan)
    found = []
    for row, value in enumerate(np.ma.asarray(column).tolist()):
        try:
            found.append(read("" if value is None else str(value)))
        except ValueError as error:
            raise ColumnsError(f"{_place(row)}: {name} {error}") from None
    return np.array(found)
