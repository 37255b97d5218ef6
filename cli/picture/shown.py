"""What is drawn of one variable: its values with their doubts and their spread, and between which levels."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import xarray
from matplotlib.colors import LogNorm, Normalize
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.selection import Selection
from gradhesion.cli.dataset.read.sensitivities import parameters_of
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.outputs import SI, SPREADS
from gradhesion.cli.names.symbols import SYMBOLS
from gradhesion.cli.picture.doubts import END, Marks, among, marks_of
from gradhesion.cli.picture.labels import Unit, label, unit_for
from gradhesion.cli.picture.looks import Looks
from gradhesion.cli.picture.plan import Plan
from gradhesion.core.answers.flags import FLAGS

Values = NDArray[np.float64]

FAR: Final = 50.0
"""The ratio of the greatest value to the least from which lines are drawn over a logarithm; contours do from 8."""

FLAT: Final = 1e-9
"""Values that differ by less, over their size, are drawn as equal: what is left is rounding."""

BAND_WORDS: Final = {"quantiles": "5 % to 95 % of samples", "std": "a standard deviation on each side"}
"""What a legend says of a band."""

_STEPS: Final = (
    (30, (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0)),
    (1e3, (1.0, 1.5, 2.0, 3.0, 5.0, 7.0)),
    (1e5, (1.0, 2.0, 5.0)),
    (np.inf, (1.0,)),
)
"""Levels in a decade, for values that differ by less than each factor."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Shown:
    """What is drawn of a variable, over rows and columns of panels and their two sides, as far as there are such."""

    values: xarray.DataArray
    """NaN where there is none; of categories their places among the names."""
    marks: Marks
    label: str
    unit: Unit
    names: tuple[str, ...] = ()
    """What the places 0, 1, 2, ... of categories stand for."""
    ends: tuple[float, float] = (0.0, 1.0)
    """The least and the greatest value."""
    limits: tuple[float, float] = (-np.inf, np.inf)
    """Between which values lines and points are drawn; all of them where they are infinite."""
    log: bool = False
    """Whether they are drawn over a logarithm."""
    band: tuple[xarray.DataArray, ...] = ()
    """The lower and the upper edge of a band, if there is one."""
    band_words: str = ""
    gaps: bool = False
    """Whether a scene has no value."""
    whole: bool = False
    """Whether they are counts."""
    caption: tuple[str, ...] = ()
    """What is to be known of the values."""

    def at(self, place: Mapping[str, int]) -> "Shown":
        """Take what is in one panel."""
        marks = [(doubt, flags.isel(place)) for doubt, flags in self.marks]
        own = {"values": self.values.isel(place), "marks": marks, "band": tuple(one.isel(place) for one in self.band)}
        return Shown(**(vars(self) | own))


def shown_of(dataset: xarray.Dataset, name: str, plan: Plan, selection: Selection, looks: Looks) -> Shown:
    """Take a variable of what is drawn of a dataset; it is refused without a value, or what is chosen that it lacks."""
    taken = selection.taken(dataset[name], dataset["status"])
    values, status = _over(taken.values, plan), _over(taken.status, plan)
    values = values.where(np.isfinite(values))
    finite = values.values[np.isfinite(values.values)]
    place = next(((axis, how) for axis, how in selection.over.items() if how.startswith("arg")), None)
    if not finite.size and taken.flat and place:
        raise DatasetError(
            f"{name}: its values along {place[0]} are equal, so that no place is that of {place[1]}; draw them instead"
        )
    if not finite.size:
        raise DatasetError(f"{name}: no value in any scene drawn; `gradhesion info` reports why")
    marks = marks_of(dataset, values, status, name)
    if taken.at_end is not None and bool(taken.at_end.any()):
        marks.append((END, among(taken.at_end, values)))
    failed = "scene" if taken.left_out == 1 else "scenes"
    caption = [f"{taken.left_out:,} failed {failed} left out"] if taken.left_out else []
    caption += [f"{taken.flat:,} left out where all values are equal"] if taken.flat else []
    found: dict[str, Any] = {
        "values": values,
        "marks": marks,
        "gaps": finite.size + taken.flat < values.size,
        "whole": dataset[name].dtype.kind == "i" and bool((finite == np.round(finite)).all()),
        "caption": tuple(caption),
    }
    labels = parameters_of(dataset[name])
    if labels or name == "status":
        codes = np.unique(finite)
        found["values"] = values.copy(data=np.searchsorted(codes, values.values)).where(values.notnull())
        found["names"] = tuple(SYMBOLS[labels[int(code)]] if labels else _flags(int(code)) for code in codes)
        if not plan.is_map:
            looks.refuse(["ylim"], f"{name} is drawn as categories")
        return Shown(label=label(name), unit=Unit(), **found)
    quantity = place[0] if place else name
    ends = float(finite.min()), float(finite.max())
    if plan.is_map:
        log = ends[0] > 0.0 and ends[1] > 8.0 * ends[0]
    else:
        if not plan.is_dense:
            found["band"], found["band_words"] = _band_of(dataset, name, plan, selection, looks)
            all_of_it = np.stack([values, *found["band"]])
            ends = float(np.nanmin(all_of_it)), float(np.nanmax(all_of_it))
        found["limits"] = looks.ylim.limits(quantity, *padded(*ends))
        low, high = found["limits"]
        ends = low if np.isfinite(low) else ends[0], high if np.isfinite(high) else ends[1]
        log = ends[0] > 0.0 and ends[1] >= FAR * ends[0]
    unit = unit_for(quantity, ends, log=log)
    words = label(quantity, unit)
    if place:
        words += f" at {'maximum' if place[1] == 'argmax' else 'minimum'} {SYMBOLS[name].split(' $')[0]}"
    return Shown(label=words, unit=unit, ends=ends, log=log, **found)


def _over(values: xarray.DataArray, plan: Plan) -> xarray.DataArray:
    """Put values over rows, columns and the sides of panels, as far as they have such axes."""
    places = plan.places[::-1]
    return values.squeeze([axis for axis in values.dims if axis not in places]).transpose(*places)


def _flags(code: int) -> str:
    """Name the flags of a status."""
    flags = [name.replace("_", " ") for name, bit in FLAGS.items() if code & bit]
    return "\n+ ".join(flags) or "nothing to report"


def padded(least: float, greatest: float) -> tuple[float, float]:
    """Move the ends of values apart that are equal but for rounding."""
    if greatest - least > FLAT * max(abs(least), abs(greatest)):
        return least, greatest
    pad = 0.05 * max(abs(least), 1e-300)
    return least - pad, greatest + pad


def levels_of(shown: Shown, looks: Looks) -> tuple[Values, Normalize]:
    """
    Choose round contour levels, rising by ratios where values differ much, and their colours.

    Those that are listed are taken as they are, with the ends of the values beyond them.
    """
    least, greatest = padded(*shown.ends)
    if isinstance(looks.levels, tuple):
        listed = np.array(looks.levels)
        if not ((listed >= least) & (listed <= greatest)).any():
            written = ",".join(f"{level:g}" for level in listed)
            between = f"{least:.4g} to {greatest:.4g}"
            raise DatasetError(
                f"--levels {written}: none is among the values, which are {between}; choose some between"
            )
        levels = np.unique([*listed, least, greatest])
        log = levels[0] > 0.0 and levels[-1] > 8.0 * levels[0]
        return levels, (LogNorm if log else Normalize)(levels[0], levels[-1])
    if shown.log:
        steps = next(steps for most, steps in _STEPS if greatest < most * least)
        decades = 10.0 ** np.arange(np.floor(np.log10(least)), np.ceil(np.log10(greatest)) + 1.0)
        rising = np.outer(decades, steps).ravel()
    else:
        round_ones = MaxNLocator(looks.levels or 11, steps=[1, 2, 2.5, 5, 10], integer=shown.whole)
        rising = np.asarray(round_ones.tick_values(least, greatest))
    first = max(0, int(np.searchsorted(rising, least, side="right")) - 1)
    levels = rising[first : int(np.searchsorted(rising, greatest)) + 1]
    if looks.levels and levels.size > looks.levels + 1:  # ratios have steps of their own
        levels = levels[np.unique(np.linspace(0, levels.size - 1, max(2, looks.levels + 1)).round().astype(int))]
    return levels, (LogNorm if shown.log else Normalize)(levels[0], levels[-1])


def _band_of(
    dataset: xarray.Dataset, name: str, plan: Plan, selection: Selection, looks: Looks
) -> tuple[tuple[xarray.DataArray, ...], str]:
    """Find the band of a variable: what is asked for, else its quantiles, else its standard deviation; or none."""
    if looks.band == "none":
        return (), ""
    if selection.over:
        looks.refuse(["band"], f"{name} is taken over {next(iter(selection.over))}, and its spread is that of a scene")
        return (), ""
    plain, unit = name.removesuffix(SI), SI if name.endswith(SI) else ""
    stem = plain.removesuffix("_mean").removesuffix("_p50") if plain in SPREADS else plain

    def taken(one: str) -> xarray.DataArray:
        return _over(selection.taken(dataset[one], dataset["status"]).values, plan)

    for how, endings in (("quantiles", ("_p05", "_p95")), ("std", ("_std",))):
        parts = [f"{stem}{ending}{unit}" for ending in endings]
        if looks.band in (None, how) and all(part in dataset for part in parts):
            edges = [taken(part) for part in parts]
            if how == "std":
                edges = [taken(name) - edges[0], taken(name) + edges[0]]
            return tuple(edges), BAND_WORDS[how]
    if looks.band:
        remedy = "add [uncertainty] with samples = 1024 to its study, choose another variable, or leave --band out"
        raise DatasetError(f"--band {looks.band}: {name} has no such spread in this dataset; {remedy}")
    return (), ""
