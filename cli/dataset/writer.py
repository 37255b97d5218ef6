"""The dataset of a study written block by block; the blocks are kept until it is whole, and reused by the next run."""

from collections import Counter
from collections.abc import Generator, Iterable, Iterator, Sequence
from contextlib import ExitStack, closing, suppress
from dataclasses import dataclass
from functools import partial
from itertools import chain
from pathlib import Path
from typing import Any, Final

import netCDF4
import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.dataset.dataset import attributes, cautions, flagged_in
from gradhesion.cli.dataset.describe import Variable, steep_contact, variables
from gradhesion.cli.disk import refuse_existing, settle, writing
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.curves import RAGGED, STATE, is_ragged
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block, Tiling, size_of
from gradhesion.cli.terminal import interrupts
from gradhesion.cli.terminal.amounts import counted
from gradhesion.cli.terminal.progress import Advance
from gradhesion.cli.work.folder import Parts, claimed, clear, is_written, mark_of
from gradhesion.cli.work.solve.blocks import Engine, in_threads, within
from gradhesion.cli.work.solve.scenes import Arrays
from gradhesion.core import FAILED

CACHE: Final = 2**22
"""Bytes of chunks to be held of each variable: blocks are whole chunks, so there is nothing to wait for. The
library's own choice took more memory than all else that a run has."""
POINTS: Final = 1024
"""Points of a curve in a chunk: most curves have fewer, and unwritten chunks take no room."""


@dataclass(kw_only=True)
class Written:
    """What has become of a study."""

    failed: int = 0
    """Scenes without value."""
    reused: int = 0
    computed: int = 0
    """Blocks."""
    cautions: tuple[str, ...] = ()
    """What is to be known of its answers."""
    complete: bool = False
    """Whether an earlier run had written it, and was killed before it could say so."""


def write(
    study: Study,
    path: Path,
    *,
    history: str,
    overwrite: bool = False,
    fresh: bool = False,
    shard: tuple[int, int] | None = None,
    engine: Engine | None = None,
    threads: int | None = None,
    advance: Advance = lambda *_, **__: None,
) -> Written:
    """Compute a study into a file, which takes the place of `path` when it is complete and on disk (OutputError).

    Until then each finished block of a map of several is kept beside it, and the next call reuses it, unless `fresh`.
    A `shard` (i, N) keeps the i-th of each N blocks, beside others that do the rest, and writes no dataset. Blocks are
    solved by the `engine`, or by `threads` of this process.
    """
    parts = Parts(path, study)
    with ExitStack() as stack:
        with writing(path):
            if shard or not parts.folder.is_dir():
                refuse_existing(path, overwrite=overwrite)
            stack.enter_context(claimed(path, f"-{shard[0]}-of-{shard[1]}" if shard else ""))
        if not (overwrite or shard) and (complete := _written_before(parts)) is not None:
            clear(parts.folder)
            return complete
        refuse_existing(path, overwrite=overwrite)
        with writing(path):
            parts.begin(fresh=fresh)
        first, step = (shard[0] - 1, shard[1]) if shard else (0, 1)
        numbers, written = range(first, len(study.tiling), step), Written()
        engine = engine or partial(in_threads, threads=threads)
        blocks = stack.enter_context(closing(_blocks(parts, numbers, engine, written, advance)))
        if shard:
            for _ in blocks:  # each is kept
                pass
            return written
        written.cautions = _merge(parts, history, blocks)
        settle(parts.merged, path, overwrite=overwrite)
        clear(parts.folder)
    return written


def _blocks(
    parts: Parts, numbers: Sequence[int], engine: Engine, written: Written, advance: Advance
) -> Generator[tuple[int, Arrays], None, None]:
    """Give blocks by their numbers, and count them: those not kept are solved, and kept if there are several."""
    several = parts.study.has_parts
    kept = {number for number in numbers if several and parts.part(number).exists()}
    damaged: list[int] = []

    def solved(waiting: Sequence[int]) -> Iterator[tuple[int, Arrays, bool]]:
        for number, values in engine(parts.study, waiting):
            if several:
                with writing(parts.output):
                    parts.write(number, values)
            yield number, values, False

    def read() -> Iterator[tuple[int, Arrays, bool]]:
        for number in sorted(kept):
            if (values := parts.read(number)) is None:
                damaged.append(number)
            else:
                yield number, values, True

    missing = [number for number in numbers if number not in kept]
    for number, values, reused in chain(solved(missing), read(), solved(damaged)):
        interrupts.check()  # a cluster may have swallowed it
        written.failed += int(np.count_nonzero(values["status"] & FAILED))
        written.reused += reused
        written.computed += not reused
        yield number, values
        advance(size_of(parts.study.tiling[number]), reused=reused)


def only_kept(output: Path, study: Study, numbers: Sequence[int]) -> Iterator[tuple[int, Arrays]]:
    """Solve nothing, in the place of an engine: DatasetError says which blocks the shards of an output lack."""
    if numbers:
        shown = ", ".join(str(number + 1) for number in numbers[:8]) + (", ..." if len(numbers) > 8 else "")
        of_all = f"{len(numbers):,} of {counted(len(study.tiling), 'block')}"
        remedy = "run the shards that have them, or `gradhesion run`, which computes the rest"
        raise DatasetError(f"{output}: {of_all} are missing or damaged ({shown}); {remedy}")
    return iter(())


def _merge(parts: Parts, history: str, blocks: Iterable[tuple[int, Arrays]]) -> tuple[str, ...]:
    """Write the dataset in the making, block by block, as they come; tells what is to be known of its answers."""
    study, path = parts.study, parts.output
    flagged = Counter[str]()
    steep = begun = 0  # scenes; items of ragged curves
    with writing(path):
        file = netCDF4.Dataset(parts.merged, "w", format="NETCDF4")
    try:
        with writing(path):
            _define(file, study, history)
        for number, values in blocks:
            block = study.tiling[number]
            with writing(path):
                for name, part in values.items():
                    if name == STEEP:
                        steep += _mark(file, study, block, part)
                    else:
                        file[name][within(name, block, part, begun) or ...] = part
            begun += sum(int(values[one].item()) for one in RAGGED.values() if one in values)
            flagged.update(flagged_in(values["status"]))
    except BaseException:
        with suppress(OSError, RuntimeError):  # what went wrong first counts
            file.close()
        raise
    with writing(path):
        file.close()
    return tuple(cautions(study, flagged, steep))


def _define(file: netCDF4.Dataset, study: Study, history: str) -> None:
    """Write all of a dataset but the values of its outputs."""
    if study.in_blocks:
        file.set_fill_off()
    file.setncatts(attributes(study, history))
    described = variables(study)
    sizes = study.sizes | {name: len(labels) for name, labels in study.labels.items()}
    sizes |= {STATE: np.asarray(described[STATE].values).size} if STATE in described else {}
    for name, size in sizes.items():
        file.createDimension(name, size)
    for name, variable in described.items():
        made = _create(file, study, name, variable)
        if variable.values is not None:
            made[...] = variable.values
        elif variable.made:
            for block in Tiling(made.shape, study.chunk):
                made[block or ...] = variable.made(block)


def _create(file: netCDF4.Dataset, study: Study, name: str, described: Variable) -> "netCDF4.Variable[Any]":
    """Create a variable, without its values."""
    settings: dict[str, Any] = {}
    if described.dimensions and described.dtype != "str":
        for dimension in described.dimensions:
            if dimension not in file.dimensions:
                file.createDimension(dimension, None)  # it grows with the longest curve
        *scenes, last = (file.dimensions[one] for one in described.dimensions)
        own = (*(1 for _ in scenes), min(POINTS, study.cells))  # a curve has its own chunks, all else those of blocks
        chunks = own if last.isunlimited() else Tiling(tuple(map(len, (*scenes, last))), study.cells).chunk
        settings |= {"compression": "zlib", "complevel": 1, "shuffle": True, "chunksizes": chunks}
    if described.blank is not None:
        settings["fill_value"] = described.blank
    dtype = str if described.dtype == "str" else described.dtype
    variable = file.createVariable(name, dtype, described.dimensions, **settings)
    if study.in_blocks and "chunksizes" in settings:
        variable.set_var_chunk_cache(CACHE)
    variable.setncatts(described.attributes)
    return variable


def _mark(file: netCDF4.Dataset, study: Study, block: Block, steep: NDArray[np.int8]) -> int:
    """Mark scenes whose contact reaches a slope that is not small; the first of them makes the coordinate."""
    count, described = int(np.count_nonzero(steep)), steep_contact(study)
    if described and count and STEEP not in file.variables:
        variable = _create(file, study, STEEP, described)
        for before in Tiling(variable.shape, study.chunk):
            variable[before or ...] = 0
        for name in (*study.variables, "status"):
            if not is_ragged(name):
                file[name].coordinates = f"{getattr(file[name], 'coordinates', '')} {STEEP}".strip()
    if STEEP in file.variables:
        file[STEEP][block or ...] = steep
    return count


def _written_before(parts: Parts) -> Written | None:
    """Report on the dataset of a run that was killed when it had written it, before it could tidy up."""
    if mark_of(parts.folder).get("key") == parts.key and is_written(parts.folder, parts.output):
        with suppress(OSError, RuntimeError), netCDF4.Dataset(parts.output) as file:
            if getattr(file, "study_sha256", "") == parts.study.sha256:
                return Written(failed=int(np.count_nonzero(file["status"][...] & FAILED)), complete=True)
    return None
