"""What a run would do and cost: blocks, what is kept of them, bytes, and the time by a few scenes that are solved."""

import math
import os
import shutil
import time
from pathlib import Path
from typing import Any, Final

from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Tiling, size_of
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
"""Of scenes that are timed."""
CELLS: Final = (128, 4096)
"""Scenes of a piece, at first and at most: more where they are quick."""
SECONDS_OF_PIECE: Final = 0.05
GOLDEN: Final = (math.sqrt(5.0) - 1.0) / 2.0
"""Multiples of it, less their integers, are spread evenly between 0 and 1, however many are taken."""


def estimate(study: Study, output: Path, threads: int | None = None) -> dict[str, Any]:
    """Find out what a run would do and cost, as `gradhesion plan --json` has it; None is not known.

    `refusal` says why a run would not go on with the blocks that are kept, `solutions_of_scene` how often a scene is
    solved with other inputs. Without `blocks` scenes are computed one by one. In the file `bytes_of_values` are
    compressed, in blocks that are kept they are not. `seconds_of_block` are those of one core.
    """
    parts = Parts(output, study)
    refusal = parts.refusal()
    numbers = range(len(study.tiling)) if study.in_blocks else range(0)
    left = [number for number in numbers if refusal or not parts.part(number).exists()]
    timed, seconds = timed_scenes(study) if left else (0, 0.0)
    of_scene = seconds / timed if timed else None
    scenes_left = sum(size_of(study.tiling[number]) for number in left)
    values = 8 * sum(math.prod(study.shape_of(name, ())) for name in study.variables) if numbers else 0
    largest = size_of(study.tiling[0])
    nearest = next(folder for folder in output.absolute().parents if os.path.isdir(folder))  # noqa: PTH112 (no error)
    return {
        "running": is_running(parts.folder),
        "refusal": refusal,
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


def timed_scenes(study: Study) -> tuple[int, float]:
    """Solve pieces of a map on one thread, spread evenly over it: how many scenes, and the seconds.

    They are cut as blocks are cut themselves: what scenes share, they share there.
    """
    cells, scenes, spent = CELLS[0], 0, 0.0
    solve_block(study, Tiling(study.shape, cells, 1)[0], 1)  # loads or compiles kernels, and makes tables
    for i in range(PIECES):
        pieces = Tiling(study.shape, cells, 1)
        piece = pieces[int(i * GOLDEN % 1.0 * len(pieces))]
        start = time.perf_counter()
        solve_block(study, piece, 1)
        seconds = time.perf_counter() - start
        scenes, spent = scenes + size_of(piece), spent + seconds
        if seconds < SECONDS_OF_PIECE:
            cells = min(2 * cells, CELLS[1])
        if spent > SECONDS or scenes >= study.scenes:
            break
    return scenes, spent
