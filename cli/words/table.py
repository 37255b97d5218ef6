"""A dataset as comma-separated values: a line for each scene, point of a curve, jump, or fitted value."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Final

import numpy as np
import pandas as pd
import xarray
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.reader import tiling_of
from gradhesion.cli.dataset.read.sensitivities import parts_of, spread
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.curves import EXTENTS, INTEGERS, RAGGED, variables_of_curves
from gradhesion.cli.names.fits import LOOP, PARAMETER_UNITS
from gradhesion.cli.names.outputs import PARAMETER
from gradhesion.cli.names.scenes import REALISATION, SOLVER
from gradhesion.cli.terminal.wording import did_you_mean
from gradhesion.core.problem.inputs import INPUTS

ITEMS: Final = 2**16
"""Jumps that are read at a time."""
COUNT: Final = RAGGED["jumps"]
JUMP: Final = EXTENTS["jumps"]

VALUES: Final = ("value", "standard_deviation", "low", "high", "on_bound")
"""The columns of a fit, after the parameter and its unit."""


def columns_of(dataset: xarray.Dataset, names: Sequence[str], like: xarray.DataArray) -> dict[str, NDArray[np.generic]]:
    """Give some variables as columns, with a row for each item of one that has all of their dimensions."""
    return {name: dataset[name].broadcast_like(like).transpose(*like.dims).values.ravel() for name in names}


def tabled(dataset: xarray.Dataset, file: Path, chosen: Sequence[str]) -> Iterator[str]:
    """Write maps or curves, some lines at a time: first the names, then parameters, variables and status.

    Numbers have all their digits. `chosen` are variables, or curves, of a dataset that has several curves one.
    """
    parts = {name: parts_of(dataset, str(name)) for name in dataset.data_vars}
    chosen = [one for name in chosen for one in (parts.get(name) or [name])]
    dataset = spread(dataset)
    dataset = dataset.drop_vars([name for name, own in parts.items() if own])  # which is the strongest, readers can see
    names = _variables(dataset, file, chosen)
    beside = [name for name in (SOLVER, *INPUTS, REALISATION) if name in dataset.coords]
    columns = [*beside, *names, "status"]
    first = dataset[names[0]]
    yield ",".join(columns)
    for block in tiling_of(first):
        part = dataset[columns].isel(dict(zip(first.dims, block, strict=True)))
        frame = pd.DataFrame(columns_of(part, columns, part[names[0]]))
        if first.dims != dataset["status"].dims:  # of a curve, whose shorter scenes are padded
            frame = frame[frame[names[0]].notna()]
        integers = {name: int for name in names if name in INTEGERS}  # read as floats if some are missing
        yield from _lines(frame.astype(integers))


def jumps_listed(dataset: xarray.Dataset, file: Path, items: int = ITEMS) -> Iterator[str]:
    """List every jump of a dataset, some lines at a time: the parameters that vary, and what is known of it."""
    if JUMP not in dataset.dims:
        raise DatasetError(f'{file}: has no jumps; add "jumps" to the outputs of a study of kind "curve" and run it')
    own = [name for name in variables_of_curves(dataset)["jumps"] if name != COUNT]
    varying = [name for name in INPUTS if name in dataset and dataset[name].ndim]
    scenes = columns_of(dataset, varying, dataset["status"])
    ends = np.cumsum(dataset[COUNT].values, dtype=np.int64)
    yield ",".join((*varying, *own))
    for start in range(0, dataset.sizes[JUMP], items):
        jumps = {name: dataset[name][start : start + items].values for name in own}
        scene = np.searchsorted(ends, start + np.arange(len(jumps[own[0]])), side="right")
        yield from _lines(pd.DataFrame({name: values[scene] for name, values in scenes.items()} | jumps))


def fits_tabled(dataset: xarray.Dataset) -> Iterator[str]:
    """Write the values of fits, a line for each loop and parameter."""
    of_loops = ("reduced_chi_square", "converged", "status") if LOOP in dataset.dims else ()
    names = [*(["file"] if of_loops else []), PARAMETER, PARAMETER_UNITS, *VALUES, *of_loops]
    table = pd.DataFrame(columns_of(dataset, names, dataset["value"])).rename(columns={PARAMETER_UNITS: "unit"})
    yield ",".join(table.columns)
    yield from _lines(table)


def _lines(table: pd.DataFrame) -> Iterator[str]:
    """Write the rows of a table, with all digits of their numbers; nothing if it has none."""
    if len(table):
        yield table.to_csv(index=False, header=False, na_rep="nan", lineterminator="\n").rstrip("\n")


def _variables(dataset: xarray.Dataset, file: Path, chosen: Sequence[str]) -> list[str]:
    """Name the variables of the table but `status`, all of one shape."""
    own = [str(name) for name in dataset.data_vars if name != "status"]
    curves: Mapping[str, list[str]] = variables_of_curves(own)
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
