"""Whether the points of a loop are plausible: with a contact, and with the right signs."""

from typing import Final

import numpy as np

from gradhesion.core.loops.measured.points import FEWEST
from gradhesion.core.types import Floats, Truths

_END: Final = 0.1  # length of an end of the depths, in parts of their span
_STRAIGHT: Final = 5.0
"""Standard deviations of chi square about a straight line, up to which the data are a straight line."""
_FLAT: Final = 0.03  # largest change of the load over a flat end of the depths, in parts of its span
_JUMPS: Final = 0.13
"""Scatter about a straight line, over the change along it, above which an end is no curve: it has a jump."""
_WORDS: Final = {(False, True): "load", (True, True): "depth", (True, False): "both"}
"""What is wrong where the load is steep at the shallow end, not at the deep one, and falls there with the depth."""


def fault_of(depth: Floats, load: Floats, noise: Floats, unloading: Truths) -> str:
    """Test by the ends of their depths whether points can be those of a contact; return "" if they can.

    Depths and loads are in any unit and order, `noise` is the standard deviation of each load, and `unloading` its
    branch, on which signs are tested; all (n,). "straight": the load is a straight line of the depth and noise, without
    contact. "load": one end of the depths is flat, and the load falls steeply towards the other, the deepest points, so
    that its sign is wrong. "depth": it rises steeply towards the shallowest points, so that the sign of the depth is
    wrong. "both": it falls towards these.

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
    found = {_signs(x[own], load[own]) for own in branches} - {None}
    return str(found.pop()) if len(found) == 1 else ""


def _signs(x: Floats, load: Floats) -> str | None:
    """Return which signs of a branch are wrong; None where its ends do not decide."""
    flat = _FLAT * float(np.ptp(np.quantile(load, [0.002, 0.998])))
    ends = [own for own in (x < x.min() + _END, x > x.max() - _END) if np.count_nonzero(own) > 9]
    if len(ends) < 2:
        return None
    changes = []
    for own in ends:
        line = np.polynomial.Polynomial.fit(x[own], load[own], 1)
        changes.append(float(line(x[own].max()) - line(x[own].min())))
        if flat < abs(changes[-1]) < float(np.std(load[own] - line(x[own]))) / _JUMPS:
            return None
    shallow, deep = changes
    if min(abs(shallow), abs(deep)) > flat or max(abs(shallow), abs(deep)) < 2.0 * flat:
        return ""
    is_shallow = abs(shallow) > abs(deep)
    return _WORDS.get((is_shallow, changes[not is_shallow] < 0.0), "")
