"""Optima of a merit over one or more searched inputs, for many cells at once.

The search is global to a stated resolution: a sweep over all searched inputs finds the basins (optimum_basins.py), and
each that can hold the optimum is refined between the neighbours of its highest point (optimum_one_input.py,
optimum_many_inputs.py). Merits are smooth but for kinks.

Here each searched input runs from 0 to 1 over its range.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from gradhesion.core.answers.optimum_basins import basins_of, is_new
from gradhesion.core.answers.optimum_many_inputs import refine_many
from gradhesion.core.answers.optimum_merit import CLOSE, Merit, heights_of
from gradhesion.core.answers.optimum_one_input import peaks_between, refine_one
from gradhesion.core.types import Floats, Truths

SCENES: Final = 2**18
"""Number of scenes evaluated at a time in a sweep."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Optima:
    """The optimum of each cell."""

    places: Floats
    """From 0 to 1; shape (inputs, cells). NaN where nothing is feasible."""
    merits: Floats
    too_coarse: Truths
    """Whether the sweep at the stated resolution, half of that computed, misses the basin, as it does where a peak was
    found between the points of the finer one."""


def axis_of(resolution: int) -> Floats:
    """Return the places of a sweep at twice a resolution: those of the resolution are every second.

    Examples
    --------
    >>> axis_of(3).tolist()
    [0.0, 0.25, 0.5, 0.75, 1.0]
    """
    return np.linspace(0.0, 1.0, 2 * resolution - 1)


def sweep(merit: Merit, inputs: int, cells: int, resolution: int) -> tuple[Floats, Floats]:
    """Return merits and margins at all places of `axis_of` for all cells, of shape (*places, cells)."""
    axis = axis_of(resolution)
    shape = (axis.size,) * inputs
    total = axis.size**inputs
    merits, margins = np.empty((total, cells)), np.empty((total, cells))
    step = max(1, SCENES // cells)
    for start in range(0, total, step):
        numbers = np.arange(start, min(total, start + step))
        places = axis[np.array(np.unravel_index(numbers, shape))][..., None]
        merits[numbers], margins[numbers] = merit.values(places, np.arange(cells))
    return merits.reshape(*shape, cells), margins.reshape(*shape, cells)


def optima_of(merit: Merit, merits: Floats, margins: Floats) -> Optima:
    """Return the optimum of each cell from a computed sweep.

    Parameters
    ----------
    merit
        The merit to be maximised.
    merits, margins
        Those of `sweep` at a resolution of 3 or more. It has twice as many points, which show basins between those of
        the resolution.

    Returns
    -------
    Places to 1e-12 of their ranges where the peak is a kink, or where exact slopes are known; else to some 1e-8, where
    the merit is within rounding of its peak. Peaks narrower than half a spacing may be missed.
    """
    inputs, cells = merits.ndim - 1, merits.shape[-1]
    heights = heights_of(merits, margins)
    basins, promised = basins_of(heights)
    if inputs == 1:
        places, found = refine_one(merit, heights, basins)
    else:
        places, found = refine_many(merit, heights, basins, promised, constrained=bool((margins < 0.0).any()))
    best = np.full(cells, -np.inf)
    where = np.full((inputs, cells), np.nan)
    order = np.argsort(found, kind="stable")  # the best of a cell last
    order = order[np.isfinite(found[order])]
    own = basins[-1][order]
    best[own], where[:, own] = found[order], places[:, order]
    too_coarse = is_new(heights, where)
    if inputs == 1:
        for cell, place, height in zip(*peaks_between(merit, heights, best, where[0]), strict=True):
            if height > best[cell] + CLOSE * abs(best[cell]):
                best[cell], where[0, cell], too_coarse[cell] = height, place, True
    best = np.where(np.isfinite(best), best, np.nan)
    return Optima(places=where, merits=best, too_coarse=too_coarse)
