"""Curves in words: how long they are, how often they fold and jump, and how far they reach."""

from collections.abc import Iterator, Sequence
from itertools import product
from typing import Any, Final

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.names.curves import INTEGERS, RAGGED, STATE_CURVES, variables_of_curves
from gradhesion.cli.study.tiling import tile
from gradhesion.cli.words.jump_words import jump_lines, meaning_of

CELLS: Final = 2**20
"""Values of a variable that are read at a time, unless a single curve has more."""

Scene = dict[str, NDArray[np.float64]]


def curve_lines(dataset: xarray.Dataset, cells: int = CELLS) -> Iterator[str]:
    """Describe the curves of a dataset, line by line, reading so many values of a variable at a time."""
    for curve, names in variables_of_curves(dataset).items():
        if curve in RAGGED:
            continue
        counts: dict[str, list[int]] = {"points": []}
        ends = {name: (np.inf, -np.inf) for name in names if name not in INTEGERS}
        for scene in _scenes(dataset, names, cells):
            counts["points"].append(int(np.count_nonzero(~np.isnan(scene[names[0]]))))
            for word, count in _events(scene).items():
                counts.setdefault(word, []).append(count)
            for name, (least, greatest) in ends.items():
                values = scene[name][~np.isnan(scene[name])]
                ends[name] = float(np.min(values, initial=least)), float(np.max(values, initial=greatest))
        yield ""
        which = "state" if curve in STATE_CURVES else "scene"
        yield f"{curve}: {_range(counts.pop('points'))} points per {which}"
        yield from (f"  {word:<30} {_range(numbers)}" for word, numbers in counts.items())
        for name, (least, greatest) in ends.items():
            extent = f"{least + 0.0:.6g} to {greatest + 0.0:.6g}" if least <= greatest else "no value in any scene"
            yield f"  {name:<30} {extent:<26} {meaning_of(dataset[name])}"
    yield from jump_lines(dataset)


def _scenes(dataset: xarray.Dataset, names: Sequence[str], cells: int) -> Iterator[Scene]:
    """Give the variables of one curve scene by scene."""
    *shape, longest = dataset[names[0]].shape
    steps = tile(tuple(shape), max(1, cells // max(1, longest)))
    starts = (range(0, length, step) for length, step in zip(shape, steps, strict=True))
    for corner in product(*starts):
        block = tuple(slice(start, start + step) for start, step in zip(corner, steps, strict=True))
        loaded = {name: np.asarray(dataset[name][block].values, dtype=float).reshape(-1, longest) for name in names}
        for i in range(len(loaded[names[0]])):
            yield {name: values[i] for name, values in loaded.items()}


def _events(scene: Scene) -> dict[str, int]:
    """Count the branches and the jumps of one scene."""
    counts: dict[str, Any] = {}
    if "stable" in scene:
        stable = scene["stable"] == 1.0
        counts["stable branches"] = stable[:1].sum() + (stable[1:] & ~stable[:-1]).sum()
    if "path_branch" in scene:
        visited = np.unique(scene["path_branch"])
        counts["branches followed, with rim"] = (visited > 0.0).sum()
    if {"path_jump", "path_unloading"} <= scene.keys():
        jumps = scene["path_jump"] == 1.0
        for word, way in (("loading", 0.0), ("unloading", 1.0)):
            counts[f"jumps on {word}"] = (jumps & (scene["path_unloading"] == way)).sum()
    return {word: int(count) for word, count in counts.items()}


def _range(numbers: Sequence[int]) -> str:
    """
    Report a number of each scene.

    >>> _range([3, 1200, 4]), _range([5])
    ('3 to 1,200', '5')
    """
    least, greatest = min(numbers), max(numbers)
    return f"{least:,}" if least == greatest else f"{least:,} to {greatest:,}"
