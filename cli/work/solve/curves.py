"""The curves of a study: drawn scene by scene, each as long as it needs to be, and padded to the longest."""

from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion import core
from gradhesion.cli.names.curves import CURVES, INTEGERS, RAGGED, STATE_CURVES, is_ragged
from gradhesion.cli.names.outputs import SI
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.names.units import UNITS
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block
from gradhesion.cli.work.solve.blocks import awaited
from gradhesion.cli.work.solve.given import driven_by, scales_of, scenes_from
from gradhesion.core.closed.reach import is_steep, slopes_of
from gradhesion.core.problem.status import NO_VALUE
from gradhesion.core.processors import processors

AHEAD: Final = 2
"""Scenes drawn ahead a thread."""

_CONTACT_RADII: Final = tuple(
    name for own in CURVES.values() for name, about in own.items() if about.startswith("contact radius")
)
"""The variables with the radii of contact that are drawn."""

Drawing = tuple[Block, dict[str, NDArray[Any]]]


def blank_of(variable: str) -> float:
    """Give what stands where a curve has no point."""
    return -1 if variable in INTEGERS else np.nan


def drawn(study: Study, threads: int | None = None) -> Iterator[Drawing]:
    """
    Draw a study scene by scene: its curves, along one more dimension than its block, and its `status`.

    Ragged curves have their own dimension alone. Scenes are drawn in threads of their own, some ahead of whoever takes
    them; they come in order.
    """
    workers = min(threads or processors(), study.scenes)
    pool = ThreadPoolExecutor(workers, thread_name_prefix="draw")
    ahead: deque[Future[Drawing]] = deque()
    try:
        for block in study.tiling:
            ahead.append(pool.submit(_draw, study, block))
            if len(ahead) > AHEAD * workers:
                yield awaited(ahead.popleft())
        while ahead:
            yield awaited(ahead.popleft())
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def _draw(study: Study, block: Block) -> Drawing:
    """Draw the curves of one scene; one that has none is one point without a value."""
    given = study.parameters_of(block)
    scene = {name: float(values.item()) for name, values in scenes_from(given).items()}
    requested = [curve for curve, own in CURVES.items() if any(name in own for name in study.outputs)]
    of_states = [curve for curve in requested if curve in STATE_CURVES]
    curves = [curve for curve in requested if curve not in STATE_CURVES]
    found, status = core.draw_curves(scene, curves, study.profile, **driven_by(study))
    if of_states:
        more, flags = _of_states(study, scene, of_states)
        found, status = found | more, status | flags
    for curve, count in RAGGED.items():
        if curve in curves:
            found[count] = np.array(np.size(found[next(name for name in CURVES[curve] if name in found)]))
    front, parts = (1,) * len(block), {}
    for name in study.outputs:
        values = np.asarray(found[name])
        if is_ragged(name):
            parts[name] = values
        else:
            values = values if values.size else np.array([blank_of(name)])
            parts[name] = values.reshape((*front, *values.shape)).astype(INTEGERS.get(name, values.dtype), copy=False)
    scales = scales_of(study, given)
    parts |= {name + SI: parts[name] * scales[UNITS[name]].item() for name in study.in_si}
    parts["status"] = np.full(front, status, dtype=study.status_type)
    radii = [np.ravel(found[name]) for name in _CONTACT_RADII if name in found] + [np.array(study.states)]
    steep = not study.is_cone and bool(is_steep(slopes_of(np.concatenate(radii), study.profile)).any())
    parts[STEEP] = np.full(front, steep, dtype=np.int8)
    return block, parts


def _of_states(study: Study, scene: Mapping[str, float], curves: Sequence[str]) -> tuple[dict[str, NDArray[Any]], int]:
    """Draw the curves of the states of one scene: those of given radii, or the named ones of its cycle."""
    from gradhesion.core.draw import states  # noqa: PLC0415 (300 ms for SciPy)

    if study.states:
        chosen = states.equilibrium_states(scene, study.states, study.profile)
        status = NO_VALUE if np.isnan(chosen).all() else 0
    else:
        chosen, status = states.named_states(scene, study.profile, study.loading)
    return states.draw_states(scene, chosen, curves, study.profile), status


def gathered(study: Study, drawings: Sequence[Drawing]) -> dict[str, NDArray[Any]]:
    """Put the drawings of a study together, padded to the longest curves."""
    filled = {"status": np.empty(study.shape, study.status_type), STEEP: np.zeros(study.shape, np.int8)}
    for name in study.variables:
        parts_of = [parts[name] for _, parts in drawings]
        if is_ragged(name):
            filled[name] = np.concatenate(parts_of)
            continue
        further = [max(lengths) for lengths in zip(*(part.shape[len(study.shape) :] for part in parts_of), strict=True)]
        filled[name] = np.full((*study.shape, *further), blank_of(name), INTEGERS.get(name, "f8"))
    for block, parts in drawings:
        for name, part in parts.items():
            if not is_ragged(name):
                filled[name][within(name, block, part)] = part
    return filled


def within(name: str, block: Block, part: NDArray[Any], begun: int = 0) -> Block:
    """
    Report where a part goes that has further dimensions than its block, or none of it after `begun` items.

    >>> within("path_load", (slice(2, 3),), np.zeros((1, 5)))
    (slice(2, 3, None), slice(0, 5, None))
    >>> within("jump_energy", (slice(2, 3),), np.zeros(4), 7)
    (slice(7, 11, None),)
    """
    if is_ragged(name):
        return (slice(begun, begun + part.size),)
    return (*block, *(slice(0, length) for length in part.shape[len(block) :]))
