"""What is drawn of one variable: its values, which of them may not hold, their spread, and between which levels."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final, NamedTuple

import numpy as np
import xarray
from matplotlib.colors import LogNorm, Normalize
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import Locator, LogLocator, MaxNLocator
from numpy.typing import NDArray

from gradhesion.cli.dataset.read import model_range
from gradhesion.cli.dataset.read.model_range import LIMITS, beyond_by, doubts_of
from gradhesion.cli.dataset.read.selection import Selection, value_in
from gradhesion.cli.dataset.read.sensitivities import parameters_of
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.outputs import BEST, ON_BOUND, SI, SPREADS
from gradhesion.cli.names.symbols import SYMBOLS
from gradhesion.cli.picture.labels import Unit, label, unit_for
from gradhesion.cli.picture.looks import Looks, between, limits_of
from gradhesion.cli.picture.plan import Plan
from gradhesion.cli.terminal.amounts import counted
from gradhesion.core.answers.flags import FLAG_WORDS, FLAGS

Values = NDArray[np.float64]
Levels = tuple[Values, Values, Normalize]
"""All levels of a map, those that have lines, and what gives their colours."""
FAR: Final = 50.0
WIDE: Final = 8.0
"""The ratio of the greatest value to the least from which lines, and contours, are drawn over a logarithm."""
FLAT: Final = 1e-9
"""Values that differ by less, over their size, are drawn as equal: what is left is rounding."""
BANDS: Final = {
    "quantiles": (("_p05", "_p95"), "5 % to 95 % of samples"),
    "std": (("_std",), "a standard deviation on each side"),
}
"""What a band of uncertain values may be: the ends of the names of its variables, and what a legend says of it."""
_STEPS: Final = (
    (30.0, (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0)),
    (1e3, (1.0, 1.5, 2.0, 3.0, 5.0, 7.0)),
    (1e5, (1.0, 2.0, 5.0)),
    (np.inf, (1.0,)),
)
"""Levels in a decade, for values that differ by less than each factor."""
INK: Final = "0.25"
"""The colour of marks in a legend."""
GREY: Final = "0.8"
CROSS: Final = "0.6"
"""The colours of scenes that have no value, in a map and as crosses."""


class Doubt(NamedTuple):
    """What makes a value doubtful: its pattern in a map, and its open marker, of a size that shows inside others."""

    words: str
    hatch: str
    mark: str
    size: float
    bit: int = 0
    """Its flag, if it is one."""

    def marker(self, colour: Any) -> dict[str, Any]:
        """Give the looks of its open marker."""
        return {"ls": "", "marker": self.mark, "ms": self.size, "mfc": "white", "mec": colour}


_OF_FLAGS: Final = (("/", "o", 3.5), ("\\", "s", 5.5), ("x", "D", 7.0), ("-", "v", 8.0), ("|", "p", 8.0))
_OF_LIMITS: Final = (("oo", "P", 6.0), ("OO", "X", 6.0), ("++", "*", 6.0), ("..", "h", 6.0), ("**", "8", 6.0))
_FLAGS: Final = {FLAG_WORDS[name]: bit for name, bit in FLAGS.items() if bit & model_range.DOUBTS}
DOUBTS: Final = [
    Doubt(words, 4 * hatch, mark, size, bit)
    for (words, bit), (hatch, mark, size) in zip(_FLAGS.items(), _OF_FLAGS, strict=True)
]
"""Every flag that makes values doubtful."""
BEYOND: Final = {name: Doubt(one.words, *look) for (name, one), look in zip(LIMITS.items(), _OF_LIMITS, strict=True)}
"""How scenes are shown that leave the range of the model, by the validity number that says so."""
BOUND: Final = Doubt("optimum at a bound of its range", "//..", ">", 6.0)
END: Final = Doubt("extreme at an end of its axis: it may lie beyond", "....", "^", 4.5)
"""How an optimum, and the place of an extreme, is shown that may be beyond what was searched."""
Marks = list[tuple[Doubt, xarray.DataArray]]
"""Doubts, each with the scenes that have it."""


def doubts_in(status: NDArray[Any], variable: str, dataset: xarray.Dataset) -> list[Doubt]:
    """List the flags of some scenes of a dataset that cast doubt on a variable; none on `status` itself."""
    there = 0 if variable == "status" else np.bitwise_or.reduce(np.ravel(status).astype(np.int16), initial=0)
    return [doubt for doubt in DOUBTS if doubt.bit & doubts_of(variable, dataset) & there]


def marks_of(dataset: xarray.Dataset, values: xarray.DataArray, status: xarray.DataArray, name: str) -> Marks:
    """Mark the scenes of a variable that are in doubt, beyond a limit (a validity number: its own), or at a bound."""
    there = doubts_in(status.where(values.notnull(), 0).values, name, dataset)
    found = [(doubt, (status & doubt.bit) != 0) for doubt in there]
    limits = {number: beyond_by(number, dataset) for number in BEYOND if name not in BEYOND or number == name}
    found += [(BEYOND[number], flags) for number, flags in limits.items() if flags is not None]
    if ON_BOUND in dataset and name.startswith(BEST):  # of a parameter that was searched its own, else any
        meanings = str(dataset[ON_BOUND].attrs["flag_meanings"]).split()
        bounds = [one for one in meanings if one.startswith(f"{name.removeprefix(BEST)}_at_its_")] or meanings
        bits = sum(1 << meanings.index(one) for one in bounds)
        found.append((BOUND, (dataset[ON_BOUND].astype(int) & bits) != 0))
    return [(doubt, own) for doubt, flags in found if bool((own := among(flags, values)).any())]


def among(flags: xarray.DataArray, values: xarray.DataArray) -> xarray.DataArray:
    """Give flags over the axes of what is drawn, where it has values."""
    flags = flags.any([axis for axis in flags.dims if axis not in values.dims])
    return (flags.drop_vars([*flags.coords]) & values.notnull()).transpose(*values.dims)


def entries(doubts: Sequence[Doubt], *, in_map: bool = False, gaps: bool = False) -> list[Patch | Line2D]:
    """Make the entries of a legend: the doubts, and scenes without a value if there are such gaps."""
    words = ["no finite value"] if gaps else []
    if in_map:
        hatched: dict[str, Any] = {"facecolor": "none", "edgecolor": INK, "lw": 0.0}
        made = [Patch(hatch=doubt.hatch, label=doubt.words, **hatched) for doubt in doubts]
        return [*made, *(Patch(facecolor=GREY, label=one) for one in words)]
    marks = [Line2D([], [], label=doubt.words, **doubt.marker(INK)) for doubt in doubts]
    return [*marks, *(Line2D([], [], ls="", marker="x", ms=4, mec=CROSS, label=one) for one in words)]


@dataclass(frozen=True, kw_only=True, eq=False)
class Shown:
    """What is drawn of a variable, over rows and columns of panels and their two sides, as far as there are such."""

    values: xarray.DataArray
    """NaN where there is none; of categories their places among the names."""
    marks: Marks
    label: str
    caption: Sequence[str]
    gaps: bool
    names: Sequence[str] = ()
    """What the places 0, 1, 2, ... of categories stand for; what follows is of values that are none."""
    unit: Unit | None = None
    ends: tuple[float, float] = (0.0, 1.0)
    """The least and the greatest value."""
    limits: tuple[float, float] = (-np.inf, np.inf)
    """Between which values lines and points are drawn; all of them where they are infinite."""
    log: bool = False
    levels: Levels | None = None
    band: Sequence[xarray.DataArray] = ()
    """The lower and the upper edge of a band, if there is one."""
    band_words: str = ""

    def at(self, place: Mapping[str, int]) -> "Shown":
        """Take what is in one panel."""
        marks = [(doubt, flags.isel(place)) for doubt, flags in self.marks]
        return replace(self, values=self.values.isel(place), marks=marks, band=[one.isel(place) for one in self.band])


def shown_of(dataset: xarray.Dataset, name: str, plan: Plan, selection: Selection, looks: Looks) -> Shown:
    """Take a variable of what is drawn of a dataset; it is refused without a value, or what is chosen that it lacks."""
    taken = selection.taken(dataset[name], dataset["status"])
    values = _over(taken.values, plan)
    values = values.where(np.isfinite(values))
    there = int(values.notnull().sum())
    axis, how = next(((axis, how) for axis, how in selection.over.items() if how.startswith("arg")), ("", ""))
    if not there:
        equal = f", or values that are equal along {axis}, so that no place is that of {how}" if axis else ""
        raise DatasetError(f"{name}: no value in any scene drawn{equal}; `gradhesion info` reports why")
    marks = marks_of(dataset, values, _over(taken.status, plan), name)
    if taken.at_end is not None and bool(taken.at_end.any()):
        marks.append((END, among(taken.at_end, values)))
    caption = [f"{counted(taken.left_out, 'failed scene')} left out"] if taken.left_out else []
    caption += [f"{taken.flat:,} left out where all values are equal"] if taken.flat else []
    own: dict[str, Any] = {"marks": marks, "caption": caption, "gaps": there + taken.flat < values.size}
    if name == "status" or parameters_of(dataset[name]):
        if not plan.is_map:
            looks.refuse(["ylim"], f"{name} is drawn as categories")
        places, names = _categories(values, parameters_of(dataset[name]))
        return Shown(values=places, names=names, label=label(name), **own)
    band, band_words = ((), "") if plan.is_map or plan.is_dense else _band_of(dataset, name, plan, selection, looks)
    all_of_it = np.stack([values, *band])
    least, greatest = float(np.nanmin(all_of_it)), float(np.nanmax(all_of_it))
    unit_from = axis or name
    limits = (-np.inf, np.inf) if plan.is_map else limits_of(looks.ylim, unit_from, *padded(least, greatest))
    ends = least if np.isinf(limits[0]) else limits[0], greatest if np.isinf(limits[1]) else limits[1]
    if not np.isfinite(limits).any() and padded(*ends) != ends:
        limits = padded(*ends)
    log = ends[0] > 0.0 and ends[1] >= (WIDE if plan.is_map else FAR) * ends[0]
    unit = unit_for(unit_from, ends, log=log)
    words = label(unit_from, unit)
    if axis:
        words += f" at {'maximum' if how == 'argmax' else 'minimum'} {SYMBOLS[name].split(' $')[0]}"
    if plan.is_map:
        whole = dataset[name].dtype.kind == "i" and bool((values.fillna(0.0) % 1.0 == 0.0).all())
        own["levels"] = _levels_of(unit_from, ends, looks, log=log, whole=whole)
    own |= {"ends": ends, "limits": limits, "log": log, "band": band, "band_words": band_words}
    return Shown(values=values, label=words, unit=unit, **own)


def _over(values: xarray.DataArray, plan: Plan) -> xarray.DataArray:
    """Put values over rows, columns and the sides of panels, as far as they have such axes."""
    places = plan.places[::-1]
    return values.squeeze([axis for axis in values.dims if axis not in places]).transpose(*places)


def _categories(values: xarray.DataArray, labels: Sequence[str]) -> tuple[xarray.DataArray, list[str]]:
    """Give places and names to the strongest of some parameters, or without any, to sets of flags."""
    codes = np.unique(values.values[values.notnull()]).astype(int)
    flags = ["\n+ ".join(name.replace("_", " ") for name, bit in FLAGS.items() if code & bit) for code in codes]
    names = [SYMBOLS[labels[code]] for code in codes] if labels else [own or "nothing to report" for own in flags]
    return values.copy(data=np.searchsorted(codes, values.values)).where(values.notnull()), names


def padded(least: float, greatest: float) -> tuple[float, float]:
    """Move the ends of values apart that are equal but for rounding."""
    if greatest - least > FLAT * max(abs(least), abs(greatest)):
        return least, greatest
    pad = 0.05 * max(abs(least), 1e-300)
    return least - pad, greatest + pad


def _levels_of(name: str, ends: tuple[float, float], looks: Looks, *, log: bool, whole: bool) -> Levels:
    """Choose round contour levels, rising by ratios where values differ much, those that have lines, and their colours.

    Those that are listed are taken as they are, with the ends of the values beyond them.
    """
    least, greatest = padded(*ends)
    if isinstance(looks.levels, tuple):
        option = f"--levels {','.join(looks.levels)}"
        listed = np.unique([value_in(word, name, option) for word in looks.levels])
        inner = listed[(listed >= least) & (listed <= greatest)]
        if not inner.size:
            drawn = between(least, greatest, name)
            raise DatasetError(f"{option}: none is among what is drawn, {drawn}; choose some between")
        levels = np.unique([*listed, *(end for end in (least, greatest) if not listed[0] <= end <= listed[-1])])
        log = levels[0] > 0.0 and levels[-1] > WIDE * levels[0]
        return levels, inner, (LogNorm if log else Normalize)(levels[0], levels[-1])
    if log:
        steps = next(steps for most, steps in _STEPS if greatest < most * least)
        finest: Locator = LogLocator(subs=steps, numticks=1000)
    else:
        finest = MaxNLocator(looks.levels or 11, steps=[1, 2, 2.5, 5, 10], integer=whole)
    rising = np.asarray(finest.tick_values(least, greatest))
    first = max(0, int(np.searchsorted(rising, least, side="right")) - 1)
    levels = rising[first : int(np.searchsorted(rising, greatest)) + 1]
    if looks.levels and levels.size > looks.levels + 1:  # ratios have steps of their own
        levels = levels[np.unique(np.linspace(0, levels.size - 1, looks.levels + 1).round().astype(int))]
    inner = levels[1:-1][1::2] if levels.size > 7 else levels[1:-1]  # the others show as edges of the bands
    return levels, inner, (LogNorm if log else Normalize)(levels[0], levels[-1])


def _band_of(
    dataset: xarray.Dataset, name: str, plan: Plan, selection: Selection, looks: Looks
) -> tuple[tuple[xarray.DataArray, ...], str]:
    """Find the band of a variable: what is asked for, else its quantiles, else its standard deviation; or none."""
    if selection.over:
        looks.refuse(["band"], f"{name} is taken over {next(iter(selection.over))}, and its spread is that of a scene")
    if selection.over or looks.band == "none":
        return (), ""
    plain, unit = name.removesuffix(SI), SI if name.endswith(SI) else ""
    stem = plain.removesuffix("_mean").removesuffix("_p50") if plain in SPREADS else plain
    for how, (endings, words) in BANDS.items():
        parts = [f"{stem}{ending}{unit}" for ending in endings]
        if looks.band in (None, how) and all(part in dataset for part in parts):
            value, *edges = (
                _over(selection.taken(dataset[one], dataset["status"]).values, plan) for one in (name, *parts)
            )
            return (tuple(edges) if how == "quantiles" else (value - edges[0], value + edges[0])), words
    if looks.band:
        remedy = "add [uncertainty] with samples = 1024 to its study, choose another variable, or leave --band out"
        raise DatasetError(f"--band {looks.band}: {name} has no such spread in this dataset; {remedy}")
    return (), ""
