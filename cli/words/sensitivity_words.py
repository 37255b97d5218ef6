"""Sensitivities in words: the parameter on which a value depends most, and the sensitivity to each."""

from collections.abc import Iterator

import numpy as np
import xarray

from gradhesion.cli.dataset.read.reader import tiling_of
from gradhesion.cli.dataset.read.sensitivities import strongest
from gradhesion.cli.names.outputs import labels_of


def sensitivity_lines(variable: xarray.DataArray, name: str) -> Iterator[str]:
    """Tell which parameter is the strongest in how many scenes, and between what each sensitivity lies."""
    dimension = labels_of(name)
    labels = [str(label) for label in variable[dimension].values]
    least, greatest = np.full(len(labels), np.inf), np.full(len(labels), -np.inf)
    counts = np.zeros(len(labels), dtype=int)
    whole = {dimension: slice(None)}
    for block in tiling_of(variable.isel({dimension: 0})):
        scenes = [axis for axis in variable.dims if axis != dimension]
        values = variable.isel(dict(zip(scenes, block, strict=True)) | whole).values.reshape(-1, len(labels))
        finite = np.isfinite(values)
        least = np.minimum(least, np.where(finite, values, np.inf).min(axis=0))
        greatest = np.maximum(greatest, np.where(finite, values, -np.inf).max(axis=0))
        place = strongest(values, labels)
        counts += np.bincount(place[place >= 0], minlength=len(labels))
    if not np.any(least <= greatest):
        yield "  no value in any scene"
        return
    total = int(counts.sum())
    order = [i for i in np.argsort(-counts, kind="stable") if counts[i]]
    if total:
        shares = ", ".join(f"{labels[i]} in {counts[i] / total:.3g} of the scenes" for i in order)
        yield f"  strongest: {shares}" if len(order) > 1 else f"  strongest: {labels[order[0]]}"
    for label, low, high in zip(labels, least, greatest, strict=True):
        if low <= high:
            yield f"  {label:<22} {low:.4g}" + (f" to {high:.4g}" if high > low else "")
