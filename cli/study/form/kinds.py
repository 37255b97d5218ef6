"""The kinds of a study: a map has one value a scene, a curve study one curve, an optimum the best of many scenes."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from gradhesion.cli.names.curves import CURVES, RAGGED
from gradhesion.cli.names.outputs import OUTPUTS


@dataclass(frozen=True, kw_only=True)
class Kind:
    """What studies of one kind have in common before anything is computed."""

    name: str
    outputs: tuple[str, ...]
    """All that can be asked for."""
    most_scenes: int
    remedy: str
    """What to do about more."""
    has_parts: bool
    """Whether finished blocks are kept, so that an interrupted run resumes where it stopped."""
    has_solver: bool
    """Whether the study chooses how its scenes are solved."""

    def variables(self, requested: Sequence[str]) -> tuple[str, ...]:
        """Give the variables that are asked for, in the order of the dataset."""
        return tuple(output for output in self.outputs if output in requested)


class _Curves(Kind):
    """Curves are asked for by name, or by their variables."""

    def variables(self, requested: Sequence[str]) -> tuple[str, ...]:
        """Give the variables asked for: a curve stands for all of its own, and a ragged one needs its count."""
        counts = {RAGGED[curve] for curve, own in CURVES.items() if curve in RAGGED and own.keys() & {*requested}}
        wanted = {*requested} | counts
        return tuple(name for curve, own in CURVES.items() for name in own if curve in requested or name in wanted)


PARETO: Final = Kind(
    name="pareto",
    outputs=(),
    most_scenes=100_000,  # each has hundreds of points, and all are in memory
    remedy="use fewer values, or split the study",
    has_parts=False,
    has_solver=True,
)
"""Optima of two outputs: the best compromises, as many as there are."""

KINDS: Final[dict[str, Kind]] = {
    "map": Kind(
        name="map",
        outputs=tuple(OUTPUTS),
        most_scenes=2**31,  # beyond it a dataset can no longer be handled as one file
        remedy="use fewer values, or split the study",
        has_parts=True,
        has_solver=True,
    ),
    "curve": _Curves(
        name="curve",
        outputs=tuple(dict.fromkeys((*CURVES, *(name for own in CURVES.values() for name in own)))),
        most_scenes=1_000,  # curves are for looking at, and each has thousands of values
        remedy='use fewer values, split the study, or write kind = "map"',
        has_parts=False,
        has_solver=False,
    ),
    "fit": Kind(  # a study of its own form (cli/study/fit)
        name="fit",
        outputs=(),
        most_scenes=1,
        remedy="fit one loop per study",
        has_parts=False,
        has_solver=False,
    ),
    "optimum": Kind(
        name="optimum",
        outputs=(),
        most_scenes=2**31,
        remedy="use fewer values, or split the study",
        has_parts=True,
        has_solver=True,
    ),
}
"""Every kind, by the word in a study."""
