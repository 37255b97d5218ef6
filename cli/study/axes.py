"""The values that a parameter expands to, and what is wrong with those of all parameters together."""

import math
from collections.abc import Iterator, Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.names import table_of, unit_of
from gradhesion.cli.study.mistakes import Mistake
from gradhesion.cli.study.places import Path
from gradhesion.cli.study.wording import shown

Values = float | NDArray[np.float64]
"""The values of a parameter: a float is fixed, an array is an axis."""

MOST_VALUES: Final = 10_000_000
"""Values of one axis: it is held in memory, and so are its kin."""

MOST_SCENES: Final = 2**31
"""Scenes of one study: beyond it a dataset can no longer be handled as one file."""


def expanded(entry: Any) -> Values:
    """
    Expand a valid parameter of a study; a range begins and ends at exactly its `start` and `stop`.

    >>> expanded(0.3)
    0.3
    >>> expanded({"start": 0.01, "stop": 1.0, "num": 3, "spacing": "log"})
    array([0.01, 0.1 , 1.  ])
    """
    if isinstance(entry, Mapping):
        start, stop = float(entry["start"]), float(entry["stop"])
        space = np.geomspace if entry.get("spacing") == "log" else np.linspace
        values = np.clip(space(start, stop, entry["num"]), min(start, stop), max(start, stop))
        values[0], values[-1] = start, stop
        return values + 0.0  # no negative zeros
    if isinstance(entry, list):
        return np.array(entry, dtype=np.float64) + 0.0
    return float(entry) + 0.0


def mistake_of_range(path: Path, written: Any, entry: Any) -> Mistake | None:
    """Check that a range makes sense as a whole, and that an axis can be held in memory."""
    if isinstance(entry, list) and len(entry) > MOST_VALUES:
        return Mistake(path, written, f"more than {MOST_VALUES:,} values in one list; split the study")
    if not isinstance(entry, Mapping):
        return None
    start, stop, num = entry["start"], entry["stop"], entry["num"]
    if num > MOST_VALUES:
        return Mistake((*path, "num"), num, f"more than {MOST_VALUES:,} values in one axis; split the study")
    if num == 1 and start != stop:
        sentence = "one value cannot be at both start and stop; use num = 2 or more, or a list of one value"
        return Mistake((*path, "num"), num, sentence)
    if num > 1 and start == stop:
        value = shown(written["start"])
        sentence = f"start and stop are the same, so the value {value} repeats; write [{value}] or another stop"
        return Mistake(path, written, sentence)
    if entry.get("spacing") == "log" and min(start, stop) <= 0:
        end = "start" if start <= 0 else "stop"
        return Mistake((*path, end), written[end], 'log spacing needs values > 0; raise it, or use spacing = "linear"')
    return None


def mistakes_of_grid(axes: Mapping[str, Values]) -> Iterator[Mistake]:
    """Check the axes of a grid: no value twice, no impossible material, and a size that can be done."""
    for name, values in axes.items():
        if isinstance(values, np.ndarray):
            unique, counts = np.unique(values, return_counts=True)
            if np.any(counts > 1):
                value = float(unique[np.argmax(counts > 1)])
                places = np.flatnonzero(values == value)[:2].tolist()
                unit = "" if unit_of(name) == "1" else f" {unit_of(name)}"
                items = f"items {places[0]} and {places[1]}"
                sentence = f"the axis repeats the value {shown(value)}{unit} ({items}); remove one"
                yield Mistake((table_of(name), name), values.tolist()[:9], sentence)
    if {"k", "nu"} <= axes.keys() and np.any(axes["k"] == 1.0):
        others = np.atleast_1d(axes["nu"])
        others = others[others != 0.5]
        if others.size:
            sentence = f"with k = 1 and nu = {others[0]} the surface has no stiffness; use nu = 0.5, or k below 1"
            yield Mistake(("parameters", "k"), 1.0, sentence)
    scenes = math.prod(np.size(values) for values in axes.values())
    if scenes > MOST_SCENES:
        sentence = f"the axes make {scenes:,} scenes, more than {MOST_SCENES:,}; use fewer values, or split the study"
        yield Mistake(("parameters",), None, sentence)


def mistakes_of_points(lists: Mapping[str, Values]) -> Iterator[Mistake]:
    """Check the lists of points: one length, and no impossible material in any scene."""
    lengths = {name: values.size for name, values in lists.items() if isinstance(values, np.ndarray)}
    first = next(iter(lengths), "")
    for name, length in lengths.items():
        if length != lengths[first]:
            sentence = (
                f"it has {length} values, but {first} has {lengths[first]}; "
                'with layout = "points" all lists have one length (a single number serves all scenes)'
            )
            yield Mistake((table_of(name), name), np.asarray(lists[name]).tolist()[:9], sentence)
    if {"k", "nu"} <= lists.keys() and len({lengths[name] for name in ("k", "nu") if name in lengths}) <= 1:
        k, nu = np.broadcast_arrays(np.atleast_1d(lists["k"]), np.atleast_1d(lists["nu"]))
        scenes = np.flatnonzero((k == 1.0) & (nu != 0.5))
        if scenes.size:
            scene = int(scenes[0])
            more = f" (and {scenes.size - 1} more)" if scenes.size > 1 else ""
            sentence = (
                f"with k = 1 and nu = {nu[scene]} in scene {scene}{more}, counted from 0, the surface has no "
                "stiffness; use nu = 0.5 there, or k below 1"
            )
            yield Mistake(("parameters", "k"), 1.0, sentence)
