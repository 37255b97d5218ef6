"""Datasets that differ along axes, as the dataset of one study whose axes have the values of all."""

import tomllib
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.study.reading import study_from
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block, shape_of
from gradhesion.cli.work.engines import Solved
from gradhesion.cli.work.folder import Parts, Results
from gradhesion.core.problem.inputs import INPUTS

if TYPE_CHECKING:
    import xarray

Sources = Mapping[Path, "xarray.Dataset"]
Places = Mapping[str, NDArray[np.intp]]
"""Of the values of a source along an axis that is joined: where they are on the axis of all."""


def joined(sources: Sources) -> tuple[Study, "Joined"]:
    """
    Make the study of several datasets together, and the engine that takes its values from them.

    Raises
    ------
    DatasetError
        They differ in something else, or in nothing, or together they lack scenes; or one was changed since it was
        written.
    """
    from gradhesion.cli.dataset.verify import belonging  # noqa: PLC0415 (xarray, which shards do without)

    wanted = "only maps and optima on a grid can be joined"
    studies = {
        file: belonging.study_of(dataset, file, kinds=("map", "optimum"), wanted=wanted)
        for file, dataset in sources.items()
    }
    (first, one), *others = studies.items()
    for file, other in others:
        if {one.layout, other.layout} != {"grid"}:
            raise DatasetError(f"{file}, {first}: {wanted}, not points")
        for what in ("kind", "search", "outputs", "method", "profile", "spectrum", "loading", "uncertainty"):
            if getattr(one, what) != getattr(other, what):
                raise DatasetError(f"{file}: differs from {first} in {what}; join datasets that share it")
        if one.parameters.keys() != other.parameters.keys():
            keys = ", ".join(sorted(one.parameters.keys() ^ other.parameters.keys()))
            raise DatasetError(
                f"{file}: gives its scenes by different keys from {first} ({keys}); join datasets that share them"
            )
        written = [sources[each].attrs["source"] for each in (first, file)]
        if written[0] != written[1]:
            raise DatasetError(
                f"{file}: was written by {written[1]}, and {first} by {written[0]}; run one of them again"
            )
    differing = [
        name
        for name, values in one.parameters.items()
        if any(not np.array_equal(values, other.parameters[name]) for _, other in others)
    ]
    if not differing:
        raise DatasetError(f"{', '.join(map(str, studies))}: have the same scenes; join datasets that differ")
    own = {axis: [np.atleast_1d(study.parameters[axis]) for study in studies.values()] for axis in differing}
    values = {axis: np.unique(np.concatenate(parts)) for axis, parts in own.items()}
    places = [
        {axis: np.searchsorted(values[axis], own[axis][number]) for axis in differing} for number in range(len(studies))
    ]
    _refuse_gaps(values, places, studies)
    data = tomllib.loads(one.text)
    for axis in differing:
        data = _with_axis(data, axis, values[axis])
    return study_from(data, one.name), Joined(sources, places)


def _refuse_gaps(
    values: Mapping[str, NDArray[np.float64]], places: Sequence[Places], studies: Mapping[Path, Study]
) -> None:
    """Make sure that each combination of the values is in some dataset."""
    covered = np.zeros([own.size for own in values.values()], bool)
    for own in places:
        covered[np.ix_(*own.values())] = True
    if not covered.all():
        gap = np.argwhere(~covered)[0]
        cell = ", ".join(f"{axis} = {own[place]:g}" for (axis, own), place in zip(values.items(), gap, strict=True))
        raise DatasetError(
            f"{', '.join(map(str, studies))}: differ in {' and '.join(values)}, and none of them has {cell}; run the "
            "scenes that are missing, and join all"
        )


def _with_axis(data: Mapping[str, Any], axis: str, values: NDArray[np.float64]) -> dict[str, Any]:
    """Give a study other values of an axis, in the unit of the dataset where it has one."""
    table = INPUTS[axis].table
    entry: list[Any] = values.tolist()
    if table == "physical":
        entry = ["inf" if value == np.inf else f"{value!r} {INPUTS[axis].unit}" for value in entry]
    return {**data, table: {**data[table], axis: entry}}


@dataclass(frozen=True)
class Joined:
    """An engine that solves nothing: the values of a joined study are those of its sources."""

    sources: Sources
    places: Sequence[Places]
    """Of each source."""

    def __call__(self, parts: Parts, numbers: Sequence[int]) -> Solved:
        """Give the blocks in order; where several sources have a value, that of the first."""
        for number in numbers:
            yield number, self._values(parts.study, parts.study.tiling[number]), True

    def _values(self, study: Study, block: Block) -> Results:
        """Fill a block from the last source to the first."""
        dimensions = list(study.sizes)
        filled: Results = {}
        for source, places in reversed([*zip(self.sources.values(), self.places, strict=True)]):
            source = source.reset_coords(STEEP) if STEEP in source.coords else source
            source = source.expand_dims([axis for axis in places if axis not in source.dims])
            here: list[NDArray[np.intp]] = []  # in the block, along each dimension
            there: dict[str, Any] = {}
            for axis, part in zip(dimensions, block, strict=True):
                own = places.get(axis, np.arange(study.sizes[axis]))
                there[axis] = np.flatnonzero((own >= part.start) & (own < part.stop))
                here.append(own[there[axis]] - part.start)
            known = [name for name in (*study.variables, STEEP, "status") if name in source.variables]
            cut = source[known].isel(there).transpose(*dimensions, ...)
            for name in known:
                shape = study.shape_of(name, shape_of(block))
                values = filled.setdefault(name, np.zeros(shape, cut[name].dtype))  # no scene is marked without marks
                values[np.ix_(*here)] = cut[name].values
        return filled


def opened_all(files: Sequence[Path], stack: ExitStack) -> dict[Path, "xarray.Dataset"]:
    """Open datasets until the stack is left."""
    from gradhesion.cli.dataset.read.reader import opened  # noqa: PLC0415 (xarray, which shards do without)

    return {file: stack.enter_context(opened(file)) for file in files}
