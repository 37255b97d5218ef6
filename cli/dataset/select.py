"""A part of a dataset, or one whose axes are reduced, as a dataset of its own."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import xarray

from gradhesion.cli.dataset.read.reader import has_curves, is_fit
from gradhesion.cli.dataset.read.reductions import REDUCTIONS
from gradhesion.cli.dataset.read.selection import Selection, selection_of
from gradhesion.cli.disk import replacement, writing
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.fits import FIT_POINTS, FIT_WORDS, LOOP
from gradhesion.cli.names.outputs import ON_BOUND
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.terminal.amounts import counted


def selected(dataset: xarray.Dataset, at: Sequence[str] = (), over: Sequence[str] = ()) -> xarray.Dataset:
    """Take a part of a dataset: axes fixed or cut, as `selection_of` reads it, then reduced; of fits one loop.

    A reduced scene has the flags of all that it is reduced from. DatasetError says which wish cannot be met.
    """
    if is_fit(dataset):
        if over or LOOP not in dataset.dims:
            option = "over" if over else "at"
            raise DatasetError(f"--{option}: fits have no axes of scenes; of several, choose --at {LOOP}=0")
        return one_loop(dataset, at) if at else dataset
    if over and has_curves(dataset):
        raise DatasetError(f"--over {over[0]}: curves are not reduced; choose scenes with --at")
    values = [how for how in REDUCTIONS if not how.startswith("arg")]  # places are drawn by `gradhesion plot` only
    selection = selection_of(dataset, at, over, ways=values)
    narrow = selection.narrowed(dataset)
    return _reduced(narrow, selection) if selection.over else narrow


def _reduced(dataset: xarray.Dataset, selection: Selection) -> xarray.Dataset:
    """Reduce every variable of a narrowed dataset; what follows from the axes that go goes with them."""
    status, going = dataset["status"], [*selection.over]
    axes = [axis for axis in status.dims if axis not in going]
    words = ", ".join(f"{how} over {axis}" for axis, how in selection.over.items())
    made: dict[str, xarray.DataArray] = {}
    for name, variable in ((str(name), one) for name, one in dataset.data_vars.items()):
        if name in ("status", ON_BOUND):
            made[name] = variable.reduce(np.bitwise_or.reduce, going, keep_attrs=True)
            continue
        made[name] = selection.taken(variable, status).values.transpose(*axes, ...)
        about = f"{variable.attrs.get('long_name', name)}; {words}"
        made[name] = made[name].assign_attrs(long_name=about, reduced=words)
    kept = {str(name): one for name, one in dataset.coords.items() if not {*one.dims} & {*going}}
    if STEEP in dataset.coords:
        kept[STEEP] = dataset[STEEP].max(going, keep_attrs=True)
    values, coordinates = ({name: one.variable for name, one in own.items()} for own in (made, kept))
    return xarray.Dataset(values, coordinates, dataset.attrs)


def one_loop(dataset: xarray.Dataset, choices: Sequence[str]) -> xarray.Dataset:
    """Take the loop that `loop=FILE` or `loop=NUMBER` (from 0) wishes, without its padding (DatasetError)."""
    axis, _, choice = (part.strip() for part in choices[0].partition("="))
    if len(choices) > 1 or axis != LOOP:
        raise DatasetError(f"--at {choices[-1]}: fits of several loops have only the axis {LOOP}; write --at {LOOP}=0")
    files = list(map(str, dataset["file"].values))
    if choice not in files and not (choice.isdecimal() and int(choice) < len(files)):
        known = f"a number from 0 to {len(files) - 1}, or the name of a file"
        raise DatasetError(f"--at {LOOP}={choice}: there are {counted(len(files), 'loop')}; write {known}")
    number = files.index(choice) if choice in files else int(choice)
    one = dataset.isel({LOOP: number}).drop_vars([name for name in FIT_WORDS if name in dataset.variables])
    if problem := str(dataset["problem"].values[number]):
        raise DatasetError(f"{files[number]}: has no fit to draw: {problem}")
    filled = {along: one[f"{along.removesuffix('_point')}_unloading"].values >= 0 for along in FIT_POINTS}
    one = one.isel({along: np.flatnonzero(there) for along, there in filled.items()})
    return one.assign_attrs(title=f"{dataset.attrs['title']}: {files[number]}")


def write_dataset(dataset: xarray.Dataset, path: Path, *, overwrite: bool) -> None:
    """Write a dataset out of memory, which takes the place of `path` when it is whole and on disk (OutputError)."""
    packed = {"zlib": True, "complevel": 1, "shuffle": True}
    encoding = {
        name: {"_FillValue": variable.encoding.get("_FillValue")}
        | (packed if variable.ndim and variable.dtype.kind in "fiu" else {})
        for name, variable in dataset.variables.items()
    }
    dataset = dataset.drop_encoding()  # that of the whole: chunks, and names of coordinates that may be gone
    with replacement(path, overwrite=overwrite) as temporary, writing(path):
        dataset.to_netcdf(temporary, format="NETCDF4", engine="netcdf4", encoding=encoding)
