"""The engine of `gradhesion merge`: it solves nothing."""

from collections.abc import Generator
from functools import partial

from gradhesion.cli.engines import Work
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.work.parts.parts import key_of
from gradhesion.cli.work.parts.resume import Solved, found
from gradhesion.cli.work.solve.blocks import one_ahead


class Kept:
    """Reads parts."""

    def results(self, work: Work) -> Generator[tuple[int, Solved], None, None]:
        """
        Give the blocks in order.

        Raises
        ------
        DatasetError
            A part is missing or of no use.
        """
        study = work.study

        def task(number: int) -> tuple[int, Solved]:
            block = study.tiling[number]
            key = key_of(study, block)
            values = found(study, work.folder, number, block, key)
            if isinstance(values, dict):
                return number, Solved(block, values, key, reused=True)
            raise DatasetError(
                f"{work.path}: block {number + 1:,} of {len(study.tiling):,} is {values}; compute its shard "
                "again, or all that is missing with `gradhesion run`"
            )

        yield from one_ahead(partial(task, number) for number in work.numbers)
