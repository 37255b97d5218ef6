"""Files that appear whole or not at all, and the dataset of a study written block by block."""

import os
import secrets
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, Final

import netCDF4
import numpy as np

from gradhesion.cli import dataset
from gradhesion.cli.blocks import blocks, chunk_shape, size_of
from gradhesion.cli.curves import within
from gradhesion.cli.errors import OutputError
from gradhesion.cli.names import RAGGED
from gradhesion.cli.study import Study
from gradhesion.core import FAILED

LEAST_SHARE: Final = 0.1
"""Values hardly compress to less than this share: what cannot fit is refused before it is begun."""

POINTS: Final = 1024
"""Points of a curve in a chunk: most curves have fewer, and unwritten chunks take no room."""


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Turn a failure to write into a sentence about `path`."""
    try:
        yield
    except (OSError, RuntimeError) as error:  # netCDF4 raises RuntimeError where HDF5 cannot write
        raise OutputError(_reason(path, error)) from error


@contextmanager
def replacement(path: Path, *, overwrite: bool) -> Iterator[Path]:
    """
    Give a temporary file beside `path` that takes its place, complete and on disk, when the body ends.

    If the body fails, or is interrupted, the temporary file goes and what stood at `path` is as it was.

    Raises
    ------
    OutputError
        At once, if `path` exists and may not be replaced or its folder cannot be written; later, if it cannot be
        finished.
    """
    target = Path(os.path.realpath(path))
    with writing(path):
        exists, is_file = target.exists(), target.is_file()
    if exists and not is_file:
        raise OutputError(f"{path}: is not a file, so it cannot be replaced; name another output with -o")
    if exists and not overwrite:
        raise OutputError(f"{path}: exists already; add --overwrite to replace it, or name another output with -o")
    # Its name is known before it is made, so that no interrupt comes between the two and leaves it behind.
    temporary = target.with_name(f".{target.name[:100]}.{secrets.token_hex(8)}.part{target.suffix}")
    try:
        with writing(path):
            target.parent.mkdir(parents=True, exist_ok=True)
            temporary.touch(exist_ok=False)
        yield temporary
        with writing(path):
            _to_disk(temporary)
            temporary.replace(target)
        with suppress(OSError):  # some file systems cannot sync a folder
            _to_disk(target.parent)
    finally:
        with suppress(OSError):
            temporary.unlink(missing_ok=True)


def write(
    study: Study,
    path: Path,
    *,
    history: str,
    overwrite: bool = False,
    threads: int | None = None,
    advance: Callable[[int], None] = lambda _: None,
) -> int:
    """
    Compute a study into a file; `advance` is told the scenes of each block when they are written.

    Returns
    -------
    The number of scenes that have failed.
    """
    failed = 0
    with replacement(path, overwrite=overwrite) as temporary:
        _check_space(study, path, temporary)
        with writing(path):
            file = netCDF4.Dataset(temporary, "w", format="NETCDF4")
        try:
            with writing(path):
                _define(file, study, history)
            begun = 0  # items of ragged curves
            for block, values in dataset.parts(study, threads):
                with writing(path):
                    for name, part in values.items():
                        file[name][within(name, block, part, begun) or ...] = part
                begun += sum(int(values[count].item()) for count in RAGGED.values() if count in values)
                failed += int(np.count_nonzero(values["status"] & FAILED))
                advance(size_of(block))
        except BaseException:
            with suppress(OSError, RuntimeError):  # what went wrong first counts
                file.close()
            raise
        with writing(path):
            file.close()
    return failed


def _define(file: netCDF4.Dataset, study: Study, history: str) -> None:
    """Write all of a dataset but the values of its outputs."""
    if study.kind == "map":
        file.set_fill_off()  # every cell is written
    file.setncatts(dataset.attributes(study, history))
    for name, size in study.sizes.items():
        file.createDimension(name, size)
    for name, described in dataset.variables(study).items():
        settings: dict[str, Any] = {}
        if described.dimensions and described.dtype != "str":
            for dimension in described.dimensions:
                if dimension not in file.dimensions:
                    file.createDimension(dimension, None)  # it grows with the longest curve
            settings |= {"compression": "zlib", "complevel": 1, "shuffle": True}
            settings["chunksizes"] = _chunks(tuple(file.dimensions[one] for one in described.dimensions))
        if described.blank is not None:
            settings["fill_value"] = described.blank
        dtype = str if described.dtype == "str" else described.dtype
        variable = file.createVariable(name, dtype, described.dimensions, **settings)
        variable.setncatts(described.attributes)
        if described.values is not None:
            variable[...] = described.values
        elif described.made:
            for block in blocks(variable.shape):
                variable[block or ...] = described.made(block)


def _chunks(dimensions: tuple[netCDF4.Dimension, ...]) -> tuple[int, ...]:
    """Choose the chunks of a variable: of a curve they are its own, of all else those of the blocks."""
    if dimensions[-1].isunlimited():
        return (*(1 for _ in dimensions[:-1]), POINTS)
    return chunk_shape(tuple(map(len, dimensions)))


def _check_space(study: Study, path: Path, temporary: Path) -> None:
    """Refuse a dataset that cannot fit on its disk."""
    least = study.scenes * LEAST_SHARE * sum(8 for output in study.outputs if not output.endswith("_jumps"))
    free = shutil.disk_usage(temporary.parent).free
    if least > free:
        raise OutputError(
            f"{path}: {study.scenes:,} scenes need {_bytes(least)} or more, and {_bytes(free)} are free there; "
            "use fewer scenes, or name an output on a larger disk with -o"
        )


def _to_disk(path: Path) -> None:
    """Wait until a file or folder is on disk."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _reason(path: Path, error: Exception) -> str:
    """Say why an output could not be written."""
    reason = getattr(error, "strerror", None) or str(error)
    with suppress(OSError, RuntimeError):
        free = shutil.disk_usage(path.resolve().parent).free
        if free < 2**20:
            reason = f"{reason}; {_bytes(free)} are free on its disk"
    return (
        f"{path}: cannot be written ({reason}); what stood there before is untouched; "
        "make room or get the right to write, or name another output with -o"
    )


def _bytes(number: float) -> str:
    """
    Write a number of bytes in the unit that fits.

    >>> _bytes(2.5e9), _bytes(300)
    ('2.5 GB', '0.3 kB')
    """
    unit, size = next((pair for pair in (("TB", 1e12), ("GB", 1e9), ("MB", 1e6)) if number >= pair[1]), ("kB", 1e3))
    return f"{number / size:,.1f} {unit}"
