"""What the pictures have in common: labels of axes, colours, dashes."""

from contextlib import AbstractContextManager
from typing import Any, Final

import matplotlib.style
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.legend import Legend
from matplotlib.lines import Line2D

from gradhesion.cli.picture import looks

STYLE: Final = (looks.STYLE, "gradhesion.journal")
"""The style of all pictures, and what differs in a column of a journal."""


def styled() -> AbstractContextManager[None]:
    """Draw in this style, whatever the user's own is."""
    return matplotlib.style.context(STYLE, after_reset=True)


RADIUS: Final = "contact radius $a/R$"
DEPTH: Final = r"depth $\delta/R$"
LOAD: Final = r"load $P\,/\,1.5\,\pi R\Delta\gamma$"
FORCE: Final = r"pull-off force $F\,/\,1.5\,\pi R\Delta\gamma$"
ENERGY: Final = r"energy loss $H\,/\,R^2\Delta\gamma$"
WAVELENGTH: Final = r"wavelength $\lambda/R$"
AMPLITUDE: Final = "amplitude $A$"
RIM: Final = r"punch radius $a_{\max}/R$"

DASHES: Final[tuple[Any, ...]] = (
    "-",
    (0, (5, 1.5)),
    (0, (6, 1.5, 1, 1.5)),
    (0, (2.5, 1.2)),
    (0, (1, 1)),
    (0, (6, 1.2, 1, 1.2, 1, 1.2)),
    (0, (9, 2)),
)
"""What distinguishes lines where colours do not print."""

INK: Final = "0.1"
GREY: Final = "0.6"


def shade(share: float) -> Any:
    """Return a colour: 0 is dark, 1 is light, and so they are in grey; the lightest would be lost on white."""
    return colormaps["viridis"](0.86 * share)


def shades(count: int) -> list[Any]:
    """Return colours from dark to light."""
    return [shade(i / max(1, count - 1)) for i in range(count)]


def zero_lines(axes: Axes, *, upright: bool = False) -> None:
    """Mark where the ordinate is zero, and the abscissa."""
    axes.axhline(0.0, color="0.8", lw=0.5, zorder=0)
    if upright:
        axes.axvline(0.0, color="0.8", lw=0.5, zorder=0)


def legend(axes: Axes, **looks: Any) -> Legend:
    """Put a legend on white, so that no zero line runs through its words."""
    return axes.legend(frameon=True, facecolor="white", edgecolor="none", framealpha=1.0, borderpad=0.2, **looks)


def key(label: str, **looks: Any) -> Line2D:
    """Return an entry of a legend."""
    return Line2D([], [], label=label, **looks)
