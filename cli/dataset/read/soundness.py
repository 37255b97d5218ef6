"""Whether a dataset has what all else relies on: a file may be damaged, or changed by other programs."""

from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.curves import EXTENTS, RAGGED, variables_of_curves
from gradhesion.cli.names.fits import FIT, FIT_POINTS, PARAMETER_UNITS
from gradhesion.cli.names.outputs import BEST, OUTPUTS, SI
from gradhesion.cli.names.scenes import REALISATION, SOLVER
from gradhesion.core.problem.inputs import INPUTS

if TYPE_CHECKING:
    import xarray


def check_form(dataset: "xarray.Dataset", path: Path | str) -> None:
    """
    Check the variables and dimensions that all else relies on.

    Raises
    ------
    DatasetError
        One is not as we write it; the message says which.
    """
    for fault in chain(_of_scenes(dataset), _of_jumps(dataset), _of_fit(dataset)):
        raise DatasetError(f"{path}: was changed or is damaged ({fault}); write it again with `gradhesion run`")


def _of_scenes(dataset: "xarray.Dataset") -> Iterator[str]:
    """Say what the scenes lack."""
    status = dataset["status"]
    if status.dtype.kind not in "iu":
        yield "status does not consist of integers"
    if status.size == 0:
        yield "it has no scene"
    for axis in status.dims:
        if axis in (*INPUTS, SOLVER, REALISATION) and axis not in dataset.coords:
            yield f"the axis {axis} has no values of its own"
    of_scenes = [RAGGED[curve] for curve in RAGGED]
    for name, variable in dataset.data_vars.items():
        known = str(name).removesuffix(SI).removeprefix(BEST)
        if (known in OUTPUTS or known in of_scenes) and variable.dims[: status.ndim] != status.dims:
            yield f"the axes of {name} are not those of status"


def _of_jumps(dataset: "xarray.Dataset") -> Iterator[str]:
    """Say whether the numbers of items of all scenes do not add up."""
    for curve in variables_of_curves(dataset.data_vars).keys() & RAGGED.keys():
        count, extent = RAGGED[curve], EXTENTS[curve]
        items = int(dataset[count].values.sum()) if count in dataset else -1
        if items != dataset.sizes.get(extent, max(items, 0)):
            yield f"the numbers of {count} do not add up to those of {extent}"


def _of_fit(dataset: "xarray.Dataset") -> Iterator[str]:
    """Say what a fit lacks."""
    if is_fit(dataset):
        needed = (*FIT, PARAMETER_UNITS, *(name for own in FIT_POINTS.values() for name in own))
        yield from (f"it has no {name}" for name in needed if name not in dataset.variables)


def is_fit(dataset: "xarray.Dataset") -> bool:
    """Report whether a dataset is that of a fit."""
    return "chi_square" in dataset.variables


def refuse_fit(dataset: "xarray.Dataset", what: str, path: Path | str = "the dataset") -> None:
    """
    Refuse a fit where scenes are wanted.

    Raises
    ------
    DatasetError
        It is one.
    """
    if is_fit(dataset):
        raise DatasetError(f"{path}: contains a fit, and {what} needs scenes; `gradhesion plot` draws it")
