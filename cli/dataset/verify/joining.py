"""Datasets whose axes have other values, as the dataset of one study whose axes have the values of all."""

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.dataset.dataset import assembled
from gradhesion.cli.dataset.verify.belonging import study_of
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.study.reading import study_from
from gradhesion.cli.study.study import Study
from gradhesion.core.problem.inputs import INPUTS

WANTED: Final = "only maps and optima on a grid can be joined"
SHARED: Final = ("kind", "search", "outputs", "method", "profile", "spectrum", "loading", "uncertainty")
"""What the studies of datasets that are joined have in common, beside the keys of their scenes."""


def joined(sources: Mapping[Path, xarray.Dataset], history: str) -> tuple[Study, xarray.Dataset]:
    """
    Join datasets in memory; where several have a scene, the first one's values hold.

    Raises
    ------
    DatasetError
        They differ in something else than the values of axes, in nothing, or lack scenes of the grid of all; or one was
        changed since it was written.
    """
    studies = {
        file: study_of(dataset, file, kinds=("map", "optimum"), wanted=WANTED) for file, dataset in sources.items()
    }
    (first, one), *others = studies.items()
    for file, study in studies.items():
        if study.layout != "grid":
            raise DatasetError(f"{file}: {WANTED}, not points")
        if dict(sources[file]["status"].sizes) != study.sizes:
            raise DatasetError(f"{file}: has only a part of the scenes of its study; join whole datasets")
        if missing := [name for name in study.variables if name not in sources[file]]:
            raise DatasetError(f"{file}: lacks {missing[0]}, which earlier versions did not write; run it again")
    for file, other in others:
        _check_shared(first, one, file, other)
        written = [sources[each].attrs["source"] for each in (first, file)]
        if written[0] != written[1]:
            raise DatasetError(
                f"{file}: was written by {written[1]}, and {first} by {written[0]}; run one of them again"
            )
    axes = {
        name: np.unique(np.concatenate([np.atleast_1d(study.parameters[name]) for study in studies.values()]))
        for name, values in one.parameters.items()
        if any(not np.array_equal(values, other.parameters[name]) for _, other in others)
    }
    if not axes:
        raise DatasetError(
            f"{', '.join(map(str, studies))}: have the same scenes; join datasets that differ in an axis"
        )
    study = study_from(_with_axes(tomllib.loads(one.text), axes), one.name)
    return study, assembled(study, _values(study, studies, sources, axes), history)


def _check_shared(first: Path, one: Study, file: Path, other: Study) -> None:
    """Check that two studies differ in nothing but the values of their parameters."""
    for what in SHARED:
        if getattr(one, what) != getattr(other, what):
            raise DatasetError(f"{file}: differs from {first} in {what}; join datasets that share it")
    if one.parameters.keys() != other.parameters.keys():
        keys = ", ".join(sorted(one.parameters.keys() ^ other.parameters.keys()))
        raise DatasetError(
            f"{file}: gives its scenes by different keys from {first} ({keys}); join datasets that share them"
        )


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
    there = np.zeros(study.shape, bool)
    found: dict[str, NDArray[Any]] = {}
    for file, source in reversed([*sources.items()]):
        own = studies[file].parameters
        along = {axis: np.searchsorted(values, np.atleast_1d(own[axis])) for axis, values in axes.items()}
        place = np.ix_(*(along.get(axis, np.arange(size)) for axis, size in study.sizes.items()))
        there[place] = True
        for name in names:
            values = source[name] if name in source else xarray.zeros_like(source["status"])  # no scene is marked
            values = values.expand_dims([axis for axis in axes if axis not in values.dims]).transpose(*study.sizes, ...)
            whole = found.setdefault(name, np.empty(study.shape_of(name, study.shape), values.dtype))
            whole[place] = values.values
    if not there.all():
        missing = f"{np.count_nonzero(~there):,} scenes of their common grid are in none of them"
        files = ", ".join(map(str, sources))
        raise DatasetError(f"{files}: differ in {' and '.join(axes)}, and {missing}; join datasets that fill it")
    return found
