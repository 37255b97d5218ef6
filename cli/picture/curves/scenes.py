"""The scenes of a dataset of curves that go into one picture, and what they have in common."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
import xarray
from matplotlib.colors import to_rgb

from gradhesion.cli.dataset.read.model_range import slope_warnings
from gradhesion.cli.names.curves import RAGGED, STATE_CURVES, variables_of_curves
from gradhesion.cli.names.scenes import SCENE
from gradhesion.cli.picture.curves.panels import Colour, Values
from gradhesion.cli.picture.doubts import CROSS, Doubt, doubts_in
from gradhesion.cli.picture.labels import effective, equation, given
from gradhesion.cli.picture.looks import Looks
from gradhesion.cli.picture.pictured import finite

SCENES: Final = 5
"""Scenes in one picture: more could not be distinguished."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Scene:
    """One scene of a dataset."""

    label: str
    colour: Colour | None
    """The colour of all its lines (None: each line has its own)."""
    values: Mapping[str, Values]
    """Its curves without padding."""
    doubts: Sequence[Doubt]
    """What makes its path doubtful."""
    item: int = 0
    """Which of the scenes it is."""


def scenes_of(dataset: xarray.Dataset, looks: Looks) -> tuple[list[Scene], list[str]]:
    """Choose the scenes to draw, along the last axis with more than one value, and write what they have in common."""
    axes = [str(axis) for axis, size in dataset["status"].sizes.items() if size > 1]
    last = axes[-1] if axes else None
    first = dataset.isel({axis: 0 for axis in dataset["status"].dims if axis != last})
    if last is None:
        return [_scene(first, "", None)], _caption(dataset, axes)
    size = dataset.sizes[last]
    items = sorted({round(item) for item in np.linspace(0, size - 1, min(size, SCENES))})
    scenes = []
    for place, item in enumerate(items):
        scene = first.isel({last: item})
        varying = [last] if last != SCENE else _varying(dataset)
        label = ", ".join(equation(name, scene[name].item()) for name in varying[:2]) or f"scene {item}"
        scenes.append(_scene(scene, label, to_rgb(looks.colours(0.75 * place / (len(items) - 1))), place))
    return scenes, _caption(dataset, axes)


def _scene(scene: xarray.Dataset, label: str, colour: Colour | None, item: int = 0) -> Scene:
    """Make a scene; one that has no value is grey and says so."""
    values = _trimmed(scene)
    if label and not any(row.size for row in values.values()):
        label, colour = f"{label} (no value)", to_rgb(CROSS)
    return Scene(label=label, colour=colour, values=values, doubts=doubts_in(scene["status"].values, "path"), item=item)


def _varying(dataset: xarray.Dataset) -> list[str]:
    """List the parameters that vary between points."""
    return [name for name in given(dataset.coords) if np.unique(dataset[name].values).size > 1]


def _caption(dataset: xarray.Dataset, axes: Sequence[str]) -> list[str]:
    """Write the parameters that are the same in all scenes drawn."""
    written = []
    for name in effective(dataset):
        values = np.unique(dataset[name].values)
        if values.size == 1:
            written.append(equation(name, values[0]))
        elif name in axes[:-1]:
            written.append(f"{equation(name, dataset[name].values[0])} (first of {values.size})")
    if axes and dataset.sizes[axes[-1]] > SCENES:
        written.append(f"{SCENES} of {dataset.sizes[axes[-1]]} scenes")
    return [*written, *slope_warnings(dataset)]


def _trimmed(scene: xarray.Dataset) -> dict[str, Values]:
    """Take the curves of a scene without their padding."""
    curves: dict[str, Values] = {}
    for curve, own in variables_of_curves(scene).items():
        if curve in (*RAGGED, *STATE_CURVES):
            continue
        rows = {name: finite(scene[name].values) for name in own}
        points = np.flatnonzero(np.any([~np.isnan(row) for row in rows.values()], axis=0))
        curves |= {name: row[: int(points[-1]) + 1 if points.size else 0] for name, row in rows.items()}
    return curves
