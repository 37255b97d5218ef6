"""The columns of a measured loop in SI units, from a table of numbers or from an instrument's file.

Instruments' files are read by afmformats, with the conventions of force microscopy: a height is the position of the
base of the cantilever, and falls as it approaches; a force is the deflection times the spring constant, and presses
where it is positive. The machine has moved by minus the height, and the depth is that less the deflection.
"""

import hashlib
import logging
import warnings
from pathlib import Path, PurePath
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.study.rules.fit_form import ColumnTable, DataTable
from gradhesion.cli.study.text.quantities import factor_of_column
from gradhesion.cli.tables.columns import Columns, ColumnsError
from gradhesion.cli.tables.reading import read_columns
from gradhesion.cli.terminal.wording import did_you_mean, shown

INSTRUMENTS: Final = (".ibw", ".jpk-force", ".jpk-force-map", ".jpk-qi-data", ".jpk-qi-series", ".zip")
"""How the names of files end that are of an instrument, and no tables."""
EITHER: Final = (".h5", ".tab")
"""How those end that are of afmformats where the study names no columns, and tables where it does."""
PAUSES: Final = ("pause", "hold", "dwell", "creep", "modulate")
"""What instruments call a stretch between branches, in which the punch waits: such rows are left out."""
PAUSE: Final = 2.0
"""The number of a pause between branches."""
_WAYS: Final = "loading unloading approach retract approaching retracting extend withdraw forward backward false true"
BRANCHES: Final = {word: float(i % 2) for i, word in enumerate(_WAYS.split())}
"""What a column of branches says, with the number for it, which may stand there as well."""
_HEIGHTS: Final = ("height (measured)", "height (piezo)")
"""An instrument's columns of heights, the better first."""
_TIP: Final = "tip position"
"""That of the height of the tip: height plus deflection."""


class LoopFileError(ValueError):
    """A file has no loop: `key` is the key of [data] that is wrong; the message says why, and what to do."""

    def __init__(self, key: str, sentence: str) -> None:
        self.key = key
        super().__init__(sentence)


Rows = dict[str, NDArray[np.float64]]
"""Depth and load as they come, NaN where a number is missing; and `branch` (0, 1, or a pause) and `cycle`, if any."""


def read_raw(path: Path, table: DataTable, *, through_machine: bool) -> tuple[str, dict[str, Rows]]:
    """Give the fingerprint of a file and its loops, by their numbers if it has several; LoopFileError without one."""
    if not is_force_file(table.model_copy(update={"file": path.name})):
        return _of_table(path, table)
    try:
        import afmformats  # noqa: PLC0415 (not there without the extra)
        from afmformats.errors import AFMFileFormatError, MissingMetaDataError  # noqa: PLC0415
    except ModuleNotFoundError:
        raise LoopFileError("file", "afmformats is missing; install it, `pip install gradhesion[afm]`") from None
    log = logging.getLogger("afmformats")  # which writes the traceback of what is raised
    silent, log.disabled = log.disabled, True
    try:
        sha256 = hashlib.sha256(path.read_bytes()).hexdigest()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            curves = afmformats.load_data(path, modality="force-distance")
            found = {str(curve.enum): _of_curve(curve, table, through_machine=through_machine) for curve in curves}
    except LoopFileError:
        raise
    except (AFMFileFormatError, MissingMetaDataError, Exception) as error:  # noqa: BLE001 (the first two are none)
        reason = " ".join(str(error).split())[:200] or type(error).__name__
        remedy = "name one that is there, or export it again or as CSV"
        raise LoopFileError("file", f"the file cannot be read ({reason}); {remedy}") from None
    finally:
        log.disabled = silent
    if not found:
        raise LoopFileError("file", "the file has no force curves; name one with approach and retraction")
    return sha256, {"": next(iter(found.values()))} if len(found) == 1 else found


def is_force_file(table: DataTable) -> bool:
    """Tell whether a file is an instrument's, by its name and whether columns are named."""
    suffix = PurePath(table.file).suffix.lower()
    return suffix in INSTRUMENTS or (suffix in EITHER and not (table.depths or table.load))


def _of_curve(curve: Any, table: DataTable, *, through_machine: bool) -> Rows:
    """Give depth (or displacement), load and branch of a force curve."""

    def known(name: str, key: str = "file") -> NDArray[np.float64]:
        if name not in curve:
            near = did_you_mean(name, curve.columns)
            raise LoopFileError(key, f"the file has no column {shown(name)}; {near}, or export it with that one")
        return np.asarray(curve[name], dtype=np.float64)

    def column(key: str) -> NDArray[np.float64]:
        requested = getattr(table, key)
        unit = "N" if requested.column == "force" else "m"  # afmformats has SI units
        found = {requested.column: known(requested.column, key)}
        return _in_si(Columns(values=found, units=dict.fromkeys(found, unit), sha256="", place=str), key, requested)

    load = column("load") if table.load else known("force")
    height = next((name for name in _HEIGHTS if name in curve), _HEIGHTS[0])
    spring = float(curve.metadata.get("spring constant", np.nan))
    if table.depths:
        depth = column(table.depths)
    elif through_machine:
        depth = -known(height)
    elif _TIP in curve:
        depth = -known(_TIP)
    elif spring > 0.0:
        depth = -known(height) - known("force") / spring
    else:
        remedy = 'name a column of depths, indentation = { column = "tip position", sign = -1 }, or calibrate it'
        raise LoopFileError("file", f"the file has no spring constant, and so no deflection; {remedy}")
    branch = {"branch": np.minimum(known("segment"), PAUSE)} if "segment" in curve else {}
    return {"depth": depth, "load": load, **branch}


def _of_table(path: Path, table: DataTable) -> tuple[str, dict[str, Rows]]:
    """Read the columns of a loop from a table."""
    depth, load = getattr(table, table.depths), table.load
    assert load is not None  # noqa: S101 (the rules of a fit ask for it)
    if depth.column == load.column:
        raise LoopFileError("load", f"the column {shown(load.column)} has the depths; name that of the loads")
    if bool(depth.back) != bool(load.back) or (depth.back and (table.branch or table.cycle)):
        sentence = "back names the columns of unloading, of depths and of loads, and then there is no branch or cycle"
        raise LoopFileError("load" if depth.back else table.depths, f"{sentence}; write all of them so")
    wanted = {depth.column: table.depths, load.column: "load", depth.back: table.depths, load.back: "load"}
    wanted |= {table.branch or "": "branch", table.cycle or "": "cycle"}
    wanted.pop("", None)  # what is not named
    pauses = dict.fromkeys((*PAUSES, *(word.strip().lower() for word in table.leave_out)), PAUSE)
    words = {table.branch: BRANCHES | pauses} if table.branch else {}
    try:
        found = read_columns(path, only=[*wanted], words=words, whole=[table.cycle] if table.cycle else [])
    except ColumnsError as error:
        raise LoopFileError("file", str(error)) from None
    for name, key in wanted.items():
        if name not in found.values:
            there = (*found.values, *found.others)
            raise LoopFileError(key, f"the file has no column {shown(name)}; {did_you_mean(name, there)}")
    columns = ((table.depths, depth), ("load", load))
    rows = np.array([_in_si(found, *one) for one in columns])
    ways = {key: found.values[name] for name, key in wanted.items() if key in ("branch", "cycle")}
    if depth.back:
        backs = ((key, one.model_copy(update={"column": one.back})) for key, one in columns)
        both = [rows, np.array([_in_si(found, *one) for one in backs])]
        for back, points in enumerate(both):  # unloading behind loading, in the order of a cycle; the shorter is padded
            points = points[:, ~np.isnan(points).all(axis=0)]
            falls = points.size > 0 and points[0, -1] < points[0, 0]
            both[back] = points if falls == bool(back) else points[:, ::-1]
        ways = {"branch": np.repeat([0.0, 1.0], [points.shape[1] for points in both])}
        rows = np.concatenate(both, axis=1)
    return found.sha256, {"": {"depth": rows[0], "load": rows[1], **ways}}


def _in_si(found: Columns, key: str, requested: ColumnTable) -> NDArray[np.float64]:
    """Give a column of loads or of depths in SI units, with its sign."""
    try:
        own = "load" if key == "load" else "indentation"
        factor = factor_of_column(found, requested.column, own, requested.unit)
    except ColumnsError as error:
        raise LoopFileError(key, str(error)) from None
    return found.values[requested.column] * (requested.sign * float(factor))
