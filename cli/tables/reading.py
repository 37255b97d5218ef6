"""Read a table of numbers from a file, a text or NetCDF. Its bytes are read once; its fingerprint is theirs."""

import hashlib
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.disk import kind_by_content, kind_of, read_at_most
from gradhesion.cli.tables.columns import Columns, ColumnsError, Wanted, converted, number, tidy
from gradhesion.cli.tables.text import of_text

MOST_BYTES: Final = 2**29
"""The largest file that is read: ten million rows of some columns."""


def read_columns(
    path: Path,
    only: Collection[str] | None = None,
    *,
    words: Mapping[str, Mapping[str, float]] | None = None,
    whole: Collection[str] = (),
) -> Columns:
    """Read the columns of a file that are wanted (`Wanted` has the keywords); ColumnsError says why there are none.

    The file is in NetCDF, whose variables of one dimension are the columns, or a text in UTF-8 (or, with a mark at its
    beginning, UTF-16). Lines of that which begin with # are left out; the first other one (or a comment above numbers)
    is the header, `name` or `name [unit]` between commas, semicolons or tabs (or else spaces), or a row of names and
    one of units; each line that follows is a row of numbers, nan and inf among them. Commas are decimal where they can
    be nothing else. 10^6 rows of six columns take some 6 s, and 20 s with decimal commas.
    """
    wanted = Wanted(only=only, words=words or {}, whole=whole)
    try:
        is_large = path.is_file() and path.stat().st_size > MOST_BYTES
        content = b"" if is_large else read_at_most(path, MOST_BYTES)
    except (OSError, ValueError) as error:
        kind = kind_of(path)
        reason = f"it is {kind}" if kind in ("a directory", "no regular file") else getattr(error, "strerror", None)
        what = reason or str(error)
        raise ColumnsError(f"the file cannot be read ({what}); name a table of numbers in CSV or NetCDF") from None
    if is_large:
        raise ColumnsError(f"the file is larger than {MOST_BYTES >> 20} MiB; split it")
    if not content.strip():
        raise ColumnsError("the file is empty; name a table with a header and a row of numbers")
    sha256 = hashlib.sha256(content).hexdigest()
    kind = kind_by_content(content)
    if kind.startswith("a dataset"):
        return _of_netcdf(content, sha256, wanted)
    if kind:
        raise ColumnsError(f"the file is {kind}, not a table; name a table of numbers in CSV or NetCDF")
    return of_text(content, sha256, wanted)


def _of_netcdf(content: bytes, sha256: str, wanted: Wanted) -> Columns:
    """Read the variables of one dimension."""
    import netCDF4  # noqa: PLC0415 (180 ms that a table in text does not need)

    try:
        with netCDF4.Dataset("columns", memory=content) as file:
            variables = dict(zip(wanted.named([*file.variables]), file.variables.values(), strict=True))
            others = tuple(name for name in variables if wanted.only is not None and name not in wanted.only)
            found = {
                name: variable[...]
                for name, variable in variables.items()
                if variable.ndim == 1
                and name not in others
                and (getattr(variable.dtype, "kind", "") in tuple("iuf") or name in wanted.words)
            }
            units = tidy({name: str(getattr(variables[name], "units", "")) for name in found})
    except (OSError, RuntimeError, ValueError, AttributeError, MemoryError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise ColumnsError(f"the file cannot be read as NetCDF ({reason}); write it again") from None
    if not any(column.size for column in found.values()) and (found or not others):
        raise ColumnsError("the file has no variable of numbers along one dimension; write columns into it")
    if len({column.size for column in found.values()}) > 1:
        sizes = ", ".join(f"{name} {column.size:,}" for name, column in list(found.items())[:8])
        raise ColumnsError(f"the columns differ in length ({sizes}); leave one dimension in the file")
    values = {name: _values(name, column, wanted) for name, column in found.items()}
    return Columns(values=values, units=units, sha256=sha256, place=_place, others=others)


def _place(row: int) -> str:
    """Say where a row is."""
    return f"row {row}, counted from 0"


def _values(name: str, column: Any, wanted: Wanted) -> NDArray[np.float64]:
    """Give the numbers of a column."""
    read = wanted.reader(name)
    if read is number:
        return np.ma.filled(column.astype(np.float64), np.nan)
    cells = ["" if value is None else str(value) for value in np.ma.asarray(column).tolist()]
    return converted(name, cells, read, _place)
