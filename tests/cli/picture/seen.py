"""What a reader sees of a picture."""

from typing import Any

from matplotlib.axes import Axes
from matplotlib.contour import QuadContourSet


def legend(panels: Any) -> list[str]:
    return [text.get_text() for one in panels.figure.legends for text in one.get_texts()]


def words(panels: Any) -> str:
    """All that stands above the panels."""
    return str(panels.figure.get_suptitle()).replace("\N{NO-BREAK SPACE}", " ").replace("$", "").replace("{}", " ")


def curves(axes: Axes) -> list[Any]:
    return [line for line in axes.get_lines() if not str(line.get_label()).startswith("_")]


def contours(axes: Axes) -> QuadContourSet:
    return next(one for one in axes.collections if isinstance(one, QuadContourSet) and not one.filled)
