"""Engines: who solves the blocks of a map that are no part yet.

threads   this process, all cores of its machine
cluster   the workers of a Dask cluster, here or elsewhere, which write the parts themselves
kept      nobody: each block must be a part already

All give the same values bit by bit (on processors of one kind), so that a run may go on with another engine.
"""

from collections.abc import Generator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from gradhesion.cli.study.study import Study
from gradhesion.cli.work.parts.folder import Folder
from gradhesion.cli.work.parts.resume import Solved


@dataclass(frozen=True)
class Work:
    """Blocks of a map whose values are wanted."""

    study: Study
    path: Path
    """The output, as the user has written it."""
    folder: Folder
    """Where the parts are."""
    numbers: Sequence[int]


class Engine(Protocol):
    """Finds or solves blocks."""

    def results(self, work: Work, /) -> Generator[tuple[int, Solved], None, None]:
        """Give each block once, in any order, with its number; those that were solved are kept as parts."""
