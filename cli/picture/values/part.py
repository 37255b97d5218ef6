"""What is drawn of one variable, as the figure around it needs it, and the legends of several."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.contour import QuadContourSet
from matplotlib.figure import SubFigure

from gradhesion.cli.picture.labels import Unit
from gradhesion.cli.picture.pictured import LETTER, letters_of

LINE: Final = 0.55
"""The width of a line in a legend with the space around it, in inches."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Part:
    """What is drawn of a variable, as the figure around it needs it."""

    width: float
    height: float
    """The size that suits it, in inches."""
    entries: Sequence[Artist]
    """The marks of doubtful scenes that a legend explains."""
    lines: Sequence[Artist] = ()
    """The lines that a legend names, if there are several."""
    contours: Sequence[tuple[QuadContourSet, Unit]] = ()
    """Contours that want numbers."""
    caption: Sequence[str] = ()
    """What is said above it."""
    again: Callable[[Axes], object] | None = None
    """What draws its only panel once more, in other axes."""
    units: tuple[str, Unit, Unit] = ("", Unit(), Unit())
    """What is along that panel, its unit, and the unit of what is up."""


def add_legends(
    body: SubFigure, parts: Sequence[SubFigure], lines: Sequence[Sequence[Artist]], width: float, beside: int
) -> None:
    """Put one legend below all variables, `beside` of them in a width, if their lines mean the same, else one each."""
    meant = {tuple(str(line.get_label()) for line in own) for own in lines}
    shared = len(lines) > 1 and len(meant) == 1
    for part, own in [(body, lines[0])] if shared else zip(parts, lines, strict=False):
        if own:
            longest = max(letters_of(str(line.get_label())) for line in own)
            room = (width if shared else width / beside) / (LINE + LETTER * longest)
            part.legend(handles=own, loc="outside lower center", ncols=int(min(len(own), max(1.0, room))))
