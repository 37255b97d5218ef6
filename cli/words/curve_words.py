"""Curves in words: how long they are, how often they fold and jump, and how far they reach."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.names.curves import EXTENTS, INTEGERS, RAGGED, STATE_CURVES, variables_of_curves
from gradhesion.cli.names.outputs import SI
from gradhesion.cli.words.table import COUNT, JUMP, columns_of
from gradhesion.core.problem.inputs import INPUTS


def told(name: str, value: str, words: str = "", width: int = 30) -> str:
    """Write a line of a name, its value and what it is."""
    return f"  {name:<{width}} {value:<26} {words}".rstrip()


def unit_behind(variable: xarray.DataArray, before: str = " ") -> str:
    """Give the unit of a variable, nothing if it has none."""
    unit = str(variable.attrs.get("units", "1"))
    return "" if unit == "1" else before + unit


def about(variable: xarray.DataArray) -> str:
    """Say what a variable is, and in which unit."""
    return f"{variable.attrs.get('long_name', 'without a name')}{unit_behind(variable, ', in ')}"


def number_range(numbers: Any) -> str:
    """Report a number of each scene.

    >>> number_range([3, 1200, 4]), number_range([5])
    ('3 to 1,200', '5')
    """
    least, greatest = int(np.min(numbers)), int(np.max(numbers))
    return f"{least:,}" if least == greatest else f"{least:,} to {greatest:,}"


def curve_lines(dataset: xarray.Dataset) -> Iterator[str]:
    """Describe the curves of a dataset, line by line."""
    for curve, names in variables_of_curves(dataset).items():
        if curve not in RAGGED:
            points = dataset[names[0]].notnull().sum(EXTENTS[curve]).values
            yield ""
            yield f"{curve}: {number_range(points)} points per {'state' if curve in STATE_CURVES else 'scene'}"
            own = dataset[[name for name in names if name in INTEGERS]]
            yield from (told(words, number_range(numbers)) for words, numbers in _counts(own).items())
            yield from _extents(dataset, names)


def _counts(own: xarray.Dataset) -> dict[str, NDArray[np.integer]]:
    """Count the branches and jumps of each scene, as far as a curve has them."""
    counts = {}
    if "stable" in own:
        stable = own["stable"].values == 1
        counts["stable branches"] = stable[..., 0] + np.count_nonzero(stable[..., 1:] & ~stable[..., :-1], axis=-1)
    if "path_branch" in own:
        ordered = np.sort(np.fmax(own["path_branch"].values, 0), axis=-1)
        counts["branches followed, with rim"] = np.count_nonzero(np.diff(ordered, axis=-1, prepend=0), axis=-1)
    if {"path_jump", "path_unloading"} <= {*own}:
        for words, way in (("loading", 0), ("unloading", 1)):
            jumps = (own["path_jump"].values == 1) & (own["path_unloading"].values == way)
            counts[f"jumps on {words}"] = np.count_nonzero(jumps, axis=-1)
    return counts


def _extents(dataset: xarray.Dataset, names: Sequence[str]) -> Iterator[str]:
    """Report between what the values of some variables lie: no flags and counts, and in SI where they are."""
    for name in (name for name in names if name not in INTEGERS and f"{name}{SI}" not in names):
        values = dataset[name].values[dataset[name].notnull().values]
        extent = f"{values.min() + 0.0:.6g} to {values.max() + 0.0:.6g}" if values.size else "no value in any scene"
        yield told(name, extent, about(dataset[name]))


def jump_lines(dataset: xarray.Dataset) -> Iterator[str]:
    """Report the jumps of a dataset, if it has them: how many, how large, and where the largest is."""
    if COUNT not in dataset:
        return
    counts = dataset[COUNT].values
    yield ""
    yield f"jumps: {number_range(counts)} per scene, {int(counts.sum()):,} in all"
    if not dataset.sizes.get(JUMP):
        return
    names = [name for name in variables_of_curves(dataset)["jumps"] if name != COUNT]
    jumps = dataset[names].load()
    for words, such in (
        ("on unloading", jumps.get("jump_unloading", 0) == 1),
        ("from or to the rim", jumps.get("jump_at_rim", 0) == 1),
        ("that gain energy", jumps.get("jump_energy", 0.0) < 0.0),
    ):
        if np.any(such):
            yield told(words, f"{int(np.sum(such)):,}")
    yield from _extents(jumps, names)
    if "jump_energy" in jumps:
        item = int(jumps["jump_energy"].values.argmax())
        scene = int(np.searchsorted(np.cumsum(counts), item, side="right"))
        varying = [name for name in INPUTS if name in dataset and dataset[name].ndim]
        place = {name: values[scene] for name, values in columns_of(dataset, varying, dataset["status"]).items()}
        known = {name: jumps[name].values[item] for name in names} | place
        yield f"  the one that dissipates most: {', '.join(f'{name} = {value:.6g}' for name, value in known.items())}"
