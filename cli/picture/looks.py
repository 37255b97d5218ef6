"""What a user chooses of a picture: its size, colours, levels, limits, and what is written on it."""

import math
import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal

import matplotlib.style
import numpy as np
import xarray
from matplotlib import colormaps
from matplotlib.colors import Colormap

from gradhesion.cli.dataset.read.selection import QUANTITY, ends_in, in_unit
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.outputs import unit_of
from gradhesion.cli.names.scenes import REALISATION, SCENE, SOLVER
from gradhesion.cli.terminal.wording import did_you_mean, nearest
from gradhesion.core.problem.inputs import INPUTS

STYLE: Final = "gradhesion.style"
"""The style of the project, as matplotlib knows it: `plt.style.use("gradhesion.style")`."""
WIDTHS: Final = {"column": 90 / 25.4, "page": 190 / 25.4}
LEAST, MOST = 1.0, 100.0
"""Sides of a picture, in inches: a smaller one has no room for its labels, a larger one no paper."""
FINEST: Final = 100
"""Contour levels: more would be one colour."""
_BETWEEN: Final = re.compile(r"\s*,\s*|\s+(?=[-+.\d])")
"""What stands between two numbers: a comma, or a space."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Looks:
    """What a user chooses of a picture, as `gradhesion.plot` has it; what is None is chosen to suit the dataset."""

    kind: Literal["lines", "map"] | None = None
    width: float | None = None
    height: float | None = None
    colour_map: str = "viridis"
    """The usual one rises in lightness, so that it survives a grey print."""
    levels: int | tuple[str, ...] | None = None
    """Contour levels of a map: about how many, or which, in SI or with units."""
    labels: bool = True
    title: str | None = None
    caption: bool = True
    xlabel: str | None = None
    ylabel: str | None = None
    clabel: str | None = None
    style: str | None = None
    xlim: str = ""
    ylim: str = ""
    """The limits of the axes as options give them, "--xlim 50 nm:1 um", or with an end left out; "" is all there is."""
    band: Literal["quantiles", "std", "none"] | None = None

    @property
    def colours(self) -> Colormap:
        """The colour map."""
        return colormaps[self.colour_map]

    def refuse(self, options: Sequence[str], why: str) -> None:
        """Refuse those of some choices, by the names of their fields, that a picture has no place for."""
        for option in options:
            value = getattr(self, option)
            if value and value != "none":
                raise DatasetError(f"{value if option in ('xlim', 'ylim') else f'--{option}'}: {why}; leave it out")


PLAIN: Final = Looks()


def looks_of(**chosen: Any) -> Looks:
    """Check what a user has chosen, by the fields of `Looks`; None is no choice.

    >>> looks_of(width="column").width, looks_of(levels="0.5, 1 mJ").levels, looks_of(levels="8").levels
    (3.5433070866141736, ('0.5', '1 mJ'), 8)
    """
    there = {name: value for name, value in chosen.items() if value is not None}
    return Looks(**{name: _READ[name](name, one) if name in _READ else one for name, one in there.items()})


def limits_of(
    span: str, name: str, least: float = -math.inf, greatest: float = math.inf, *, log: bool = False
) -> tuple[float, float]:
    """Give the ends of a part of the axis of a variable, which has values between two; inf where there is none.

    >>> limits_of("--xlim 50 nm:2e-6", "R"), limits_of("", "R")
    ((5e-08, 2e-06), (-inf, inf))
    """
    low, high = ends_in(span.partition(" ")[2], name, span)
    if low == high:
        raise DatasetError(f"{span}: the two limits are one; give two")
    if log and (high <= 0.0 or -math.inf < low <= 0.0):
        raise DatasetError(f"{span}: the axis is logarithmic; choose limits above 0")
    if low >= greatest or high <= least:
        drawn = between(least, greatest, name)
        raise DatasetError(f"{span}: outside what is drawn, {drawn}; choose limits that meet it")
    return low, high


def between(least: float, greatest: float, name: str) -> str:
    """Write between which values a variable is."""
    return f"which is {least:.4g} to {greatest:.4g} {unit_of(name)}".removesuffix(" 1")


def check_dimensions(dataset: xarray.Dataset) -> None:
    """Refuse dimensions that no picture knows."""
    others = [str(dim) for dim in dataset["status"].dims if dim not in (*INPUTS, REALISATION, SCENE, SOLVER)]
    if others:
        raise DatasetError(
            f"the dataset: its dimension {others[0]} is no parameter, and pictures are drawn over parameters; draw it "
            f'with xarray, as in dataset["pull_off_force"].plot(x="{others[0]}"), or name a list of points "{SCENE}"'
        )


def check_names(option: str, names: Iterable[str], known: Sequence[str], what: str) -> None:
    """Refuse the first name of an option that is not among those known, and say what it is."""
    for name in names:
        if name not in known:
            raise DatasetError(f"--{option} {name}: {what}; {did_you_mean(name, known)}")


def _one_of(option: str, value: Any, known: Sequence[str]) -> str:
    """Read one of some words; of those that are not like it the first few are named."""
    word = str(value)
    if word not in known:
        near = nearest(word, known)
        remedy = did_you_mean(word, [near] if near else known[:4])
        raise DatasetError(f"--{option.replace('_', '-')} {word}: not known; {remedy}")
    return word


def _style(option: str, value: Any) -> str:
    """Read a style: its name, or the file of one."""
    try:
        with matplotlib.style.context(str(value)):
            return str(value)
    except OSError:
        return _one_of(option, value, matplotlib.style.available)


def _side(option: str, value: float | str) -> float:
    """Read a side of a picture: a number of inches, a length with its unit, or a width by its name."""
    text = str(value).strip().lower()
    if option == "width" and text in WIDTHS:
        return WIDTHS[text]
    inches = in_unit(text, "inch")
    if not LEAST <= inches <= MOST:
        raise DatasetError(
            f"--{option} {value}: not a size of {LEAST:g} to {MOST:g} inches; write for example 3.5, or 9 cm, "
            "or as a width column or page"
        )
    return inches


def _levels(option: str, value: Any) -> int | tuple[str, ...]:
    """Read contour levels: about how many, or a list of them."""
    words = _BETWEEN.split(value.strip()) if isinstance(value, str) else list(map(str, np.atleast_1d(value).tolist()))
    a_number = len(words) == 1 and words[0].isdecimal()
    if a_number and 1 <= int(words[0]) <= FINEST:
        return int(words[0])
    if words and not a_number and all(map(QUANTITY.fullmatch, words)):
        return tuple(words)
    raise DatasetError(
        f"--{option} {', '.join(words)}: neither a number of levels, 1 to {FINEST}, nor a list of them; "
        "write 8, or 0.5,1,2"
    )


def _span(option: str, value: Any) -> str:
    """Read what a user writes as a part of an axis: "LOW:HIGH", or two ends in a sequence.

    >>> _span("xlim", "0.1:1 um"), _span("xlim", (0.1, None))
    ('--xlim 0.1:1 um', '--xlim 0.1:')
    """
    ends = value.split(":") if isinstance(value, str) else value
    if isinstance(ends, Sequence) and len(ends) == 2:
        low, high = ("" if end is None else str(end).strip() for end in ends)
        if low or high:
            return f"--{option} {low}:{high}"
    raise DatasetError(f"--{option} {value}: not two ends with a colon between them; write --{option} 0.1:0.5")


_READ: Final[dict[str, Callable[[str, Any], Any]]] = {
    "kind": lambda option, value: _one_of(option, value, ["lines", "map"]),
    "band": lambda option, value: _one_of(option, value, ["quantiles", "std", "none"]),
    "colour_map": lambda option, value: _one_of(option, value, list(colormaps)),
    "style": _style,
    "width": _side,
    "height": _side,
    "levels": _levels,
    "title": lambda _, value: {True: None, False: ""}[value] if isinstance(value, bool) else value,
    "xlim": _span,
    "ylim": _span,
}
