"""A part of a dataset, or one whose axes are reduced, as a dataset of its own."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import xarray

from gradhesion.cli.dataset.read.loop_choice import one_loop
from gradhesion.cli.dataset.read.reader import has_curves
from gradhesion.cli.dataset.read.selection import Selection, selection_of
from gradhesion.cli.dataset.read.soundness import is_fit
from gradhesion.cli.disk import replacement, writing
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.fits import LOOP
from gradhesion.cli.names.outputs import ON_BOUND
from gradhesion.cli.names.scenes import STEEP


def selected(dataset: xarray.Dataset, at: Sequence[str] = (), over: Sequence[str] = ()) -> xarray.Dataset:
    """
    Take a part of a dataset: axes fixed or cut, as `selection_of` reads it, then axes reduced; of fits one loop.

    A flag of a reduced scene is that of any of those that it is reduced from. A part without reductions is loaded when
    it is used.

    Raises
    ------
    DatasetError
        A wish cannot be read or met.
    """
    if is_fit(dataset):
        if over or LOOP not in dataset.dims:
            raise DatasetError(
                f"--{'over' if over else 'at'}: fits have no axes of scenes; of several, choose --at loop=0"
            )
        return one_loop(dataset, at) if at else dataset
    if over and has_curves(dataset):
        raise DatasetError(f"--over {over[0]}: curves are not reduced; choose scenes with --at")
    selection = selection_of(dataset, at, over)
    if place := [axis for axis, how in selection.over.items() if how.startswith("arg")]:
        raise DatasetError(f"--over {place[0]}={selection.over[place[0]]}: places are drawn by `gradhesion plot` only")
    narrow = selection.narrowed(dataset)
    return _reduced(narrow, selection) if selection.over else narrow


def _reduced(dataset: xarray.Dataset, selection: Selection) -> xarray.Dataset:
    """Reduce every variable of a narrowed dataset; what follows from the axes that go goes with them."""
    status, going = dataset["status"], [*selection.over]
    axes = [axis for axis in status.dims if axis not in going]
    made: dict[str, xarray.DataArray] = {}
    for name, variable in ((str(name), one) for name, one in dataset.data_vars.items()):
        if name in ("status", ON_BOUND):
            made[name] = variable.reduce(np.bitwise_or.reduce, going, keep_attrs=True)
            continue
        values = selection.taken(variable, status).values.transpose(*axes, ...)
        words = ", ".join(f"{how} over {axis}" for axis, how in selection.over.items())
        values.attrs["long_name"] = f"{variable.attrs.get('long_name', name)}; {words}"
        made[name] = values
    kept = {name: one for name, one in dataset.coords.items() if not {*one.dims} & {*going}}
    if STEEP in dataset.coords:
        kept[STEEP] = dataset[STEEP].max(going, keep_attrs=True)
    plain = {name: one.variable for name, one in made.items()}
    return xarray.Dataset(plain, {name: one.variable for name, one in kept.items()}, dataset.attrs)


def write_dataset(dataset: xarray.Dataset, path: Path, *, overwrite: bool) -> None:
    """
    Write a dataset out of memory, which takes the place of `path` when it is complete and on disk.

    Raises
    ------
    OutputError
        It cannot be written, or exists.
    """
    packed = {"zlib": True, "complevel": 1, "shuffle": True}
    encoding = {}
    for name, variable in dataset.variables.items():
        is_packed = variable.ndim and variable.dtype.kind in "fiu"
        encoding[name] = (packed if is_packed else {}) | {"_FillValue": variable.encoding.get("_FillValue")}
    dataset = dataset.drop_encoding()  # that of the whole: chunks, and names of coordinates that may be gone
    with replacement(path, overwrite=overwrite) as temporary, writing(path):
        dataset.to_netcdf(temporary, format="NETCDF4", engine="netcdf4", encoding=encoding)
