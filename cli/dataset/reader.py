"""Datasets of ours, opened for reading."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import xarray

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names import EXTENTS, RAGGED
from gradhesion.cli.study.tiling import CHUNK, Tiling

if TYPE_CHECKING:
    from xarray import Dataset


@contextmanager
def opened(path: Path) -> Iterator["Dataset"]:
    """
    Open a dataset that `gradhesion run` wrote; nothing is loaded yet.

    Raises
    ------
    DatasetError
        The file is missing, damaged or not ours.
    """
    if not path.is_file():
        what = "is not a file" if path.exists() else "does not exist"
        raise DatasetError(f"{path}: {what}; name a dataset that `gradhesion run` wrote")
    try:
        dataset = xarray.open_dataset(path, engine="netcdf4", cache=False)
    except (OSError, ValueError, RuntimeError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise DatasetError(
            f"{path}: cannot be read as NetCDF ({reason}); write it again with `gradhesion run`"
        ) from error
    with dataset:
        if "study_sha256" not in dataset.attrs or "status" not in dataset:
            raise DatasetError(f"{path}: is not a dataset of gradhesion; name one that `gradhesion run` wrote")
        try:
            yield dataset
        except BrokenPipeError:  # of what is told about it
            raise
        except (OSError, RuntimeError) as error:
            raise DatasetError(f"{path}: is damaged ({error}); write it again with `gradhesion run`") from error


def has_curves(dataset: "Dataset") -> bool:
    """Tell whether a dataset is that of a curve study."""
    return any(extent in dataset.dims for extent in EXTENTS.values()) or any(
        name in dataset for name in RAGGED.values()
    )


def tiling_of(variable: "xarray.DataArray") -> Tiling:
    """Cut a variable into blocks of the chunks that it has in its file."""
    chunk = variable.encoding.get("chunksizes") or (CHUNK,)
    return Tiling(variable.shape, max(1, math.prod(chunk)))
