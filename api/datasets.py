"""Open and verify datasets of this program."""

from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

import xarray

import gradhesion.accessor  # noqa: F401 (registers `dataset.gr`)
from gradhesion.cli.dataset.read.reader import check_form, check_ours, found, in_own_units, opened
from gradhesion.cli.errors import DatasetError, GradhesionError, StudyError
from gradhesion.cli.installation import checked

if TYPE_CHECKING:
    from gradhesion.cli.dataset.verify import Recomputed

Data = xarray.Dataset | str | Path
"""A dataset, or the path of its file."""


def open_dataset(file: str | Path) -> xarray.Dataset:
    """Open a dataset that `gradhesion run` wrote, or `dataset.to_netcdf`; values are read when they are used.

    Parameters
    ----------
    file
        A NetCDF file.

    Returns
    -------
    The dataset; `with gr.open(...) as dataset` closes its file, as with `xarray.open_dataset`.

    Raises
    ------
    DatasetError
        The file is missing or damaged, or not a dataset of this program; the message names what it is, or what it
        lacks.
    """
    dataset = found(Path(file), kept=True)
    try:
        check_form(dataset, Path(file))
    except BaseException:
        dataset.close()
        raise
    return dataset


def verify(dataset: Data, *, sample: int = 20, seed: int | None = None) -> "Recomputed":
    """Recompute a random sample of a map's scenes to 30 digits by other means, and compare.

    Parameters
    ----------
    dataset
        A dataset with its study in it, or the path of its file.
    sample
        Scenes to recompute, 1 or more.
    seed
        Draws the same sample again; a new one each time if None.

    Returns
    -------
    What was found: `deviations` (the worst first, each with `output`, `scene`, `value`, `expected`, `deviation`,
    `stated` and its `share` of its stated error), the number `exceeding` their stated errors, and what was left out.

    Raises
    ------
    DatasetError
        The dataset has no study, does not belong to it, or contains nothing that can be recomputed.
    MissingExtraError
        python-flint is not installed, or too old.

    Examples
    --------
    >>> import gradhesion as gr
    >>> punch = dict(nu=0.3, modulus=500.0, c0_over_R=0.01, lambda_over_R=0.2, A=0.01, a_max_over_R=1.0)
    >>> found = gr.verify(gr.solve(punch, k=[0.0, 0.5]), seed=7)
    >>> len(found.deviations), found.exceeding
    (4, 0)
    """
    if sample < 1 or (seed is not None and seed < 0):
        wrong = f"gr.verify: sample = {sample}, seed = {seed}"
        raise StudyError(f"{wrong}: a sample of 1 scene or more, a seed of 0 or more")
    with checked():
        from gradhesion.cli.dataset.verify import recompute  # noqa: PLC0415 (python-flint)
    path = Path(dataset) if isinstance(dataset, str | Path) else Path("the dataset")
    with data_of(dataset) as values:
        return recompute(values, path, sample=sample, seed=seed, progress=lambda _: nullcontext(lambda _: None))


@contextmanager
def data_of(dataset: Data) -> Iterator[xarray.Dataset]:
    """Open a dataset, if it is not open; one whose variables were given other units is taken in those of our files.

    DatasetError says that it was not written by this program; sentences within are those `as_keywords`.
    """
    with as_keywords():
        if isinstance(dataset, xarray.Dataset):
            check_ours(dataset, "the dataset")
            yield in_own_units(dataset)
        elif isinstance(dataset, str | Path):
            with opened(Path(dataset)) as values:
                yield values
        else:
            raise DatasetError(
                f"a {type(dataset).__name__} is neither a dataset nor the path of one; a variable alone has no status"
            )


@contextmanager
def as_keywords() -> Iterator[None]:
    """Have mistakes of what is done within name the keyword `at` where a command has the option `--at`."""
    try:
        yield
    except GradhesionError as error:
        error.mistakes = tuple(sentence.replace("--", "") for sentence in error.mistakes)
        error.args = (error.mistakes,)
        raise
