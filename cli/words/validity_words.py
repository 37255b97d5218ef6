"""Where a dataset leaves the range of the model, in words: scenes whose validity numbers are beyond their limits."""

from collections.abc import Iterator

import xarray

from gradhesion.cli.dataset.model_range import LIMITS, is_beyond
from gradhesion.cli.dataset.reader import tiling_of
from gradhesion.cli.terminal.amounts import counted


def validity_told(dataset: xarray.Dataset) -> Iterator[str]:
    """Tell how many scenes leave the range of the model, by each number that the dataset has."""
    for name, limit in LIMITS.items():
        if name not in dataset:
            continue
        count = sum(int(is_beyond(dataset[name][block]).sum()) for block in tiling_of(dataset[name]))
        if count:
            scenes = dataset[name].size
            share = f"{count:,} of {counted(scenes, 'scene')} ({100 * count / scenes:.2g} %)"
            yield f"  {name:<30} {share:<26} {limit.condition}: {limit.words}"
