"""How fast the scenes of a study are: a few pieces of it, spread evenly, solved and timed."""

import math
import time
import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block, shape_of, size_of, tile
from gradhesion.cli.work.blocks import solve_block

SECONDS: Final = 2.0
"""For all pieces together."""
PIECES: Final = 32
"""At most: each stands for an equal share of the blocks."""
SECONDS_OF_PIECE: Final = 0.05
CELLS: Final = 8192
"""Scenes of a piece at most."""
FIRST_CELLS: Final = 128
"""Scenes of the first piece: enough to know how many the others may have."""


@dataclass(frozen=True)
class Probe:
    """Seconds a scene, of one thread, and how far they may be off; what the values compress to."""

    scenes: int
    solving: float
    uncertainty: float
    """Two standard errors of `solving`."""
    compressing: float
    ratio: float


def probe(study: Study, numbers: Sequence[int]) -> Probe | None:
    """Time pieces of some of the blocks of a map; None if there is none."""
    if not numbers:
        return None
    spread = [numbers[int(i * len(numbers))] for i in _spread(min(PIECES, 4 * len(numbers)))]
    place = _spread(PIECES)
    cells = min(FIRST_CELLS, study.cells)
    start = time.monotonic()
    solve_block(study, _piece(study.tiling[spread[0]], 1, 0.0), 1)  # compiles, if need be
    rates: list[float] = []
    scenes = compressed = plain = 0
    compressing = 0.0
    begun = time.monotonic()
    for number in spread:
        piece = _piece(study.tiling[number], cells, next(place))
        solve_block(study, tuple(slice(part.start, part.start + 1) for part in piece), 1)  # its table is kept then
        start = time.perf_counter()
        values = solve_block(study, piece, 1)
        rates.append((time.perf_counter() - start) / size_of(piece))
        scenes += size_of(piece)
        start = time.perf_counter()
        compressed += sum(_compressed(array) for array in values.values())
        compressing += time.perf_counter() - start
        plain += sum(array.nbytes for array in values.values())
        cells = max(1, min(CELLS, study.cells, int(SECONDS_OF_PIECE / max(rates))))
        if time.monotonic() - begun > SECONDS:
            break
    return Probe(
        scenes=scenes,
        solving=float(np.mean(rates)),
        uncertainty=2 * float(np.std(rates, ddof=1)) / math.sqrt(len(rates)) if len(rates) > 1 else math.inf,
        compressing=compressing / scenes,
        ratio=compressed / plain,
    )


def _spread(count: int) -> Iterator[float]:
    """
    Give numbers in [0, 1) that are spread evenly, however many are taken (van der Corput).

    >>> list(_spread(4))
    [0.0, 0.5, 0.25, 0.75]
    """
    for i in range(count):
        yield sum(int(bit) / 2.0 ** (place + 1) for place, bit in enumerate(reversed(f"{i:b}")))


def _piece(block: Block, cells: int, place: float) -> Block:
    """Cut a piece out of a block, as blocks are cut themselves: what scenes share, they share in a piece."""
    shape = shape_of(block)
    piece = []
    for part, size in zip(block, tile(shape, cells), strict=True):
        free = part.stop - part.start - size + 1
        place *= free
        piece.append(slice(part.start + int(place), part.start + int(place) + size))
        place -= int(place)
    return tuple(piece)


def _compressed(array: NDArray[np.generic]) -> int:
    """Count the bytes that an array is compressed to in the file: bytes of one kind together, then zlib."""
    return len(zlib.compress(np.ascontiguousarray(array).view(np.uint8).reshape(-1, array.itemsize).T.tobytes(), 1))
