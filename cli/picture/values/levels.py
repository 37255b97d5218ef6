"""The levels that all panels of a variable share: contours, the values that lines go over, and their limits."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from matplotlib.colors import BoundaryNorm, LogNorm, Normalize
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.picture.looks import PLAIN, Looks
from gradhesion.core.answers.flags import FLAGS

Values = NDArray[np.float64]

FAR: Final = 50.0
"""The ratio of the greatest value to the least from which lines are drawn over a logarithm."""

FLAT: Final = 1e-9
"""Values that differ by less, over their size, are drawn as equal: what is left is rounding."""

_STEPS = (
    (30, (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0)),
    (1e3, (1.0, 1.5, 2.0, 3.0, 5.0, 7.0)),
    (1e5, (1.0, 2.0, 5.0)),
)
"""Levels in a decade, for values that differ by less than each factor."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Levels:
    """The contour levels that all panels of a variable share."""

    levels: Values
    norm: Normalize
    extremes: tuple[float, float]
    """The least and the greatest of the values."""
    names: tuple[str, ...] = ()
    """What 0, 1, 2, ... stand for, where values are no more than that."""
    looks: Looks = PLAIN
    requested: bool = False
    """Whether a user has listed the levels; the ends may then be those of the values."""
    limits: tuple[float, float] = (-np.inf, np.inf)
    """Between which values lines and points are drawn; all of them where they are infinite."""

    @property
    def log(self) -> bool:
        """Report whether lines and points are drawn over a logarithm."""
        return not self.names and self.extremes[0] > 0 and self.extremes[1] >= FAR * self.extremes[0]

    def inner(self) -> Values:
        """Choose the levels that have lines."""
        inner = self.levels[1:-1]
        if self.requested:
            return np.array([level for level in self.levels if level in self._listed()])
        return inner[1::2] if inner.size > 5 else inner  # the others show as edges of the bands

    def ticks(self, room: int) -> Values:
        """Choose the levels that have numbers at a colour bar with room for so many."""
        own = self.inner() if self.requested else self.levels
        return own[:: max(1, -(-own.size // max(1, room)))]

    def _listed(self) -> tuple[float, ...]:
        return self.looks.levels if isinstance(self.looks.levels, tuple) else ()


def levels_of(least: float, greatest: float, *, whole: bool = False, looks: Looks = PLAIN) -> Levels:
    """
    Choose round contour levels between two values, rising by ratios where they differ much; whole ones for numbers.

    Those that are listed are taken as they are, with the ends of the values beyond them.

    >>> levels_of(1.0, 2.0).levels
    array([1. , 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9, 2. ])
    """
    extremes = least, greatest
    if isinstance(looks.levels, tuple):
        listed = np.array(looks.levels)
        if not ((listed >= least) & (listed <= greatest)).any():
            written = ",".join(f"{level:g}" for level in listed)
            raise DatasetError(
                f"--levels {written}: none is among the values, which are {least:.4g} to {greatest:.4g}; choose "
                "some between"
            )
        levels = np.unique(np.concatenate([listed, [least, greatest]]))
        norm = (LogNorm if levels[0] > 0 and levels[-1] > 8 * levels[0] else Normalize)(levels[0], levels[-1])
        return Levels(levels=levels, norm=norm, extremes=extremes, looks=looks, requested=True)
    if greatest - least <= FLAT * max(abs(least), abs(greatest)):
        pad = 0.05 * max(abs(least), 1e-300)
        least, greatest = least - pad, greatest + pad
    log = least > 0 and greatest > 8 * least
    if log:
        decades = range(int(np.floor(np.log10(least))), int(np.ceil(np.log10(greatest))) + 1)
        steps = next((steps for most, steps in _STEPS if greatest < most * least), (1.0,))
        rising = np.array([step * 10.0**decade for decade in decades for step in steps])
    else:
        rising = np.asarray(MaxNLocator(looks.levels or 11, steps=[1, 2, 2.5, 5, 10]).tick_values(least, greatest))
    if whole:
        rising = np.unique(np.append(np.round(rising), np.ceil(greatest) + 1.0))
    first = max(0, int(np.searchsorted(rising, least, side="right")) - 1)
    levels = rising[first : int(np.searchsorted(rising, greatest)) + 1]
    if looks.levels and levels.size > looks.levels + 1:  # ratios have steps of their own
        kept = np.unique(np.round(np.linspace(0, levels.size - 1, max(2, looks.levels + 1))).astype(int))
        levels = levels[kept]
    norm = (LogNorm if log else Normalize)(levels[0], levels[-1])
    return Levels(levels=levels, norm=norm, extremes=extremes, looks=looks)


def limited(levels: Levels, values: Values, name: str) -> Levels:
    """Give lines and points the limits that are chosen; scale and unit then suit what is between them."""
    span = levels.looks.ylim
    if levels.names:
        levels.looks.refuse(["ylim"], f"{name} is drawn as categories")
        return levels
    least, greatest = float(values.min()), float(values.max())
    low, high = span.within(name, *((least, greatest) if least < greatest else levels.levels[[0, -1]].tolist()))
    extremes = (low if np.isfinite(low) else least, high if np.isfinite(high) else greatest)
    return replace(levels, extremes=extremes, limits=(low, high))


def levels_of_flags(codes: Values, looks: Looks = PLAIN) -> Levels:
    """Give each code of a status a level of its own, named by its flags; values are to be places among the codes."""
    names = []
    for code in codes:
        flags = [name.replace("_", " ") for name, bit in FLAGS.items() if int(code) & bit]
        names.append("\n+ ".join(flags) or "nothing to report")
    return levels_of_names(names, looks)


def levels_of_names(names: Sequence[str], looks: Looks = PLAIN) -> Levels:
    """Give each of some names a level of its own; values are to be places among them."""
    edges: Values = np.arange(len(names) + 1, dtype=np.float64) - 0.5
    norm = BoundaryNorm(edges, looks.colours.N)
    return Levels(levels=edges, norm=norm, extremes=(0.0, len(names) - 1.0), names=tuple(names), looks=looks)
