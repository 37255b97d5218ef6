"""Scenes whose value is there and may not hold, and how a picture shows them."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import xarray
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from gradhesion.cli.dataset.read import doubtful
from gradhesion.cli.dataset.read.doubtful import doubts_of
from gradhesion.cli.dataset.read.model_range import LIMITS
from gradhesion.cli.names.outputs import BEST, ON_BOUND
from gradhesion.core.answers.flags import FLAG_WORDS, FLAGS

INK: Final = "0.25"
"""The colour of marks in a legend."""

GREY: Final = "0.8"
CROSS: Final = "0.6"
"""The colours of scenes that have no value, in a map and as crosses."""


@dataclass(frozen=True, kw_only=True)
class Doubt:
    """A flag that makes a value doubtful, with its looks."""

    bit: int
    words: str
    hatch: str
    """Its pattern in a map."""
    mark: str
    """Its open marker in a line or among points."""
    size: float
    """That of the marker: all can be seen one in the other."""

    def marks(self, status: NDArray[Any]) -> NDArray[np.bool_]:
        """Report which scenes have the flag."""
        flags: NDArray[np.bool_] = (status.astype(np.int16) & self.bit) != 0
        return flags


def _doubts() -> tuple[Doubt, ...]:
    """Give each flag that makes values doubtful a look of its own."""
    flags = [(name, bit) for name, bit in FLAGS.items() if bit & doubtful.DOUBTS]
    looks = (("////", "o", 3.5), ("\\\\\\\\", "s", 5.5), ("xxxx", "D", 7.0), ("----", "v", 8.0), ("||||", "p", 8.0))
    return tuple(
        Doubt(bit=bit, words=FLAG_WORDS[name], hatch=hatch, mark=mark, size=size)
        for (name, bit), (hatch, mark, size) in zip(flags, looks, strict=True)
    )


DOUBTS: Final = _doubts()
"""Every flag that makes values doubtful."""


def doubts_in(status: NDArray[Any], variable: str, *, turned: bool = False) -> list[Doubt]:
    """List the doubts that some scenes cast on a variable; none on `status` itself."""
    if variable == "status":
        return []
    return [doubt for doubt in DOUBTS if doubt.bit & doubts_of(variable, turned=turned) and doubt.marks(status).any()]


END: Final = Doubt(bit=0, words="extreme at an end of its axis: it may lie beyond", hatch="....", mark="^", size=4.5)
"""How the place of an extreme is shown that is no extreme of a wider axis, perhaps."""

BEYOND: Final = {
    name: Doubt(bit=0, words=limit.words, hatch=hatch, mark=mark, size=6.0)
    for (name, limit), (hatch, mark) in zip(
        LIMITS.items(), (("oo", "P"), ("OO", "X"), ("++", "*"), ("..", "h"), ("**", "8")), strict=True
    )
}
"""How scenes are shown that leave the range of the model, by the validity number that says so."""

BOUND: Final = Doubt(bit=0, words="optimum at a bound of its range", hatch="//..", mark=">", size=6.0)
"""How an optimum is shown that would be better beyond a bound of what was searched, perhaps."""

BAND_WORDS: Final = {"quantiles": "5 % to 95 % of samples", "std": "a standard deviation on each side"}
"""What a legend says of a band."""

GAP: Final = "no finite value"
"""What a legend says of scenes without a value."""

ORDER: Final = (*(doubt.words for doubt in (*DOUBTS, *BEYOND.values(), END, BOUND)), GAP, *BAND_WORDS.values())
"""The order of the entries of a legend."""


def at_bound(dataset: xarray.Dataset, name: str) -> xarray.DataArray | None:
    """
    Report which scenes have an optimum at a bound: of a parameter that was searched at its own, else at any.

    None where the dataset has no optima, or the variable is not of them.
    """
    if ON_BOUND not in dataset or not name.startswith(BEST):
        return None
    flags = dataset[ON_BOUND]
    meanings = str(flags.attrs["flag_meanings"]).split()
    own = [one for one in meanings if one.startswith(f"{name.removeprefix(BEST)}_at_its_")] or meanings
    return (flags.astype(int) & sum(1 << meanings.index(one) for one in own)) != 0


def entries(doubts: Sequence[Doubt], *, in_map: bool, gaps: bool) -> list[Patch | Line2D]:
    """Make the entries of a legend: the doubts, and scenes without a value if there are such gaps."""
    made: list[Patch | Line2D] = []
    for doubt in doubts:
        if in_map:
            made.append(Patch(facecolor="none", edgecolor=INK, lw=0.0, hatch=doubt.hatch, label=doubt.words))
        else:
            made.append(
                Line2D([], [], ls="", marker=doubt.mark, ms=doubt.size, mfc="white", mec=INK, label=doubt.words)
            )
    if gaps and in_map:
        made.append(Patch(facecolor=GREY, label=GAP))
    elif gaps:
        made.append(Line2D([], [], ls="", marker="x", ms=4, mec=CROSS, label=GAP))
    return made
