"""All zeros of a tilt, proved complete by interval arithmetic, and the refinement of one bracketed zero."""

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Final

from flint import arb

from gradhesion.twin.curve import Curve

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


def window(curve: Curve, c: arb) -> tuple[arb, arb]:
    """Phases z0 < z1 with no zero of the tilt below z0 or above z1.

    Below: |V| <= V(0) = 2/(1+k), so the tilt is negative while (b + g V(0)) z^p < c. Above: with alpha = (k-1)/2,
    |V| <= 2/z^2 + 2^alpha G(1+alpha) z^(-1-alpha) (1 + (2+alpha)/z) from steepest descent, and the tilt is positive.
    """
    b, p = 2 / (1 + float(curve.k)), (3 + float(curve.k)) / 2
    alpha, g, level = (float(curve.k) - 1) / 2, float(curve.waviness), float(c)
    low = 0.999 * (level / (b * (1 + g))) ** (1 / p)
    amplitude = 2**alpha * math.gamma(1 + alpha)
    high = max(low, 1.0)
    while b <= 1.001 * (
        g * (2 / high**2 + amplitude * high ** (-1 - alpha) * (1 + (2 + alpha) / high)) + level * high**-p
    ):
        high *= 1.01
    return arb(low), arb(high)


def zeros(curve: Curve, c: arb, end: arb | None) -> list[arb]:
    """All zeros of the tilt with the coefficient c in (0, end], in order.

    Every bin of width 1/2 is halved until the enclosure of the tilt, or of its derivative, excludes 0: then the piece
    has no zero, or at most one, which the signs at its ends decide.
    """
    low, high = window(curve, c)
    if end is not None and end < high:
        high = end
    edges = [low]
    edges += [arb(2 * j + 1) / 4 for j in range(math.floor(2 * float(low)), math.ceil(2 * float(high)) + 1)]
    edges = [low, *(e for e in edges if low < e < high), high] if low < high else []
    found: list[arb] = []
    todo = list(pairwise(edges))[::-1]
    while todo:
        lo, hi = todo.pop()
        middle = ((lo + hi) / 2).mid()
        value, slope = curve.tilt(arb(middle, (hi - lo) / 2), c)
        if value > 0 or value < 0:
            continue
        if slope > 0 or slope < 0:
            left, right = curve.tilt(lo, c)[0], curve.tilt(hi, c)[0]
            if left * right < 0:
                found.append(refine(lambda z: curve.tilt(z, c), lo, hi))
            elif not left * right > 0:
                message = f"zero of the tilt at the end of a piece, z = {float(lo)}"
                raise ArithmeticError(message)
            continue
        if hi - lo < arb(2) ** -70 * hi:
            message = f"the folds at z = {float(middle)} cannot be told from a tangency"
            raise ArithmeticError(message)
        todo += [(middle, hi), (lo, middle)]
    return found


def extrema(curve: Curve, c: arb, end: arb | None) -> list[arb]:
    """Extrema of the tilt in the window, by sign changes of its slope on a grid (only margins rest on them)."""
    low, high = window(curve, c)
    if end is not None and end < high:
        high = end
    edges = [arb(j) / 4 for j in range(max(1, math.ceil(4 * float(low))), math.floor(4 * float(high)) + 1)]
    edges = [low, *(e for e in edges if low < e < high), high] if low < high else []
    slopes = [curve.tilt(z, c)[1] if z > 0 else arb(0) for z in edges]
    found: list[arb] = []
    for i in range(len(edges) - 1):
        if slopes[i] * slopes[i + 1] < 0:
            lo, hi, sign = edges[i], edges[i + 1], slopes[i] > 0
            for _ in range(40):
                middle = ((lo + hi) / 2).mid()
                lo, hi = (middle, hi) if bool(curve.tilt(middle, c)[1] > 0) == sign else (lo, middle)
            found.append(lo)
    return found
