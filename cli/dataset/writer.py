"""The dataset of a study, written block by block, and the blocks kept until it is complete."""

import math
import os
import shutil
from collections import Counter
from collections.abc import Callable, Generator, Iterable
from contextlib import ExitStack, closing, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Final, NoReturn

import netCDF4

from gradhesion.cli.dataset.cautions import cautions, flagged_in
from gradhesion.cli.dataset.contents import CONTENTS
from gradhesion.cli.dataset.file import define, mark
from gradhesion.cli.disk import refuse_beside, refuse_existing, refuse_unnamed, settled, to_disk, writing
from gradhesion.cli.engines import Engine, Work
from gradhesion.cli.engines.threads import Threads
from gradhesion.cli.errors import OutputError, ScenesFailedError
from gradhesion.cli.names.curves import RAGGED
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import size_of
from gradhesion.cli.terminal.amounts import counted, two_in_words
from gradhesion.cli.work.parts.folder import Folder, claimed, folder_of, identity
from gradhesion.cli.work.parts.manifest import adopt, manifest_of
from gradhesion.cli.work.parts.parts import types_of
from gradhesion.cli.work.parts.records import Finished, Keeper, read_record, write_record
from gradhesion.cli.work.parts.resume import Solved, place_of
from gradhesion.cli.work.solve.curves import within

LEAST_SHARE: Final = 0.1
"""Values hardly compress to less than this share: what cannot fit is refused before it is begun."""


@dataclass(frozen=True, kw_only=True)
class Written:
    """What has become of a study."""

    failed: int = 0
    """Scenes without value."""
    reused: int = 0
    computed: int = 0
    """Blocks."""
    raised: tuple[str, ...] = ()
    """A sentence for each block that could not be solved."""
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
    fail_fast: bool = False,
    threads: int | None = None,
    engine: Engine | None = None,
    advance: Callable[..., None] = lambda *_, **__: None,
) -> Written:
    """
    Compute a study into a file; `advance` gets the scenes of each block when they are written.

    The file takes the place of `path` when it is complete and on disk. Until then each finished block of a map of
    several is a part of its own, which the next call reuses.

    Parameters
    ----------
    fresh
        Drop the parts of an earlier run.
    fail_fast
        End at the first block with a failed scene.
    engine
        Who solves the blocks of a map, `threads` of this process if not given; curves are drawn here.

    Raises
    ------
    GradhesionError
        The engine gives up: a worker cannot do its work, or a block is no part and is not to be solved.
    OutputError
        It cannot be written: it exists, another run is writing it, parts of another study are kept, the disk; or it
        has appeared meanwhile, and the dataset is kept beside it.
    ScenesFailedError
        No block could be solved, or one has failed and `fail_fast`.
    """
    target = Path(os.path.realpath(path))
    refuse_unnamed(path, target)
    if not os.path.isdir(folder_of(path).path):  # noqa: PTH112 (never an error, whatever the name)
        refuse_existing(path, target, overwrite=overwrite)
    with ExitStack() as stack:
        with writing(path):
            folder = stack.enter_context(claimed(path))
            done = _finished(folder, target, study)
        if done is not None and not fresh:
            return done
        refuse_existing(path, target, overwrite=overwrite)
        with writing(path):
            if fresh:
                folder.clear()
                folder.finished.unlink(missing_ok=True)
            adopt(study, folder, path)
        _check_space(study, path, folder)
        solved = stack.enter_context(closing(_solved(study, path, folder, threads, engine or Threads(threads))))
        written = _merge(study, path, folder, history, solved, advance, fail_fast=fail_fast)
        with writing(path):
            to_disk(folder.merged)
            if not written.raised and (made := identity(folder.merged)):
                write_record(folder.finished, Finished(made, manifest_of(study), written.failed))
            place = settled(folder.merged, target, overwrite=overwrite)
        with suppress(OSError):  # some file systems cannot sync a folder
            to_disk(target.parent)
        if not written.raised:
            folder.clear_parts()
        refuse_beside(path, place, target)
    return written


def _merge(
    study: Study,
    path: Path,
    folder: Folder,
    history: str,
    results: Iterable[tuple[int, Solved]],
    advance: Callable[..., None],
    *,
    fail_fast: bool,
) -> Written:
    """Write the dataset in the making, block by block, as they are solved or found."""
    count = len(study.tiling)
    keeper = Keeper(folder.path / "state.json", scenes=study.scenes, blocks=count)
    raised: dict[int, str] = {}
    flagged = Counter[str]()
    steep = 0
    with writing(path):
        file = netCDF4.Dataset(folder.merged, "w", format="NETCDF4")
    try:
        with writing(path):
            define(file, study, history)
        begun = 0  # items of ragged curves
        for number, solved in results:
            with writing(path):
                for name, part in solved.values.items():
                    if name == STEEP:
                        steep += mark(file, study, solved.block, part)
                    else:
                        file[name][within(name, solved.block, part, begun) or ...] = part
            begun += sum(int(solved.values[one].item()) for one in RAGGED.values() if one in solved.values)
            if solved.error:
                raised[number] = _sentence(study, number, solved)
            flagged.update(flagged_in(solved.values["status"]))
            scenes, failed = size_of(solved.block), solved.failed
            keeper.add(scenes=scenes, failed=failed, reused=solved.reused, raised=bool(solved.error))
            if failed and fail_fast:
                _give_up(path, raised.get(number), f"block {number + 1:,} of {count:,} has {failed:,} failed scenes")
            advance(scenes, reused=solved.reused)
        if len(raised) == count:
            _give_up(path, raised[number], "")
    except BaseException:
        keeper.write()
        with suppress(OSError, RuntimeError):  # what went wrong first counts
            file.close()
        raise
    with writing(path):
        file.close()
    state = keeper.state
    return Written(
        failed=state.scenes_failed,
        reused=state.blocks_reused,
        computed=state.blocks_done - state.blocks_reused,
        raised=tuple(raised[number] for number in sorted(raised)),
        cautions=tuple(cautions(study, flagged, steep)),
    )


def write_shard(
    study: Study,
    path: Path,
    shard: tuple[int, int],
    *,
    overwrite: bool = False,
    engine: Engine,
    advance: Callable[..., None] = lambda *_, **__: None,
) -> Written:
    """
    Solve every N-th block of a study into its part, beside others that do the rest.

    Raises
    ------
    OutputError
        As `write`.
    """
    target = Path(os.path.realpath(path))
    refuse_unnamed(path, target)
    refuse_existing(path, target, overwrite=overwrite)
    index, count = shard
    name = f"{index}-of-{count}"
    mine = range(index - 1, len(study.tiling), count)
    scenes = sum(size_of(study.tiling[number]) for number in mine)
    raised: dict[int, str] = {}
    with ExitStack() as stack:
        with writing(path):
            folder = stack.enter_context(claimed(path, name))
            adopt(study, folder, path)
        keeper = Keeper(folder.path / f"state-{name}.json", scenes=scenes, blocks=len(mine))
        results = stack.enter_context(closing(engine.results(Work(study, path, folder, mine))))
        for number, solved in results:
            if solved.error:
                raised[number] = _sentence(study, number, solved)
            scenes = size_of(solved.block)
            keeper.add(scenes=scenes, failed=solved.failed, reused=solved.reused, raised=bool(solved.error))
            advance(scenes, reused=solved.reused)
        keeper.write()
    state = keeper.state
    computed = state.blocks_done - state.blocks_reused
    written = tuple(raised[number] for number in sorted(raised))
    return Written(failed=state.scenes_failed, reused=state.blocks_reused, computed=computed, raised=written)


def _sentence(study: Study, number: int, solved: Solved) -> str:
    """Report of a block that could not be solved."""
    return f"block {number + 1:,} of {len(study.tiling):,} ({place_of(study, solved.block)}) raised {solved.error}"


def _give_up(path: Path, raised: str | None, otherwise: str) -> NoReturn:
    """End a run in which a block has failed, or every one."""
    raise ScenesFailedError(f"{path}: {raised or otherwise}; nothing is written")


def _solved(
    study: Study, path: Path, folder: Folder, threads: int | None, engine: Engine
) -> Generator[tuple[int, Solved], None, None]:
    """Give the blocks of a study with their values; of curves each scene is one."""
    if study.in_blocks:
        yield from engine.results(Work(study, path, folder, range(len(study.tiling))))
    else:
        yield from ((i, Solved(*part)) for i, part in enumerate(CONTENTS[study.sort].parts(study, threads)))


def _finished(folder: Folder, target: Path, study: Study) -> Written | None:
    """Report whether the run that left this folder had written the output, and tidy up if so."""
    finished = read_record(folder.finished, Finished)
    if finished is None:
        return None
    if finished.file != identity(target):
        folder.finished.unlink(missing_ok=True)
        return None
    folder.clear()
    if finished.study == manifest_of(study):
        return Written(failed=finished.failed, complete=True)
    folder.finished.unlink(missing_ok=True)  # or it would say of the parts to come that they are of no use
    return None


def _check_space(study: Study, path: Path, folder: Folder) -> None:
    """Refuse a dataset that cannot fit on its disk, with its parts."""
    values = (math.prod(study.shape_of(name, ())) for name in study.variables if not name.endswith("_jumps"))
    least = study.scenes * LEAST_SHARE * 8 * sum(values)
    if study.has_parts:
        types = types_of(study).items()
        least += study.scenes * sum(kind.itemsize * math.prod(study.shape_of(name, ())) for name, kind in types)
        least -= folder.bytes_of_parts()
    with writing(path):
        free = shutil.disk_usage(folder.path).free
    if least > free:
        needed, there = two_in_words(least, free)
        raise OutputError(
            f"{path}: {counted(study.scenes, 'scene')} need {needed} or more, and {there} are free there; use fewer "
            "scenes, or name an output on a larger disk with -o"
        )
