"""Where a dataset leaves the range of the model, in words: scenes whose validity numbers are beyond their limits."""

from collections.abc import Iterator

import xarray

from gradhesion.cli.dataset.read.model_range import LIMITS, beyond_by, is_cone
from gradhesion.cli.dataset.read.reader import tiling_of
from gradhesion.cli.terminal.amounts import counted, percent
from gradhesion.core.problem.names import CONTACT_SLOPE


def validity_lines(dataset: xarray.Dataset) -> Iterator[str]:
    """Tell how many scenes leave the range of the model, by each number that is known."""
    scenes = dataset["status"].size
    for name, limit in LIMITS.items():
        blocks = (beyond_by(name, dataset, block) for block in tiling_of(dataset["status"]))
        count = sum(int(beyond.sum()) for beyond in blocks if beyond is not None)
        condition = f"{limit.condition}: {limit.words}"
        if name == CONTACT_SLOPE and is_cone(dataset):
            count, condition = scenes, "1 at every radius: slopes of a cone are not small"
        if count:
            share = f"{count:,} of {counted(scenes, 'scene')} ({percent(count, scenes)})"
            yield f"  {name:<30} {share:<26} {condition}"
