"""The columns of a measured loop in SI units, from a table of numbers or from an instrument's file."""

from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.study.rules.fit_form import ColumnTable, DataTable
from gradhesion.cli.study.text.quantities import factor_of_column
from gradhesion.cli.tables.columns import Columns, ColumnsError
from gradhesion.cli.tables.reading import read_columns
from gradhesion.cli.terminal.wording import did_you_mean, shown

PAUSES: Final = ("pause", "hold", "dwell", "creep", "modulate")
"""What instruments call a stretch between branches, in which the punch waits: such rows are left out."""
PAUSE: Final = 2.0
"""The number of a pause between branches."""
_WAYS: Final = "loading unloading approach retract approaching retracting extend withdraw forward backward false true"
BRANCHES: Final = {word: float(i % 2) for i, word in enumerate(_WAYS.split())}
"""What a column of branches says, with the number for it, which may stand there as well."""


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
    cycle: NDArray[np.float64] | None = None
    of: str = ""
    """Which of the loops of a file it is; empty for the only one."""


def read_table(path: Path, table: DataTable) -> Raw:
    """
    Read the columns of a loop.

    Raises
    ------
    LoopFileError
        The file cannot be read, or lacks a column.
    """
    depth, load = getattr(table, table.depths), table.load
    assert load is not None  # noqa: S101 (the rules of a fit ask for it)
    if depth.column == load.column:
        sentence = f"the column {shown(load.column)} has the depths already; name the column of the loads"
        raise LoopFileError("load", sentence)
    if bool(depth.back) != bool(load.back) or (depth.back and (table.branch or table.cycle)):
        sentence = "back names the columns of unloading, of depths and of loads, and then there is no branch or cycle"
        raise LoopFileError("load" if depth.back else table.depths, f"{sentence}; write all of them so")
    wanted = [(table.depths, depth.column), ("load", load.column), ("branch", table.branch), ("cycle", table.cycle)]
    wanted += [(table.depths, depth.back), ("load", load.back)]
    pauses = dict.fromkeys((*PAUSES, *(word.strip().lower() for word in table.leave_out)), PAUSE)
    try:
        found = read_columns(
            path,
            only=[name for _, name in wanted if name],
            words={table.branch: BRANCHES | pauses} if table.branch else {},
            whole=[table.cycle] if table.cycle else [],
        )
    except ColumnsError as error:
        raise LoopFileError("file", str(error)) from None
    for key, name in wanted:
        if name and name not in found.values:
            there = (*found.values, *found.others)
            raise LoopFileError(key, f"the file has no column {shown(name)}; {did_you_mean(name, there)}")
    columns = ((table.depths, depth), ("load", load))
    rows = np.array([in_si(found, *one) for one in columns])
    if not depth.back:
        branch, cycle = (found.values[name] if name else None for name in (table.branch, table.cycle))
        return Raw(depth=rows[0], load=rows[1], branch=branch, cycle=cycle, sha256=found.sha256)
    backs = ((key, one.model_copy(update={"column": one.back})) for key, one in columns)
    ways = [rows, np.array([in_si(found, *one) for one in backs])]
    for back, points in enumerate(ways):  # unloading behind loading, in the order of a cycle; the shorter is padded
        points = points[:, ~np.isnan(points).all(axis=0)]
        falls = points.size > 0 and points[0, -1] < points[0, 0]
        ways[back] = points if falls == bool(back) else points[:, ::-1]
    branch = np.repeat([0.0, 1.0], [way.shape[1] for way in ways])
    both = np.concatenate(ways, axis=1)
    return Raw(depth=both[0], load=both[1], branch=branch, sha256=found.sha256)


def in_si(found: Columns, key: str, requested: ColumnTable) -> NDArray[np.float64]:
    """
    Give a column of loads or of depths in SI units, with its sign.

    Raises
    ------
    LoopFileError
        It has no unit, one of another dimension, or another one than the file says.
    """
    own = "load" if key == "load" else "indentation"
    try:
        factor = factor_of_column(found, requested.column, own, requested.unit)
    except ColumnsError as error:
        raise LoopFileError(key, str(error)) from None
    return found.values[requested.column] * (requested.sign * float(factor))
