"""What a run would do and cost: blocks, what is kept of them, bytes, and the time by a few scenes that are solved."""

import math
import os
import shutil
import time
from pathlib import Path
from typing import Any, Final

from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block, Tiling, shape_of, size_of
from gradhesion.cli.work.folder import Parts, is_running
from gradhesion.cli.work.solve.blocks import solve_block
from gradhesion.core.processors import processors

BASE: Final = 250e6
"""Bytes of the program itself, its libraries and kernels."""
COPIES: Final = 8
"""Times the values of a block, as measured: two blocks are in memory, and one of them at work."""
SECONDS: Final = 2.0
"""For all scenes that are timed."""
PIECES: Final = 32
"""Of scenes that are timed, spread evenly."""
CELLS: Final = 4096
"""Scenes of a piece at most."""
SECONDS_OF_PIECE: Final = 0.05


def estimate(study: Study, output: Path, threads: int | None = None) -> dict[str, Any]:
    """Find out what a run would do and cost, as `gradhesion plan --json` prints it; None is not known.

    `refusal` says why a run would not go on with the blocks that are kept, `solutions_of_scene` how often a scene is
    solved with other inputs. Without `blocks` scenes are computed one by one. In the file `bytes_of_values` are
    compressed, in blocks that are kept they are not. `seconds_of_block` are those of one core.
    """
    parts = Parts(output, study)
    refusal = parts.refusal()
    numbers = range(len(study.tiling)) if study.in_blocks else range(0)
    left = [number for number in numbers if refusal or not parts.part(number).exists()]
    timed, seconds = timed_scenes(study, left) if left else (0, 0.0)
    of_scene = seconds / timed if timed else None
    scenes_left = sum(size_of(study.tiling[number]) for number in left)
    values = 8 * sum(math.prod(study.shape_of(name, ())) for name in study.variables) if numbers else 0
    largest = size_of(study.tiling[0])
    nearest = next(folder for folder in output.absolute().parents if os.path.isdir(folder))  # noqa: PTH112 (no error)
    return {
        "output": str(output),
        "output_exists": output.exists(),
        "running": is_running(parts.folder),
        "refusal": refusal,
        "kind": study.kind,
        "scenes": study.scenes,
        "solutions_of_scene": study.solutions,
        "sizes": study.sizes,
        "outputs": study.outputs or study.variables,
        "blocks": len(numbers),
        "blocks_kept": len(numbers) - len(left),
        "bytes_of_values": values * study.scenes,
        "bytes_free": shutil.disk_usage(nearest).free,
        "bytes_of_memory": round(BASE + COPIES * values * largest),
        "seconds": of_scene * scenes_left / (threads or processors()) if of_scene else None,
        "seconds_of_block": of_scene * largest if of_scene else None,
        "scenes_timed": timed,
    }


def timed_scenes(study: Study, numbers: list[int]) -> tuple[int, float]:
    """Solve pieces of some of the blocks of a map on one thread, spread evenly: how many scenes, and the seconds."""
    cells = min(128, study.cells)
    solve_block(study, _piece(study.tiling[numbers[0]], cells, 0.0), 1)  # loads or compiles kernels, and makes tables
    scenes, spent = 0, 0.0
    for i in range(PIECES):
        place = (i * (math.sqrt(5.0) - 1.0) / 2.0) % 1.0  # however many are taken, they are spread evenly
        number, within = divmod(place * len(numbers), 1.0)
        piece = _piece(study.tiling[numbers[int(number)]], cells, within)
        start = time.perf_counter()
        solve_block(study, piece, 1)
        seconds = time.perf_counter() - start
        scenes, spent = scenes + size_of(piece), spent + seconds
        if seconds < SECONDS_OF_PIECE:
            cells = min(2 * cells, CELLS, study.cells)
        if spent > SECONDS or scenes >= study.scenes:
            break
    return scenes, spent


def _piece(block: Block, cells: int, place: float) -> Block:
    """Take one of the pieces of a block, cut as blocks are cut themselves: what scenes share, they share there.

    >>> _piece((slice(2, 4), slice(0, 6)), 3, 0.3)
    (slice(2, 3, None), slice(3, 6, None))
    """
    pieces = Tiling(shape_of(block), cells, 1)
    piece = pieces[int(place * len(pieces))]
    return tuple(
        slice(all_.start + part.start, all_.start + part.stop) for all_, part in zip(block, piece, strict=True)
    )
