"""Datasets of ours, opened for reading: a file may be damaged, or changed by other programs."""

import math
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Final

from gradhesion.cli.disk import kind_of
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.curves import EXTENTS, RAGGED, variables_of_curves
from gradhesion.cli.names.fits import FIT, FIT_POINTS, PARAMETER_UNITS
from gradhesion.cli.names.outputs import BEST, OUTPUTS, SI, unit_of
from gradhesion.cli.names.scenes import REALISATION, SOLVER
from gradhesion.cli.study.text.quantities import apart, factor_between, filled, scaled
from gradhesion.cli.study.tiling import CHUNK, Tiling
from gradhesion.core.problem.inputs import INPUTS

if TYPE_CHECKING:
    import xarray

MOST: Final = 2**22
"""Cells that are read at a time, whatever chunks a file has."""


@contextmanager
def opened(path: Path) -> Iterator["xarray.Dataset"]:
    """Open a dataset of ours, not loaded, its axes not indexed; DatasetError if it is missing, damaged or not ours."""
    with found(path, kept=False) as dataset:
        try:
            check_form(dataset, path)
            yield dataset
        except BrokenPipeError:  # of the message about it
            raise
        except (OSError, RuntimeError) as error:
            raise DatasetError(f"{path}: is damaged ({error}); write it again with `gradhesion run`") from error


def found(path: Path, *, kept: bool) -> "xarray.Dataset":
    """Open a dataset, which is the caller's to close; DatasetError says what the file is instead.

    For users values that were read are `kept`, and axes indexed, so that `sel` finds their labels. Commands read each
    value once and take items by their numbers; what makes indices takes longer than most of them.
    """
    import xarray  # noqa: PLC0415 (450 ms that `run` does not need)

    kind = kind_of(path)
    if not os.path.isfile(path):  # noqa: PTH113 (that of pathlib raises where a name is too long)
        what = f"is not a file, but {kind or 'cannot be read'}" if os.path.lexists(path) else "does not exist"
        raise DatasetError(f"{path}: {what}; name a dataset that `gradhesion run` wrote")
    try:
        return xarray.open_dataset(path, engine="netcdf4", cache=kept, create_default_indexes=kept)
    except (OSError, ValueError, RuntimeError, AttributeError, TypeError) as error:  # as the libraries say it
        reason = getattr(error, "strerror", None) or str(error)
        if kind and not kind.startswith("a dataset"):
            reason = f"it is {kind}"
        remedy = "name one that `gradhesion run` wrote, or write it again"
        raise DatasetError(f"{path}: cannot be read as NetCDF ({reason}); {remedy}") from error


def check_ours(dataset: "xarray.Dataset", path: Path | str = "this") -> None:
    """Check that a dataset is one of this program; DatasetError says what is missing."""
    missing = [f"the attribute {name}" for name in ("title", "source") if name not in dataset.attrs]
    if "status" not in dataset:
        missing.append("the variable status")
    elif "flag_meanings" not in dataset["status"].attrs:
        missing.append("the attribute flag_meanings of status")
    source = str(dataset.attrs.get("source", "gradhesion"))
    if missing or not source.startswith("gradhesion"):
        lack = f"it lacks {' and '.join(missing)}" if missing else f"its source is {source}"
        raise DatasetError(f"{path}: is not a dataset of gradhesion; name one that `gradhesion run` wrote ({lack})")


def check_form(dataset: "xarray.Dataset", path: Path | str) -> None:
    """Check that a dataset is ours, and all that else relies on; DatasetError says which is not as we write it."""
    check_ours(dataset, path)
    for fault in _faults(dataset):
        raise DatasetError(f"{path}: was changed or is damaged ({fault}); write it again with `gradhesion run`")


def _faults(dataset: "xarray.Dataset") -> Iterator[str]:
    """Say what the scenes lack, the curves of which the counts do not add up, and what a fit lacks."""
    status = dataset["status"]
    if status.dtype.kind not in "iu":
        yield "status does not consist of integers"
    if status.size == 0:
        yield "it has no scene"
    for axis in status.dims:
        if axis in (*INPUTS, SOLVER, REALISATION) and axis not in dataset.coords:
            yield f"the axis {axis} has no values of its own"
    for name, variable in dataset.data_vars.items():
        known = str(name).removesuffix(SI).removeprefix(BEST)
        if (known in OUTPUTS or known in RAGGED.values()) and variable.dims[: status.ndim] != status.dims:
            yield f"the axes of {name} are not those of status"
    for curve in variables_of_curves(dataset.data_vars).keys() & RAGGED.keys():
        count, extent = RAGGED[curve], EXTENTS[curve]
        items = int(dataset[count].values.sum()) if count in dataset else -1
        if items != dataset.sizes.get(extent, max(items, 0)):
            yield f"the numbers of {count} do not add up to those of {extent}"
    if is_fit(dataset):
        needed = (*FIT, PARAMETER_UNITS, *(name for own in FIT_POINTS.values() for name in own))
        yield from (f"it has no {name}" for name in needed if name not in dataset.variables)


def is_fit(dataset: "xarray.Dataset") -> bool:
    """Report whether a dataset is that of a fit."""
    return "chi_square" in dataset.variables


def has_curves(dataset: "xarray.Dataset") -> bool:
    """Report whether a dataset is that of a curve study."""
    return not {*EXTENTS.values(), *RAGGED.values()}.isdisjoint({*dataset.dims, *dataset.variables})


def tiling_of(variable: "xarray.DataArray") -> Tiling:
    """Cut a variable into blocks of the chunks that it has in its file."""
    chunk = variable.encoding.get("chunksizes") or (CHUNK,)
    return Tiling(variable.shape, max(1, min(math.prod(chunk), MOST)))


def in_own_units(dataset: "xarray.Dataset") -> "xarray.Dataset":
    """Give a dataset with plain numbers in the units of our files, whether it was quantified or its units were changed.

    Values of a file are only read where they change.
    """
    changed = {}
    for name, variable in dataset.variables.items():
        own, written = unit_of(str(name)), variable.attrs.get("units")
        numbers, unit = (variable, str(written)) if written is not None else apart(dataset[name])
        if unit and written != own and (factor := factor_between(unit, own)):
            values = None if factor == 1 and written is not None else filled(numbers)
            values = values if values is None or factor == 1 else scaled(values, factor)
            changed[name] = variable.copy(deep=False, data=values)
            changed[name].attrs = variable.attrs | {"units": own}
    return dataset.assign(changed) if changed else dataset
