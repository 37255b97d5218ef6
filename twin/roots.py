"""All zeros of a tilt, proved complete by interval arithmetic, and the refinement of one bracketed zero."""

from collections.abc import Callable
from itertools import pairwise
from typing import Final

from flint import arb

from gradhesion.twin.curve import Control, Curve

NARROW: Final = arb(2) ** -140
"""Relative step at which Newton's iteration ends (42 digits)."""


def refine(f: Callable[[arb], tuple[arb, arb]], lo: arb, hi: arb) -> arb:
    """Return the one zero of f (given with its derivative) between lo and hi: Newton's iteration kept inside them."""
    rising = bool(f(hi)[0] > 0)
    z = ((lo + hi) / 2).mid()
    for _ in range(400):
        value, slope = f(z)
        if bool(value > 0) == rising:
            hi = z
        else:
            lo = z
        step = value.mid() / slope.mid() if slope.mid() != 0 else hi - lo
        new = (z - step).mid()
        if not (lo <= new <= hi):
            new = ((lo + hi) / 2).mid()
        if abs(new - z) <= NARROW * abs(new):
            return new
        z = new
    message = f"no convergence at z = {float(z)}"
    raise ArithmeticError(message)


def zeros(curve: Curve, control: Control, end: arb | None) -> list[arb]:
    """All zeros of the tilt of a control in (0, end], in order.

    Every piece of the grid is halved until the enclosure of the tilt, or of its derivative, excludes 0: then the piece
    has no zero, or at most one, which the signs at its ends decide.
    """
    found: list[arb] = []
    todo = list(pairwise(curve.grid(control, end)))[::-1]
    while todo:
        lo, hi = todo.pop()
        middle = ((lo + hi) / 2).mid()
        value, slope = curve.tilt(arb(middle, (hi - lo) / 2), control)
        if value > 0 or value < 0:
            continue
        if slope > 0 or slope < 0:
            left, right = curve.tilt(lo, control)[0], curve.tilt(hi, control)[0]
            if left * right < 0:
                found.append(refine(lambda z: curve.tilt(z, control), lo, hi))
            elif not left * right > 0:
                message = f"zero of the tilt at the end of a piece, z = {float(lo)}"
                raise ArithmeticError(message)
            continue
        if hi - lo < arb(2) ** -70 * hi:
            message = f"the folds at z = {float(middle)} cannot be told from a tangency"
            raise ArithmeticError(message)
        todo += [(middle, hi), (lo, middle)]
    return found


def extrema(curve: Curve, control: Control, end: arb | None) -> list[arb]:
    """Extrema of the tilt in the window, by sign changes of its slope on a grid (only margins rest on them)."""
    coarse = curve.grid(control, end)
    edges = [z for lo, hi in pairwise(coarse) for z in (lo, ((lo + hi) / 2).mid())] + coarse[-1:]
    slopes = [curve.tilt(z, control)[1] for z in edges]
    found: list[arb] = []
    for i in range(len(edges) - 1):
        if slopes[i] * slopes[i + 1] < 0:
            lo, hi, sign = edges[i], edges[i + 1], slopes[i] > 0
            for _ in range(40):
                middle = ((lo + hi) / 2).mid()
                lo, hi = (middle, hi) if bool(curve.tilt(middle, control)[1] > 0) == sign else (lo, middle)
            found.append(lo)
    return found
