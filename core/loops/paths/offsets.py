"""The zeros of an instrument: which of depth and load are fitted, fixed or found beforehand, and a tilt of the load."""

from dataclasses import dataclass
from typing import Final, Literal

NAMES: Final = ("indentation_offset", "load_offset", "load_slope")
DEPTH_ZERO, LOAD_ZERO, TILT = NAMES
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
        return tuple(name for name, own in zip(NAMES, fitted, strict=True) if own)
