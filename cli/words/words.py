"""A dataset in words: its axes, its extremes and where they are, its failures, its origin."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.reader import has_curves, tiling_of
from gradhesion.cli.dataset.read.sensitivities import parts_of
from gradhesion.cli.names.outputs import ON_BOUND
from gradhesion.cli.names.scenes import IDLE, REALISATION, SCENE, SOLVER
from gradhesion.cli.study.shape_words import control_in_words
from gradhesion.cli.terminal.amounts import bytes_in_words, counted, percent
from gradhesion.cli.words.curve_words import curve_lines
from gradhesion.cli.words.optimum_words import bound_lines, point_lines
from gradhesion.cli.words.sensitivity_words import sensitivity_lines
from gradhesion.cli.words.uncertainty_words import uncertainty_lines
from gradhesion.cli.words.validity_words import validity_lines
from gradhesion.cli.words.value_words import is_of_one_scene, value_lines
from gradhesion.core import FAILED
from gradhesion.core.answers.flags import FLAG_WORDS, FLAGS
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.inputs import INPUTS

FEW: Final = 8
"""Values of an axis that are listed one by one."""


def described(dataset: xarray.Dataset, file: Path) -> Iterator[str]:
    """Report what a dataset holds, line by line."""
    yield dataset.attrs["title"]
    yield f"{file}: {counted(dataset['status'].size, 'scene')}, {bytes_in_words(file.stat().st_size)}"
    if "profile" in dataset.attrs:
        yield ""
        yield f"profile: {dataset.attrs['profile']}"
        yield from _fit(dataset)
        yield f"control: {control_in_words(Loading(control=dataset.attrs.get('control', 'displacement')))}"
        yield from (f"{law}: {dataset.attrs[law]}" for law in ("toughness", "rate") if law in dataset.attrs)
    yield from _parameters(dataset)
    yield from uncertainty_lines(dataset)
    yield from point_lines(dataset)
    if has_curves(dataset):
        yield from curve_lines(dataset)
    else:
        yield from _outputs(dataset)
        yield from value_lines(dataset, _varying(dataset))
    yield from _status(dataset)
    if beyond := list(validity_lines(dataset)):
        yield ""
        yield "outside the range of the model"
        yield from beyond
    yield from _origin(dataset)


def _fit(dataset: xarray.Dataset) -> Iterator[str]:
    """Tell which file a profile was fitted to, and how well."""
    if "profile_residual_rms" in dataset.attrs:
        rms, most = (1e9 * float(dataset.attrs[f"profile_residual_{name}"]) for name in ("rms", "max"))
        file = dataset.attrs.get("profile_file", "a file")
        yield f"  fitted to {file}: residual {rms:.3g} nm rms, {most:.3g} nm at most"


def _coordinates(dataset: xarray.Dataset | xarray.DataArray) -> list[str]:
    """List what distinguishes scenes: the solver, and the parameters."""
    return [name for name in (SOLVER, *INPUTS, REALISATION) if name in dataset.coords]


def _varying(dataset: xarray.Dataset | xarray.DataArray) -> list[str]:
    """List those that differ from scene to scene, without what follows from axes."""
    return [
        name for name in _coordinates(dataset) if dataset[name].ndim and (name in dataset.dims or SCENE in dataset.dims)
    ]


def _parameters(dataset: xarray.Dataset) -> Iterator[str]:
    """Report the values of the parameters: axes first, then fixed ones, then what follows from them."""
    points = SCENE in dataset.dims
    known = [name for name in _coordinates(dataset) if name != SOLVER]
    varying = [name for name in _varying(dataset) if name != SOLVER]
    if SOLVER in dataset.dims:
        yield ""
        yield "solvers, each for all scenes: " + ", ".join(dataset[SOLVER].values)
    yield ""
    yield "points: one scene for each item of" if points else "axes"
    for name in varying:
        values = dataset[name].values
        unit = _unit(dataset[name])
        if values.size <= FEW:
            written = ", ".join(f"{value:g}" for value in values) + unit
        else:
            written = f"{values.size:,} values from {np.nanmin(values):g} to {np.nanmax(values):g}{unit}"
            written += "" if points else f", {_spacing(values)}"
        yield f"  {name:<17} {written}"
    if not varying:
        yield "  none: a single scene"
    fixed = [name for name in known if dataset[name].ndim == 0]
    if fixed:
        yield ""
        yield "fixed"
        for name in fixed:
            yield f"  {name:<17} {dataset[name].item():g}{_unit(dataset[name])}{_remark(dataset[name])}"
    following = [name for name in known if name not in (*varying, *fixed)]
    if following:
        yield ""
        yield "following from these"
    for name in following:
        extremes = [f"{value:g}" for value, _ in _extremes(dataset[name])]
        yield f"  {name:<17} {' to '.join(extremes) or 'no finite value in any scene'}"


def _unit(variable: xarray.DataArray, before: str = " ") -> str:
    """Give the unit of a variable, nothing if it has none."""
    unit = str(variable.attrs.get("units", "1"))
    return "" if unit == "1" else before + unit


def _remark(variable: xarray.DataArray) -> str:
    """Say of a parameter that is there for completeness that it has no effect."""
    comment = str(variable.attrs.get("comment", "")).partition(";")[0]
    return f"  ({comment})" if comment.startswith(IDLE) else ""


def _number(value: float | str) -> str:
    """Write a value of a coordinate."""
    return value if isinstance(value, str) else f"{value:g}"


def _spacing(values: NDArray[np.float64]) -> str:
    """
    Report how the values of an axis are spaced, inf apart.

    >>> _spacing(np.array([0.01, 0.1, 1.0, np.inf]))
    'log-spaced'
    >>> _spacing(np.array([0.0, 0.1, 0.2]))
    'evenly spaced'
    """
    finite = np.sort(values[np.isfinite(values)])
    if finite.size < 3:
        return "listed"
    steps = np.diff(finite)
    if np.ptp(steps) <= 1e-6 * np.max(steps):
        return "evenly spaced"
    if finite[0] > 0 and np.ptp(np.diff(np.log(finite))) <= 1e-6 * np.log(finite[-1] / finite[0]):
        return "log-spaced"
    return "listed"


def _outputs(dataset: xarray.Dataset) -> Iterator[str]:
    """Report the extremes of each output, and where they are; of a single scene they are values."""
    for name in dataset.data_vars:
        if name == "status" or is_of_one_scene(dataset, str(name)):
            continue
        yield ""
        yield f"{name}: {dataset[name].attrs.get('long_name', 'without a name')}{_unit(dataset[name], ', in ')}"
        if name == ON_BOUND:
            yield from bound_lines(dataset[name])
            continue
        if parts_of(dataset, str(name)):
            yield from sensitivity_lines(dataset[name], str(name))
            continue
        extremes = _extremes(dataset[name])
        if not extremes:
            yield "  no value in any scene"
        for word, (extreme, place) in zip(("min", "max"), extremes, strict=False):
            where = ", ".join(f"{key} = {_number(value)}" for key, value in place.items())
            yield f"  {word:<9} {extreme:<12.7g}" + (f" at {where}" if where else "")


def _extremes(variable: xarray.DataArray) -> list[tuple[float, dict[str, float | str]]]:
    """Find the least and the greatest value of a variable with their places, a block at a time."""
    found: list[tuple[float, dict[str, float | str]]] = []
    for block in tiling_of(variable):
        part = variable[block]
        values = np.asarray(part.values, dtype=float)
        if not np.any(np.isfinite(values)):
            continue
        for i, (position, better) in enumerate(((np.nanargmin(values), np.less), (np.nanargmax(values), np.greater))):
            index = np.unravel_index(position, values.shape)
            value = float(values[index])
            if len(found) < 2 or better(value, found[i][0]):
                found[i : i + 1] = [(value, _place(part, index))]
    return found


def _place(part: xarray.DataArray, index: tuple[Any, ...]) -> dict[str, float | str]:
    """Report the solver and the varying parameters of a cell."""
    cell = part[index]
    return {name: cell[name].item() for name in _varying(part)}


def _status(dataset: xarray.Dataset) -> Iterator[str]:
    """Report how many scenes have failed, and what the others report."""
    counts = dict.fromkeys(FLAGS, 0)
    failed = 0
    for block in tiling_of(dataset["status"]):
        status: NDArray[np.int16] = dataset["status"][block].values.astype(np.int16)
        failed += int(np.count_nonzero(status & FAILED))
        for name, bit in FLAGS.items():
            counts[name] += int(np.count_nonzero(status & bit))
    scenes = dataset["status"].size
    yield ""
    yield f"status: {scenes - failed:,} of {counted(scenes, 'scene')} ({(scenes - failed) / scenes:.1%}) have values"
    for name, count in counts.items():
        if count:
            share = f"{count:,} of {counted(scenes, 'scene')} ({percent(count, scenes)})"
            yield f"  {name:<30} {share:<26} {FLAG_WORDS[name]}"


def _origin(dataset: xarray.Dataset) -> Iterator[str]:
    """Report where a dataset comes from."""
    attributes = dataset.attrs
    named = ("python", "numpy", "numba", "scipy")
    versions = ", ".join(f"{name} {attributes.get(f'{name}_version', 'unknown')}" for name in named)
    yield ""
    yield "origin"
    yield f"  {attributes['source']} ({versions})"
    yield from (f"  {line}" for line in str(attributes.get("history", "")).splitlines())
    if "study_sha256" in attributes:
        yield f"  study with sha256 {attributes['study_sha256']}"
