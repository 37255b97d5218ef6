"""What is fitted to a loop beside its parameters, the zeros of the instrument, and the results."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Literal

from gradhesion.core.loops.measured.features import BaseLine, ContactPoint
from gradhesion.core.types import Floats

OFFSETS: Final = ("indentation_offset", "load_offset", "load_slope")
DEPTH_ZERO, LOAD_ZERO, TILT = OFFSETS
"""What is added to a path: to its depth (m), to its load (N), and to its load for each metre of depth (N/m)."""


@dataclass(frozen=True, kw_only=True)
class Offsets:
    """What is added to the path of a loop before it is compared with the points.

    measured depth = depth + indentation_offset, measured load = load + load_offset + load_slope * measured depth.

    indentation   "free" within the span of the depths, searched from low to high (m), at the "contact" point that is
                  found beforehand, or False: the zero of depth is right
    load          "free" within the spread of the base line and the pull-off force, searched from low to high (N), or
                  False
    slope         whether the base line is tilted

    Examples
    --------
    >>> Offsets().names
    ('indentation_offset', 'load_offset')
    >>> Offsets(indentation="contact", load=(-1e-9, 1e-9), slope=True).names
    ('load_offset', 'load_slope')
    """

    indentation: Literal["free", "contact", False] | tuple[float, float] = "free"
    load: Literal["free", False] | tuple[float, float] = "free"
    slope: bool = False

    @property
    def names(self) -> tuple[str, ...]:
        """What is fitted, in the order of a fit."""
        fitted = (self.indentation not in ("contact", False), self.load is not False, self.slope)
        return tuple(name for name, own in zip(OFFSETS, fitted, strict=True) if own)


@dataclass(frozen=True, kw_only=True, eq=False)
class OtherMinimum:
    """Another minimum that the noise allows: its values by name, and its sum of squares."""

    values: dict[str, float]
    chi_square: float


@dataclass(frozen=True, kw_only=True, eq=False)
class FittedLoop:
    """The result of a fit to a loop."""

    names: tuple[str, ...]
    """The free parameters in their order, then those of `OFFSETS` that are fitted."""
    values: dict[str, float]
    standard_deviations: dict[str, float]
    low: dict[str, float]
    high: dict[str, float]
    """By name; low and high bound the 95 % interval, of the linear problem (of its logarithm where that is searched) or
    by profile likelihood; never beyond the range that was searched."""
    ranges: dict[str, tuple[float, float]]
    """What was searched, by name."""
    correlation: Floats
    """Of all of them, a square in the order of the names."""
    on_bound: tuple[str, ...]
    """The names whose values are within 1 % of their range of one of its ends."""
    chi_square: float
    degrees_of_freedom: int
    """The sum of squares of the residual, and the number of points less that of fitted values."""
    residual: Floats
    """The signed distance of every point to the path, in standard deviations of the noise."""
    loading: Floats
    unloading: Floats
    """The vertices of the path, offsets included: rows of depth in m and load in N."""
    converged: bool
    """Whether the last refinement converged."""
    status: int
    """What `solve` reports of the fitted cycle, with `POOR_FIT` and `ANOTHER_MINIMUM`."""
    others: tuple[OtherMinimum, ...] = ()
    """Other minima that the noise allows, the best first."""
    alike: tuple[str, ...] = ()
    """Sentences: other models that would explain the data as well."""
    base_line: BaseLine | None = None
    """The line of no load of the data, if they have one."""
    contact: ContactPoint | None = None
    """The contact point at which the zero of depth was fixed, if requested."""
    turning_radius: float = math.nan
    """The radius a/R at which the fitted cycle turns."""
    widening: float = 1.0
    """By what deviations and intervals are widened where the noise was estimated: the root of the reduced chi square,
    if that is above 1."""

    @property
    def reduced_chi_square(self) -> float:
        """The sum of squares per degree of freedom: near 1 where model and noise are right."""
        return self.chi_square / self.degrees_of_freedom


class CannotTellApartError(ValueError):
    """The free parameters have the same effect; `names` lists those that a loop does not determine separately."""

    def __init__(self, names: Sequence[str]) -> None:
        self.names = tuple(names)
        listed = f"{', '.join(names[:-1])} and {names[-1]}"
        super().__init__(f"a loop cannot tell {listed} apart; give one of them as a number")


def poor_from(degrees: int) -> float:
    """Return the reduced chi square above which a fit is poor: max(1.5, 1 + 10 sqrt(2/degrees)).

    Examples
    --------
    >>> poor_from(10_000), round(poor_from(50), 3)
    (1.5, 3.0)
    """
    return max(1.5, 1.0 + 10.0 * math.sqrt(2.0 / degrees))
