"""How the scenes of a study are cut: into chunks of the file, and blocks of whole chunks that are solved one by one."""

import math
import os
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

CHUNK: Final = 131_072
"""Cells of a chunk in the file: one MiB of float64."""

CHUNKS_OF_BLOCK: Final = 2
"""Chunks of a block: a second or so of the slowest work, so that progress shows and an interrupt is heard."""

Block = tuple[slice, ...]


def cells_of_chunk() -> int:
    """Give the cells of a chunk; tests set fewer, so that small studies have many blocks."""
    return int(os.environ.get("GRADHESION_CHUNK", CHUNK))


@dataclass(frozen=True)
class Tiling:
    """A shape cut into blocks of whole chunks, so that no chunk is written twice; blocks have numbers in C order."""

    shape: tuple[int, ...]
    cells: int = CHUNK
    """Cells of a chunk, at most."""
    chunks: int = CHUNKS_OF_BLOCK
    """Chunks of a block, at most."""

    @cached_property
    def chunk(self) -> tuple[int, ...]:
        """The shape of a chunk."""
        return tile(self.shape, self.cells)

    @cached_property
    def _cuts(self) -> tuple[range, ...]:
        """Where the blocks begin along each axis; the steps are their lengths."""
        counts = tuple(-(-length // part) for length, part in zip(self.shape, self.chunk, strict=True))
        steps = (n * part for n, part in zip(tile(counts, self.chunks), self.chunk, strict=True))
        return tuple(range(0, length, step) for length, step in zip(self.shape, steps, strict=True))

    def __len__(self) -> int:
        """Count the blocks."""
        return math.prod(map(len, self._cuts))

    def __iter__(self) -> Iterator[Block]:
        """Give the blocks in the order of their numbers."""
        return (self[number] for number in range(len(self)))

    def __getitem__(self, number: int) -> Block:
        """Give a block by its number, from 0."""
        places = np.unravel_index(number, [len(cut) for cut in self._cuts])
        cuts = zip(places, self._cuts, strict=True)
        return tuple(slice(cut[i], min(cut[i] + cut.step, cut.stop)) for i, cut in cuts)


def tile(shape: tuple[int, ...], cells: int) -> tuple[int, ...]:
    """Cut a shape into even tiles of at most `cells` cells, the trailing axes whole as long as they fit.

    Leading axes are cut first, since all a_max (the last axis) of one curve share its trace.

    >>> tile((19, 4, 60, 5, 6), 131_072)
    (10, 4, 60, 5, 6)
    """
    size = []
    for length in reversed(shape):
        parts = -(-length // max(1, min(length, cells)))
        size.append(-(-length // parts))
        cells = cells // length if parts == 1 else 1
    return tuple(reversed(size))


def shape_of(block: Block) -> tuple[int, ...]:
    """Give the shape of a block."""
    return tuple(part.stop - part.start for part in block)


def size_of(block: Block) -> int:
    """Count the cells of a block."""
    return math.prod(shape_of(block))
