"""What is drawn of one variable: its values, which of them may not hold, their spread, and between which levels."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final, NamedTuple

import numpy as np
import xarray
from matplotlib.artist import Artist
from matplotlib.colors import LogNorm, Normalize
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import Locator, LogLocator, MaxNLocator
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.model_range import DOUBTS as BITS
from gradhesion.cli.dataset.read.model_range import LIMITS, beyond_by, doubts_of
from gradhesion.cli.dataset.read.reductions import Taken
from gradhesion.cli.dataset.read.selection import Selection, value_in
from gradhesion.cli.dataset.read.sensitivities import parameters_of
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.outputs import BEST, ON_BOUND, SI, SPREADS
from gradhesion.cli.names.symbols import SYMBOLS
from gradhesion.cli.picture.labels import Values, padded
from gradhesion.cli.picture.looks import Looks, between, limits_of
from gradhesion.cli.picture.plan import Plan
from gradhesion.cli.terminal.amounts import counted
from gradhesion.core.answers.flags import FLAG_WORDS, FLAGS

Levels = tuple[Values, Values, Normalize]
"""All levels of a map, those that have lines, and what gives their colours."""
FAR: Final = 50.0
WIDE: Final = 8.0
"""The ratio of the greatest value to the least from which lines, and contours, are drawn over a logarithm."""
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
GAP: Final = "no finite value"


class Doubt(NamedTuple):
    """What makes a value doubtful: its pattern in a map, and its open marker, of a size that shows inside others."""

    words: str
    bit: int
    """Its flag; 0 if it is none."""
    hatch: str
    mark: str
    size: float

    def marker(self, colour: Any) -> dict[str, Any]:
        """Give the looks of its open marker."""
        return {"ls": "", "marker": self.mark, "ms": self.size, "mfc": "white", "mec": colour}


AT_END: Final = "at_end"
_WORDS: Final = (
    {name: (FLAG_WORDS[name], bit) for name, bit in FLAGS.items() if bit & BITS}
    | {name: (limit.words, 0) for name, limit in LIMITS.items()}
    | {ON_BOUND: ("optimum at a bound of its range", 0)}
    | {AT_END: ("extreme at an end of its axis: it may lie beyond", 0)}
)
_HATCHES: Final = ("////", "\\\\\\\\", "xxxx", "----", "||||", "oo", "OO", "++", "..", "**", "//..", "....")
_MARKS: Final = ("o", "s", "D", "v", "p", "P", "X", "*", "h", "8", ">", "^")
_SIZES: Final = (3.5, 5.5, 7.0, 8.0, 8.0, 6.0, 6.0, 6.0, 6.0, 6.0, 6.0, 4.5)
DOUBTS: Final = {
    name: Doubt(words, bit, hatch, mark, size)
    for (name, (words, bit)), hatch, mark, size in zip(_WORDS.items(), _HATCHES, _MARKS, _SIZES, strict=True)
}
"""Every doubt: by the flag, by the validity number beyond its limit, of an optimum, and of the place of an extreme."""


def doubts_in(status: NDArray[Any], variable: str, dataset: xarray.Dataset) -> list[Doubt]:
    """List the flags of some scenes of a dataset that cast doubt on a variable; none on `status` itself."""
    there = 0 if variable == "status" else np.bitwise_or.reduce(np.ravel(status).astype(np.int16), initial=0)
    return [doubt for doubt in DOUBTS.values() if doubt.bit & doubts_of(variable, dataset) & there]


def marks_of(dataset: xarray.Dataset, taken: Taken, name: str) -> list[tuple[Doubt, xarray.DataArray]]:
    """Mark the scenes of a variable that are in doubt, beyond a limit (a validity number: its own), or at a bound."""
    values, status = taken.values, taken.status
    there = doubts_in(status.where(values.notnull(), 0).values, name, dataset)
    found = [(doubt, (status & doubt.bit) != 0) for doubt in there]
    limits = [name] if name in LIMITS else [*LIMITS]
    found += [(DOUBTS[one], flags) for one in limits if (flags := beyond_by(one, dataset)) is not None]
    if ON_BOUND in dataset and name.startswith(BEST):  # of a parameter that was searched its own, else any
        meanings = str(dataset[ON_BOUND].attrs["flag_meanings"]).split()
        bounds = [one for one in meanings if one.startswith(f"{name.removeprefix(BEST)}_at_its_")] or meanings
        bits = sum(1 << meanings.index(one) for one in bounds)
        found.append((DOUBTS[ON_BOUND], (dataset[ON_BOUND].astype(int) & bits) != 0))
    if taken.at_end is not None:
        found.append((DOUBTS[AT_END], taken.at_end))
    found = [(doubt, flags.any([axis for axis in flags.dims if axis not in values.dims])) for doubt, flags in found]
    found = [(doubt, flags.drop_vars([*flags.coords]) & values.notnull()) for doubt, flags in found]
    return [(doubt, flags) for doubt, flags in found if flags.any()]


def entries(doubts: Sequence[Doubt], *, in_map: bool = False, gaps: bool = False) -> list[Artist]:
    """Make the entries of a legend: the doubts, and scenes without a value if there are such gaps."""
    made: list[Artist]
    if in_map:
        hatched: dict[str, Any] = {"facecolor": "none", "edgecolor": INK, "lw": 0.0}
        made = [Patch(hatch=doubt.hatch, label=doubt.words, **hatched) for doubt in doubts]
        gap: Artist = Patch(facecolor=GREY, label=GAP)
    else:
        made = [Line2D([], [], label=doubt.words, **doubt.marker(INK)) for doubt in doubts]
        gap = Line2D([], [], ls="", marker="x", ms=4, mec=CROSS, label=GAP)
    return [*made, gap] if gaps else made


@dataclass(frozen=True, kw_only=True, eq=False)
class Shown:
    """What is drawn of a variable; its arrays are over rows and columns of panels and their two sides, as of `Plan`."""

    name: str
    """The variable, or the axis whose places of an extreme are drawn."""
    after: str = ""
    """What stands behind its name: of which variable the extreme is."""
    values: Values
    """NaN where there is none; of categories their places among the names."""
    marks: Sequence[tuple[Doubt, NDArray[np.bool_]]]
    """Doubts, each with the scenes that have it."""
    caption: Sequence[str]
    gaps: bool
    names: Sequence[str] = ()
    """What the places 0, 1, 2, ... of categories stand for; what follows is of values that are none."""
    ends: tuple[float, float] = (0.0, 1.0)
    """The least and the greatest value, of those between the limits of lines and points."""
    log: bool = False
    levels: Levels | None = None
    band: Sequence[Values] = ()
    """The lower and the upper edge of a band, if there is one."""
    band_words: str = ""


def shown_of(dataset: xarray.Dataset, name: str, plan: Plan, selection: Selection, looks: Looks) -> Shown:
    """Take a variable of what is drawn of a dataset; it is refused without a value, or what is chosen that it lacks."""
    taken = selection.taken(dataset[name], dataset["status"])
    values = plan.arrange(taken.values).astype(float)
    count = np.count_nonzero(np.isfinite(values))
    axis, how = next(((axis, how) for axis, how in selection.over.items() if how.startswith("arg")), ("", ""))
    if not count:
        equal = f", or values that are equal along {axis}, so that no place is that of {how}" if axis else ""
        raise DatasetError(f"{name}: no value in any scene drawn{equal}; `gradhesion info` reports why")
    caption = [f"{counted(taken.left_out, 'failed scene')} left out"] if taken.left_out else []
    caption += [f"{taken.flat:,} left out where all values are equal"] if taken.flat else []
    own: dict[str, Any] = {"caption": caption, "gaps": count + taken.flat < values.size}
    own["marks"] = [(doubt, plan.arrange(flags)) for doubt, flags in marks_of(dataset, taken, name)]
    labels = parameters_of(dataset[name])
    if name == "status" or labels:
        if not plan.is_map:
            looks.refuse(["ylim"], f"{name} is drawn as categories")
        codes = np.unique(values[np.isfinite(values)]).astype(int)
        flags = ["\n+ ".join(flag.replace("_", " ") for flag, bit in FLAGS.items() if code & bit) for code in codes]
        names = [SYMBOLS[labels[code]] for code in codes] if labels else [one or "nothing to report" for one in flags]
        places = np.where(np.isfinite(values), np.searchsorted(codes, values), np.nan)
        return Shown(name=name, values=places, names=names, **own)
    if axis:
        own["after"] = f" at {'maximum' if how == 'argmax' else 'minimum'} {SYMBOLS[name].split(' $')[0]}"
    of = axis or name
    band, words = ((), "") if plan.is_map or plan.is_dense else _band_of(dataset, name, values, plan, selection, looks)
    least, greatest = (float(end(np.stack([values, *band]))) for end in (np.nanmin, np.nanmax))
    if plan.is_map:
        whole = dataset[name].dtype.kind == "i" and bool((np.nan_to_num(values) % 1.0 == 0.0).all())
        own["levels"] = _levels_of(of, *padded(least, greatest), looks, whole=whole)
    else:
        low, high = limits_of(looks.ylim, of, *padded(least, greatest))
        least, greatest = max(least, low), min(greatest, high)
    log = _differ(least, greatest, WIDE if plan.is_map else FAR)
    return Shown(name=of, values=values, ends=(least, greatest), log=log, band=band, band_words=words, **own)


def _differ(least: float, greatest: float, ratio: float) -> bool:
    """Report whether positive values differ by so much that their logarithm is drawn."""
    return least > 0.0 and greatest >= ratio * least


def _levels_of(name: str, least: float, greatest: float, looks: Looks, *, whole: bool) -> Levels:
    """Choose round contour levels, rising by ratios where values differ much, those that have lines, and their colours.

    Those that are listed are taken as they are, with the ends of the values beyond them.
    """
    if isinstance(looks.levels, tuple):
        option = f"--levels {','.join(looks.levels)}"
        listed = np.unique([value_in(word, name, option) for word in looks.levels])
        inner = listed[(listed >= least) & (listed <= greatest)]
        if not inner.size:
            drawn = between(least, greatest, name)
            raise DatasetError(f"{option}: none is among what is drawn, {drawn}; choose some between")
        levels = np.unique([*listed, *(end for end in (least, greatest) if not listed[0] <= end <= listed[-1])])
        log = _differ(levels[0], levels[-1], WIDE)
    else:
        log = _differ(least, greatest, WIDE)
        finest: Locator = MaxNLocator(looks.levels or 11, steps=[1, 2, 2.5, 5, 10], integer=whole)
        if log:
            finest = LogLocator(subs=next(steps for most, steps in _STEPS if greatest < most * least), numticks=1000)
        rising = np.asarray(finest.tick_values(least, greatest))
        first = max(0, int(np.searchsorted(rising, least, side="right")) - 1)
        levels = rising[first : int(np.searchsorted(rising, greatest)) + 1]
        if looks.levels and levels.size > looks.levels + 1:  # ratios have steps of their own
            levels = levels[np.unique(np.linspace(0, levels.size - 1, looks.levels + 1).round().astype(int))]
        inner = levels[1:-1][1::2] if levels.size > 7 else levels[1:-1]  # the others show as edges of the bands
    return levels, inner, (LogNorm if log else Normalize)(levels[0], levels[-1])


def _band_of(
    dataset: xarray.Dataset, name: str, values: Values, plan: Plan, selection: Selection, looks: Looks
) -> tuple[list[Values], str]:
    """Find the band of a variable: what is asked for, else its quantiles, else its standard deviation; or none."""
    if selection.over:
        looks.refuse(["band"], f"{name} is taken over {next(iter(selection.over))}, and its spread is that of a scene")
    if selection.over or looks.band == "none":
        return [], ""
    plain, unit = name.removesuffix(SI), SI if name.endswith(SI) else ""
    stem = plain.removesuffix("_mean").removesuffix("_p50") if plain in SPREADS else plain
    for how, (endings, words) in BANDS.items():
        parts = [f"{stem}{ending}{unit}" for ending in endings]
        if looks.band in (None, how) and all(part in dataset for part in parts):
            edges = [plan.arrange(selection.taken(dataset[one], dataset["status"]).values) for one in parts]
            return edges if how == "quantiles" else [values - edges[0], values + edges[0]], words
    if looks.band:
        remedy = "add [uncertainty] with samples = 1024 to its study, choose another variable, or leave --band out"
        raise DatasetError(f"--band {looks.band}: {name} has no such spread in this dataset; {remedy}")
    return [], ""
