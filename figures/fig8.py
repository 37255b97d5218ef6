"""Fig. 8: the loop of the effective path and the two parts of its area."""

from typing import Final

import numpy as np
import xarray
from matplotlib.axes import Axes

from figures.curves import Values, dress, values_of
from figures.style import INK, shade

CLEAR: Final = {"fc": "white", "ec": "none", "alpha": 0.75, "pad": 1.0}
"""What keeps the curve from running through a name."""
HEAD: Final = {
    "arrowstyle": "-|>,head_width=0.25,head_length=0.5",
    "mutation_scale": 8,
    "lw": 0,
    "color": INK,
    "shrinkA": 0,
    "shrinkB": 0,
}


def parts_of(dataset: xarray.Dataset) -> tuple[Values, Values]:
    """Return depth and load, shape (2, n), around C1, the loop of a rim at a_2, and around C2, what lies beyond."""
    names = ("contact_radius", "indentation", "load", "jump")
    radius, depth, load, jump = values_of(dataset, *(f"effective_{name}" for name in names))
    entry, turn = int(np.flatnonzero(jump > 0.5)[0]), int(np.argmax(radius))
    points = np.array([depth, load])
    before, loading, unloading = points[:, :entry], points[:, entry : turn + 1], points[:, turn + 1 :]
    way = radius[turn + 1 :]
    beyond = way > radius[entry]
    meeting = np.array([np.interp(radius[entry], way[::-1], values[::-1]) for values in unloading])[:, None]
    first = np.concatenate([before, loading[:, :1], meeting, unloading[:, ~beyond], before[:, :1]], axis=1)
    second = np.concatenate([loading, unloading[:, beyond], meeting, loading[:, :1]], axis=1)
    return first, second


def corners_of(dataset: xarray.Dataset) -> list[tuple[str, Values, tuple[int, int]]]:
    """Return the names 0 to 4, 2' and 3' of the corners, their depth and load, and where the name stands, in points."""
    _, second = parts_of(dataset)
    (radius,) = values_of(dataset, "effective_contact_radius")
    turn = int(np.argmax(radius))
    points = np.array(values_of(dataset, "effective_indentation", "effective_load"))
    four, two, meeting = points[:, -2], second[:, 0], second[:, -2]
    ends = np.flatnonzero(radius == radius[turn])
    return [
        ("0", np.array([four[0], 0.0]), (-4, 7)),
        ("1", np.array([two[0], 0.0]), (4, 7)),
        ("2", two, (6, 8)),
        ("3", points[:, ends[0]], (-7, 3)),
        ("3'", points[:, ends[-1]], (8, -3)),
        ("4", four, (-7, 0)),
        ("2'", meeting, (2, -8)),
    ]


def centre_of(outline: Values) -> tuple[float, float]:
    """Return the centroid of the area within a closed outline."""
    (x, y), (after_x, after_y) = outline[:, :-1], outline[:, 1:]
    cross = x * after_y - after_x * y
    total = 3.0 * np.sum(cross)
    return float(np.sum((x + after_x) * cross) / total), float(np.sum((y + after_y) * cross) / total)


def loop(axes: Axes, dataset: xarray.Dataset) -> None:
    """Draw the asymptotic curve and the loop, its two parts shaded and its corners named as the paper names them."""
    first, second = parts_of(dataset)
    axes.fill(*first, fc=shade(0.45), alpha=0.55, ec="none")
    axes.fill(*second, fc=shade(1.0), alpha=0.4, ec="none")
    axes.plot(*values_of(dataset, "asymptotic_indentation", "asymptotic_load"), color="0.6", lw=0.5, zorder=1)
    axes.plot(*values_of(dataset, "effective_indentation", "effective_load"), color=INK, lw=1.1)
    axes.plot(*second[:, -2:], color=INK, lw=0.8, ls=(0, (3, 1.5)))
    (_, zero, _), (_, one, _), *_ = corners_of(dataset)
    axes.plot(*np.stack([zero, one], axis=1), color=INK, lw=1.1)
    _arrows(axes, dataset)
    for name, part in (("$C_1$", first), ("$C_2$", second)):
        axes.annotate(name, centre_of(part), ha="center", va="center", fontsize=9, bbox=CLEAR)
    for name, corner, place in corners_of(dataset):
        axes.plot(*corner, "o", ms=2.2, color=INK)
        written = name.replace("'", "\N{PRIME}")
        axes.annotate(written, (corner[0], corner[1]), place, textcoords="offset points", ha="center", va="center")
    dress(axes, "a")
    axes.margins(x=0.07, y=0.1)  # room for the names of the corners


def _arrows(axes: Axes, dataset: xarray.Dataset) -> None:
    """Put an arrow head on each side of the loop, the way of the path."""
    corners = {name: corner for name, corner, _ in corners_of(dataset)}
    path = np.array(values_of(dataset, "effective_indentation", "effective_load"))
    places = [0.5 * (corners[a] + corners[b]) for a, b in (("0", "1"), ("1", "2"), ("3", "3'"), ("4", "0"))]
    ways = [corners[b] - corners[a] for a, b in (("0", "1"), ("1", "2"), ("3", "3'"), ("4", "0"))]
    for a, b in (("2", "3"), ("3'", "4")):
        on = [int(np.argmin(np.hypot(*(path - corners[name][:, None])))) for name in (a, b)]
        middle = (2 * on[0] + on[1]) // 3
        places.append(path[:, middle])
        ways.append(path[:, middle + 1] - path[:, middle - 1])
    for place, way in zip(places, ways, strict=True):
        (x, y), (dx, dy) = place, 1e-3 * way
        axes.annotate("", (x + dx, y + dy), (x - dx, y - dy), arrowprops=HEAD, zorder=2.5)


PICTURES = {"fig8": loop}
