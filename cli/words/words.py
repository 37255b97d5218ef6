"""A dataset in words: its axes, its values or their extremes and where they are, its flags, its origin."""

import hashlib
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, Final

import numpy as np
import pandas as pd
import xarray
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.model_range import LIMITS, count_beyond, is_cone
from gradhesion.cli.dataset.read.reader import has_curves, is_fit, tiling_of
from gradhesion.cli.dataset.read.sensitivities import parts_of, strongest
from gradhesion.cli.names.outputs import BEST, ON_BOUND, PARETO_POINT, SI, labels_of
from gradhesion.cli.names.scenes import IDLE, REALISATION, SCENE, SOLVER
from gradhesion.cli.study.shape_words import CONTROLS
from gradhesion.cli.terminal.amounts import bytes_in_words, counted, share_of
from gradhesion.cli.terminal.wording import shown
from gradhesion.cli.words.fit_words import fit_lines, fits_in_short
from gradhesion.cli.words.table import about, columns_of, curve_lines, number_range, told, unit_behind
from gradhesion.core import FAILED
from gradhesion.core.answers.flags import FLAG_WORDS
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.names import CONTACT_SLOPE, PULL_OFF, RESULTS

FEW: Final = 8
"""Values of an axis that are listed one by one."""
MOST: Final = 12
"""Scenes whose values are all told, at most."""
WIDTH: Final = 100
"""Characters of a line of these, at most."""


def described(dataset: xarray.Dataset, file: Path) -> Iterator[str]:
    """Report what a dataset holds, line by line."""
    attributes, status = dataset.attrs, dataset["status"]
    yield attributes["title"]
    what = fits_in_short(dataset) if is_fit(dataset) else counted(status.size, "scene")
    yield f"{file}: {what}, {bytes_in_words(file.stat().st_size)}"
    if "profile" in attributes:
        yield ""
        yield f"profile: {attributes['profile']}"
        if "profile_residual_rms" in attributes:
            rms, most = (1e9 * float(attributes[f"profile_residual_{name}"]) for name in ("rms", "max"))
            source = attributes.get("profile_file", "a file")
            yield f"  fitted to {source}: residual {rms:.3g} nm rms, {most:.3g} nm at most"
        yield f"control: {CONTROLS.get(attributes.get('control', 'displacement'), '')}"
        yield from (f"{law}: {attributes[law]}" for law in ("toughness", "rate") if law in attributes)
    if is_fit(dataset):
        yield from fit_lines(dataset)
    else:
        yield from _parameters(dataset)
        yield from _uncertain_inputs(dataset)
        yield from curve_lines(dataset) if has_curves(dataset) else _outputs(dataset)
        yield from _status_lines(dataset)
    yield from _origin_lines(attributes)


def _status_lines(dataset: xarray.Dataset) -> Iterator[str]:
    """Report how many scenes have values, which flags they have, and which of them leave the range of the model."""
    status, scenes = dataset["status"], dataset["status"].size
    failed = sum(int(np.count_nonzero(status[block].values.astype(np.int16) & FAILED)) for block in tiling_of(status))
    written = f"{scenes - failed:,} of {counted(scenes, 'scene')} ({(scenes - failed) / scenes:.1%})"
    yield from ("", f"status: {written} have values", *_flag_counts(status))
    if not has_curves(dataset) and not any(name in dataset for name in RESULTS if name not in PULL_OFF):
        yield "  whether the contact is one disc was not tested: nothing but the pull-off was asked for"
    cone = {CONTACT_SLOPE: "1 at every radius of a cone"} if is_cone(dataset) else {}
    beyond = [
        told(name, share_of(count, scenes), f"{cone.get(name, limit.condition)}: {limit.words}")
        for name, limit in LIMITS.items()
        if (count := count_beyond(name, dataset))
    ]
    yield from ("", "outside the range of the model", *beyond) if beyond else ()


def _coordinates(dataset: xarray.Dataset | xarray.DataArray) -> list[str]:
    """List what distinguishes scenes: the solver, and the parameters."""
    return [name for name in (SOLVER, *INPUTS, REALISATION) if name in dataset.coords]


def _varying(dataset: xarray.Dataset | xarray.DataArray) -> list[str]:
    """List those that differ from scene to scene, without what follows from axes."""
    points = SCENE in dataset.dims
    return [name for name in _coordinates(dataset) if dataset[name].ndim and (points or name in dataset.dims)]


def _parameters(dataset: xarray.Dataset) -> Iterator[str]:
    """Report the values of the parameters: axes first, then fixed ones, then what follows from them."""
    points = SCENE in dataset.dims
    known = [name for name in _coordinates(dataset) if name != SOLVER]
    varying = [name for name in _varying(dataset) if name != SOLVER]
    fixed = [name for name in known if dataset[name].ndim == 0]
    if SOLVER in dataset.dims:
        yield from ("", "solvers, each for all scenes: " + ", ".join(dataset[SOLVER].values))
    groups = {"points: one scene for each item of" if points else "axes": varying, "fixed": fixed}
    groups["following from these"] = [name for name in known if name not in (*varying, *fixed)]
    for heading, names in groups.items():
        lines = [told(name, _written(dataset[name], points=points), width=17) for name in names]
        yield from ("", heading, *lines) if names else ()


def _written(variable: xarray.DataArray, *, points: bool) -> str:
    """Write the value of a parameter, a few, or between what its values lie."""
    unit, comment = unit_behind(variable), str(variable.attrs.get("comment", "")).partition(";")[0]
    if variable.ndim == 0:
        return f"{variable.item():g}{unit}" + (f"  ({comment})" if comment.startswith(IDLE) else "")
    if not points and variable.dims != (variable.name,):  # it follows from axes
        return " to ".join(f"{value:g}" for value, _ in _extremes(variable)) or "no finite value in any scene"
    values = variable.values
    if values.size <= FEW:
        return ", ".join(f"{value:g}" for value in values) + unit
    span = f"{values.size:,} values from {np.nanmin(values):g} to {np.nanmax(values):g}{unit}"
    return span if points else f"{span}, {_spacing(values)}"


def _spacing(values: NDArray[np.float64]) -> str:
    """Report how the values of an axis are spaced, inf apart.

    >>> _spacing(np.array([0.01, 0.1, 1.0, np.inf])), _spacing(np.array([0.0, 0.1, 0.2]))
    ('log-spaced', 'evenly spaced')
    """
    finite = np.sort(values[np.isfinite(values)])
    ways = {"evenly spaced": finite, "log-spaced": np.log(finite) if finite[:1] > 0 else np.empty(0)}
    even = (how for how, own in ways.items() if own.size > 2 and np.ptp(np.diff(own)) <= 1e-6 * np.ptp(own))
    return next(even, "listed")


def _uncertain_inputs(dataset: xarray.Dataset) -> Iterator[str]:
    """Say which inputs are uncertain, and by how much, as the study has it."""
    table: Any = None
    with suppress(ValueError, RecursionError):
        table = tomllib.loads(str(dataset.attrs.get("study", ""))).get("uncertainty")
    if isinstance(table, Mapping):
        samples = f", {table['samples']:,} samples" if table.get("samples") else ""
        yield from ("", f"uncertain inputs{samples}: standard deviations, or the ends of a uniform distribution")
        yield from (told(name, shown(one), width=17) for name, one in table.items() if name not in ("samples", "seed"))


def _outputs(dataset: xarray.Dataset) -> Iterator[str]:
    """Report each output: all values of few scenes, else the extremes and where they are; in SI, optima in both."""
    names = [str(name) for name in dataset.data_vars if name != "status"]
    names = [name for name in names if name.startswith(BEST) or f"{name}{SI}" not in dataset]  # either may be the goal
    if PARETO_POINT in dataset.dims:
        counts = np.asarray(dataset[names[0]].notnull().sum(PARETO_POINT))
        yield ""
        yield f"Pareto fronts: {number_range(counts)} points per scene"
    status = dataset["status"]
    listed = [name for name in names if dataset[name].dims == status.dims and name != ON_BOUND]
    listed = listed if status.size <= MOST else []
    for name in [name for name in names if name not in listed]:
        yield ""
        yield f"{name}: {about(dataset[name])}"
        if name == ON_BOUND:
            yield from _flag_counts(dataset[name]) or ["  no optimum is at a bound"]
        elif parts_of(dataset, name):
            yield from _sensitivities(dataset[name], name)
        elif extremes := _extremes(dataset[name]):
            for word, (extreme, place) in zip(("min", "max"), extremes, strict=True):
                at = [f"{key} = {one if isinstance(one, str) else f'{one:g}'}" for key, one in place.items()]
                yield f"  {word:<9} {extreme:<12.7g}" + (f" at {', '.join(at)}" if at else "")
        else:
            yield "  no value in any scene"
    if listed:
        yield ""
        yield "values"
        yield from _of_one_scene(dataset, listed) if status.size == 1 else _of_few_scenes(dataset, listed)


def _of_one_scene(dataset: xarray.Dataset, names: Sequence[str]) -> Iterator[str]:
    """Give each output of a single scene a line: its name, its value with its unit, what it is."""
    values = [f"{dataset[name].values.item():.7g}{unit_behind(dataset[name])}" for name in names]
    wide = [max(map(len, each)) for each in (names, values)]
    for name, value in zip(names, values, strict=True):
        yield f"  {name:<{wide[0]}}  {value:<{wide[1]}}  {dataset[name].attrs.get('long_name', 'without a name')}"


def _of_few_scenes(dataset: xarray.Dataset, names: Sequence[str]) -> Iterator[str]:
    """Give each scene a line of what distinguishes it and of its outputs, in several tables if they are many."""
    status = dataset["status"]
    yield from (f"  {name}: {about(dataset[name])}" for name in names)
    yield ""
    varying = [name for name in _varying(dataset) if len({*np.ravel(dataset[name].values)}) > 1]
    flags = ["status"] if status.values.any() else []
    table = pd.DataFrame(columns_of(dataset, [*varying, *names, *flags], status))
    numbers = {name: f"{{:{'g' if name in varying else '.7g'}}}".format for name in table if name != SOLVER}
    text = table.to_string(index=False, formatters=numbers, line_width=WIDTH - 2)
    yield from (f"  {line.rstrip()}" for line in text.replace("\\\n", "\n").splitlines())


def _extremes(variable: xarray.DataArray) -> list[tuple[float, dict[str, float | str]]]:
    """Find the least and the greatest value of a variable with their places, a block at a time."""
    cells: list[xarray.DataArray] = []
    for block in tiling_of(variable):
        part = variable[block]
        values = np.where(np.isfinite(part.values), part.values, np.nan)
        if not np.isnan(values).all():
            places = np.nanargmin(values), np.nanargmax(values)
            cells += [part[np.unravel_index(place, part.shape)] for place in places]
    ends = [min(cells, key=float), max(cells, key=float)] if cells else []
    return [(float(cell), {name: cell[name].item() for name in _varying(variable)}) for cell in ends]


def _sensitivities(variable: xarray.DataArray, name: str) -> Iterator[str]:
    """Tell which parameter is the strongest in how many scenes, and between what each sensitivity lies."""
    labels = [str(label) for label in variable[labels_of(name)].values]
    values = variable.transpose(..., labels_of(name)).values.reshape(-1, len(labels))
    # Of what `select` has reduced signs have decided what is largest.
    place = np.full(len(values), -1) if "reduced" in variable.attrs else strongest(values, labels)
    shares = pd.Series(place[place >= 0]).value_counts(normalize=True)
    if shares.size:
        written = (f"{labels[i]} in {100.0 * share:.3g} % of the scenes" for i, share in shares.items())
        yield f"  strongest: {', '.join(written)}"
    for label, own in zip(labels, values.T, strict=True):
        finite = own[np.isfinite(own)]
        if finite.size:
            low, high = finite.min(), finite.max()
            yield f"  {label:<22} {low:.4g}" + (f" to {high:.4g}" if high > low else "")


def _flag_counts(variable: xarray.DataArray) -> list[str]:
    """Tell of each flag that occurs how many scenes have it, and what it means."""
    masks = np.atleast_1d(variable.attrs["flag_masks"]).astype(int)
    counts = np.zeros(masks.size, int)
    for block in tiling_of(variable):
        values = variable[block].values.astype(int)
        counts += [np.count_nonzero(values & mask) for mask in masks]
    found = zip(str(variable.attrs["flag_meanings"]).split(), counts, strict=True)
    return [told(name, share_of(count, variable.size), FLAG_WORDS.get(name, "")) for name, count in found if count]


def _origin_lines(attributes: Mapping[str, Any]) -> Iterator[str]:
    """Report where a dataset comes from, and whether the study in it was changed since."""
    parts = ("python", "numpy", "numba", "scipy")
    versions = (f"{name} {attributes.get(f'{name}_version', 'unknown')}" for name in parts)
    yield from ("", "origin", f"  {attributes['source']} ({', '.join(versions)})")
    yield from (f"  {line}" for line in str(attributes.get("history", "")).splitlines())
    if "study_sha256" in attributes:
        own = hashlib.sha256(str(attributes.get("study", "")).encode()).hexdigest()
        changed = "" if own == attributes["study_sha256"] else "; its text was changed since"
        yield f"  study with sha256 {attributes['study_sha256']}{changed}"
