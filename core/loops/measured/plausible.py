"""Whether the points of a loop are plausible: with a contact, and with the right signs."""

from typing import Final

import numpy as np

from gradhesion.core.loops.measured.points import FEWEST
from gradhesion.core.types import Floats, Truths

_END: Final = 0.1
"""Length of an end of the depths, in parts of their span."""
_STRAIGHT: Final = 5.0
"""Standard deviations of chi square about a straight line, up to which the data are a straight line."""
_FLAT: Final = 0.03
"""Largest change of the load over a flat end of the depths, in parts of its span."""


def fault_of(depth: Floats, load: Floats, noise: Floats, unloading: Truths) -> str:
    """Test by the ends of their depths whether points can be those of a contact; return "" if they can.

    Depths and loads are in any unit and order, `noise` is the standard deviation of each load, and `unloading` its
    branch, on which signs are tested; all (n,). "straight": the load is a straight line of the depth and noise, without
    contact. "load": it falls towards the deepest points and is farthest from the other end there, so that its sign is
    wrong. "depth": it does so rising towards the shallowest points, so that the sign of the depth is wrong. "both".

    >>> depth = np.linspace(-1.0, 1.0, 200)
    >>> load, noise = np.maximum(depth, 0.0) ** 1.5, np.full(200, 1e-3)
    >>> up = np.zeros(200, bool)
    >>> [fault_of(x * depth, y * load, noise, up) for x, y in ((1, 1), (1, -1), (-1, 1), (-1, -1))]
    ['', 'load', 'depth', 'both']
    >>> fault_of(depth, 0.1 * depth, noise, up)
    'straight'
    """
    if depth.size < FEWEST or not (np.ptp(depth) > 0.0 and np.ptp(load) > 0.0):
        return ""
    x = (depth - depth.min()) / np.ptp(depth)
    rest = load - np.polynomial.Polynomial.fit(x, load, 1, w=1.0 / noise)(x)
    if float(np.sum((rest / noise) ** 2)) < depth.size + _STRAIGHT * float(np.sqrt(2.0 * depth.size)):
        return "straight"
    branches = [own for own in (~unloading, unloading) if np.count_nonzero(own) >= FEWEST // 2]
    found = {_signs(x[own], load[own], noise[own]) for own in branches} - {None}
    return str(found.pop()) if len(found) == 1 else ""


def _signs(x: Floats, load: Floats, noise: Floats) -> str | None:
    """Return which signs of a branch are wrong; None where its ends do not decide."""
    span = float(np.ptp(np.quantile(load, [0.002, 0.998])))
    shallow, deep = (_end(x, load, noise, float(side)) for side in (x.min(), x.max()))
    if shallow is None or deep is None:
        return None
    apart, flat = deep[0] - shallow[0], _FLAT * span
    if abs(apart) < 0.5 * span:
        return ""
    if apart < 0.0 and deep[1] < -flat and deep[1] < -abs(shallow[1]):
        return "load"
    if apart < 0.0 and shallow[1] < -3.0 * flat:
        return "depth"
    return "both" if apart > 0.0 and deep[1] < flat and shallow[1] > 3.0 * flat else ""


def _end(x: Floats, load: Floats, noise: Floats, side: float) -> tuple[float, float] | None:
    """Give the load at an end of the depths, and its change over it; None where it jumps there, and is no curve."""
    fifths = [np.abs(np.abs(x - side) / _END - share) < 0.1 for share in (0.1, 0.3, 0.5, 0.7, 0.9)]
    if min(np.count_nonzero(own) for own in fifths) < 2:
        return None
    levels = np.array([np.mean(load[own]) for own in fifths])
    error = max(float(np.median(noise[own]) / np.sqrt(np.count_nonzero(own))) for own in fifths)
    steps = np.diff(levels) * (1.0 if side < np.mean(x) else -1.0)
    change = float(steps.sum()) * 1.25
    if abs(change) > 5.0 * error and abs(steps[0]) < 0.4 * abs(change) / 5.0:
        return None
    return float(levels[0]), change
