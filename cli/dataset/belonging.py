"""Whether a dataset is that of the study in it: the text unchanged, and the coordinates those that it gives."""

import hashlib
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np
import pandas as pd
import xarray

from gradhesion.cli.dataset.describe import variables
from gradhesion.cli.dataset.read.reader import study_text
from gradhesion.cli.errors import DatasetError, StudyError
from gradhesion.cli.names.outputs import labels_of
from gradhesion.cli.names.scenes import SOLVER
from gradhesion.cli.study.files import COMMENT, points_of
from gradhesion.cli.study.reading import study_from
from gradhesion.cli.study.study import Study
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.outputs import GIVEN_UP

CLOSE: Final = 16 * 2.0**-52
"""Of a coordinate: logarithmic spacing may differ by some units in the last place from one numpy to the next."""


def study_of(
    dataset: xarray.Dataset,
    path: Path,
    *,
    kinds: Sequence[str] = ("map",),
    wanted: str = "`gradhesion verify` accepts only maps",
) -> Study:
    """Read the study of some kinds out of its dataset; `wanted` says of another which are wanted.

    Raises
    ------
    DatasetError
        The study was edited, is not that of the dataset, or is of another kind.
    """
    text = study_text(dataset, path)
    if hashlib.sha256(text.encode()).hexdigest() != dataset.attrs["study_sha256"]:
        raise _apart(path, "the text of its study was changed: its sha256 is not that of the dataset")
    try:
        data = tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise _apart(path, f"its study is not valid TOML ({error})") from None
    if (kind := data.get("kind", "map")) not in kinds:
        raise DatasetError(f"{path}: contains {'an' if kind == 'optimum' else 'a'} {kind}; {wanted}")
    if isinstance(data.get("outputs"), list):  # a file of an earlier version has them
        data["outputs"] = [name for name in data["outputs"] if name not in GIVEN_UP]
    try:
        study = study_from(_with_fit(dataset, data), "its study", **_points_of(dataset, data, path))
    except ValueError as error:  # of the study, or of what was fitted to the file of its profile
        reason = error.mistakes[0] if isinstance(error, StudyError) else str(error)
        raise DatasetError(f"{path}: its study is not valid in this version ({reason}); write it again") from None
    if study.search.is_front:
        raise DatasetError(f"{path}: contains Pareto fronts, whose size differs from cell to cell; {wanted}")
    _check(dataset, study, path)
    return study


def _with_fit(dataset: xarray.Dataset, data: dict[str, Any]) -> dict[str, Any]:
    """Put what was fitted to the file of a profile in its place: the dataset has it."""
    table = data.get("profile")
    if not isinstance(table, Mapping) or "file" not in table:
        return data
    fit = tomllib.loads(str(dataset.attrs.get("profile_fit", "")))
    names = ("R", "wavelength", "amplitude") if isinstance(data.get("physical"), Mapping) else ("lambda_over_R", "A")
    home = "physical" if len(names) == 3 else "parameters"
    numbers = {name: float(dataset[name]) for name in names if name in dataset and dataset[name].ndim == 0}
    own = {name: f"{value!r} m" if home == "physical" else value for name, value in numbers.items()}
    given = data.get(home)
    return {**data, "profile": fit, home: {**(given if isinstance(given, Mapping) else {}), **own}}


def _points_of(dataset: xarray.Dataset, data: dict[str, Any], path: Path) -> dict[str, Any]:
    """Find the file of its points, in the current directory or beside the dataset; else what the dataset has of it."""
    columns = {
        str(name): np.asarray(values.values, dtype=np.float64)
        for name, values in dataset.coords.items()
        if name in INPUTS and values.ndim == 1 and str(values.attrs.get("comment", "")).startswith(COMMENT)
    }
    for folder in (Path(), path.parent):
        if columns and not points_of(data, folder).mistakes:
            return {"folder": folder}
    return {"columns": columns} if columns else {}


def _check(dataset: xarray.Dataset, study: Study, path: Path) -> None:
    """Check that a dataset has what its study describes, along its axes, at its parameters, or at a part of them."""
    sizes = {str(axis): size for axis, size in dataset["status"].sizes.items()}
    for axis, size in sizes.items():
        if size > (own_size := study.sizes.get(axis, 0)):
            raise _apart(path, f"its study has {own_size:,} items of {axis}, the dataset {size:,}")
    for name, variable in variables(study).items():
        if name not in dataset.variables:
            if name in study.spreads:
                continue  # which earlier versions did not write, and nobody recomputes
            if name in study.sizes:
                what = f"was reduced over {name}: its values are not those of scenes"
                raise DatasetError(f"{path}: {what}; give the whole")
            raise _apart(path, f"its study has {name}, which the dataset lacks")
        own = labels_of(name)
        whole = sizes | ({own: len(study.labels[own])} if own else {})
        is_output = name in (*study.variables, "status")
        fits = dict(dataset[name].sizes) == whole if is_output else {*dataset[name].dims} <= {*variable.dimensions}
        if not fits:
            raise _apart(path, f"the axes of {name} are not those of its study")
        if name in study.parameters:
            here, given = np.ravel(dataset[name].values), np.ravel(study.parameters[name])
            nearest = given
            if here.size != given.size:
                rising = pd.Index(np.unique(given))
                with np.errstate(invalid="ignore"):  # of inf
                    nearest = rising[rising.get_indexer(here, method="nearest")].to_numpy()
            wrong = np.flatnonzero(~np.isclose(here, nearest, rtol=CLOSE, atol=0.0))
            if wrong.size:
                at = f"[{wrong[0]}]" if dataset[name].ndim else ""
                raise _apart(path, f"{name}{at} is {here[wrong[0]]!s}, in its study {nearest[wrong[0]]!s}")
    solvers = [str(solver) for solver in np.ravel(dataset[SOLVER].values if SOLVER in dataset else ())]
    if [solver for solver in np.ravel(study.method.solver) if solver in solvers] != solvers:
        raise _apart(path, "its solvers are not those of its study")


def _apart(path: Path, what: str) -> DatasetError:
    """Make the error of a dataset that is not that of the study in it."""
    return DatasetError(
        f"{path}: {what}, so that its study and its values do not belong together; write it again with `gradhesion run`"
    )
