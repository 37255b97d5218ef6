"""How a picture looks, where a user chooses: its size, its colours, its levels, and what is written on it."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, Literal

import matplotlib.style
from matplotlib import colormaps
from matplotlib.colors import Colormap

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.picture.spans import ALL, Span, span_of
from gradhesion.cli.terminal.wording import did_you_mean, nearest

VIRIDIS: Final = "viridis"
"""The usual colour map: perceptual, and rising in lightness, so that it survives a grey print."""

WIDTHS: Final = {"column": 90 / 25.4, "page": 190 / 25.4}
"""The widths of a column and of a page of a journal, in inches: 90 mm and 190 mm."""

LEAST: Final = 1.0
MOST: Final = 100.0
"""Sides of a picture, in inches: a smaller one has no room for its labels, a larger one no paper."""

UNITS: Final = {"": 1.0, "in": 1.0, "cm": 1 / 2.54, "mm": 1 / 25.4}
"""Inches in each unit that a side may have."""

FINEST: Final = 100
"""Contour levels: more would be one colour."""

STYLE: Final = "gradhesion.style"
"""The style of the project, as matplotlib knows it: `plt.style.use("gradhesion.style")`."""

BANDS: Final = ("quantiles", "std", "none")
"""What a band of uncertain values may be: from the 5 % to the 95 % quantile, or a standard deviation on each side."""

Kind = Literal["lines", "map"]
Band = Literal["quantiles", "std", "none"]


@dataclass(frozen=True, kw_only=True, eq=False)
class Looks:
    """What a user chooses of a picture; what is None is chosen to suit the dataset."""

    kind: Kind | None = None
    """Lines or a map."""
    width: float | None = None
    height: float | None = None
    """Its sides, in inches."""
    colour_map: str = VIRIDIS
    """A colour map of matplotlib, by name."""
    levels: int | tuple[float, ...] | None = None
    """Contour levels of a map: about how many, or which."""
    labels: bool = True
    """Whether contours have numbers on them."""
    title: str | None = None
    """What stands above the panels in the place of title, profile and control of the study; "" for nothing."""
    caption: bool = True
    """Whether the parameters that are not drawn stand above the panels."""
    xlabel: str | None = None
    ylabel: str | None = None
    """What the axes are called."""
    style: str | None = None
    """A style of matplotlib, by name or file, on top of that of the project."""
    xlim: Span = ALL
    ylim: Span = ALL
    """The limits of the axes."""
    inset: Span = ALL
    """The part of the horizontal axis that is drawn once more, enlarged."""
    band: Band | None = None
    """What is drawn around uncertain values."""

    @property
    def colours(self) -> Colormap:
        """The colour map."""
        return colormaps[self.colour_map]

    def styles(self) -> list[Any]:
        """List the styles that apply, the later ones on top."""
        return [STYLE, self.style] if self.style else [STYLE]

    def refuse(self, options: Sequence[str], why: str) -> None:
        """Refuse those of some choices, by the names of their fields, that a picture has no place for."""
        for option in options:
            value = getattr(self, option)
            if value and value != "none":
                raise DatasetError(f"{value if isinstance(value, Span) else f'--{option}'}: {why}; leave it out")


PLAIN: Final = Looks()
"""Nothing is chosen."""


def looks_of(
    *,
    kind: Any = None,
    width: float | str | None = None,
    height: float | str | None = None,
    colour_map: str | None = None,
    levels: Any = None,
    style: str | Path | None = None,
    title: str | bool | None = None,
    xlim: Any = None,
    ylim: Any = None,
    inset: Any = None,
    band: Any = None,
    **words: Any,
) -> Looks:
    """
    Check what a user has chosen; `words` are the fields of `Looks` that may be anything.

    Raises
    ------
    DatasetError
        A size, a colour map, a style, levels, limits or a band that do not exist; the message names the nearest.

    >>> looks_of(width="column").width, looks_of(levels="0.5, 1, 2").levels, looks_of(levels="8").levels
    (3.5433070866141736, (0.5, 1.0, 2.0), 8)
    """
    if kind not in (None, "lines", "map"):
        raise DatasetError(f'kind = "{kind}": not a kind of picture; {did_you_mean(str(kind), ["lines", "map"])}')
    if band not in (None, *BANDS):
        raise DatasetError(f"--band {band}: not a band; {did_you_mean(str(band), list(BANDS))}")
    name = VIRIDIS if colour_map is None else str(colour_map)
    if name not in colormaps:
        raise DatasetError(f"--colour-map {name}: not a colour map of matplotlib; {_near(name, [*colormaps], VIRIDIS)}")
    return Looks(
        kind=kind,
        width=_side("width", width),
        height=_side("height", height),
        colour_map=name,
        levels=_levels(levels),
        style=_style(style),
        title={True: None, False: ""}[title] if isinstance(title, bool) else title,
        xlim=span_of("xlim", xlim),
        ylim=span_of("ylim", ylim),
        inset=span_of("inset", inset),
        band=band,
        **words,
    )


def _side(name: str, value: float | str | None) -> float | None:
    """Read a side of a picture: a number of inches, a length in cm or mm, or a width by its name."""
    if value is None:
        return None
    words = WIDTHS if name == "width" else {}
    text = str(value).strip().lower()
    if text in words:
        return words[text]
    parts = re.fullmatch(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*([a-z]*)", text)
    if not parts or parts[2] not in UNITS:
        near = nearest(text, list(words))
        meant = f'did you mean "{near}"?' if near else f'write for example 3.5, "9 cm"{" or column" if words else ""}'
        raise DatasetError(f"--{name} {value}: not a size; {meant}")
    inches = float(parts[1]) * UNITS[parts[2]]
    if not LEAST <= inches <= MOST:
        raise DatasetError(
            f"--{name} {value}: a picture of {inches:.3g} inches; choose one of {LEAST:g} to {MOST:g} inches"
        )
    return inches


def _levels(value: Any) -> int | tuple[float, ...] | None:
    """Read contour levels: about how many, or a list of them."""
    if value is None:
        return None
    words = value.replace(",", " ").split() if isinstance(value, str) else value
    words = [words] if isinstance(words, int | float) else [*words]
    written = value if isinstance(value, str) else ", ".join(map(str, words))
    try:
        numbers = sorted({float(word) for word in words})
    except (TypeError, ValueError):
        numbers = []
    if not numbers or not all(map(math.isfinite, numbers)):
        raise DatasetError(f"--levels {written}: neither a number of levels nor a list of levels; write 8 or 0.5,1,2")
    if len(words) > 1 or "." in str(words[0]):
        return tuple(numbers)
    if not 1 <= numbers[0] <= FINEST:
        raise DatasetError(
            f"--levels {written}: choose 1 to {FINEST} levels; a single level is written with its point, as {written}.0"
        )
    return int(numbers[0])


def _style(value: str | Path | None) -> str | None:
    """Find a style."""
    if value is None:
        return None
    try:
        with matplotlib.style.context(str(value)):
            return str(value)
    except OSError:
        near = _near(str(value), [*matplotlib.style.available], "grayscale")
        raise DatasetError(f"--style {value}: neither a style of matplotlib nor the file of a style; {near}") from None


def _near(word: str, known: list[str], usual: str) -> str:
    """Suggest the nearest of many words, or one that suits most."""
    near = nearest(word, known)
    return f'did you mean "{near}"?' if near else f'choose one of its own, as "{usual}"'
