"""One of the fits of several loops, as a dataset of one."""

from collections.abc import Sequence

import numpy as np
import xarray

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.fits import FIT_POINTS, FIT_WORDS, LOOP
from gradhesion.cli.terminal.amounts import counted


def one_loop(dataset: xarray.Dataset, choices: Sequence[str]) -> xarray.Dataset:
    """
    Take the loop that `loop=FILE` or `loop=NUMBER` (from 0) wishes, without what it is padded with.

    Raises
    ------
    DatasetError
        Something else is wished, there is no such loop, or it has no fit.
    """
    axis, _, choice = choices[0].partition("=")
    if len(choices) > 1 or axis.strip() != LOOP:
        raise DatasetError(f"--at {choices[-1]}: fits of several loops have only the axis {LOOP}; write --at {LOOP}=0")
    files, choice = list(map(str, dataset["file"].values)), choice.strip()
    if choice not in files and not (choice.isdecimal() and int(choice) < len(files)):
        raise DatasetError(
            f"--at {LOOP}={choice}: there are {counted(len(files), 'loop')}; "
            f"write a number from 0 to {len(files) - 1}, or the name of a file"
        )
    number = files.index(choice) if choice in files else int(choice)
    one = dataset.isel({LOOP: number}).drop_vars([name for name in FIT_WORDS if name in dataset.variables])
    if problem := str(dataset["problem"].values[number]):
        raise DatasetError(f"{files[number]}: has no fit to draw: {problem}")
    filled = {along: one[f"{along.removesuffix('_point')}_unloading"].values >= 0 for along in FIT_POINTS}
    one = one.isel({along: np.flatnonzero(there) for along, there in filled.items()})
    return one.assign_attrs(title=f"{dataset.attrs['title']}: {files[number]}")
