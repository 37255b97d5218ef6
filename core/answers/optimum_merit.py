"""The merit to be maximised, for many cells at once, and when one merit is better than another."""

from typing import Final, Protocol

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
