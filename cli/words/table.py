"""A dataset as comma-separated values, a line for each scene, point of a curve, jump or fit; and curves in words."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np
import pandas as pd
import xarray
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.reader import tiling_of
from gradhesion.cli.dataset.read.sensitivities import spread
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.curves import EXTENTS, INTEGERS, RAGGED, STATE_CURVES, variables_of_curves
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


def tabled(dataset: xarray.Dataset, file: Path, chosen: Sequence[str]) -> Iterator[str]:
    """Write maps or curves, some lines at a time: first the names, then parameters, variables and status.

    Numbers have all their digits. `chosen` are variables, or curves, of a dataset that has several curves one.
    """
    dataset, parts = spread(dataset)
    chosen = [one for name in chosen for one in parts.get(name, [name])]
    dataset = dataset.drop_vars([*parts])  # which is the strongest, readers can see
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
        if curve not in RAGGED:
            points = dataset[names[0]].notnull().sum(EXTENTS[curve]).values
            yield ""
            yield f"{curve}: {number_range(points)} points per {'state' if curve in STATE_CURVES else 'scene'}"
            own = dataset[[name for name in names if name in INTEGERS]]
            yield from (told(words, number_range(numbers)) for words, numbers in _counts(own).items())
            yield from _extents(dataset, names)


def _counts(own: xarray.Dataset) -> dict[str, NDArray[np.integer]]:
    """Count the branches and jumps of each scene, as far as a curve has them."""
    counts = {}
    if "stable" in own:
        stable = own["stable"].values == 1
        counts["stable branches"] = stable[..., 0] + np.count_nonzero(stable[..., 1:] & ~stable[..., :-1], axis=-1)
    if "path_branch" in own:
        ordered = np.sort(np.fmax(own["path_branch"].values, 0), axis=-1)
        counts["branches followed, with rim"] = np.count_nonzero(np.diff(ordered, axis=-1, prepend=0), axis=-1)
    if {"path_jump", "path_unloading"} <= {*own}:
        for words, way in (("loading", 0), ("unloading", 1)):
            jumps = (own["path_jump"].values == 1) & (own["path_unloading"].values == way)
            counts[f"jumps on {words}"] = np.count_nonzero(jumps, axis=-1)
    return counts


def _extents(dataset: xarray.Dataset, names: Sequence[str]) -> Iterator[str]:
    """Report between what the values of some variables lie: no flags and counts, and in SI where they are."""
    for name in (name for name in names if name not in INTEGERS and f"{name}{SI}" not in names):
        values = dataset[name].values[dataset[name].notnull().values]
        extent = f"{values.min() + 0.0:.6g} to {values.max() + 0.0:.6g}" if values.size else "no value in any scene"
        yield told(name, extent, about(dataset[name]))


def jump_lines(dataset: xarray.Dataset) -> Iterator[str]:
    """Report the jumps of a dataset, if it has them: how many, how large, and where the largest is."""
    if COUNT not in dataset:
        return
    counts = dataset[COUNT].values
    yield ""
    yield f"jumps: {number_range(counts)} per scene, {int(counts.sum()):,} in all"
    if not dataset.sizes.get(JUMP):
        return
    names = [name for name in variables_of_curves(dataset)["jumps"] if name != COUNT]
    jumps = dataset[names].load()
    for words, such in (
        ("on unloading", jumps.get("jump_unloading", 0) == 1),
        ("from or to the rim", jumps.get("jump_at_rim", 0) == 1),
        ("that gain energy", jumps.get("jump_energy", 0.0) < 0.0),
    ):
        if np.any(such):
            yield told(words, f"{int(np.sum(such)):,}")
    yield from _extents(jumps, names)
    if "jump_energy" in jumps:
        item = int(jumps["jump_energy"].values.argmax())
        scene = int(np.searchsorted(np.cumsum(counts), item, side="right"))
        varying = [name for name in INPUTS if name in dataset and dataset[name].ndim]
        place = {name: values[scene] for name, values in columns_of(dataset, varying, dataset["status"]).items()}
        known = {name: jumps[name].values[item] for name in names} | place
        yield f"  the one that dissipates most: {', '.join(f'{name} = {value:.6g}' for name, value in known.items())}"
