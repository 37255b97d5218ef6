"""The jumps of a curve study: summarised, and listed one by one."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.curves import EXTENTS, INTEGERS, RAGGED, curve_of, variables_of_curves
from gradhesion.core.problem.inputs import INPUTS

ITEMS: Final = 2**16
"""Jumps that are read at a time."""

COUNT: Final = RAGGED["jumps"]
JUMP: Final = EXTENTS["jumps"]

Piece = dict[str, NDArray[Any]]


def jump_lines(dataset: xarray.Dataset, items: int = ITEMS) -> Iterator[str]:
    """Report the jumps of a dataset, if it has them: how many, how large, and where the largest is."""
    if COUNT not in dataset:
        return
    counts = dataset[COUNT].values
    least, greatest = int(counts.min()), int(counts.max())
    each = f"{least:,}" if least == greatest else f"{least:,} to {greatest:,}"
    yield ""
    yield f"jumps: {each} per scene, {int(counts.sum()):,} in all"
    numbers = dict.fromkeys(("on unloading", "from or to the rim", "that gain energy"), 0)
    ends: dict[str, tuple[float, float]] = {}
    largest: dict[str, Any] = {}
    for piece in _pieces(dataset, items):
        if not all(values.size for values in piece.values()):
            break
        for word, flags in (
            ("on unloading", piece.get("jump_unloading", np.empty(0)) == 1),
            ("from or to the rim", piece.get("jump_at_rim", np.empty(0)) == 1),
            ("that gain energy", piece.get("jump_energy", np.empty(0)) < 0.0),
        ):
            numbers[word] += int(np.count_nonzero(flags))
        for name in [name for name in piece if curve_of(name) == "jumps" and name not in INTEGERS]:
            low, high = ends.get(name, (np.inf, -np.inf))
            ends[name] = min(low, float(piece[name].min())), max(high, float(piece[name].max()))
        if "jump_energy" in piece:
            item = int(np.argmax(piece["jump_energy"]))
            if not largest or piece["jump_energy"][item] > largest["jump_energy"]:
                largest = {name: values[item].item() for name, values in piece.items()}
    yield from (f"  {word:<30} {number:,}" for word, number in numbers.items() if number)
    for name, (low, high) in ends.items():
        yield f"  {name:<30} {f'{low + 0.0:.6g} to {high + 0.0:.6g}':<26} {meaning_of(dataset[name])}"
    if largest:
        yield f"  the largest dissipates {largest['jump_energy']:.6g}{_where(largest)}"


def jumps_listed(dataset: xarray.Dataset, file: Path, items: int = ITEMS) -> Iterator[str]:
    """List every jump of a dataset as CSV, some lines at a time: the parameters that vary, and what is known of it."""
    if JUMP not in dataset.dims:
        raise DatasetError(f'{file}: has no jumps; add "jumps" to the outputs of a study of kind "curve" and run it')
    for number, piece in enumerate(_pieces(dataset, items)):
        if number == 0:
            yield ",".join(piece)
        rows = zip(*(values.tolist() for values in piece.values()), strict=True)
        lines = "\n".join(",".join(map(repr, row)) for row in rows)
        if lines:
            yield lines


def meaning_of(variable: xarray.DataArray) -> str:
    """Give the long name of a variable, with its unit if it has one."""
    unit = variable.attrs.get("units", "1")
    return str(variable.attrs.get("long_name", "of no name")) + ("" if unit == "1" else f", in {unit}")


def _pieces(dataset: xarray.Dataset, items: int) -> Iterator[Piece]:
    """Read some jumps at a time, none if there is none: the parameters that vary, and the variables of each jump."""
    status = dataset["status"]
    counts = dataset[COUNT].values.ravel()
    scenes = {
        name: dataset[name].broadcast_like(status).transpose(*status.dims).values.ravel()
        for name in INPUTS
        if name in dataset and dataset[name].ndim
    }
    own = [name for name in variables_of_curves(dataset)["jumps"] if name != COUNT]
    ends = np.cumsum(counts, dtype=np.int64)
    total = int(ends[-1]) if own else 0
    for start in range(0, max(1, total), items):
        stop = min(start + items, total)
        scene = np.searchsorted(ends, np.arange(start, stop), side="right")
        yield {name: values[scene] for name, values in scenes.items()} | {
            name: dataset[name][start:stop].values for name in own
        }


def _where(jump: dict[str, Any]) -> str:
    """Report what is known of a jump but its energy."""
    written = []
    if "jump_unloading" in jump:
        written.append("on unloading" if jump["jump_unloading"] == 1 else "on loading")
    if "jump_indentation" in jump:
        written.append(f"at the depth {jump['jump_indentation'] + 0.0:.6g}")
    if {"jump_radius_before", "jump_radius_after"} <= jump.keys():
        written.append(f"from the radius {jump['jump_radius_before']:.6g} to {jump['jump_radius_after']:.6g}")
    written += [f"{name} = {jump[name]:g}" for name in INPUTS if name in jump]
    return ", " + ", ".join(written) if written else ""
