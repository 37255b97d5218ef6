"""The file of a dataset in the making: its dimensions, its variables without values, and what is marked later."""

from typing import Any, Final

import netCDF4
import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.dataset import dataset
from gradhesion.cli.dataset.contents import CONTENTS
from gradhesion.cli.dataset.variable import Variable
from gradhesion.cli.names.curves import STATE, is_ragged
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block, Tiling

CACHE: Final = 2**22
"""Bytes of chunks to be held of each variable: blocks are whole chunks, so there is nothing to wait for. The
library's own choice took more memory than all else that a run has."""

POINTS: Final = 1024
"""Points of a curve in a chunk: most curves have fewer, and unwritten chunks take no room."""


def define(file: netCDF4.Dataset, study: Study, history: str) -> None:
    """Write all of a dataset but the values of its outputs."""
    filled = CONTENTS[study.sort].filled
    if filled:
        file.set_fill_off()
    file.setncatts(dataset.attributes(study, history))
    for name, size in study.sizes.items():
        file.createDimension(name, size)
    described_all = dataset.variables(study)
    for name, labels in study.labels.items():
        file.createDimension(name, len(labels))
    if STATE in described_all:
        file.createDimension(STATE, np.size(np.asarray(described_all[STATE].values)))
    for name, described in described_all.items():
        variable = _create(file, study, name, described)
        if described.values is not None:
            variable[...] = described.values
        elif described.made:
            for block in Tiling(variable.shape, study.chunk):
                variable[block or ...] = described.made(block)


def _create(file: netCDF4.Dataset, study: Study, name: str, described: Variable) -> "netCDF4.Variable[Any]":
    """Create a variable, without its values."""
    settings: dict[str, Any] = {}
    if described.dimensions and described.dtype != "str":
        for dimension in described.dimensions:
            if dimension not in file.dimensions:
                file.createDimension(dimension, None)  # it grows with the longest curve
        settings |= {"compression": "zlib", "complevel": 1, "shuffle": True}
        settings["chunksizes"] = _chunks(tuple(file.dimensions[one] for one in described.dimensions), study.cells)
    if described.blank is not None:
        settings["fill_value"] = described.blank
    dtype = str if described.dtype == "str" else described.dtype
    variable = file.createVariable(name, dtype, described.dimensions, **settings)
    if CONTENTS[study.sort].filled and "chunksizes" in settings:
        variable.set_var_chunk_cache(CACHE)
    variable.setncatts(described.attributes)
    return variable


def _chunks(dimensions: tuple[netCDF4.Dimension, ...], cells: int) -> tuple[int, ...]:
    """Choose the chunks of a variable: of a curve they are its own, of all else those of the blocks."""
    if dimensions[-1].isunlimited():
        return (*(1 for _ in dimensions[:-1]), min(POINTS, cells))
    return Tiling(tuple(map(len, dimensions)), cells).chunk


def mark(file: netCDF4.Dataset, study: Study, block: Block, steep: NDArray[np.int8]) -> int:
    """Mark scenes whose contact reaches a slope that is not small; the first of them makes the coordinate."""
    count = int(np.count_nonzero(steep))
    if not dataset.marks_steep_contact(study):
        return count
    if count and STEEP not in file.variables:
        variable = _create(file, study, STEEP, dataset.steep_contact(study))
        for before in Tiling(variable.shape, study.chunk):
            variable[before or ...] = 0
        for name in (*study.variables, "status"):
            if not is_ragged(name):
                known = getattr(file[name], "coordinates", "")
                file[name].coordinates = f"{known} {STEEP}".strip()
    if STEEP in file.variables:
        file[STEEP][block or ...] = steep
    return count
