"""A dataset as comma-separated values, a line for each scene, point of a curve, jump or fit; and curves in words."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np
import pandas as pd
import xarray
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.reader import tiling_of
from gradhesion.cli.dataset.read.sensitivities import spread
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.curves import EXTENTS, INTEGERS, MEANINGS, RAGGED, STATE_CURVES, variables_of_curves
from gradhesion.cli.names.fits import LOOP, PARAMETER_UNITS
from gradhesion.cli.names.outputs import PARAMETER, SI
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


def csv_of(tables: Iterable[pd.DataFrame]) -> Iterator[str]:
    """Write tables that go on below each other: the names once, and all digits of the numbers."""
    for i, table in enumerate(tables):
        if i == 0 or len(table):
            yield table.to_csv(index=False, header=i == 0, na_rep="nan", lineterminator="\n").rstrip("\n")


def tabled(dataset: xarray.Dataset, file: Path, chosen: Sequence[str]) -> Iterator[pd.DataFrame]:
    """Give maps or curves, some lines at a time: parameters, variables and status.

    `chosen` are variables, or curves, of a dataset that has several curves one.
    """
    dataset, parts = spread(dataset)
    chosen = [one for name in chosen for one in parts.get(name, [name])]
    dataset = dataset.drop_vars([*parts])  # which is the strongest, readers can see
    names = _variables(dataset, file, chosen)
    beside = [name for name in (SOLVER, *INPUTS, REALISATION) if name in dataset.coords]
    columns = [*beside, *names, "status"]
    first = dataset[names[0]]
    for block in tiling_of(first):
        part = dataset[columns].isel(dict(zip(first.dims, block, strict=True)))
        table = pd.DataFrame(columns_of(part, columns, part[names[0]]))
        if first.dims != dataset["status"].dims:  # of a curve, whose shorter scenes are padded
            table = table[table[names[0]].notna()]
        yield table.astype({name: int for name in names if name in INTEGERS})  # read as floats if some are missing


def jumps_listed(dataset: xarray.Dataset, file: Path) -> Iterator[pd.DataFrame]:
    """List every jump of a dataset, some lines at a time: the parameters that vary, and what is known of it."""
    if JUMP not in dataset.dims:
        raise DatasetError(f'{file}: has no jumps; add "jumps" to the outputs of a study of kind "curve" and run it')
    own = [name for name in variables_of_curves(dataset)["jumps"] if name != COUNT]
    scenes = _varying_of_jumps(dataset)
    ends = np.cumsum(dataset[COUNT].values, dtype=np.int64)
    for start in range(0, max(1, dataset.sizes[JUMP]), ITEMS):
        jumps = {name: dataset[name][start : start + ITEMS].values for name in own}
        scene = np.searchsorted(ends, start + np.arange(len(jumps[own[0]])), side="right")
        yield pd.DataFrame({name: values[scene] for name, values in scenes.items()} | jumps)


def _varying_of_jumps(dataset: xarray.Dataset) -> dict[str, NDArray[np.generic]]:
    """Give the parameters that vary, with a value for each scene."""
    return columns_of(dataset, [name for name in INPUTS if name in dataset and dataset[name].ndim], dataset["status"])


def fit_values(dataset: xarray.Dataset) -> pd.DataFrame:
    """Give the values of fits, a line for each loop and parameter."""
    of_loops = ("reduced_chi_square", "converged", "status") if LOOP in dataset.dims else ()
    names = [*(["file"] if of_loops else []), PARAMETER, PARAMETER_UNITS, *VALUES, *of_loops]
    return pd.DataFrame(columns_of(dataset, names, dataset["value"])).rename(columns={PARAMETER_UNITS: "unit"})


def _variables(dataset: xarray.Dataset, file: Path, chosen: Sequence[str]) -> list[str]:
    """Name the variables of the table but `status`, all of one shape."""
    own = [str(name) for name in dataset.data_vars if name != "status"]
    curves: Mapping[str, list[str]] = variables_of_curves(own)
    wrong = [name for name in chosen if name not in (*own, *curves)]
    if wrong:
        raise DatasetError(f'{file}: there is no variable "{wrong[0]}"; {did_you_mean(wrong[0], [*curves, *own])}')
    names = list(dict.fromkeys(each for name in chosen or own for each in curves.get(name, [name])))
    if {*names} & {*curves.get("jumps", ())}:
        raise DatasetError(f"{file}: jumps have a separate table; add --jumps for it, or choose others with --variable")
    if len({dataset[name].dims for name in names}) > 1:
        choices = " or ".join(f"--variable {curve}" for curve in curves)
        raise DatasetError(f"{file}: each of its curves has its own points; choose one with {choices}")
    return names


def told(name: str, value: str, words: str = "", width: int = 30) -> str:
    """Write a line of a name, its value and what it is."""
    return f"  {name:<{width}} {value:<26} {words}".rstrip()


def unit_behind(variable: xarray.DataArray, before: str = " ") -> str:
    """Give the unit of a variable, nothing if it has none."""
    unit = str(variable.attrs.get("units", "1"))
    return "" if unit == "1" else before + unit


def about(variable: xarray.DataArray) -> str:
    """Say what a variable is, and in which unit."""
    return f"{variable.attrs.get('long_name', 'without a name')}{unit_behind(variable, ', in ')}"


def number_range(numbers: Any) -> str:
    """Report a number of each scene.

    >>> number_range([3, 1200, 4]), number_range([5])
    ('3 to 1,200', '5')
    """
    least, greatest = int(np.min(numbers)), int(np.max(numbers))
    return f"{least:,}" if least == greatest else f"{least:,} to {greatest:,}"


def curve_lines(dataset: xarray.Dataset) -> Iterator[str]:
    """Describe the curves of a dataset, line by line."""
    for curve, names in variables_of_curves(dataset).items():
        yield ""
        if curve in RAGGED:
            yield from _jump_lines(dataset, [name for name in names if name != COUNT])
        else:
            points = dataset[names[0]].notnull().sum(EXTENTS[curve]).values
            yield f"{curve}: {number_range(points)} points per {'state' if curve in STATE_CURVES else 'scene'}"
            if {"path_jump", "path_unloading"} <= {*names}:
                for number, way in enumerate(MEANINGS["path_unloading"].split()):
                    jumps = (dataset["path_jump"] == 1) & (dataset["path_unloading"] == number)
                    yield told(f"jumps on {way}", number_range(jumps.sum(EXTENTS[curve])))
            yield from _extents(dataset, names)


def _extents(dataset: xarray.Dataset, names: Sequence[str]) -> Iterator[str]:
    """Report between what the values of some variables lie: no flags and counts, and in SI where they are."""
    for name in (name for name in names if name not in INTEGERS and f"{name}{SI}" not in names):
        values = dataset[name].values[dataset[name].notnull().values]
        extent = f"{values.min() + 0.0:.6g} to {values.max() + 0.0:.6g}" if values.size else "no value in any scene"
        yield told(name, extent, about(dataset[name]))


def _jump_lines(dataset: xarray.Dataset, names: list[str]) -> Iterator[str]:
    """Report the jumps of a dataset: how many, how large, and where the largest is."""
    counts = dataset[COUNT].values
    yield f"jumps: {number_range(counts)} per scene, {int(counts.sum()):,} in all"
    if not dataset.sizes.get(JUMP):
        return
    jumps = dataset[names].load()
    for name in (name for name in names if name in MEANINGS and jumps[name].any()):
        yield told(MEANINGS[name].split()[1].replace("_", " "), f"{int(jumps[name].sum()):,}")
    yield from _extents(jumps, names)
    if "jump_energy" in jumps:
        item = int(jumps["jump_energy"].values.argmax())
        scene = int(np.searchsorted(np.cumsum(counts), item, side="right"))
        place = {name: values[scene] for name, values in _varying_of_jumps(dataset).items()}
        known = {name: jumps[name].values[item] for name in names} | place
        yield f"  the one that dissipates most: {', '.join(f'{name} = {value:.6g}' for name, value in known.items())}"
