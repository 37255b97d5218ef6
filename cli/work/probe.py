"""How fast the scenes of a study are: a few pieces of it, spread evenly, solved and timed.

Each piece is solved twice. The second time is that of its scenes; what the first one takes longer is that of the tables
of its gradient exponents, which a run makes once for each.
"""

import math
import time
import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block, Tiling, shape_of, size_of
from gradhesion.cli.work.parts.parts import digest_of
from gradhesion.cli.work.solve.blocks import solve_block

clock = time.perf_counter
SECONDS: Final = 2.0
"""For all pieces together."""
PIECES: Final = 32
"""At most: each stands for an equal share of the scenes."""
SECONDS_OF_PIECE: Final = 0.03
CELLS: Final = 8192
"""Scenes of a piece at most."""
OF_COLUMN: Final = 1.6
"""Writing a column of numbers over compressing it: they hardly get smaller, and are shuffled and written too."""
FIRST_CELLS: Final = 128
"""Scenes of the first piece: enough to know how many the others may have."""


@dataclass(frozen=True)
class Probe:
    """Seconds a scene, of one thread, and how far they may be off; what the values compress to."""

    scenes: int
    solving: float
    """A scene, with tables that are there."""
    uncertainty: float
    """Two standard errors of `solving`."""
    tables: float
    """Of all gradient exponents together."""
    compressing: float
    """A scene, for the dataset."""
    sealing: float
    """A scene, for its part."""
    ratio: float
    columns: float
    """Of writing all that is given as long columns, a table of points above all."""


def probe(study: Study, numbers: Sequence[int]) -> Probe | None:
    """Time pieces of some of the blocks of a map; None if there is none."""
    if not numbers:
        return None
    cells = min(FIRST_CELLS, study.cells)
    first = _piece(study.tiling[numbers[0]], cells, 0.0)
    solve_block(study, first, 1)  # loads kernels, or compiles them, and makes what all exponents share
    start = clock()
    solve_block(study, first, 1)
    cells = _next_cells(study, clock() - start, size_of(first))
    seen = {*_exponents(study, first).tolist()}
    rates: list[float] = []
    scenes = compressed = plain = new = 0
    compressing = sealing = making = 0.0
    begun = time.monotonic()
    for part in _spread(PIECES):
        number, place = divmod(part * len(numbers), 1.0)
        piece = _piece(study.tiling[numbers[int(number)]], cells, place)
        start = clock()
        solve_block(study, piece, 1)
        again = clock()
        values = solve_block(study, piece, 1)
        seconds = clock() - again
        rates.append(seconds / size_of(piece))
        if unseen := {*_exponents(study, piece).tolist()} - seen:
            seen |= unseen
            new += len(unseen)
            making += again - start - seconds
        scenes += size_of(piece)
        start = clock()
        compressed += sum(_compressed(array) for array in values.values())
        sealed = clock()
        digest_of(np.ascontiguousarray(array).data.cast("B") for array in values.values())
        compressing += sealed - start
        sealing += clock() - sealed
        plain += sum(array.nbytes for array in values.values())
        cells = min(cells, _next_cells(study, seconds, size_of(piece)))
        if time.monotonic() - begun > SECONDS or scenes >= study.scenes:
            break
    return Probe(
        scenes=scenes,
        solving=float(np.mean(rates)),
        uncertainty=2 * float(np.std(rates, ddof=1)) / math.sqrt(len(rates)) if len(rates) > 1 else math.inf,
        tables=max(0.0, making) / new * _exponents(study).size if new else 0.0,
        compressing=compressing / scenes,
        sealing=sealing / scenes,
        ratio=compressed / plain,
        columns=_seconds_of_columns(study),
    )


def _seconds_of_columns(study: Study) -> float:
    """Time how long a part of each long column takes to compress, for writing all of it."""
    seconds = 0.0
    for values in study.parameters.values():
        column = np.ravel(values)
        if column.size > CELLS:
            start = clock()
            _compressed(column[:CELLS])
            seconds += OF_COLUMN * (clock() - start) * column.size / CELLS
    return seconds


def _next_cells(study: Study, seconds: float, scenes: int) -> int:
    """Choose how many scenes the next piece may have."""
    return max(1, min(CELLS, study.cells, int(SECONDS_OF_PIECE * scenes / max(seconds, 1e-9))))


def _exponents(study: Study, block: Block | None = None) -> NDArray[np.float64]:
    """List the gradient exponents of a block, or of all of a study; none where they are searched."""
    given = study.parameters if block is None else study.parameters_of(study.apart(block)[1])
    return np.unique(np.asarray(given.get("k", []), dtype=float))


def _spread(count: int) -> Iterator[float]:
    """
    Give numbers in [0, 1) that are spread evenly, however many are taken (van der Corput).

    >>> list(_spread(4))
    [0.0, 0.5, 0.25, 0.75]
    """
    for i in range(count):
        yield sum(int(bit) / 2.0 ** (place + 1) for place, bit in enumerate(reversed(f"{i:b}")))


def _piece(block: Block, cells: int, place: float) -> Block:
    """
    Take one of the pieces that a block is cut into, as blocks are cut themselves: what scenes share, they share there.

    `place` is in [0, 1): all scenes are in a piece, and in one alone.

    >>> [_piece((slice(2, 4), slice(0, 6)), 3, place) for place in (0.0, 0.3, 0.99)]  # doctest: +NORMALIZE_WHITESPACE
    [(slice(2, 3, None), slice(0, 3, None)), (slice(2, 3, None), slice(3, 6, None)),
     (slice(3, 4, None), slice(3, 6, None))]
    """
    pieces = Tiling(shape_of(block), cells, 1)
    piece = pieces[int(place * len(pieces))]
    return tuple(
        slice(all_.start + part.start, all_.start + part.stop) for all_, part in zip(block, piece, strict=True)
    )


def _compressed(array: NDArray[np.generic]) -> int:
    """Count the bytes that an array is compressed to in the file: bytes of one kind together, then zlib."""
    return len(zlib.compress(np.ascontiguousarray(array).view(np.uint8).reshape(-1, array.itemsize).T.tobytes(), 1))
