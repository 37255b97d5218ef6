"""Studies from Python: read, changed and computed in memory."""

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import xarray

import gradhesion.accessor  # noqa: F401 (registers `dataset.gr`)
from gradhesion.cli.errors import StudyError
from gradhesion.cli.installation import checked
from gradhesion.cli.study.fit.study import FitStudy
from gradhesion.cli.study.reading import any_from, load_any
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.text.quantities import as_written
from gradhesion.cli.study.text.toml import value_of
from gradhesion.datasets import as_keywords


def load(
    study: str | Path | Mapping[str, Any],
    *,
    set: Mapping[str, Any] | None = None,  # noqa: A002 (as the option --set)
) -> Study | FitStudy:
    """Read a study, check it as a whole, and expand its axes.

    Parameters
    ----------
    study
        The path of a study in TOML, or a mapping with its keys; lists may be arrays, and strings with units quantities
        of pint, astropy or unyt, or arrays with the attribute `units`. As in a file, a plain number is not a quantity.
    set
        Keys to set, by their dotted paths: {"parameters.A": 0.02, "physical.R": "1 um"}; values as in a mapping.

    Returns
    -------
    The study, frozen: `parameters`, `outputs`, `sizes`, `scenes`, `text` (as TOML) and more; that of a fit has `fixed`,
    `free` and `loop`.

    Raises
    ------
    StudyError
        The study cannot be read or is wrong; the error lists all mistakes.

    Examples
    --------
    >>> import gradhesion as gr
    >>> table = {"outputs": ["pull_off_force"], "parameters": {"k": [0.0, 0.5], "nu": 0.3, "modulus": 500.0,
    ...     "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.02, "a_max_over_R": 1.0}}
    >>> gr.load(table, set={"parameters.A": [0.0, 0.01, 0.02]}).sizes
    {'k': 2, 'A': 3}
    """
    changes = _checked({} if set is None else set)
    if isinstance(study, Mapping):
        return any_from(_changed(study, changes))
    written = {key: as_written(value, tuple(key.split("."))) for key, value in changes.items()}
    with as_keywords():
        return load_any(study, [f"{key}={value_of(value)}" for key, value in written.items()])


def run(
    study: str | Path | Mapping[str, Any] | Study | FitStudy,
    *,
    set: Mapping[str, Any] | None = None,  # noqa: A002 (as the option --set)
    threads: int | None = None,
) -> xarray.Dataset:
    """Compute a study in memory.

    Parameters
    ----------
    study, set
        As for `load`, or a study that it returned.
    threads
        Threads to use, all processors if None; the values do not depend on it.

    Returns
    -------
    The dataset that `gradhesion run` writes to a file.

    Raises
    ------
    StudyError
        The study cannot be read or is wrong; the error lists all mistakes. For a fit: the data do not determine its
        parameters.

    Examples
    --------
    >>> import gradhesion as gr
    >>> table = {"outputs": ["pull_off_force"], "parameters": {"k": [0.0, 0.5], "nu": 0.3, "modulus": 500.0,
    ...     "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.0, "a_max_over_R": 1.0}}
    >>> gr.run(table)["pull_off_force"].values.round(12).tolist()
    [1.0, 1.166666666667]
    """
    if threads is not None and threads < 1:
        raise StudyError(f"threads = {threads}: the number of threads is 1 or more, or None for all processors")
    if not isinstance(study, Study | FitStudy):
        study = load(study, set=set)
    elif set:
        study = any_from(_changed(tomllib.loads(study.text), _checked(set)), folder=study.folder)
    with checked():  # of what needs the compiler, for which `load` has no use
        from gradhesion.cli.dataset.fits import compute_fit  # noqa: PLC0415
        from gradhesion.cli.dataset.writer import compute  # noqa: PLC0415

    return compute_fit(study) if isinstance(study, FitStudy) else compute(study, threads=threads)


def _checked(changes: Any) -> Mapping[str, Any]:
    """Refuse what is no mapping from keys to values, such as the text of an option --set."""
    if not isinstance(changes, Mapping) or not all(isinstance(key, str) for key in changes):
        expected = "a mapping from names of keys to values is expected"
        raise StudyError(f'set: {expected}; write for example set={{"parameters.A": 0.02}}')
    if none := [key for key, value in changes.items() if value is None]:
        remedy = "a key has no value None; leave it out to keep the value of the study"
        raise StudyError([f"set {key}=None: {remedy}" for key in none])
    return changes


def _changed(study: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Set keys of a study by their dotted paths, in a copy."""
    data = {key: {**value} if isinstance(value, Mapping) else value for key, value in study.items()}
    for key, value in changes.items():
        *above, last = key.split(".")
        table = data
        for step in above:
            inner = table.setdefault(step, {})
            if not isinstance(inner, dict):
                raise StudyError(f"set {key}: {step} is not a table; set it as a whole")
            table = inner
        table[last] = value
    return data
