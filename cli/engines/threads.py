"""The engine that solves blocks in this process, one ahead of whoever takes them, each on several threads."""

from collections.abc import Generator
from dataclasses import dataclass
from functools import partial

from gradhesion.cli.disk import writing
from gradhesion.cli.engines import Work
from gradhesion.cli.work.parts.parts import key_of, write_part
from gradhesion.cli.work.parts.resume import Solved, attempted, found
from gradhesion.cli.work.solve.blocks import one_ahead


@dataclass(frozen=True)
class Threads:
    """Solves blocks here."""

    threads: int | None = None
    """As many as the process may use if None."""

    def results(self, work: Work) -> Generator[tuple[int, Solved], None, None]:
        """Give the blocks in order."""
        study, kept = work.study, work.study.has_parts

        def task(number: int) -> tuple[int, Solved]:
            block = study.tiling[number]
            key = key_of(study, block) if kept else ""
            values = found(study, work.folder, number, block, key) if kept else None
            if isinstance(values, dict):
                return number, Solved(block, values, key, reused=True)
            values, error = attempted(study, block, self.threads)
            return number, Solved(block, values, key, error=error)

        for number, solved in one_ahead(partial(task, number) for number in work.numbers):
            if kept and not (solved.reused or solved.error):
                with writing(work.path):
                    write_part(work.folder.part(number), solved.key, solved.values, study)
            yield number, solved
