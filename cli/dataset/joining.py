"""Datasets whose axes have other values, as the dataset of one study whose axes have the values of all."""

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.dataset.belonging import study_of
from gradhesion.cli.dataset.dataset import assembled
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.study.reading import study_from
from gradhesion.cli.study.study import Study
from gradhesion.core.problem.inputs import INPUTS

WANTED: Final = "only maps and optima on a grid can be joined"
SHARED: Final = (
    "kind", "search", "searched", "outputs", "method", "profile", "spectrum", "loading",
    "toughness", "rate", "uncertainty",
)  # fmt: skip
"""What the studies of datasets that are joined have in common, beside the keys of their scenes."""


def joined(sources: Mapping[Path, xarray.Dataset], history: str) -> tuple[Study, xarray.Dataset]:
    """Join datasets in memory; where several have a scene, the first one's values hold.

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
    return study, assembled(study, _values(study, studies, sources, axes), history)


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
    types: dict[str, Any] = {}
    whole = xarray.Dataset()
    for file, source in sources.items():
        none = xarray.zeros_like(source["status"].variable)  # no scene is marked
        part = xarray.Dataset({name: source[name].variable if name in source else none for name in names})
        types |= {name: part[name].dtype for name in names}
        part = part.expand_dims([axis for axis in axes if axis not in part.dims])
        # Of its study: a logarithmic axis of another numpy may be off in the last place.
        own = {axis: np.atleast_1d(studies[file].parameters[axis]) for axis in axes}
        whole = whole.combine_first(part.assign_coords(own))
    if missing := int(whole["status"].isnull().sum()):
        lack = f"{missing:,} scenes of the grid of all along {' and '.join(axes)} are in none of them"
        raise DatasetError(f"{', '.join(map(str, sources))}: {lack}; join datasets that fill it")
    whole = whole.sel(axes).transpose(*study.sizes, ...)
    return {name: whole[name].values.astype(types[name]) for name in names}
