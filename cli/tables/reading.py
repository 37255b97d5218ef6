"""Read a table of numbers from a file. Its bytes are read once; its fingerprint is theirs."""

import hashlib
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Final

from gradhesion.cli.files import kind_by_content, kind_of, read_at_most
from gradhesion.cli.tables.columns import Columns, ColumnsError, Wanted
from gradhesion.cli.tables.netcdf import MAGIC, of_netcdf
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
    """Read a file.

    Parameters
    ----------
    path
        Of a file in NetCDF, whose variables of one dimension are the columns; or of a text in UTF-8 (or, with a mark at
        its beginning, UTF-16): lines that begin with # are left out, the first other one (or a comment above numbers)
        is the header, `name` or `name [unit]` between commas, semicolons or tabs (or else spaces), or a row of names
        and one of units; each line that follows is a row of numbers, nan and inf among them. Commas are decimal where
        they can be nothing else.
    only, words, whole
        As those of `Wanted`.

    Returns
    -------
    The columns, each of one row or more; what is missing is NaN. ColumnsError says why there are none.

    Notes
    -----
    10^6 rows of six columns take some 3 s, three times that where there is anything but numbers.
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
    if content.startswith(MAGIC):
        return of_netcdf(content, sha256, wanted)
    if kind := kind_by_content(content):
        raise ColumnsError(f"the file is {kind}, not a table; name a table of numbers in CSV or NetCDF")
    return of_text(content, sha256, wanted)
