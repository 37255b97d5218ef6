"""Datasets of ours, opened for reading."""

import math
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Final

import xarray

from gradhesion.cli.dataset.read.soundness import check_form
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.files import is_file, kind_of
from gradhesion.cli.names.curves import EXTENTS, RAGGED
from gradhesion.cli.study.tiling import CHUNK, Tiling
from gradhesion.core.problem.names import TURNS

if TYPE_CHECKING:
    from xarray import Dataset

MOST: Final = 2**22
"""Cells that are read at a time, whatever chunks a file has."""


@contextmanager
def opened(path: Path) -> Iterator["Dataset"]:
    """
    Open a dataset that `gradhesion run` wrote; nothing is loaded yet, and its axes are not indexed.

    Raises
    ------
    DatasetError
        The file is missing, damaged or not ours.
    """
    with found(path, kept=False) as dataset:
        try:
            check_ours(dataset, path)
            check_form(dataset, path)
            yield dataset
        except BrokenPipeError:  # of the message about it
            raise
        except (OSError, RuntimeError) as error:
            raise DatasetError(f"{path}: is damaged ({error}); write it again with `gradhesion run`") from error


def found(path: Path, *, kept: bool) -> "Dataset":
    """
    Open a dataset; it is the caller's to close.

    Parameters
    ----------
    path
        Of a file in NetCDF.
    kept
        Whether values that were read are kept, and axes indexed, so that `sel` finds their labels: for users. Commands
        read each value once and take items by their numbers; what makes indices takes longer than most of them.

    Raises
    ------
    DatasetError
        The file is missing, damaged or none in NetCDF; the message says what it is instead.
    """
    kind = kind_of(path)
    if not is_file(path):
        what = (
            f"is not a file, but {kind or 'something that cannot be read'}"
            if os.path.lexists(path)
            else "does not exist"
        )
        raise DatasetError(f"{path}: {what}; name a dataset that `gradhesion run` wrote")
    try:
        return xarray.open_dataset(path, engine="netcdf4", cache=kept, create_default_indexes=kept)
    except (OSError, ValueError, RuntimeError, AttributeError, TypeError) as error:  # as the libraries say it
        reason = getattr(error, "strerror", None) or str(error)
        other = kind and not kind.startswith("a dataset")
        what, remedy = (f"it is {kind}", "name a dataset that") if other else (reason, "write it again with")
        wrote = " wrote" if other else ""
        raise DatasetError(f"{path}: cannot be read as NetCDF ({what}); {remedy} `gradhesion run`{wrote}") from error


def check_ours(dataset: "Dataset", path: Path | str = "this") -> None:
    """
    Check that a dataset is one of this program.

    Raises
    ------
    DatasetError
        It is not; the message says what is missing.
    """
    missing = [f"the attribute {name}" for name in ("title", "source") if name not in dataset.attrs]
    if "status" not in dataset:
        missing.append("the variable status")
    elif "flag_meanings" not in dataset["status"].attrs:
        missing.append("the attribute flag_meanings of status")
    source = str(dataset.attrs.get("source", "gradhesion"))
    if not missing and source.startswith("gradhesion"):
        return
    lack = f"it lacks {' and '.join(missing)}" if missing else f"its source is {source}"
    raise DatasetError(f"{path}: is not a dataset of gradhesion; name one that `gradhesion run` wrote ({lack})")


def study_text(dataset: "Dataset", path: Path | str) -> str:
    """
    Give the text of the study in a dataset.

    Raises
    ------
    DatasetError
        There is none, as in what `gradhesion.solve` computes of more than a study can say.
    """
    if not {"study", "study_sha256"} <= dataset.attrs.keys():
        raise DatasetError(
            f"{path}: lacks its study, the attributes study and study_sha256; compute it from a study, "
            "with `gradhesion run`"
        )
    return str(dataset.attrs["study"])


def has_curves(dataset: "Dataset") -> bool:
    """Report whether a dataset is that of a curve study."""
    return any(extent in dataset.dims for extent in EXTENTS.values()) or any(
        name in dataset for name in RAGGED.values()
    )


def is_turned(dataset: "Dataset") -> bool:
    """Report whether the cycles of a dataset turn at a depth or a load, so that loading decides on all that follows."""
    return any(name in dataset.coords for name in TURNS)


def tiling_of(variable: "xarray.DataArray") -> Tiling:
    """Cut a variable into blocks of the chunks that it has in its file."""
    chunk = variable.encoding.get("chunksizes") or (CHUNK,)
    return Tiling(variable.shape, max(1, min(math.prod(chunk), MOST)))
