"""The dataset of a study written block by block; the blocks are kept until it is whole, and reused by the next run."""

from collections import Counter
from collections.abc import Generator, Iterator
from contextlib import ExitStack, closing, suppress
from dataclasses import dataclass
from pathlib import Path

import netCDF4
import numpy as np

from gradhesion.cli.dataset.cautions import cautions, flagged_in
from gradhesion.cli.dataset.contents import CONTENTS
from gradhesion.cli.dataset.file import define, mark
from gradhesion.cli.disk import refuse_existing, settle, writing
from gradhesion.cli.names.curves import RAGGED
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block, size_of
from gradhesion.cli.terminal.progress import Advance
from gradhesion.cli.work.engines import Engine, in_threads
from gradhesion.cli.work.folder import Parts, Results, claimed, clear, is_written, mark_of
from gradhesion.cli.work.solve.curves import within
from gradhesion.core import FAILED


@dataclass(kw_only=True)
class Written:
    """What has become of a study."""

    failed: int = 0
    """Scenes without value."""
    reused: int = 0
    computed: int = 0
    """Engine."""
    cautions: tuple[str, ...] = ()
    """What is to be known of its answers."""
    complete: bool = False
    """Whether an earlier run had written it, and was killed before it could say so."""

    def count(self, values: Results, *, reused: bool) -> None:
        """Count a block that is done."""
        self.failed += int(np.count_nonzero(values["status"] & FAILED))
        self.reused += reused
        self.computed += not reused


def write(
    study: Study,
    path: Path,
    *,
    history: str,
    overwrite: bool = False,
    fresh: bool = False,
    engine: Engine | None = None,
    threads: int | None = None,
    advance: Advance = lambda *_, **__: None,
) -> Written:
    """
    Compute a study into a file, which takes the place of `path` when it is complete and on disk.

    Until then each finished block of a map of several is kept beside it, and the next call reuses it.

    Parameters
    ----------
    fresh
        Drop the blocks of an earlier run.
    engine
        Who has the blocks of a map: `threads` of this process if not given; curves are drawn here.

    Raises
    ------
    GradhesionError
        A block cannot be had.
    OutputError
        It cannot be written: it exists, another run is writing it, blocks of another study are kept, the disk; or it
        has appeared meanwhile, and the dataset is kept beside it.
    """
    parts = Parts(path, study)
    with writing(path):
        is_new = not parts.folder.is_dir()
    if is_new:
        refuse_existing(path, overwrite=overwrite)
    with ExitStack() as stack:
        with writing(path):
            stack.enter_context(claimed(path))
        if not overwrite and (complete := _written_before(parts)) is not None:
            clear(parts.folder)
            return complete
        refuse_existing(path, overwrite=overwrite)
        with writing(path):
            parts.begin(fresh=fresh)
        solved = stack.enter_context(closing(_solved(parts, threads, engine or in_threads(threads))))
        written = _merge(parts, history, solved, advance)
        settle(parts.merged, path, overwrite=overwrite)
        clear(parts.folder)
    return written


def write_shard(
    study: Study,
    path: Path,
    shard: tuple[int, int],
    *,
    overwrite: bool = False,
    engine: Engine,
    advance: Advance = lambda *_, **__: None,
) -> Written:
    """
    Solve every N-th block of a study, to be kept, beside others that do the rest.

    Raises
    ------
    OutputError
        As `write`.
    """
    refuse_existing(path, overwrite=overwrite)
    parts, written = Parts(path, study), Written()
    with ExitStack() as stack:
        with writing(path):
            stack.enter_context(claimed(path, f"-{shard[0]}-of-{shard[1]}"))
            parts.begin()
        numbers = range(shard[0] - 1, len(study.tiling), shard[1])
        for number, values, reused in stack.enter_context(closing(engine(parts, numbers))):
            if not reused:
                with writing(path):
                    parts.write(number, values)
            written.count(values, reused=reused)
            advance(values["status"].size, reused=reused)
    return written


def _solved(
    parts: Parts, threads: int | None, engine: Engine
) -> Generator[tuple[int, Block, Results, bool], None, None]:
    """Give the blocks of a study with their numbers, their values, and whether they exist already."""
    study = parts.study
    if study.in_blocks:
        for number, values, reused in engine(parts, range(len(study.tiling))):
            yield number, study.tiling[number], values, reused
    else:  # of curves each scene is one
        for number, (block, values) in enumerate(CONTENTS[study.sort].parts(study, threads)):
            yield number, block, values, False


def _merge(parts: Parts, history: str, solved: Iterator[tuple[int, Block, Results, bool]], advance: Advance) -> Written:
    """Write the dataset in the making, block by block, as they come."""
    study, path, written = parts.study, parts.output, Written()
    flagged = Counter[str]()
    steep = begun = 0  # scenes; items of ragged curves
    with writing(path):
        file = netCDF4.Dataset(parts.merged, "w", format="NETCDF4")
    try:
        with writing(path):
            define(file, study, history)
        for number, block, values, reused in solved:
            with writing(path):
                if study.has_parts and not reused:
                    parts.write(number, values)
                for name, part in values.items():
                    if name == STEEP:
                        steep += mark(file, study, block, part)
                    else:
                        file[name][within(name, block, part, begun) or ...] = part
            begun += sum(int(values[one].item()) for one in RAGGED.values() if one in values)
            flagged.update(flagged_in(values["status"]))
            written.count(values, reused=reused)
            advance(size_of(block), reused=reused)
    except BaseException:
        with suppress(OSError, RuntimeError):  # what went wrong first counts
            file.close()
        raise
    with writing(path):
        file.close()
    written.cautions = tuple(cautions(study, flagged, steep))
    return written


def _written_before(parts: Parts) -> Written | None:
    """Report on the dataset of a run that was killed when it had written it, before it could tidy up."""
    if mark_of(parts.folder).get("key") == parts.key and is_written(parts.folder, parts.output):
        with suppress(OSError, RuntimeError), netCDF4.Dataset(parts.output) as file:
            if getattr(file, "study_sha256", "") == parts.study.sha256:
                return Written(failed=int(np.count_nonzero(file["status"][...] & FAILED)), complete=True)
    return None
