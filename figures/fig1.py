"""Fig. 1: the problem: punch, waviness and half-space, with the lengths and the load that the theory speaks of."""

from typing import Any, Final

import numpy as np
import xarray
from matplotlib.axes import Axes

from figures.curves import Values
from figures.style import INK, shade

HEIGHT: Final = 2.0
"""Heights over widths."""
ARROW: Final[dict[str, Any]] = {
    "arrowstyle": "-|>",
    "color": INK,
    "lw": 0.7,
    "shrinkA": 0,
    "shrinkB": 0,
    "mutation_scale": 6,
}
BOTH: Final = ARROW | {"arrowstyle": "<|-|>"}


def problem(axes: Axes, dataset: xarray.Dataset) -> None:
    """Draw a section through punch and half-space."""
    r, surface, gap = (
        np.asarray(dataset[f"surface_{name}"].values, dtype=float).ravel() for name in ("radius", "displacement", "gap")
    )
    a, rim = float(dataset["state"].item()), float(dataset["a_max_over_R"].item())
    depth, length = surface[0], float(dataset["lambda_over_R"].item())
    side = np.concatenate([-r[::-1], r])
    ground = np.concatenate([surface[::-1], surface])
    floor = depth + 0.22
    axes.fill_between(side, ground, floor, fc=shade(0.55), alpha=0.12, ec="none")
    for level in np.linspace(0.35, 1.0, 6) ** 2:  # stiffer with depth: lines that come closer
        axes.plot(side, ground + level * (floor - ground), color=shade(0.35), lw=0.35, alpha=0.5)
    axes.plot(side, ground, color=shade(0.3), lw=1.3)
    under = ~np.isnan(gap)
    shape = _mirrored(r[under], (surface - gap)[under])
    top = shape[1].min() - 0.05
    axes.fill_between(shape[0], shape[1], top, fc="0.86", ec="none")
    axes.plot(*shape, color=INK, lw=1.1)
    axes.plot([-rim, -rim, rim, rim], [shape[1][0], top, top, shape[1][-1]], color=INK, lw=0.8)
    smooth = _mirrored(r[under], depth - 0.5 * r[under] ** 2)
    axes.plot(*smooth, color=INK, lw=0.6, ls=(0, (4, 2)))
    axes.axhline(0.0, color="0.55", lw=0.5, ls=(0, (1, 1.5)), zorder=0)
    _lengths(axes, a, depth, length, top, float(r.max()), float(np.interp(a, r, surface)))
    axes.set(xlim=(-r.max(), r.max()), ylim=(floor, top - 0.13))
    axes.set_aspect(HEIGHT)
    axes.set_axis_off()


def _lengths(axes: Axes, a: float, depth: float, length: float, top: float, end: float, edge: float) -> None:
    """Draw the axes and arrows, and name them."""
    low = depth + 0.11
    axes.annotate("", (0.0, top), (0.0, top - 0.11), arrowprops=ARROW | {"lw": 1.2, "mutation_scale": 9})
    axes.text(0.02, top - 0.09, "$P$", va="center")
    axes.annotate("", (0.0, low + 0.09), (0.0, depth), arrowprops=ARROW)
    axes.text(0.02, low + 0.07, "$z$", va="center")
    axes.annotate("", (end, 0.0), (0.66 * end, 0.0), arrowprops=ARROW)
    axes.text(0.95 * end, -0.03, "$r$", ha="center")
    for x in (-a, a):
        axes.plot([x, x], [edge, low], color=INK, lw=0.4)
    axes.annotate("", (a, low), (0.0, low), arrowprops=BOTH)
    axes.text(0.5 * a, low - 0.018, "$a$", ha="center")
    x = -0.76 * end
    axes.annotate("", (x, depth), (x, 0.0), arrowprops=BOTH)
    axes.plot([x - 0.03, 0.0], [depth, depth], color=INK, lw=0.4)
    axes.text(x - 0.03, 0.5 * depth, r"$\delta$", ha="right", va="center")
    crest = depth - 0.5 * length**2
    for x in (length, 2.0 * length):
        axes.plot([x, x], [depth - 0.5 * x**2, top - 0.045], color=INK, lw=0.4)
    axes.annotate("", (2.0 * length, top - 0.03), (length, top - 0.03), arrowprops=BOTH)
    axes.text(1.5 * length, top - 0.048, r"$\lambda$", ha="center")
    axes.annotate("rigid punch", (-0.25 * end, 0.5 * (top + crest)), ha="center", va="center", fontsize=7)
    axes.annotate("$E = E_0(z/c_0)^k$", (-0.5 * end, low + 0.07), ha="center", va="center", fontsize=7)


def _mirrored(r: Values, heights: Values) -> tuple[Values, Values]:
    """Return a section on both sides of the axis."""
    return np.concatenate([-r[::-1], r]), np.concatenate([heights[::-1], heights])


PICTURES = {"fig1": problem}
