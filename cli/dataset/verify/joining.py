"""Datasets that differ along one axis, as the dataset of one study whose axis has the values of all."""

import tomllib
from collections.abc import Generator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.engines import Work
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.study.reading import study_from
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block
from gradhesion.cli.work.parts.resume import Solved, blank
from gradhesion.core.problem.inputs import INPUTS

if TYPE_CHECKING:
    import xarray

Sources = Mapping[Path, "xarray.Dataset"]


def joined(sources: Sources) -> tuple[Study, "Joined"]:
    """
    Make the study of several datasets together, and the engine that takes its values from them.

    Raises
    ------
    DatasetError
        They differ in something else, in nothing, or along more than one axis; or one was changed since it was written.
    """
    from gradhesion.cli.dataset.verify import belonging  # noqa: PLC0415 (xarray, which shards do without)

    wanted = "only maps and optima on a grid can be joined"
    studies = {
        file: belonging.study_of(dataset, file, kinds=("map", "optimum"), wanted=wanted)
        for file, dataset in sources.items()
    }
    for file, study in studies.items():
        if dict(sources[file]["status"].sizes) != study.sizes:
            raise DatasetError(f"{file}: has only a part of the scenes of its study; join whole datasets")
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
    if len(differing) != 1:
        what = f"differ in {' and '.join(differing)}" if differing else "have the same scenes"
        raise DatasetError(f"{', '.join(map(str, studies))}: {what}; join datasets that differ along one axis")
    (axis,) = differing
    own = [np.atleast_1d(study.parameters[axis]) for study in studies.values()]
    values = np.unique(np.concatenate(own))
    study = study_from(_with_axis(tomllib.loads(one.text), axis, values), one.name)
    return study, Joined(sources, axis, _owners(values, own))


def _with_axis(data: Mapping[str, Any], axis: str, values: NDArray[np.float64]) -> dict[str, Any]:
    """Give a study other values of an axis, in the unit of the dataset where it has one."""
    table = INPUTS[axis].table
    entry: list[Any] = values.tolist()
    if table == "physical":
        entry = ["inf" if value == np.inf else f"{value!r} {INPUTS[axis].unit}" for value in entry]
    return {**data, table: {**data[table], axis: entry}}


@dataclass(frozen=True)
class Joined:
    """An engine that solves nothing: it takes the values of a joined study from its sources."""

    sources: Sources
    axis: str
    owners: NDArray[np.int64]
    """Of each value of the axis: which source has it, and where on its own axis."""

    def results(self, work: Work) -> Generator[tuple[int, Solved], None, None]:
        """Give the blocks in order; where several sources have a value, the first."""
        for number in work.numbers:
            block = work.study.tiling[number]
            yield number, Solved(block, self._values(work.study, block))

    def _values(self, study: Study, block: Block) -> dict[str, NDArray[Any]]:
        dimensions = list(study.sizes)
        along = dimensions.index(self.axis)
        cut = dict(zip(dimensions, block, strict=True))
        own = self.owners[:, block[along]]
        filled = blank(study, block)
        for number, source in enumerate(self.sources.values()):
            here = np.flatnonzero(own[0] == number)
            if here.size == 0:
                continue
            source = source.reset_coords(STEEP) if STEEP in source.coords else source
            whole = source if self.axis in source.dims else source.expand_dims(self.axis)
            known = [name for name in filled if name in whole.variables]  # no scene is marked without marks
            part = whole[known].isel({**cut, self.axis: own[1, here]}).transpose(*dimensions, ...)
            for name, values in ((name, filled[name]) for name in known):
                np.moveaxis(values, along, 0)[here] = np.moveaxis(part[name].values, along, 0)
        return filled


def _owners(values: NDArray[np.float64], parts: Sequence[NDArray[np.float64]]) -> NDArray[np.int64]:
    """
    Find which of several axes has each of their values together, the first if several have it, and where.

    >>> _owners(np.array([1.0, 2.0, 3.0]), [np.array([3.0, 2.0]), np.array([1.0, 2.0])])
    array([[1, 0, 0],
           [0, 1, 0]])
    """
    owners = np.full((2, values.size), -1)
    for number, own in reversed(list(enumerate(parts))):
        places = np.searchsorted(values, own)
        owners[0, places], owners[1, places] = number, np.arange(own.size)
    return owners


def opened_all(files: Sequence[Path], stack: ExitStack) -> dict[Path, "xarray.Dataset"]:
    """Open datasets until the stack is left."""
    from gradhesion.cli.dataset.read.reader import opened  # noqa: PLC0415 (xarray, which shards do without)

    return {file: stack.enter_context(opened(file)) for file in files}
