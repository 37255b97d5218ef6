"""A measured loop in a file: depth and load in SI units, which way the points go, and how noisy they are."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.study.quantities import si_value
from gradhesion.cli.tables.columns import Columns, ColumnsError
from gradhesion.cli.tables.reading import read_columns
from gradhesion.cli.terminal.amounts import counted
from gradhesion.cli.terminal.wording import did_you_mean, shown
from gradhesion.core.answers import loop_points

if TYPE_CHECKING:
    from gradhesion.cli.study.fit_form import ColumnTable, DataTable

BRANCHES: Final = {
    "loading": 0.0,
    "unloading": 1.0,
    "approach": 0.0,
    "retract": 1.0,
    "false": 0.0,
    "true": 1.0,
}
"""What a column of branches says, with the number for it, which may stand there as well."""
_DIMENSIONS: Final = {"length": ("R", "nm"), "force": ("preload", "nN")}
"""For each dimension a key of it, and a unit to name."""


class LoopFileError(ValueError):
    """A file has no loop: `key` is the key of [data] that is wrong; the message says why, and what to do."""

    def __init__(self, key: str, sentence: str) -> None:
        self.key = key
        super().__init__(sentence)


@dataclass(frozen=True, kw_only=True, eq=False)
class LoopFile:
    """The points of a measured loop."""

    depth: NDArray[np.float64]
    """In m: of the contact, or of the machine."""
    load: NDArray[np.float64]
    """In N; positive presses."""
    unloading: NDArray[np.bool_]
    cycle: NDArray[np.int64]
    """The number of the cycle of each point, from 1 unless the file has them."""
    through_machine: bool = False
    """Whether `depth` is the displacement of the machine."""
    sha256: str = ""
    dropped: int = 0
    """Rows without a number that were left out."""
    noise: tuple[float, float] = field(default=(0.0, 0.0))
    """Standard deviations of depth and load, estimated from the points."""

    @property
    def cycles(self) -> int:
        """The number of its cycles."""
        return np.unique(self.cycle).size


def read_loop(path: Path, table: "DataTable") -> LoopFile:
    """
    Read a measured loop.

    Raises
    ------
    LoopFileError
        The file cannot be read, lacks a column, or is no loop.
    """
    depth_key = "displacement" if table.displacement else "indentation"
    asked = table.displacement or table.indentation
    if asked is None:
        raise LoopFileError("indentation", "the depths are missing")
    wanted = {depth_key: asked.column, "load": table.load.column, "branch": table.branch, "cycle": table.cycle}
    names = [name for name in wanted.values() if name]
    words = {table.branch: BRANCHES} if table.branch else {}
    try:
        found = read_columns(path, only=names, words=words, whole=[table.cycle] if table.cycle else [])
    except ColumnsError as error:
        raise LoopFileError("file", str(error)) from None
    for key, name in wanted.items():
        if name and name not in found.values:
            there = (*found.values, *found.others)
            raise LoopFileError(key, f"the file has no column {shown(name)}; {did_you_mean(name, there)}")
    depth = _scaled(found, depth_key, asked, "length")
    load = _scaled(found, "load", table.load, "force")
    columns = [depth, load, *(found.values[name] for name in (table.branch, table.cycle) if name)]
    sound = np.all([np.isfinite(column) for column in columns], axis=0)
    if not sound.any():
        raise LoopFileError("file", "no row has numbers in all of its columns; name a file with some")
    depth, load = depth[sound], load[sound]
    cycle = None if table.cycle is None else found.whole[table.cycle][sound]
    rank = None if cycle is None else np.unique(cycle, return_inverse=True)[1].astype(np.int32)
    if table.branch is not None:
        unloading = found.values[table.branch][sound] == 1.0
        rank = np.ones(depth.size, np.int32) if rank is None else rank
    else:
        unloading, rank = loop_points.ways(depth, rank)
    if not unloading.any():
        raise LoopFileError(
            "file", "the loop has no unloading: the depth never falls after its deepest point; measure both ways"
        )
    return LoopFile(
        depth=depth,
        load=load,
        unloading=unloading,
        cycle=rank.astype(np.int64) if cycle is None else cycle,
        through_machine=table.displacement is not None,
        sha256=found.sha256,
        dropped=int(np.count_nonzero(~sound)),
        noise=loop_points.noise(depth, load, unloading, rank),
    )


def _scaled(found: Columns, key: str, asked: "ColumnTable", dimension: str) -> NDArray[np.float64]:
    """Give a column in SI units."""
    own, unit = _DIMENSIONS[dimension]
    above = found.units.get(asked.column, "")
    written = asked.unit or above
    if not written:
        raise LoopFileError(
            key,
            f'the column {shown(asked.column)} has no unit; write for example {key} = {{ column = "{asked.column}", '
            f'unit = "{unit}" }}, or its unit in brackets after its name in the header',
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
            f"the unit of the column {shown(asked.column)} is {shown(written)} in the study and {shown(above)} in the "
            "header of the file; correct one of the two, or leave it out of the study",
        )
    return found.values[asked.column] * factor


def _is_unit(written: str, name: str, factor: float) -> bool:
    """Tell whether a unit is that of a factor."""
    try:
        return si_value(f"1 {written}", name) == factor
    except ValueError:
        return False


def dropped_sentence(loop: LoopFile, file: str) -> str:
    """Say how many rows were left out; nothing if none was."""
    if not loop.dropped:
        return ""
    were = "was" if loop.dropped == 1 else "were"
    return f"{file}: {counted(loop.dropped, 'row')} without a number {were} left out"


def table_of(data: Mapping[str, Any]) -> Mapping[str, Any]:
    """Give the table [data] of a study, empty where it is none."""
    table = data.get("data")
    return table if isinstance(table, Mapping) else {}
