"""The dataset of a study made block by block: in memory, or in a file, where blocks are kept until it is whole."""

from collections import Counter
from collections.abc import Generator, Iterable, Iterator, Sequence
from contextlib import ExitStack, closing, suppress
from dataclasses import dataclass
from functools import partial
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import netCDF4
import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.dataset.describe import Variable, attributes, steep_contact, variables
from gradhesion.cli.dataset.read.model_range import cautions, flagged_in
from gradhesion.cli.disk import refuse_existing, settle, writing
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.curves import RAGGED, is_ragged
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block, Tiling, size_of
from gradhesion.cli.terminal import interrupts, messages
from gradhesion.cli.terminal.amounts import counted
from gradhesion.cli.terminal.progress import Advance
from gradhesion.cli.work.compiling import prepare
from gradhesion.cli.work.folder import Parts, claimed, clear, is_written, mark_of
from gradhesion.cli.work.solve.blocks import Engine, in_threads, within
from gradhesion.cli.work.solve.scenes import Arrays
from gradhesion.core import FAILED

if TYPE_CHECKING:
    import xarray

CACHE: Final = 2**22
"""Bytes of chunks to be held of each variable: blocks are whole chunks, so there is nothing to wait for. The
library's own choice took more memory than all else that a run has."""
PACKED: Final[dict[str, Any]] = {"compression": "zlib", "complevel": 1, "shuffle": True}
"""How the values in a file are kept small."""
IN_MEMORY: Final = "memory"
"""The name of what is no file."""
ENCODED: Final = ("_FillValue", "coordinates", "dtype")
"""What is said of the cells of a dataset in memory."""
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


def compute(study: Study, *, threads: int | None = None) -> "xarray.Dataset":
    """Compute a study in memory.

    Parameters
    ----------
    study
        From `load_study` or `study_from`.
    threads
        Threads to use, as many as the process may use if None; the values do not depend on it.

    Returns
    -------
    The dataset that `gradhesion run` writes to a file, as xarray reads it.

    Notes
    -----
    The first study of a version compiles the solver, which a line on stderr reports.
    """
    import xarray  # noqa: PLC0415 (450 ms that `run` does not need)

    prepare(study)
    blocks = in_threads(study, range(len(study.tiling)), threads)
    with netCDF4.Dataset(IN_MEMORY, "w", diskless=True) as file:
        said = _filled(file, study, "computed in memory", blocks)
        messages.say(*(f"{study.name}: {sentence}" for sentence in said))
        store: Any = xarray.backends.NetCDF4DataStore(file)  # type: ignore[no-untyped-call]
        found = xarray.open_dataset(store).load()
    found.encoding = {}
    for variable in found.variables.values():  # chunks and the like are those of a file
        variable.encoding = {key: one for key, one in variable.encoding.items() if key in ENCODED}
    return found


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
    with writing(path), ExitStack() as stack:
        if shard or not parts.folder.is_dir():
            refuse_existing(path, overwrite=overwrite)
        stack.enter_context(claimed(path, f"-{shard[0]}-of-{shard[1]}" if shard else ""))
        if not (overwrite or shard) and (complete := _written_before(parts)) is not None:
            clear(parts.folder)
            return complete
        refuse_existing(path, overwrite=overwrite)
        parts.begin(fresh=fresh)
        first, step = (shard[0] - 1, shard[1]) if shard else (0, 1)
        numbers, written = range(first, len(study.tiling), step), Written()
        engine = engine or partial(in_threads, threads=threads)
        blocks = stack.enter_context(closing(_blocks(parts, numbers, engine, written, advance)))
        if shard:
            for _ in blocks:  # each is kept
                pass
            return written
        with netCDF4.Dataset(parts.merged, "w") as file:
            written.cautions = _filled(file, study, history, blocks)
        settle(parts.merged, path, overwrite=overwrite)
        clear(parts.folder)
    return written


def _blocks(
    parts: Parts, numbers: Sequence[int], engine: Engine, written: Written, advance: Advance
) -> Generator[tuple[int, Arrays], None, None]:
    """Give blocks by their numbers, and count them: those that are kept, whole; then the others, which are solved."""
    several = parts.study.has_parts
    missing: list[int] = []

    def kept() -> Iterator[tuple[int, Arrays, bool]]:
        for number in numbers:
            if several and (values := parts.read(number)) is not None:
                yield number, values, True
            else:
                missing.append(number)

    def solved() -> Iterator[tuple[int, Arrays, bool]]:
        for number, values in engine(parts.study, missing):
            if several:
                parts.write(number, values)
            yield number, values, False

    for number, values, reused in chain(kept(), solved()):
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
        remedy = "run the shards that have them (of N block b is in shard (b - 1) % N + 1), or `gradhesion run` for all"
        raise DatasetError(f"{output}: {of_all} are missing or damaged ({shown}); {remedy}")
    return iter(())


def of_values(values: Arrays, study: Study, numbers: Sequence[int]) -> Iterator[tuple[int, Arrays]]:
    """Solve nothing, in the place of an engine: cut the blocks out of the values of all scenes."""
    for number in numbers:
        yield number, {name: one[within(name, study.tiling[number], one)] for name, one in values.items()}


def _filled(file: netCDF4.Dataset, study: Study, history: str, blocks: Iterable[tuple[int, Arrays]]) -> tuple[str, ...]:
    """Fill a file with a dataset, block by block, as they come; tells what is to be known of its answers."""
    flagged = Counter[str]()
    steep = begun = 0  # scenes; items of ragged curves
    _define(file, study, history)
    for number, values in blocks:
        block = study.tiling[number]
        for name, part in values.items():
            if name == STEEP:
                steep += _mark(file, study, block, part)
            else:
                file[name][within(name, block, part, begun) or ...] = part
        begun += sum(int(values[one].item()) for one in RAGGED.values() if one in values)
        flagged.update(flagged_in(values["status"]))
    return tuple(cautions(study, flagged, steep, file.variables.get("A")))


def _define(file: netCDF4.Dataset, study: Study, history: str) -> None:
    """Write all of a dataset but the values of its outputs."""
    if study.in_blocks:
        file.set_fill_off()
    file.setncatts(attributes(study, history))
    described = variables(study)
    own = {name: one.values for name, one in described.items() if one.dimensions == (name,)}
    sizes = study.sizes | {name: values.size for name, values in own.items() if values is not None}
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
        settings |= {"chunksizes": chunks} | ({} if file.filepath() == IN_MEMORY else PACKED)
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
