"""Files of instruments, as afmformats reads them: cantilever deflection and height turned into depth and load.

The conventions are those of force microscopy, which afmformats keeps: a height is the position of the base of the
cantilever, and falls as it approaches; a force is the deflection times the spring constant, and presses where it is
positive. The machine has moved by minus the height, and the depth is that less the deflection.
"""

import hashlib
import logging
import warnings
from pathlib import Path, PurePath
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.study.fit.columns import PAUSE, LoopFileError, Raw, in_si
from gradhesion.cli.study.rules.fit_form import ColumnTable, DataTable
from gradhesion.cli.tables.columns import Columns
from gradhesion.cli.terminal.wording import did_you_mean, shown

INSTRUMENTS: Final = (".ibw", ".jpk-force", ".jpk-force-map", ".jpk-qi-data", ".jpk-qi-series", ".zip")
"""How the names of files end that are of an instrument, and no tables."""
EITHER: Final = (".h5", ".tab")
"""How those end that are of afmformats where the study names no columns, and tables where it does."""
_HEIGHTS: Final = ("height (measured)", "height (piezo)")
"""The columns of heights, the better first."""
_TIP: Final = "tip position"
"""The column of the height of the tip: height plus deflection."""


def is_force_file(table: DataTable) -> bool:
    """
    Tell whether a file is an instrument's, by its name and whether columns are named.

    >>> is_force_file(DataTable(file="curve.jpk-force")), is_force_file(DataTable(file="curve.csv"))
    (True, False)
    """
    suffix = PurePath(table.file).suffix.lower()
    return suffix in INSTRUMENTS or (suffix in EITHER and not (table.depths or table.load))


def read_force_file(path: Path, table: DataTable, *, through_machine: bool) -> list[Raw]:
    """
    Read the force curves of an instrument's file.

    Raises
    ------
    LoopFileError
        afmformats is not installed, or cannot read the file; or a curve has no such column.
    """
    try:
        import afmformats  # noqa: PLC0415 (not there without the extra)
        from afmformats.errors import AFMFileFormatError, MissingMetaDataError  # noqa: PLC0415
    except ModuleNotFoundError:
        raise LoopFileError(
            "file", "files of instruments are read by afmformats: install it with `pip install gradhesion[afm]`"
        ) from None
    log = logging.getLogger("afmformats")  # which writes the traceback of what is raised
    silent, log.disabled = log.disabled, True
    try:
        sha256 = hashlib.sha256(path.read_bytes()).hexdigest()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            curves = afmformats.load_data(path, modality="force-distance")
            found = [_raw(curve, table, sha256, through_machine=through_machine) for curve in curves]
    except LoopFileError:
        raise
    except OSError as error:
        reason = error.strerror or error
        raise LoopFileError("file", f"the file cannot be read ({reason}); name one that is there") from None
    except (AFMFileFormatError, MissingMetaDataError, Exception) as error:  # noqa: BLE001 (the first two are none)
        reason = " ".join(str(error).split())[:200] or type(error).__name__
        raise LoopFileError(
            "file", f"afmformats cannot read a force curve from the file ({reason}); export it again, or as CSV"
        ) from None
    finally:
        log.disabled = silent
    if not found:
        raise LoopFileError("file", "the file has no force curves; name one with approach and retraction")
    return found if len(found) > 1 else [_raw(curves[0], table, sha256, through_machine=through_machine, of="")]


def _raw(curve: Any, table: DataTable, sha256: str, *, through_machine: bool, of: str | None = None) -> Raw:
    """Give depth (or displacement), load and branch of a curve, in SI units."""

    def column(key: str, requested: ColumnTable) -> NDArray[np.float64]:
        name = requested.column
        if name not in curve:
            raise LoopFileError(key, f"the file has no column {shown(name)}; {did_you_mean(name, curve.columns)}")
        units = {name: "N" if name == "force" else "m"}  # afmformats has SI units
        return in_si(Columns(values={name: known(name)}, units=units, sha256=sha256, place=str), key, requested)

    def known(name: str) -> NDArray[np.float64]:
        if name not in curve:
            there = ", ".join(map(shown, curve.columns))
            raise LoopFileError("file", f"the curve has no column {shown(name)}, only {there}; export it with that one")
        return np.asarray(curve[name], dtype=np.float64)

    load = column("load", table.load) if table.load else known("force")
    height = next((name for name in _HEIGHTS if name in curve), _HEIGHTS[0])
    spring = float(curve.metadata.get("spring constant", np.nan))
    if table.depths:
        depth = column(table.depths, getattr(table, table.depths))
    elif through_machine:
        depth = -known(height)
    elif _TIP in curve:
        depth = -known(_TIP)
    elif spring > 0.0:
        depth = -known(height) - known("force") / spring
    else:
        what = "the file has no spring constant, without which there is no deflection; name the column of the depths, "
        remedy = 'indentation = { column = "tip position", sign = -1 }, or calibrate and save the curve again'
        raise LoopFileError("file", what + remedy)
    branch = np.minimum(known("segment"), PAUSE) if "segment" in curve else None
    return Raw(depth=depth, load=load, branch=branch, sha256=sha256, of=str(curve.enum) if of is None else of)
