"""What the pictures of all datasets have in common: their style, their heading, and how they are saved."""

import re
import warnings
from collections.abc import Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Final

import matplotlib.style
import numpy as np
import xarray
from matplotlib.figure import Figure
from matplotlib.mathtext import MathTextParser
from numpy.typing import ArrayLike, NDArray

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.picture.looks import PLAIN, Looks
from gradhesion.cli.study.shape_words import shape_in_words
from gradhesion.cli.terminal.printable import printable
from gradhesion.core import Profile

CAPTION: Final = "small"
"""The size of a caption, over that of the style."""

LETTER: Final = 0.058
"""The mean width of a letter of a caption, in inches."""

LONGEST: Final = 110
"""Letters of a profile that a heading has room for."""


def styled(looks: Looks = PLAIN) -> AbstractContextManager[None]:
    """Draw in the style of the project, whatever the user's own is: the same dataset gives the same picture."""
    return matplotlib.style.context(looks.styles(), after_reset=True)


def save(figure: Figure, file: Path, form: str, looks: Looks = PLAIN) -> None:
    """Save a picture as "png", "svg" or "pdf"; the same picture gives the same file."""
    undated = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
    with styled(looks), warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph .* missing from")  # of a title: no font has every letter
        figure.savefig(file, format=form, metadata=undated.get(form))


def lay_out(figure: Figure) -> None:
    """
    Find the place of everything in a picture.

    Raises
    ------
    DatasetError
        The sides that were chosen leave no room for its panels.
    """
    with warnings.catch_warnings():
        warnings.filterwarnings("error", "constrained_layout not applied")
        warnings.filterwarnings("ignore", "Glyph .* missing from")
        try:
            figure.draw_without_rendering()
        except UserWarning:
            width, height = figure.get_size_inches()
            raise DatasetError(
                f"a picture of {width:.3g} by {height:.3g} inches has no room for its panels beside what is written; "
                "choose larger sides with --width and --height, or leave words out with --no-title and --no-caption"
            ) from None


def finite(values: ArrayLike) -> NDArray[np.float64]:
    """Take values as numbers, NaN where they have no place on an axis: they leave a gap."""
    numbers = np.asarray(values, dtype=float)
    return np.where(np.isfinite(numbers), numbers, np.nan)


def heading(dataset: xarray.Dataset) -> str:
    """Report the title of a dataset, and shape and control where they are not those of the paper."""
    written = []
    profile = str(dataset.attrs.get("profile", ""))
    if profile not in ("", shape_in_words(Profile())):
        written.append(f"profile {profile if len(profile) <= LONGEST else profile[:LONGEST] + ' ...'}")
    control = str(dataset.attrs.get("control", "displacement"))
    if control != "displacement":
        written.append({"load": "under controlled load", "machine": "through a machine of finite stiffness"}[control])
    return "\n".join(map(_drawable, [str(dataset.attrs["title"]), *written]))


def _drawable(text: str) -> str:
    """Write a text so that matplotlib draws it: formulae in dollars as such if they are some."""
    text = printable(text)
    try:
        MathTextParser("agg").parse(text)
    except ValueError:
        return text.replace("$", r"\$")
    return text


def letters_of(text: str) -> int:
    r"""
    Count the letters of a text as it is drawn, about: a command of TeX is one of them.

    >>> letters_of(r"$\lambda/R$ = 0.1")
    10
    """
    return len(re.sub(r"\\[a-zA-Z]+|[${}^_]", "x", text).replace("x" * 2, "x"))


def in_lines(parts: Sequence[str], width: float) -> str:
    r"""
    Put the parts of a caption into lines of a width in inches.

    >>> in_lines([r"$\lambda/R$ = 0.1", "$A$ = 0.02", "$k$ = 0.3"], 1.4)
    '$\\lambda/R$ = 0.1,  $A$ = 0.02,\n$k$ = 0.3'
    """
    lines: list[list[str]] = []
    room = 0.0
    for part in parts:
        letters = letters_of(part) + 2
        if not lines or letters * LETTER > room:
            lines.append([])
            room = width
        lines[-1].append(part)
        room -= letters * LETTER
    return ",\n".join(",  ".join(line) for line in lines)
