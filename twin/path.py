"""The way of a contact along its equilibrium curve: rising branches, jumps between them.

Loading holds at the running maximum of the coordinate Y from a = 0 outwards, unloading at the running minimum from the
rim inwards; a jump keeps Y and crosses all radii where the curve lies off that level. Y is delta if that is prescribed.
"""

from dataclasses import dataclass

from flint import arb

from gradhesion.twin.curve import Curve
from gradhesion.twin.roots import refine, zeros


@dataclass(frozen=True)
class Branch:
    """A rising piece of Y(z) from `lo` to `hi`; the outermost may end at the rim, or never (`hi` None)."""

    lo: arb
    hi: arb | None
    bottom: arb
    top: arb | None


@dataclass(frozen=True)
class Jump:
    """A jump at constant Y = `level`."""

    start: arb
    end: arb
    level: arb


@dataclass(frozen=True)
class Path:
    """One cycle: its jumps, the largest Y, and Y where contact is lost, each with the phase where it is met."""

    loading: list[Jump]
    unloading: list[Jump]
    largest: arb
    lowest: arb
    deepest: arb
    last: arb


def branches(curve: Curve, folds: list[arb]) -> list[Branch]:
    """Rising branches in order; Y falls at first for k < 1 and may rise from a = 0 at k = 1."""
    ends = [arb(0), *folds] if curve.starts_rising else folds
    made: list[Branch] = []
    for i in range(0, len(ends), 2):
        lo, hi = ends[i], ends[i + 1] if i + 1 < len(ends) else curve.rim
        made.append(Branch(lo, hi, curve.coordinate(lo), None if hi is None else curve.coordinate(hi)))
    return made


def ends_at_rim(curve: Curve, made: list[Branch]) -> bool:
    """Whether the rim (or infinity) lies on a rising branch, and is stable."""
    return bool(made) and (made[-1].hi is None or made[-1].hi is curve.rim)


def crossing(curve: Curve, branch: Branch, level: arb) -> arb:
    """Return the phase where a rising branch has Y = level."""
    hi = branch.hi
    if hi is None:
        hi = 2 * branch.lo + 1
        while not curve.coordinate(hi) > level:
            hi = 2 * hi
    return refine(lambda z: (curve.coordinate(z) - level, curve.slope(z)), branch.lo, hi)


def load(curve: Curve, made: list[Branch]) -> tuple[list[Jump], arb, arb]:
    """Return the jumps from a = 0, Y = 0 to full contact, the largest Y on the way, and its phase."""
    jumps: list[Jump] = []
    at, level = arb(0), arb(0)
    for branch in made:
        if branch.top is not None and not branch.top > level:
            continue
        if not (branch.lo == 0 and branch.bottom == level):  # without adhesion contact grows from a point
            jumps.append(Jump(at, crossing(curve, branch, level), level))
        if branch.hi is None or branch.top is None:
            return jumps, arb("inf"), arb("inf")
        at, level = branch.hi, branch.top
    if not ends_at_rim(curve, made) or at != curve.rim:
        assert curve.rim is not None
        jumps.append(Jump(at, curve.rim, level))
        if level == 0:
            at = curve.rim
    return jumps, level, at


def unload(curve: Curve, made: list[Branch]) -> tuple[list[Jump], arb, arb]:
    """Return the jumps from full contact to a = 0, Y where contact is lost, and its phase."""
    jumps: list[Jump] = []
    inner = list(made)
    if ends_at_rim(curve, made):
        branch = inner.pop()
        at, level = branch.lo, branch.bottom
    else:
        assert curve.rim is not None
        at, level = curve.rim, curve.coordinate(curve.rim)
    while inner:
        branch = inner.pop()
        if branch.bottom < level:
            jumps.append(Jump(at, crossing(curve, branch, level), level))
            at, level = branch.lo, branch.bottom
    if at != 0:  # at k = 1 the contact may have shrunk to a point
        jumps.append(Jump(at, arb(0), level))
    return jumps, level, at


def cycle(curve: Curve) -> tuple[Path, list[Branch]]:
    """Return the whole cycle and the branches it rests on."""
    made = branches(curve, zeros(curve, curve.fold, curve.rim))
    loading, largest, deepest = load(curve, made)
    unloading, lowest, last = unload(curve, made)
    return Path(loading, unloading, largest, lowest, deepest, last), made


def pull_off(curve: Curve) -> tuple[arb, arb, list[arb]]:
    """Return the pull-off force -min P, its phase, and -P at every candidate (the minima of P, and the rim)."""
    found = zeros(curve, curve.trough, curve.rim)[::2]  # P falls at first, so minima come first
    if curve.rim is not None:
        found.append(curve.rim)
    forces = [-curve.force(z) for z in found]
    best = max(range(len(found)), key=lambda i: float(forces[i]))
    for i, force in enumerate(forces):
        best = i if force > forces[best] else best
    return forces[best], found[best], forces
