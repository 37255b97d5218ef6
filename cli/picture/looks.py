"""What a user chooses of a picture: its size, colours, levels, limits, and what is written on it."""

import math
import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Annotated, Any, Final, Literal

import matplotlib.style
import numpy as np
import xarray
from matplotlib import colormaps
from matplotlib.colors import Colormap
from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, ValidationError, ValidationInfo

from gradhesion.cli.dataset.read.selection import QUANTITY, ends_in, in_unit
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.outputs import unit_of
from gradhesion.cli.names.scenes import REALISATION, SCENE, SOLVER
from gradhesion.cli.terminal.wording import did_you_mean, nearest
from gradhesion.core.problem.inputs import INPUTS

STYLE: Final = "gradhesion.style"
"""The style of the project, as matplotlib knows it: `plt.style.use("gradhesion.style")`."""
WIDTHS: Final = {"column": 90 / 25.4, "page": 190 / 25.4}
"""Widths by name, in inches."""
LEAST, MOST = 1.0, 100.0
"""Sides of a picture, in inches: a smaller one has no room for its labels, a larger one no paper."""
FINEST: Final = 100
"""Contour levels: more would be one colour."""
_BETWEEN: Final = re.compile(r"\s*,\s*|\s+(?=[-+.\d])")
"""What stands between two numbers: a comma, or a space."""


def _colour_map(word: str) -> str:
    """Check the name of a colour map."""
    if word not in colormaps:
        raise ValueError(_not_known(word, [*colormaps]))
    return word


def _style(value: Any) -> str:
    """Check the name of a style, or the file of one."""
    try:
        with matplotlib.style.context(str(value)):
            return str(value)
    except OSError:
        raise ValueError(_not_known(str(value), ["gradhesion.journal", *matplotlib.style.available])) from None


def _not_known(word: str, known: Sequence[str]) -> str:
    """Say that a word is not among some; of those that are not like it the first few are named."""
    near = nearest(word, known)
    return f"not known; {did_you_mean(word, [near] if near else known[:4])}"


def _side(value: float | str, info: ValidationInfo) -> float:
    """Read a side of a picture: a number of inches, a length with its unit, or a width by its name."""
    text = str(value).strip().lower()
    if info.field_name == "width" and text in WIDTHS:
        return WIDTHS[text]
    inches = in_unit(text, "inch")
    if not LEAST <= inches <= MOST:
        remedy = "write for example 3.5, or 9 cm, or as a width column or page"
        raise ValueError(f"not a size of {LEAST:g} to {MOST:g} inches; {remedy}")
    return inches


def _levels(value: Any) -> int | tuple[str, ...]:
    """Read contour levels: about how many, or a list of them."""
    words = _BETWEEN.split(value.strip()) if isinstance(value, str) else list(map(str, np.atleast_1d(value).tolist()))
    a_number = len(words) == 1 and words[0].isdecimal()
    if a_number and 1 <= int(words[0]) <= FINEST:
        return int(words[0])
    if words and not a_number and all(map(QUANTITY.fullmatch, words)):
        return tuple(words)
    raise ValueError(f"neither a number of levels, 1 to {FINEST}, nor a list of them; write 8, or 0.5,1,2")


def _span(value: Any, info: ValidationInfo) -> str:
    """Read what a user writes as a part of an axis: "LOW:HIGH", or two ends in a sequence."""
    ends = value.split(":") if isinstance(value, str) else value
    if isinstance(ends, Sequence) and len(ends) == 2:
        low, high = ("" if end is None else str(end).strip() for end in ends)
        if low or high:
            return f"--{info.field_name} {low}:{high}"
    raise ValueError(f"not two ends with a colon between them; write --{info.field_name} 0.1:0.5")


class Looks(BaseModel):
    """What a user chooses of a picture, as `gradhesion.plot` has it; what is None is chosen to suit the dataset."""

    model_config = ConfigDict(frozen=True)

    variables: tuple[str, ...] = ()
    at: tuple[str, ...] = ()
    over: tuple[str, ...] = ()
    """Axes fixed and reduced, as `selection_of` reads them."""
    interpolate: bool = False
    x: str | None = None
    y: str | None = None
    data: Path | None = None
    """Measured points for curves."""
    kind: Literal["lines", "map"] | None = None
    width: Annotated[float | None, BeforeValidator(_side)] = None
    height: Annotated[float | None, BeforeValidator(_side)] = None
    colour_map: Annotated[str, AfterValidator(_colour_map)] = "viridis"
    """The usual one rises in lightness, so that it survives a grey print."""
    levels: Annotated[int | tuple[str, ...] | None, BeforeValidator(_levels)] = None
    """Contour levels of a map: about how many, or which, in SI or with units."""
    labels: bool = True
    title: str | bool = True
    """Whether there is that of the dataset, or one of the user's own; none if empty."""
    caption: bool = True
    xlabel: str | None = None
    ylabel: str | None = None
    clabel: str | None = None
    style: Annotated[str | None, BeforeValidator(_style)] = None
    xlim: Annotated[str, BeforeValidator(_span)] = ""
    ylim: Annotated[str, BeforeValidator(_span)] = ""
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
            if value and (option, value) != ("band", "none"):
                word = {"variables": "variable", "kind": self.kind}.get(option, option)
                raise DatasetError(f"{value if option in ('xlim', 'ylim') else f'--{word}'}: {why}; leave it out")


PLAIN: Final = Looks()


def looks_of(**chosen: Any) -> Looks:
    """Check what a user has chosen, by the fields of `Looks`; None is no choice. DatasetError says all that is wrong.

    >>> looks_of(width="column").width, looks_of(levels="0.5, 1 mJ").levels, looks_of(xlim=(0.1, None)).xlim
    (3.5433070866141736, ('0.5', '1 mJ'), '--xlim 0.1:')
    """
    try:
        return Looks(**{name: value for name, value in chosen.items() if value is not None})
    except ValidationError as error:
        raise DatasetError(
            [
                f"--{str(one['loc'][0]).replace('_', '-')} {one['input']}: {one['msg'].removeprefix('Value error, ')}"
                for one in error.errors()
            ]
        ) from None


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
