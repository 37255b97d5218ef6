"""Curves in words: how long they are, how often they fold and jump, and how far they reach."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from typing import Final

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.names.curves import INTEGERS, RAGGED, STATE_CURVES, curve_of, variables_of_curves
from gradhesion.cli.names.outputs import SI
from gradhesion.cli.study.tiling import tile
from gradhesion.cli.words.table import COUNT, JUMP, columns_of
from gradhesion.core.problem.inputs import INPUTS

CELLS: Final = 2**20
"""Values of a variable that are read at a time, unless a single curve has more."""

Curves = dict[str, NDArray[np.float64]]
"""The variables of one curve, of some scenes: the last axis is that along the curve."""


def number_range(numbers: Sequence[int] | NDArray[np.integer]) -> str:
    """
    Report a number of each scene.

    >>> number_range([3, 1200, 4]), number_range([5])
    ('3 to 1,200', '5')
    """
    least, greatest = int(np.min(numbers)), int(np.max(numbers))
    return f"{least:,}" if least == greatest else f"{least:,} to {greatest:,}"


def curve_lines(dataset: xarray.Dataset, cells: int = CELLS) -> Iterator[str]:
    """Describe the curves of a dataset, line by line, reading so many values of a variable at a time."""
    for curve, names in variables_of_curves(dataset).items():
        if curve in RAGGED:
            continue
        counts: dict[str, list[int]] = {}
        ends: dict[str, list[float]] = {name: [] for name in _told(names)}
        for part in _parts(dataset, names, cells):
            for word, numbers in _counts(part, names[0]).items():
                counts.setdefault(word, []).extend((int(numbers.min()), int(numbers.max())))
            for name, found in ends.items():
                finite = part[name][~np.isnan(part[name])]
                found += [float(finite.min()), float(finite.max())] if finite.size else []
        yield ""
        which = "state" if curve in STATE_CURVES else "scene"
        yield f"{curve}: {number_range(counts.pop('points'))} points per {which}"
        yield from (f"  {word:<30} {number_range(numbers)}" for word, numbers in counts.items())
        for name, found in ends.items():
            yield _extent(dataset[name], found)


def _told(names: Sequence[str]) -> list[str]:
    """List the variables whose extent is told: no flags and counts, and in SI where there is such a variable."""
    return [name for name in names if name not in INTEGERS and f"{name}{SI}" not in names]


def _parts(dataset: xarray.Dataset, names: Sequence[str], cells: int) -> Iterator[Curves]:
    """Give the variables of one curve, some scenes at a time."""
    *shape, longest = dataset[names[0]].shape
    steps = tile(tuple(shape), max(1, cells // max(1, longest)))
    for corner in product(*(range(0, length, step) for length, step in zip(shape, steps, strict=True))):
        block = tuple(slice(start, start + step) for start, step in zip(corner, steps, strict=True))
        yield {name: np.asarray(dataset[name][block].values, dtype=float) for name in names}


def _counts(part: Curves, first: str) -> dict[str, NDArray[np.integer]]:
    """Count the points, branches and jumps of some scenes."""
    counts = {"points": np.count_nonzero(~np.isnan(part[first]), axis=-1)}
    if "stable" in part:
        stable = part["stable"] == 1.0
        counts["stable branches"] = stable[..., 0] + np.count_nonzero(stable[..., 1:] & ~stable[..., :-1], axis=-1)
    if "path_branch" in part:
        ordered = np.sort(np.where(part["path_branch"] > 0.0, part["path_branch"], 0.0), axis=-1)
        counts["branches followed, with rim"] = np.count_nonzero(np.diff(ordered, axis=-1, prepend=0.0), axis=-1)
    if {"path_jump", "path_unloading"} <= part.keys():
        for word, way in (("loading", 0.0), ("unloading", 1.0)):
            jumps = (part["path_jump"] == 1.0) & (part["path_unloading"] == way)
            counts[f"jumps on {word}"] = np.count_nonzero(jumps, axis=-1)
    return {word: np.asarray(numbers) for word, numbers in counts.items()}


def jump_lines(dataset: xarray.Dataset) -> Iterator[str]:
    """Report the jumps of a dataset, if it has them: how many, how large, and where the largest is."""
    if COUNT not in dataset:
        return
    counts = dataset[COUNT].values
    yield ""
    yield f"jumps: {number_range(counts)} per scene, {int(counts.sum()):,} in all"
    if not dataset.sizes.get(JUMP):
        return
    jumps = {str(name): dataset[name] for name in dataset.data_vars if curve_of(str(name)) == "jumps" and name != COUNT}
    for word, is_such in (
        ("on unloading", jumps["jump_unloading"] == 1 if "jump_unloading" in jumps else None),
        ("from or to the rim", jumps["jump_at_rim"] == 1 if "jump_at_rim" in jumps else None),
        ("that gain energy", jumps["jump_energy"] < 0.0 if "jump_energy" in jumps else None),
    ):
        if is_such is not None and is_such.any():
            yield f"  {word:<30} {int(is_such.sum()):,}"
    for name in _told([*jumps]):
        yield _extent(jumps[name], [float(jumps[name].min()), float(jumps[name].max())])
    if "jump_energy" in jumps:
        item = int(jumps["jump_energy"].values.argmax())
        scene = int(np.searchsorted(np.cumsum(counts), item, side="right"))
        varying = [name for name in INPUTS if name in dataset and dataset[name].ndim]
        place = {name: values[scene] for name, values in columns_of(dataset, varying, dataset["status"]).items()}
        yield _largest({name: values[item].item() for name, values in jumps.items()}, place)


def _largest(jump: Mapping[str, float], place: Mapping[str, np.generic]) -> str:
    """Report what is known of the jump that dissipates most."""
    written = [f"  the largest dissipates {jump['jump_energy']:.6g}"]
    if "jump_unloading" in jump:
        written.append("on unloading" if jump["jump_unloading"] == 1 else "on loading")
    if "jump_indentation" in jump:
        written.append(f"at the depth {jump['jump_indentation'] + 0.0:.6g}")
    if {"jump_radius_before", "jump_radius_after"} <= jump.keys():
        written.append(f"from the radius {jump['jump_radius_before']:.6g} to {jump['jump_radius_after']:.6g}")
    return ", ".join([*written, *(f"{name} = {value:g}" for name, value in place.items())])


def _extent(variable: xarray.DataArray, ends: Sequence[float]) -> str:
    """Report between what the values of a variable lie, given the ends of some parts, and what it is."""
    extent = f"{min(ends) + 0.0:.6g} to {max(ends) + 0.0:.6g}" if ends else "no value in any scene"
    unit = str(variable.attrs.get("units", "1"))
    meaning = str(variable.attrs.get("long_name", "of no name")) + ("" if unit == "1" else f", in {unit}")
    return f"  {variable.name!s:<30} {extent:<26} {meaning}"
