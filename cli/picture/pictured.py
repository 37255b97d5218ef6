"""What the pictures of all datasets have in common: style, size, what is written around the panels, and saving."""

import math
import re
import textwrap
import warnings
from collections.abc import Iterable, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any, Final, Literal

import matplotlib.style
import numpy as np
import xarray
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.mathtext import MathTextParser
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.model_range import slope_warnings
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.picture.labels import Unit, called
from gradhesion.cli.picture.looks import PLAIN, STYLE, Looks
from gradhesion.cli.study.shape_words import shape_in_words
from gradhesion.cli.terminal.messages import printable
from gradhesion.core import Profile

LOWEST: Final = 1.25
"""The height of a row of panels with what is written at them, in inches: a lower one could not be read."""


def styled(looks: Looks = PLAIN) -> AbstractContextManager[None]:
    """Draw in the style of the project, whatever the user's own is: the same dataset gives the same picture."""
    return matplotlib.style.context([STYLE, looks.style] if looks.style else [STYLE], after_reset=True)


def save(figure: Figure, file: Path, form: str, looks: Looks = PLAIN) -> None:
    """Save a picture as "png", "svg" or "pdf"; the same picture gives the same file."""
    undated = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
    with styled(looks), warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph .* missing from")  # of a title: no font has every letter
        figure.savefig(file, format=form, metadata=undated.get(form))


def make_room(axes: Axes, side: Literal["x", "y"], values: NDArray[np.float64]) -> None:
    """Set the limits of an axis to some values, with a margin beyond both ends."""
    there = values[np.isfinite(values)]
    if there.size:
        margin = 0.08 * float(np.ptp(there)) or 1.0
        axes.set(**{f"{side}lim": (float(there.min()) - margin, float(there.max()) + margin)})


def side_by_side(count: int, narrow: float, looks: Looks) -> tuple[Figure, Any, int]:
    """Make a figure of panels in a row, or below each other where a chosen width leaves each less than `narrow`."""
    below = count if looks.width and looks.width < narrow * count else 1
    figure = Figure(layout="constrained")
    return figure, figure.subplots(below, count // below, squeeze=False).ravel(), below


def finish(
    figure: Figure,
    dataset: xarray.Dataset,
    looks: Looks,
    panels: Any,
    caption: Iterable[str],
    entries: Sequence[Artist] = (),
    *,
    size: tuple[float, float],
    laid_out: bool = False,
) -> None:
    """Size a picture, and put the words around its panels: title and caption above, a legend below.

    The size in inches is that which suits its panels; words and sides that are chosen come first. Numbers on contours
    need it `laid_out`, with everything in its place.
    """
    for side, words in (("x", looks.xlabel), ("y", looks.ylabel)):
        named = [axis for axes in panels if (axis := getattr(axes, f"{side}axis")).get_label_text()]
        if words is not None and len({axis.get_label_text() for axis in named}) > 1:
            raise DatasetError(f"--{side}label: the panels have different axes; choose one variable, or one plane")
        for axis in named if words is not None else ():
            rename(axis, str(words))
    width = looks.width or size[0]
    longest = max((len(re.sub(r"[$\\{}]", "", str(entry.get_label()))) for entry in entries), default=0)
    columns = max(1, min(len(entries), int(width / (0.7 + 0.05 * longest))))
    if entries:
        figure.legend(handles=entries, loc="outside lower center", ncols=columns)
    above = [heading(dataset) if looks.title is True else drawable(looks.title or "")]
    above += [", ".join(map(_unbroken, [*caption, *slope_warnings(dataset)]))] if looks.caption else []
    words = "\n".join(filter(None, above))
    if words:
        figure.suptitle(words, fontsize="medium", wrap=True)
    lines = math.ceil(len(entries) / columns) + (words.count("\n") + 2 if words else 0)
    height = max(size[1] * min(1.0, width / size[0]), LOWEST * panels[0].get_gridspec().nrows)
    figure.set_size_inches(width, looks.height or height + 0.17 * lines)
    if laid_out or looks.width or looks.height:
        with warnings.catch_warnings():
            warnings.filterwarnings("error", "constrained_layout not applied")
            warnings.filterwarnings("ignore", "Glyph .* missing from")
            try:
                figure.draw_without_rendering()
            except UserWarning:
                width, height = figure.get_size_inches()
                raise DatasetError(
                    f"a picture of {width:.3g} by {height:.3g} inches has no room for its panels beside what is "
                    "written; choose larger sides with --width and --height, or leave words out with --no-title and "
                    "--no-caption"
                ) from None


def rename(axis: Axis, words: str) -> None:
    """Name an axis in words of the user, whose ticks are in the unit of these."""
    unit = axis.get_major_formatter()
    if isinstance(unit, Unit):
        words, unit = called(words, unit)
        axis.set_major_formatter(unit)
    axis.set_label_text(drawable(words))


def heading(dataset: xarray.Dataset) -> str:
    """Report the title of a dataset, and shape and control where they are not those of the paper."""
    profile = str(dataset.attrs.get("profile", ""))
    is_own = profile not in ("", shape_in_words(Profile()))
    shape = textwrap.shorten(f"profile {profile}", 120, placeholder=" ...") if is_own else ""
    controls = {"load": "under controlled load", "machine": "through a machine of finite stiffness"}
    control = controls.get(str(dataset.attrs.get("control")), "")
    return "\n".join(map(drawable, filter(None, (str(dataset.attrs["title"]), shape, control))))


def drawable(text: str) -> str:
    """Write a text so that matplotlib draws it: formulae in dollars as such if they are some."""
    text = printable(text)
    try:
        MathTextParser("agg").parse(text)
    except ValueError:
        return text.replace("$", r"\$")
    return text


def _unbroken(words: str) -> str:
    r"""Keep an equation of a caption in one line, wherever matplotlib wraps the others.

    >>> _unbroken(r"$\pi R$ = 10 nm") == "$\\pi{}R$\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}10\N{NO-BREAK SPACE}nm"
    True
    """
    in_formulae = re.sub(r"\$[^$]*\$", lambda found: found[0].replace(" ", "{}"), words)
    return in_formulae.replace(" ", "\N{NO-BREAK SPACE}") if "=" in words else words
