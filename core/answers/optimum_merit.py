"""The merit to be maximised, for many cells at once; when one is better than another, and where it is feasible."""

from collections.abc import Callable
from typing import Any, Final, Protocol

import numpy as np
from scipy.optimize.elementwise import find_root

from gradhesion.core.types import Floats, Integers

CLOSE: Final = 1e-9
"""Relative difference by which a merit is better than another."""
WIDTH: Final = 1e-12
"""Width to which a peak is bracketed, in parts of its range."""


class Merit(Protocol):
    """The merit to be maximised, of cells that differ in the inputs that are not searched."""

    def values(self, places: Floats, cells: Integers) -> tuple[Floats, Floats]:
        """Return merits, and margins that are not negative where all requirements are met.

        Parameters
        ----------
        places
            Of shape (inputs, *shape), each from 0 to 1.
        cells
            The numbers of the cells; broadcast to `shape`.

        Returns
        -------
        Two arrays of shape `shape`; merits are NaN where there is no value.
        """

    def slopes(self, places: Floats, cells: Integers) -> Floats | None:
        """Return the slopes of merits to the searched inputs, as `places`; None if they are not known."""


def heights_of(merits: Floats, margins: Floats) -> Floats:
    """Return merits of any shape, -inf where they have no value or a margin is negative."""
    return np.where((margins >= 0.0) & ~np.isnan(merits), merits, -np.inf)


def heights_at(merit: Merit, places: Floats, cells: Any) -> Floats:
    """Return the merits of feasible places, -inf elsewhere; arguments as of `Merit.values`, cells also as floats."""
    return heights_of(*merit.values(places, np.asarray(cells).astype(np.int64)))


def edge_of(height: Callable[..., Floats], inside: Any, outside: Any, args: tuple[Floats, ...], width: float) -> Floats:
    """Return the last finite places of a height between feasible and infeasible ones, all of shape (n,) or numbers."""
    tolerances = {"xatol": width, "xrtol": 0.0, "fatol": 0.0}
    found = find_root(
        lambda *at: np.where(np.isfinite(height(*at)), 1.0, -1.0), (inside, outside), args=args, tolerances=tolerances
    )
    (one, other), (side_of_one, _) = found.bracket, found.f_bracket
    return np.where(side_of_one > 0.0, one, other)
