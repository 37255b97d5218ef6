"""Where a cycle turns at a depth or a load: the first place on the way of loading that has it.

Loading stays on each branch that it visits from where a jump arrives to where the next one leaves. Depth and load are
searched there piece by piece, between the extrema of the load; a value that a jump passes turns the cycle at its end.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

from flint import arb

from gradhesion.twin.curve import Control, Curve
from gradhesion.twin.path import Branch, branches, crossing
from gradhesion.twin.roots import refine, zeros

TURNS: Final = ("indentation_max_over_R", "load_max")


@dataclass(frozen=True)
class Turn:
    """The phase at which a cycle turns: 0 without contact, None at the rim, or never.

    `margin` is the least distance of the target from a value at which the place steps, over the size of both;
    `condition` the relative change of the radius for one of the target's terms, 0 where the place is that of a jump.
    """

    place: arb | None
    margin: float
    condition: float


class Measured:
    """The depth, or the load, along a curve."""

    def __init__(self, curve: Curve, turn: str) -> None:
        """Choose what is measured; loads are in 1.5 pi."""
        self.curve, self.by_load = curve, turn == "load_max"
        self.control = Control(arb(0), arb(1)) if self.by_load else Control(arb(1), arb(0))

    def value(self, z: arb) -> arb:
        """Return it at a phase."""
        return self.curve.force(z) / (3 * arb.pi() / 2) if self.by_load else self.curve.delta(z)

    def size(self, z: arb) -> float:
        """Return the size of its terms."""
        if self.by_load:
            return float(self.curve.force_size(z) / (3 * arb.pi() / 2))
        return self.curve.depth_size(z)

    def rate(self, z: arb) -> arb:
        """Return its derivative in z: a central difference of 25 digits, which is enough for Newton's method."""
        step = z * arb(2) ** -60
        return (self.value(z + step) - self.value(z - step)) / (2 * step)

    def pieces(self, low: arb, high: arb) -> list[arb]:
        """Return places between two phases, both included, between which it has no extremum."""
        inside = [z for z in zeros(self.curve, self.control, high) if low < z < high] if self.by_load else []
        return [low, *inside, high]

    def place_of(self, target: arb, low: arb, high: arb) -> arb:
        """Return where it rises through a target between two phases."""
        f: Callable[[arb], tuple[arb, arb]] = lambda z: (self.value(z) - target, self.rate(z))  # noqa: E731
        return refine(f, low, high)


def turning(curve: Curve, turn: str, target: float) -> Turn:
    """Find where a cycle turns."""
    measured, wanted = Measured(curve, turn), arb(target)
    if turn == TURNS[0] and target < 0.0:
        return Turn(arb(0), min(1.0, -target / (measured.size(_first_place(curve)) or -target)), 0.0)
    margins = [1.0]
    if turn == TURNS[0]:
        margins.append(target / (measured.size(_first_place(curve)) or target))
    level = arb(0)
    for branch in branches(curve, zeros(curve, curve.fold, curve.rim)):
        if branch.top is not None and not branch.top > level:
            continue
        arrival = branch.lo if branch.bottom == level else crossing(curve, branch, level)
        places = measured.pieces(arrival, _end(branch, measured, wanted))
        values = [measured.value(z) for z in places]
        if branch.hi is not None and branch.hi is not curve.rim:
            best = max(range(len(places)), key=lambda i: float(values[i]))
            margins.append(abs(float(values[best] - wanted)) / measured.size(places[best]))
        if values[0] >= wanted or abs(float(values[0] - wanted)) < 1e-40 * measured.size(arrival):
            return Turn(arrival, min(margins), 0.0)
        for (low, _), (high, value) in pairwise(zip(places, values, strict=True)):
            if value >= wanted:
                z = measured.place_of(wanted, low, high)
                return Turn(z, min(margins), measured.size(z) / float(z * abs(measured.rate(z))))
        if branch.top is None:
            break
        level = branch.top
    return Turn(None, min(margins), 0.0)


def _first_place(curve: Curve) -> arb:
    """Return where the first branch is met at the coordinate 0, or the rim."""
    for branch in branches(curve, zeros(curve, curve.fold, curve.rim)):
        if branch.top is None or branch.top > 0:
            return branch.lo if branch.bottom == 0 else crossing(curve, branch, arb(0))
    assert curve.rim is not None
    return curve.rim


def _end(branch: Branch, measured: Measured, target: arb) -> arb:
    """Return the end of a branch, or for one that has none a place where the target is exceeded."""
    if branch.hi is not None:
        return branch.hi
    high = 2 * branch.lo + 1
    while not measured.value(high) > target:
        high = 2 * high
    return high
