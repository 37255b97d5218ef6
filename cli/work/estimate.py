"""What a run would do and cost: blocks, what is kept of them, bytes, memory, and the time by a probe of real scenes."""

import shutil
from collections import Counter
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import size_of
from gradhesion.cli.work.parts.folder import Folder, folder_of
from gradhesion.cli.work.parts.manifest import differences_of, manifest_of
from gradhesion.cli.work.parts.parts import bytes_of, key_of
from gradhesion.cli.work.parts.resume import found
from gradhesion.cli.work.probe import probe
from gradhesion.core.processors import processors

BASE: Final = 250e6
"""Bytes of the program itself, its libraries and kernels: 220 to 245 MB as measured, the more kernels the more."""
START: Final = 3.0
"""Seconds until the workers of a cluster on this machine are at work: 4 of processor time on two cores, and waiting."""
OF_CLUSTER: Final = 0.006
"""Seconds of this process for a block of a cluster, beside writing it: 2 ms to hand it out, and to read its part."""
FILE: Final = 0.01
"""Seconds of a file: its definition, and its way to the disk."""
COPIES: Final = 8
"""Times the values of a block, as measured: two blocks are in memory, and one of them at work."""


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """What a run would do and cost; None is not known."""

    output: str
    output_exists: bool
    running: bool
    """Whether a run is at work on this output."""
    kind: str
    has_blocks: bool
    """Whether it is computed block by block, so that its cost can be probed."""
    scenes: int
    solutions_of_scene: int
    """How often a scene is solved with other inputs: its samples."""
    sizes: dict[str, int]
    outputs: tuple[str, ...]
    blocks: int
    blocks_reused: int
    not_reused: dict[str, int]
    """Reasons, with the number of blocks."""
    differences: tuple[str, ...]
    """How the study differs from that of the parts: a run would refuse."""
    bytes_of_parts: int
    """To be written, beside the dataset."""
    bytes_of_file: int | None
    bytes_free: int | None
    bytes_of_memory: int | None
    seconds: float | None
    seconds_uncertain: float | None
    """Two standard errors of the probe."""
    seconds_dask: float | None
    """With --engine dask on this machine."""
    seconds_of_block: float | None
    """Of one core: what a worker of a cluster needs at a time."""
    scenes_probed: int


def estimate(study: Study, output: Path, threads: int | None = None) -> Estimate:
    """Find out what a run would do and cost; writes nothing."""
    folder = folder_of(output)
    is_map = study.in_blocks
    count = len(study.tiling)
    of_block = bytes_of(study, study.tiling[0]) if is_map else 0
    foreign, old = folder.foreign(), folder.manifest()
    parts = study.has_parts
    differences = differences_of(old, manifest_of(study)) if old and folder.parts() else []
    if foreign:
        differences = [f"{output}.parts {foreign}"]
    reused, reasons = _reused(study, folder, count) if parts and not differences else (set[int](), Counter[str]())
    if differences and not foreign:
        reasons["of another study"] = len(folder.parts())
    if count - len(reused) - reasons.total():
        reasons["not computed yet"] += count - len(reused) - reasons.total()
    left = [number for number in range(count) if number not in reused] if is_map else []
    scenes_left = study.scenes - sum(size_of(study.tiling[number]) for number in reused)
    probed = probe(study, left)
    seconds = uncertain = by_dask = of_one = None
    if probed:
        workers = threads or processors()
        writing = probed.compressing * study.scenes + probed.columns + probed.sealing * scenes_left * parts
        solving = probed.solving * scenes_left + probed.tables * len(left) / count
        seconds = FILE + max((solving + writing) / workers, writing)
        uncertain = probed.uncertainty * scenes_left / workers
        of_one = solving / len(left)
        if parts:
            by_dask = START + seconds + OF_CLUSTER * len(left)
    each = of_block // size_of(study.tiling[0]) if is_map else 0
    return Estimate(
        output=str(output),
        output_exists=output.exists(),
        running=not foreign and folder.busy(),
        kind=study.kind,
        has_blocks=is_map,
        scenes=study.scenes,
        solutions_of_scene=study.solutions,
        sizes=study.sizes,
        outputs=study.outputs or study.variables,
        blocks=count,
        blocks_reused=len(reused),
        not_reused=dict(reasons),
        differences=tuple(differences),
        bytes_of_parts=each * scenes_left if parts else 0,
        bytes_of_file=round(probed.ratio * study.scenes * each) if probed else None,
        bytes_free=_free(output),
        bytes_of_memory=round(BASE + COPIES * of_block) if is_map else None,
        seconds=seconds,
        seconds_uncertain=uncertain,
        seconds_dask=by_dask,
        seconds_of_block=of_one,
        scenes_probed=probed.scenes if probed else 0,
    )


def _reused(study: Study, folder: Folder, count: int) -> tuple[set[int], Counter[str]]:
    """Read every part that is there: the numbers of those that a run would reuse, and why not the others."""
    reused = set()
    reasons: Counter[str] = Counter()
    for path in folder.parts():
        if int(path.stem) >= count:
            continue
        block = study.tiling[int(path.stem)]
        values = found(study, folder, int(path.stem), block, key_of(study, block))
        if isinstance(values, str):
            reasons[values] += 1
        else:
            reused.add(int(path.stem))
    return reused, reasons


def _free(output: Path) -> int | None:
    """Count the free bytes where the output goes: in its folder, or the one that the folder would be made in."""
    for folder in output.absolute().parents:
        with suppress(OSError):
            return shutil.disk_usage(folder).free
    return None
