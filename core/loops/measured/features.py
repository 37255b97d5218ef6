"""What a measured loop shows whatever its zeros are: its base line, and whether it is that of a contact at all.

Out of contact the load does not change with depth. On each branch the points at the least depths, as many as lie on a
straight line within the noise, give a line; that line is the base line if it is flat against the slopes of contact.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from gradhesion.core.loops.measured.points import FEWEST
from gradhesion.core.types import Floats, Truths

_SIGMAS: Final = 3.0  # standard deviations of the noise by which points of a base line scatter at most, drift included
_WHITE: Final = 1.05  # standard deviations by which they scatter without drift, apart from chance
_FLAT: Final = 0.05  # slope over the mean slope of the loop: a steeper line is no base line
_DOUBT: Final = 2.5
"""Error of a slope over that mean slope: with a larger one the points are too close together to be called flat."""
_LEAST: Final = 6  # least number of points of a base line
_CLEAR: Final = 5.0  # standard deviations from the base line at which contact is certain
_END: Final = 0.1  # length of an end of the depths, in parts of their span
_STRAIGHT: Final = 5.0
"""Standard deviations of chi square about a straight line, up to which the data are a straight line."""
_LEVEL: Final = 0.03  # largest change of the load over a flat end of the depths, in parts of its span
_JUMPS: Final = 0.13
"""Scatter about a straight line, over the change along it, above which an end is no curve: it has a jump."""
_WORDS: Final = {(False, True): "load", (True, True): "depth", (True, False): "both"}
"""What is wrong where the load is steep at the shallow end, not at the deep one, and falls there with the depth."""


@dataclass(frozen=True)
class BaseLine:
    """The line of no load."""

    level: float  # its load, in N
    spread: float  # standard deviation of its points about that, in N
    slope: float  # its tilt, in N/m, and the standard deviation of that
    slope_deviation: float
    ends: tuple[float, float]  # the depths in m at which it ends on loading and unloading; NaN where a branch has none
    middle: float = 0.0  # the mean depth of its points, in m


@dataclass(frozen=True)
class ContactPoint:
    """The depth at which contact begins on loading, found from the end of the base line, its deviation, and how."""

    depth: float  # in m, as its standard deviation
    deviation: float
    method: str = "end of the base line of loading"


def _flat_part(depth: Floats, load: Floats, noise: float, steep: float) -> int:
    """Return how many points at the least depths lie on a flat line; all of shape (n,), in order of depth."""
    count = depth.size
    if count < _LEAST:
        return 0
    number = np.arange(1.0, count + 1.0)
    x, y = depth - depth[0], load - load[0]
    mx, my, xx, xy, yy = np.cumsum([x, y, x * x, x * y, y * y], axis=1) / number
    xx, xy, yy = xx - mx * mx, xy - mx * my, yy - my * my
    with np.errstate(all="ignore"):
        slope = np.where(xx > 0.0, xy / xx, 0.0)
        scatter = np.sqrt(np.maximum(yy - slope * xy, 0.0) * number / np.maximum(number - 2.0, 1.0))
        doubt = scatter / np.sqrt(number * np.maximum(xx, np.finfo(float).tiny))
    is_flat = (np.abs(slope) <= steep + _SIGMAS * doubt) & (doubt <= _DOUBT * steep)
    is_flat[: _LEAST - 1] = False
    white = noise * (_WHITE + _SIGMAS / np.sqrt(2.0 * number))
    found = np.flatnonzero(is_flat & (scatter <= white))  # as if there were only noise
    if not found.size:
        found = np.flatnonzero(is_flat & (scatter <= _SIGMAS * noise))  # with drift
    if not found.size:
        return 0
    last = int(found[-1])
    # the last ones may be in contact already: two consecutive ones off the line do not belong to it
    away = np.abs(y[: last + 1] - (my[last] + slope[last] * (x[: last + 1] - mx[last])))
    out = away > _SIGMAS * max(noise, float(scatter[last]))
    begun = np.flatnonzero(out[1:] & out[:-1])
    return int(begun[0]) if begun.size and begun[0] >= _LEAST else last + 1


def base_line(points: Floats, back: Truths, noise: float) -> BaseLine | None:
    """Find the line of no load of a loop; None where no branch has one.

    `points` are rows of depth in m and load in N, (n, 2), `back` says whether each belongs to unloading, and `noise` is
    the standard deviation of the load of a point.

    >>> depth = np.concatenate([np.linspace(-1.0, 0.0, 100), np.linspace(0.01, 1.0, 100)])
    >>> load = 0.3 + np.maximum(depth, 0.0) ** 1.5 - np.where(depth > 0.0, 0.1, 0.0)
    >>> line = base_line(np.column_stack([depth, load]), np.zeros(200, bool), 1e-3)
    >>> round(line.level, 2), abs(line.ends[0]) < 0.03
    (0.3, True)
    """
    span = np.ptp(points, axis=0)
    steep = _FLAT * float(span[1] / span[0]) if span[0] > 0.0 else 0.0
    parts, ends = list[Floats](), list[float]()
    for way in (False, True):
        own = points[back == way]
        own = own[np.argsort(own[:, 0], kind="stable")]
        count = _flat_part(own[:, 0], own[:, 1], noise, steep)
        if way and count and own[:count, 1].min() <= points[:, 1].min():
            off = np.abs(own[:count, 1].mean() - parts[0][:, 1].mean()) if parts[0].size else np.inf
            count = count if off < _CLEAR * noise else 0  # flat at the pull-off, the lowest load of all
        parts.append(own[:count])
        ends.append(float(own[count - 1, 0]) if count else float("nan"))
    flat = np.concatenate(parts)
    if flat.shape[0] < _LEAST:
        return None
    mean = flat.mean(axis=0)
    away = flat - mean
    across = max(float(away[:, 0] @ away[:, 0]), float(np.finfo(float).tiny))
    slope = float(away[:, 0] @ away[:, 1]) / across
    error = float((away[:, 1] - slope * away[:, 0]).std()) / across**0.5
    return BaseLine(float(mean[1]), float(away[:, 1].std()), slope, error, (ends[0], ends[1]), float(mean[0]))


def contact_point(
    points: Floats, back: Truths, line: BaseLine | None, noise: tuple[float, float]
) -> ContactPoint | None:
    """Find the depth at which contact begins on loading; None without a base line there and a point beyond it.

    Points are as to `base_line`, whose result `line` is; `noise` are the standard deviations of their depth and load.
    It is half way from the end of the base line to the next point.
    """
    end = np.inf if line is None else line.ends[0]
    beyond = points[~back & (points[:, 0] > end), 0]
    if not beyond.size:
        return None
    gap = float(beyond.min()) - end
    return ContactPoint(end + 0.5 * gap, float(np.hypot(noise[0], gap / np.sqrt(12.0))))


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
    flat = _LEVEL * float(np.ptp(np.quantile(load, [0.002, 0.998])))
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
