"""A small dataset as comma-separated values: a line for each scene, or for each point of a curve."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Final

import numpy as np
import xarray

from gradhesion.cli.dataset.read.reader import tiling_of
from gradhesion.cli.dataset.read.sensitivities import parts_of, spread
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.curves import INTEGERS, variables_of_curves
from gradhesion.cli.names.scenes import REALISATION, SOLVER
from gradhesion.cli.terminal.wording import did_you_mean
from gradhesion.core.problem.inputs import INPUTS

MOST: Final = 1_000_000
"""Lines of a table: what a spreadsheet takes."""


def tabled(dataset: xarray.Dataset, file: Path, chosen: Sequence[str]) -> Iterator[str]:
    """
    Write a dataset as CSV, some lines at a time: first the names, then parameters, variables and status.

    Numbers have all their digits. `chosen` are variables, or curves, of a dataset that has several curves one.

    Raises
    ------
    DatasetError
        A variable is not there, the chosen ones have no lines in common, or there are too many lines.
    """
    parts = {name: parts_of(dataset, str(name)) for name in dataset.data_vars}
    chosen = [one for name in chosen for one in (parts.get(name) or [name])]
    dataset = spread(dataset)
    dataset = dataset.drop_vars([name for name, own in parts.items() if own])  # which is the strongest, readers can see
    names = _variables(dataset, file, chosen)
    first = dataset[names[0]]
    if first.size > MOST:
        remedy = "read it with xarray or NCO instead"
        raise DatasetError(f"{file}: {first.size:,} lines, and a table has at most {MOST:,}; {remedy}")
    beside = [name for name in (SOLVER, *INPUTS, REALISATION) if name in dataset.coords]
    columns = [*beside, *names, "status"]
    yield ",".join(columns)
    for block in tiling_of(first):
        part = dataset[columns].isel(dict(zip(first.dims, block, strict=True)))
        lines = part[names[0]]
        values = [part[name].broadcast_like(lines).transpose(*lines.dims).values.ravel() for name in columns]
        filled = ~np.isnan(values[len(beside)]) if first.dims != dataset["status"].dims else slice(None)
        lists = [
            each[filled].astype(int if name in INTEGERS else each.dtype).tolist()  # read as floats if some are missing
            for name, each in zip(columns, values, strict=True)
        ]
        text = "\n".join(",".join(map(_written, row)) for row in zip(*lists, strict=True))
        if text:
            yield text


def _written(value: float | str) -> str:
    return value if isinstance(value, str) else repr(value)


def _variables(dataset: xarray.Dataset, file: Path, chosen: Sequence[str]) -> list[str]:
    """Name the variables of the table but `status`, all of one shape."""
    own = [str(name) for name in dataset.data_vars if name != "status"]
    curves = variables_of_curves(own)
    wrong = [name for name in chosen if name not in (*own, *curves)]
    if wrong:
        raise DatasetError(f'{file}: there is no variable "{wrong[0]}"; {did_you_mean(wrong[0], [*curves, *own])}')
    names = list(dict.fromkeys(each for name in chosen or own for each in curves.get(name, [name])))
    if {*names} & {*curves.get("jumps", ())}:
        raise DatasetError(f"{file}: jumps have a separate table; write it with gradhesion info --jumps")
    if len({dataset[name].dims for name in names}) > 1:
        choices = " or ".join(f"--variable {curve}" for curve in curves)
        raise DatasetError(f"{file}: each of its curves has its own points; choose one with {choices}")
    return names
