"""The blocks of a study, taken from the parts of an earlier run where they are there, and solved where they are not."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from gradhesion.cli.names.outputs import ON_BOUND
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block, shape_of, size_of
from gradhesion.cli.work.parts.folder import Folder
from gradhesion.cli.work.parts.parts import PartError, Results, read_part, types_of
from gradhesion.cli.work.solve.blocks import solve_block
from gradhesion.core import FAILED, FLAGS

ATTEMPTS: Final = 2
"""Times that a block is tried: what raises twice, as for lack of memory, hardly ends well a third time."""


@dataclass(frozen=True)
class Solved:
    """A block with its values."""

    block: Block
    values: Results
    key: str = ""
    """What its part depends on."""
    reused: bool = False
    error: str = ""
    """Why it has none, if it raised each time."""

    @property
    def failed(self) -> int:
        """The number of its scenes that have failed."""
        return int(np.count_nonzero(self.values["status"] & FAILED))


def found(study: Study, folder: Folder, number: int, block: Block, key: str) -> Results | str:
    """Read the part of a block, or report why it is unusable."""
    try:
        return read_part(folder.part(number), key, study, block)
    except FileNotFoundError:
        return "not computed yet"
    except OSError:
        return "cannot be read"
    except PartError as error:
        return str(error)


def attempted(study: Study, block: Block, threads: int | None) -> tuple[Results, str]:
    """Solve a block, again if it raises; then its scenes have no value, and the error is reported."""
    reason = ""
    for _ in range(ATTEMPTS):
        try:
            return solve_block(study, block, threads), ""
        except Exception as error:  # noqa: BLE001 (its neighbours are not to be lost with it)
            reason = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
    return blank(study, block), reason


def blank(study: Study, block: Block) -> Results:
    """Make the values of a block that has none."""
    shape = shape_of(block)
    marks = (ON_BOUND, STEEP)
    values = {
        name: np.full(study.shape_of(name, shape), np.nan if kind.kind == "f" else 0 if name in marks else -1, kind)
        for name, kind in types_of(study).items()
        if name != "status"
    }
    return values | {"status": np.full(shape, FLAGS["no_value"], types_of(study)["status"])}


def place_of(study: Study, block: Block) -> str:
    """Say which scenes a block has."""
    axes = [
        f"{name} {part.start}" + (f" to {part.stop - 1}" if part.stop - part.start > 1 else "")
        for (name, size), part in zip(study.sizes.items(), block, strict=True)
        if (part.start, part.stop) != (0, size)
    ]
    return f"{size_of(block):,} scenes" + (f", index {', '.join(axes)}" if axes else "")
