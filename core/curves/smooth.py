"""The curve of the smooth punch, A = 0."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.curves.equilibrium import draw_named
from gradhesion.core.curves.subject import Subject


class Turns(NamedTuple):
    """Where smooth punches of some pull turn: at places (level pull)^root."""

    fold: float  # the level where d depth/dz = 0,
    zero: float  # where depth = 0,
    least: float  # and where d load/dz = 0
    root: float

    def place(self, level: float, pull: float) -> float:
        """Return the place of one of the levels, 0 where no adhesion pulls."""
        return float((level * max(0.0, pull)) ** self.root)

    def places(self, pulls: Sequence[float], end: float) -> NDArray[np.float64]:
        """Return all places of some pulls, in order, between 0 and an end."""
        places = np.unique([self.place(level, pull) for pull in pulls for level in self[:3]])
        kept: NDArray[np.float64] = places[(places > 0.0) & (places < end)]
        return kept


def turns_of(k: float) -> Turns:
    """Return where paraboloids turn, in the units of closed/smooth.py: X = z^((3+k)/2) is a level times the pull."""
    return Turns(0.5 * (1.0 - k), 2.0, 0.5 * (3.0 + k), 2.0 / (3.0 + k))


def draw_smooth(subject: Subject) -> dict[str, NDArray[np.float64]]:
    """Return the variables `smooth_...` (draw.CURVES): the punch without waviness, as far as other curves."""
    form = subject.plain(1.0)
    places = turns_of(subject.k).places((1.0,), subject.end / form.radius_scale)
    return draw_named(subject, form, places, "smooth")
