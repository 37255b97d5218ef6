"""The columns of a measured loop in SI units, from a table of numbers."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.study.fit.form import PAUSES
from gradhesion.cli.study.text.quantities import si_value
from gradhesion.cli.tables.columns import Columns, ColumnsError
from gradhesion.cli.tables.reading import read_columns
from gradhesion.cli.terminal.wording import did_you_mean, shown

if TYPE_CHECKING:
    from gradhesion.cli.study.fit.form import ColumnTable, DataTable

BRANCHES: Final = {
    "loading": 0.0,
    "unloading": 1.0,
    "approach": 0.0,
    "retract": 1.0,
    "approaching": 0.0,
    "retracting": 1.0,
    "extend": 0.0,
    "withdraw": 1.0,
    "forward": 0.0,
    "backward": 1.0,
    "false": 0.0,
    "true": 1.0,
}
"""What a column of branches says, with the number for it, which may stand there as well."""
PAUSE: Final = 2.0
"""The number of a pause between branches."""
_DIMENSIONS: Final = {"length": ("R", "nm"), "force": ("preload", "nN")}
"""For each dimension a key of it, and a unit to name."""


class LoopFileError(ValueError):
    """A file has no loop: `key` is the key of [data] that is wrong; the message says why, and what to do."""

    def __init__(self, key: str, sentence: str) -> None:
        self.key = key
        super().__init__(sentence)


@dataclass(frozen=True, kw_only=True, eq=False)
class Raw:
    """The rows of a file, as they come; NaN where a number is missing."""

    depth: NDArray[np.float64]
    load: NDArray[np.float64]
    sha256: str
    branch: NDArray[np.float64] | None = None
    """0 loading, 1 unloading, 2 a pause."""
    cycle: NDArray[np.int64] | None = None
    of: str = ""
    """Which of the loops of a file it is; empty for the only one."""


def words_of(table: "DataTable") -> dict[str, float]:
    """
    Give the words of a column of branches, with their numbers.

    >>> from gradhesion.cli.study.fit.form import DataTable
    >>> words = words_of(DataTable(file="a.csv", leave_out=["Wait"]))
    >>> words["retract"], words["dwell"], words["wait"]
    (1.0, 2.0, 2.0)
    """
    return BRANCHES | dict.fromkeys((*PAUSES, *(word.strip().lower() for word in table.leave_out)), PAUSE)


def read_table(path: Path, table: "DataTable") -> Raw:
    """
    Read the columns of a loop.

    Raises
    ------
    LoopFileError
        The file cannot be read, or lacks a column.
    """
    depth_key = "displacement" if table.displacement else "indentation"
    depth, load = table.displacement or table.indentation, table.load
    if depth is None or load is None:
        raise LoopFileError("load" if depth else "indentation", "the name of this column is missing; give it")
    if depth.column == load.column:
        sentence = f"the column {shown(load.column)} has the depths already; name the column of the loads"
        raise LoopFileError("load", sentence)
    if bool(depth.back) != bool(load.back) or (depth.back and (table.branch or table.cycle)):
        sentence = "back names the columns of unloading, of depths and of loads, and then there is no branch or cycle"
        raise LoopFileError("load" if depth.back else depth_key, f"{sentence}; write all of them so")
    wanted = [(depth_key, depth.column), ("load", load.column), ("branch", table.branch), ("cycle", table.cycle)]
    wanted += [(depth_key, depth.back), ("load", load.back)]
    words = {table.branch: words_of(table)} if table.branch else {}
    try:
        found = read_columns(
            path,
            only=[name for _, name in wanted if name],
            words=words,
            whole=[table.cycle] if table.cycle else [],
        )
    except ColumnsError as error:
        raise LoopFileError("file", str(error)) from None
    for key, name in wanted:
        if name and name not in found.values:
            there = (*found.values, *found.others)
            raise LoopFileError(key, f"the file has no column {shown(name)}; {did_you_mean(name, there)}")
    if depth.back:
        return _side_by_side(found, depth_key, depth, load)
    missing = np.isnan(found.values[table.cycle]) if table.cycle else np.zeros(found.rows, bool)
    return Raw(
        depth=np.where(missing, np.nan, _scaled(found, depth_key, depth, "length")),
        load=_scaled(found, "load", load, "force"),
        branch=found.values[table.branch] if table.branch else None,
        cycle=np.nan_to_num(found.values[table.cycle]).astype(np.int64) if table.cycle else None,
        sha256=found.sha256,
    )


def _side_by_side(found: Columns, depth_key: str, depth: "ColumnTable", load: "ColumnTable") -> Raw:
    """Put unloading, which has columns of its own, behind loading, in the order of a cycle."""
    ways = []
    for word in ("column", "back"):
        own = (one.model_copy(update={"column": getattr(one, word)}) for one in (depth, load))
        points = np.array([_scaled(found, *each) for each in zip((depth_key, "load"), own, _DIMENSIONS, strict=True)])
        points = points[:, ~np.isnan(points).all(axis=0)]  # the shorter of the two is padded
        falls = points.size > 0 and points[0, -1] < points[0, 0]
        ways.append(points if falls == (word == "back") else points[:, ::-1])
    branch = np.repeat([0.0, 1.0], [way.shape[1] for way in ways])
    both = np.concatenate(ways, axis=1)
    return Raw(depth=both[0], load=both[1], branch=branch, sha256=found.sha256)


def _scaled(found: Columns, key: str, requested: "ColumnTable", dimension: str) -> NDArray[np.float64]:
    """Give a column in SI units, with its sign."""
    own, unit = _DIMENSIONS[dimension]
    above = found.units.get(requested.column, "")
    written = requested.unit or above
    if not written:
        raise LoopFileError(
            key,
            f"the column {shown(requested.column)} has no unit; "
            f'write for example {key} = {{ column = "{requested.column}", unit = "{unit}" }}, '
            "or its unit in brackets after its name in the header",
        )
    try:
        factor = si_value(f"1 {written}", own)
    except ValueError:
        raise LoopFileError(
            key, f'the unit {shown(written)} is no {dimension}; write for example unit = "{unit}"'
        ) from None
    if above and not _is_unit(above, own, factor):
        raise LoopFileError(
            key,
            f"the unit of the column {shown(requested.column)} is {shown(written)} in the study and "
            f"{shown(above)} in the header of the file; correct one of the two, or leave it out of the study",
        )
    return found.values[requested.column] * (requested.sign * factor)


def _is_unit(written: str, name: str, factor: float) -> bool:
    """Tell whether a unit is that of a factor."""
    try:
        return si_value(f"1 {written}", name) == factor
    except ValueError:
        return False
