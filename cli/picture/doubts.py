"""Scenes whose value is there and may not hold, and how a picture shows them: by hatches in maps, by open markers."""

from collections.abc import Sequence
from typing import Any, Final, NamedTuple

import numpy as np
import xarray
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from gradhesion.cli.dataset.read import model_range
from gradhesion.cli.dataset.read.model_range import LIMITS, beyond_by, doubts_of
from gradhesion.cli.names.outputs import BEST, ON_BOUND
from gradhesion.core.answers.flags import FLAG_WORDS, FLAGS

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


_OF_FLAGS: Final = (
    ("////", "o", 3.5),
    ("\\\\\\\\", "s", 5.5),
    ("xxxx", "D", 7.0),
    ("----", "v", 8.0),
    ("||||", "p", 8.0),
)
_OF_LIMITS: Final = (("oo", "P", 6.0), ("OO", "X", 6.0), ("++", "*", 6.0), ("..", "h", 6.0), ("**", "8", 6.0))
_FLAGS: Final = {FLAG_WORDS[name]: bit for name, bit in FLAGS.items() if bit & model_range.DOUBTS}
DOUBTS: Final = [Doubt(words, *look, bit) for (words, bit), look in zip(_FLAGS.items(), _OF_FLAGS, strict=True)]
"""Every flag that makes values doubtful."""
BEYOND: Final = {
    name: Doubt(limit.words, *look) for (name, limit), look in zip(LIMITS.items(), _OF_LIMITS, strict=True)
}
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
    """Mark the scenes of what is drawn of a variable that are in doubt, beyond the range of the model, or at a bound.

    A validity number shows its own limit alone. What is taken over an axis is marked if any scene on it is; what has no
    value is not.
    """
    there = doubts_in(status.where(values.notnull(), 0).values, name, dataset)
    found = [(doubt, (status & doubt.bit) != 0) for doubt in there]
    limits = {number: beyond_by(number, dataset) for number in BEYOND if name not in BEYOND or number == name}
    found += [(BEYOND[number], flags) for number, flags in limits.items() if flags is not None]
    if ON_BOUND in dataset and name.startswith(BEST):  # of a parameter that was searched its own, else any
        meanings = str(dataset[ON_BOUND].attrs["flag_meanings"]).split()
        own = [one for one in meanings if one.startswith(f"{name.removeprefix(BEST)}_at_its_")] or meanings
        bits = sum(1 << meanings.index(one) for one in own)
        found.append((BOUND, (dataset[ON_BOUND].astype(int) & bits) != 0))
    return [(doubt, own) for doubt, flags in found if bool((own := among(flags, values)).any())]


def among(flags: xarray.DataArray, values: xarray.DataArray) -> xarray.DataArray:
    """Give flags over the axes of what is drawn, where it has values."""
    flags = flags.any([axis for axis in flags.dims if axis not in values.dims])
    return (flags.drop_vars([*flags.coords]) & values.notnull()).transpose(*values.dims)


def entries(doubts: Sequence[Doubt], *, in_map: bool = False, gaps: bool = False) -> list[Patch | Line2D]:
    """Make the entries of a legend: the doubts, and scenes without a value if there are such gaps."""
    words = "no finite value"
    if in_map:
        hatched: dict[str, Any] = {"facecolor": "none", "edgecolor": INK, "lw": 0.0}
        patches = [Patch(hatch=doubt.hatch, label=doubt.words, **hatched) for doubt in doubts]
        return [*patches, *([Patch(facecolor=GREY, label=words)] if gaps else [])]
    marks = [Line2D([], [], label=doubt.words, **doubt.marker(INK)) for doubt in doubts]
    return [*marks, *([Line2D([], [], ls="", marker="x", ms=4, mec=CROSS, label=words)] if gaps else [])]
