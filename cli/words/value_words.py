"""The values of few scenes as a table in words: a line for each output of one scene, or for each of several scenes."""

from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np
import xarray

from gradhesion.cli.names.outputs import ON_BOUND, SI
from gradhesion.cli.terminal.amounts import counted

MOST: Final = 12
"""Scenes of a table, at most."""
WIDTH: Final = 100
"""Characters of a line, at most."""
GAP: Final = "  "


def is_of_one_scene(dataset: xarray.Dataset, name: str) -> bool:
    """Tell whether a variable is a number, that of a single scene."""
    return dataset["status"].size == 1 and name != ON_BOUND and dataset[name].dims == dataset["status"].dims


def value_lines(dataset: xarray.Dataset, varying: Sequence[str]) -> Iterator[str]:
    """
    Tabulate the outputs of up to 12 scenes; nothing of other datasets.

    A single scene has a line for each output. Of several, each has a line of its parameters and outputs. `varying` are
    the parameters; those of one value are left out. Outputs in SI units stand for their ratios. Columns that do not fit
    into a line are counted below. The status is there if a scene has a flag.
    """
    status = dataset["status"]
    own = [str(name) for name in dataset.data_vars if dataset[name].dims == status.dims]
    own = [name for name in own if name not in ("status", ON_BOUND)]
    if status.size > MOST or not own:
        return
    yield ""
    yield "values"
    yield from _of_one(dataset, own) if status.size == 1 else _of_several(dataset, varying, own)


def _of_one(dataset: xarray.Dataset, own: Sequence[str]) -> Iterator[str]:
    """Give each output of a single scene a line: its name, its value, its unit, what it is."""
    cells = [_column(dataset, name) for name in own]
    values = [f"{value.strip()} {unit.strip()}".rstrip() for _, unit, value in cells]
    wide = [max(map(len, each)) for each in (own, values)]
    for name, value in zip(own, values, strict=True):
        meaning = dataset[name].attrs.get("long_name", "without a name")
        yield f"  {name:<{wide[0]}}  {value:<{wide[1]}}  {meaning}"


def _of_several(dataset: xarray.Dataset, varying: Sequence[str], own: Sequence[str]) -> Iterator[str]:
    """Give each scene a line of its parameters and outputs."""
    status = dataset["status"]
    outputs = list(dict.fromkeys(f"{name}{SI}" if f"{name}{SI}" in own else name for name in own))
    columns = [column for name in varying if len(set((column := _column(dataset, name))[2:])) > 1]
    columns += [_column(dataset, name) for name in outputs]
    last = [_column(dataset, "status")] if status.values.any() else []
    room = WIDTH - sum(len(column[0]) + len(GAP) for column in last)
    widths = np.cumsum([len(column[0]) + len(GAP) for column in columns])
    shown = max(1, int(np.count_nonzero(widths <= room)))
    for line in zip(*columns[:shown], *last, strict=True):
        if written := "".join(GAP + cell for cell in line).rstrip():
            yield written
    if left := len(columns) - shown:
        yield f"  and {counted(left, 'more column')}: gradhesion info --format csv"


def _column(dataset: xarray.Dataset, name: str) -> list[str]:
    """Write a variable for all scenes: its name, its unit, its values, all of one width."""
    status, variable = dataset["status"], dataset[name]
    values = variable.broadcast_like(status).transpose(*status.dims).values.ravel().tolist()
    form = "{:g}" if name in dataset.coords else "{:.7g}"
    written = [value if isinstance(value, str) else form.format(value) for value in values]
    unit = str(variable.attrs.get("units", "1"))
    cells = [name, "" if unit == "1" else unit, *written]
    width = max(map(len, cells))
    return [cell.rjust(width) for cell in cells]
