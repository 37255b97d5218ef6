"""Engines: who has the blocks of a study that are not kept yet: this process, a cluster (`cluster.py`), or nobody."""

from collections.abc import Callable, Generator, Sequence
from functools import partial

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.terminal.amounts import counted
from gradhesion.cli.work.folder import Parts, Results
from gradhesion.cli.work.solve.blocks import in_order, solve_block

Solved = Generator[tuple[int, Results, bool], None, None]
Engine = Callable[[Parts, Sequence[int]], Solved]
"""Gives blocks by their numbers, each once, in any order: with its values, and whether these exist already."""


def in_threads(threads: int | None = None) -> Engine:
    """Solve blocks in this process, one ahead of whoever takes them, each on `threads`, or as many as there are."""

    def solved_or_kept(parts: Parts, number: int) -> tuple[int, Results, bool]:
        values = parts.read(number) if parts.study.has_parts else None
        if values is not None:
            return number, values, True
        return number, solve_block(parts.study, parts.study.tiling[number], threads), False

    def engine(parts: Parts, numbers: Sequence[int]) -> Solved:
        yield from in_order(partial(solved_or_kept, parts, number) for number in numbers)

    return engine


def kept(parts: Parts, numbers: Sequence[int]) -> Solved:
    """Give blocks that shards have solved; DatasetError where some are not there, or damaged."""
    of_all = f"of {counted(len(parts.study.tiling), 'block')}"
    if missing := [str(number + 1) for number in numbers if not parts.part(number).exists()]:
        shown = ", ".join(missing[:8]) + (", ..." if len(missing) > 8 else "")
        raise DatasetError(
            f"{parts.output}: {len(missing):,} {of_all} are missing ({shown}); run the shards that have them, or "
            "`gradhesion run`, which computes the rest"
        )
    for number in numbers:
        values = parts.read(number)
        if values is None:
            raise DatasetError(
                f"{parts.output}: block {number + 1:,} {of_all} is damaged, or of another version; compute its shard "
                "again, or all that is missing with `gradhesion run`"
            )
        yield number, values, True
