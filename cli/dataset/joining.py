"""Datasets and the studies in them: whether the two belong together, and several as the dataset of one study."""

import hashlib
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np
import pandas as pd
import xarray
from numpy.typing import NDArray

from gradhesion.cli.dataset.describe import variables
from gradhesion.cli.errors import DatasetError, StudyError
from gradhesion.cli.names.scenes import SOLVER, STEEP
from gradhesion.cli.study.files import COMMENT
from gradhesion.cli.study.reading import study_from
from gradhesion.cli.study.study import Study
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.outputs import GIVEN_UP

MAPS: Final = "`gradhesion verify` accepts only maps"
CLOSE: Final = 16 * 2.0**-52
"""Of a coordinate: logarithmic spacing may differ by some units in the last place from one numpy to the next."""
WANTED: Final = "only maps and optima on a grid can be joined"
SHARED: Final = (
    "kind", "search", "searched", "outputs", "method", "profile", "spectrum", "loading",
    "toughness", "rate", "uncertainty",
)  # fmt: skip
"""What the studies of datasets that are joined have in common, beside the keys of their scenes."""


def study_of(dataset: xarray.Dataset, path: Path, kinds: Sequence[str] = ("map",), wanted: str = MAPS) -> Study:
    """Read the study of some kinds out of its dataset; DatasetError if it is another's, or of a kind not `wanted`."""
    if not {"study", "study_sha256"} <= dataset.attrs.keys():  # as of named dimensions
        raise DatasetError(f"{path}: lacks its study; compute it from a study, with `gradhesion run`")
    text = str(dataset.attrs["study"])
    if hashlib.sha256(text.encode()).hexdigest() != dataset.attrs["study_sha256"]:
        raise _apart(path, "the text of its study was changed: its sha256 is not that of the dataset")
    columns = {  # of the file of its points, which the dataset has
        str(name): np.asarray(values.values, dtype=np.float64)
        for name, values in dataset.coords.items()
        if name in INPUTS and values.ndim == 1 and str(values.attrs.get("comment", "")).startswith(COMMENT)
    }
    try:
        data = tomllib.loads(text)
        if "outputs" in data:  # a file of an earlier version has those that were given up
            data["outputs"] = [name for name in data["outputs"] if name not in GIVEN_UP]
        kind = data.get("kind", "map")
        study = study_from(_with_fit(dataset, data), "its study", columns=columns or None) if kind in kinds else None
    except (ValueError, RecursionError) as error:  # of the study, or of what was fitted to the file of its profile
        reason = error.mistakes[0] if isinstance(error, StudyError) else str(error)
        raise DatasetError(f"{path}: its study is not valid in this version ({reason}); write it again") from None
    if study is None or study.search.is_front:
        what = "Pareto fronts, whose size differs from cell to cell" if study else f"the kind {kind}"
        raise DatasetError(f"{path}: contains {what}; {wanted}")
    _check(dataset, study, path)
    return study


def _with_fit(dataset: xarray.Dataset, data: dict[str, Any]) -> dict[str, Any]:
    """Put what was fitted to the file of a profile in its place: the dataset has it."""
    if "file" not in data.get("profile", {}):
        return data
    fit = tomllib.loads(str(dataset.attrs.get("profile_fit", "")))
    home, names = "parameters", ["lambda_over_R", "A"]
    if "physical" in data:
        home, names = "physical", ["R", "wavelength", "amplitude"]
    numbers = {name: float(dataset[name]) for name in names if name in dataset and dataset[name].ndim == 0}
    own = {name: f"{value!r} m" if home == "physical" else value for name, value in numbers.items()}
    return {**data, "profile": fit, home: {**data.get(home, {}), **own}}


def _check(dataset: xarray.Dataset, study: Study, path: Path) -> None:
    """Check that a dataset has what its study describes, along its axes, at its parameters, or at a part of them."""
    lengths = {str(axis): size for axis, size in dataset["status"].sizes.items()}
    lengths |= {name: len(words) for name, words in study.labels.items()}
    for name, variable in variables(study).items():
        if name not in dataset.variables:
            if name in study.spreads:
                continue  # which earlier versions did not write, and nobody recomputes
            if name in study.sizes:
                what = f"was reduced over {name}: its values are not those of scenes"
                raise DatasetError(f"{path}: {what}; give the whole")
            raise _apart(path, f"its study has {name}, which the dataset lacks")
        own = {str(axis): size for axis, size in dataset[name].sizes.items()}
        whole = {axis: lengths[axis] for axis in variable.dimensions if axis in lengths}
        if own != whole if name in (*study.variables, "status") else not own.keys() <= {*variable.dimensions}:
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
    remedy = "its study and its values do not belong together; write it again with `gradhesion run`"
    return DatasetError(f"{path}: {what}: {remedy}")


def joined(sources: Mapping[Path, xarray.Dataset]) -> tuple[Study, dict[str, NDArray[Any]]]:
    """Join datasets: the study of all, and its values; where several have a scene, the first one's hold.

    DatasetError: they differ in something else than the values of axes, in nothing, or lack scenes of the grid of all;
    or one was changed since it was written.
    """
    studies = {file: study_of(dataset, file, ("map", "optimum"), WANTED) for file, dataset in sources.items()}
    (first, one), *_ = studies.items()
    for file, study in studies.items():
        if study.layout != "grid":
            raise DatasetError(f"{file}: {WANTED}, not points")
        if dict(sources[file]["status"].sizes) != study.sizes:
            raise DatasetError(f"{file}: has only a part of the scenes of its study; join whole datasets")
        if missing := [name for name in study.variables if name not in sources[file]]:
            raise DatasetError(f"{file}: lacks {missing[0]}, which earlier versions did not write; run it again")
        apart = [what for what in SHARED if getattr(one, what) != getattr(study, what)]
        apart += sorted(one.parameters.keys() ^ study.parameters.keys())
        apart += ["source"] * (sources[first].attrs["source"] != sources[file].attrs["source"])
        if apart:
            raise DatasetError(f"{file}: differs from {first} in {', '.join(apart)}; join datasets that share them")
    axes = {
        name: np.unique(np.concatenate([np.atleast_1d(study.parameters[name]) for study in studies.values()]))
        for name, values in one.parameters.items()
        if any(not np.array_equal(values, other.parameters[name]) for other in studies.values())
    }
    if not axes:
        files = ", ".join(map(str, studies))
        raise DatasetError(f"{files}: have the same scenes; join datasets that differ in an axis")
    study = study_from(_with_axes(tomllib.loads(one.text), axes), one.name)
    return study, _values(study, studies, sources, axes)


def _with_axes(data: dict[str, Any], axes: Mapping[str, NDArray[np.float64]]) -> dict[str, Any]:
    """Give a study other values of axes, in the unit of the dataset where they have one."""
    for name, values in axes.items():
        table, entry = INPUTS[name].table, values.tolist()
        if table == "physical":
            entry = ["inf" if value == np.inf else f"{value!r} {INPUTS[name].unit}" for value in entry]
        data = {**data, table: {**data[table], name: entry}}
    return data


def _values(
    study: Study,
    studies: Mapping[Path, Study],
    sources: Mapping[Path, xarray.Dataset],
    axes: Mapping[str, NDArray[np.float64]],
) -> dict[str, NDArray[Any]]:
    """Put the values of all sources where they belong in the dataset of their common study."""
    names = [*study.variables, "status", *([STEEP] if any(STEEP in source for source in sources.values()) else [])]
    values: dict[str, NDArray[Any]] = {}
    is_there = np.zeros(study.shape, dtype=bool)
    for file in reversed([*sources]):  # so that the first one's values hold
        source = sources[file]
        # Of its study: a logarithmic axis of another numpy may be off in the last place.
        own = {axis: np.searchsorted(all_of_it, studies[file].parameters[axis]) for axis, all_of_it in axes.items()}
        items = (np.atleast_1d(own.get(axis, np.arange(size))) for axis, size in study.sizes.items())
        place = np.ix_(*items)
        is_there[place] = True
        for name in names:
            part = source.get(name, xarray.zeros_like(source["status"]))  # no scene is marked
            part = part.expand_dims([axis for axis in axes if axis not in part.dims]).transpose(*study.sizes, ...)
            whole = values.setdefault(name, np.empty((*study.shape, *part.shape[len(study.shape) :]), part.dtype))
            whole[place] = part.values
    if missing := np.count_nonzero(~is_there):
        lack = f"{missing:,} scenes of the grid of all along {' and '.join(axes)} are in none of them"
        raise DatasetError(f"{', '.join(map(str, sources))}: {lack}; join datasets that fill it")
    return values
