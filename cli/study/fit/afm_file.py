"""Files of instruments, as afmformats reads them: cantilever deflection and height turned into depth and load.

The conventions are those of force microscopy, which afmformats keeps: a height is the position of the base of the
cantilever, and falls as it approaches; a force is the deflection times the spring constant, and presses where it is
positive. The machine has moved by minus the height, and the depth is that less the deflection.
"""

import hashlib
import logging
import warnings
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.study.fit.loop_columns import PAUSE, LoopFileError, Raw
from gradhesion.cli.terminal.wording import did_you_mean, shown

if TYPE_CHECKING:
    from gradhesion.cli.study.fit.form import ColumnTable, DataTable

INSTRUMENTS: Final = (".ibw", ".jpk-force", ".jpk-force-map", ".jpk-qi-data", ".jpk-qi-series", ".zip")
"""How the names of files end that are of an instrument, and no tables."""
EITHER: Final = (".h5", ".tab")
"""How those end that are of afmformats where the study names no columns, and tables where it does."""
_HEIGHTS: Final = ("height (measured)", "height (piezo)")
"""The columns of heights, the better first."""
_TIP: Final = "tip position"
"""The column of the height of the tip: height plus deflection."""


def is_force_file(file: str, table: "DataTable") -> bool:
    """
    Tell whether a file is an instrument's, by its name and whether columns are named.

    >>> from gradhesion.cli.study.fit.form import DataTable
    >>> is_force_file("curve.jpk-force", DataTable(file="x")), is_force_file("curve.csv", DataTable(file="x"))
    (True, False)
    """
    suffix = PurePath(file).suffix.lower()
    return suffix in INSTRUMENTS or (suffix in EITHER and not table.names_columns)


def read_force_file(path: Path, table: "DataTable", *, through_machine: bool) -> list[Raw]:
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
    try:
        sha256 = hashlib.sha256(path.read_bytes()).hexdigest()
    except OSError as error:
        raise LoopFileError("file", f"the file cannot be read ({error.strerror}); name one that is there") from None
    log = logging.getLogger("afmformats")  # which writes the traceback of what is raised
    silent, log.disabled = log.disabled, True
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            curves = afmformats.load_data(path, modality="force-distance")
            rows = [_rows(curve, table, through_machine=through_machine) for curve in curves]
    except LoopFileError:
        raise
    except (AFMFileFormatError, MissingMetaDataError, Exception) as error:  # noqa: BLE001 (a reader of others: any)
        reason = " ".join(str(error).split())[:200] or type(error).__name__
        raise LoopFileError(
            "file", f"afmformats cannot read a force curve from the file ({reason}); export it again, or as CSV"
        ) from None
    finally:
        log.disabled = silent
    if not rows:
        raise LoopFileError("file", "the file has no force curves; name one with approach and retraction")
    return [
        Raw(
            depth=depth,
            load=load,
            branch=None if branch is None else np.minimum(branch, PAUSE),
            sha256=sha256,
            of="" if len(rows) == 1 else str(curve.enum),
        )
        for curve, (depth, load, branch) in zip(curves, rows, strict=True)
    ]


def _rows(
    curve: Any, table: "DataTable", *, through_machine: bool
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64] | None]:
    """Give depth (or displacement), load and branch of a curve, in SI units."""
    load = _named(curve, "load", table.load) if table.load else _column(curve, "force")
    requested = table.displacement or table.indentation
    if requested is not None:
        depth = _named(curve, "displacement" if table.displacement else "indentation", requested)
    elif through_machine:
        depth = -_height(curve)
    elif _TIP in curve:
        depth = -_column(curve, _TIP)
    else:
        spring = float(curve.metadata.get("spring constant", np.nan))
        if not spring > 0.0:
            raise LoopFileError(
                "file",
                "the file has no spring constant, without which there is no deflection; name the column of the depths, "
                'indentation = { column = "tip position", sign = -1 }, or calibrate and save the curve again',
            )
        depth = -_height(curve) - _column(curve, "force") / spring
    return depth, load, _column(curve, "segment") if "segment" in curve else None


def _height(curve: Any) -> NDArray[np.float64]:
    """Give the height of the base of the cantilever."""
    return _column(curve, next((name for name in _HEIGHTS if name in curve), _HEIGHTS[0]))


def _column(curve: Any, name: str) -> NDArray[np.float64]:
    """Give a column of a curve."""
    if name not in curve:
        there = ", ".join(shown(one) for one in curve.columns)
        raise LoopFileError("file", f"the curve has no column {shown(name)}, only {there}; export it with that one")
    return np.asarray(curve[name], dtype=np.float64)


def _named(curve: Any, key: str, requested: "ColumnTable") -> NDArray[np.float64]:
    """Give a column that the study names; afmformats has SI units."""
    if requested.column not in curve:
        there = did_you_mean(requested.column, curve.columns)
        raise LoopFileError(key, f"the file has no column {shown(requested.column)}; {there}")
    if requested.unit:
        raise LoopFileError(key, f"afmformats gives {shown(requested.column)} in SI units; remove the unit")
    return requested.sign * _column(curve, requested.column)
