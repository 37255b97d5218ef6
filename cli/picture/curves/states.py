"""The picture of states of contact: the pressure under the punch, and the surface around it."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import cycle
from typing import Final

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.model_range import slope_warnings
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.curves import CURVES, STATE
from gradhesion.cli.names.outputs import SI
from gradhesion.cli.picture.labels import Unit, effective, equation, number, unit_for
from gradhesion.cli.picture.looks import PLAIN, Looks
from gradhesion.cli.picture.pictured import finite, heading, in_lines, lay_out, styled

Values = NDArray[np.float64]

LABELS: Final = {
    "pressure_radius": ("distance $r/R$", "distance $r$"),
    "pressure": (r"pressure $pR/\Delta\gamma$", "pressure $p$"),
    "surface_radius": ("distance $r/R$", "distance $r$"),
    "surface_displacement": ("surface $u_z/R$", "surface $u_z$"),
}
"""What an axis shows, without a unit and with one."""

PANELS: Final = (("pressure", "pressure_radius", "pressure"), ("surface", "surface_radius", "surface_displacement"))
"""The curve of each panel, and what it has along and up."""

DASHES: Final = ("-", (0, (5, 1.5)), (0, (2, 1)), (0, (6, 1.5, 1, 1.5)))
"""What distinguishes states where colours do not print."""

SHOWN: Final = 0.95
"""The share of a contact up to which the pressure sets the limits of its panel: it has no bound at the edge."""


NARROW: Final = 2.4
"""The width of a panel, in inches, below which panels stand below each other if a width is given."""


def draw_states(dataset: xarray.Dataset, chosen: Sequence[str], looks: Looks = PLAIN) -> Figure:
    """
    Draw pressure and surface of the states of one scene, the first of a dataset of several; in units if it has them.

    Raises
    ------
    DatasetError
        A radius is missing that the curve is drawn over, or no state has a value.
    """
    scene = dataset.isel(dict.fromkeys(dataset["status"].dims, 0))
    panels = [(curve, x, y) for curve, x, y in PANELS if curve in chosen and y in scene]
    for curve, x, _ in panels:
        if x not in scene:
            raise DatasetError(f'{curve}: needs {x}, which this dataset lacks; write outputs = ["{curve}"]')
    if not panels:
        needed = CURVES["surface"]
        raise DatasetError(f'surface: needs {", ".join(needed)} for a picture; write outputs = ["surface"]')
    if not any((np.isfinite(_rows(scene, x)) & np.isfinite(_rows(scene, y))).any() for _, x, y in panels):
        raise DatasetError("no value in any state drawn; `gradhesion info` reports why")
    with styled(looks):
        width = looks.width or 4.0 * len(panels)
        below = len(panels) if width < NARROW * len(panels) else 1
        figure = Figure(figsize=(width, looks.height or 2.5 * below + 0.9), layout="constrained")
        grid = figure.subplots(below, len(panels) // below, squeeze=False).ravel()
        for axes, (curve, x, y) in zip(grid, panels, strict=True):
            units = {name: _unit(scene, name) for name in (x, y)}
            _draw(axes, scene, curve, x, y, units, looks)
            for name, put in ((x, axes.set_xlabel), (y, axes.set_ylabel)):
                put(LABELS[name][1] + f" ({units[name].symbol})" if units[name].symbol else LABELS[name][0])
        handles, labels = axes.get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=max(1, min(int(width / 1.4), len(labels))))
        caption = in_lines(list(_caption(dataset)), width) if looks.caption else ""
        words = "\n".join(filter(None, (heading(dataset) if looks.title else "", caption)))
        if words:
            figure.suptitle(words, fontsize="medium", wrap=True)
        if looks.width or looks.height:
            lay_out(figure)
    return figure


def _rows(scene: xarray.Dataset, name: str) -> Values:
    """Take a variable of every state, in SI if it is there."""
    return np.atleast_2d(finite(scene[name + SI if name + SI in scene else name].values))


def _unit(scene: xarray.Dataset, name: str) -> Unit:
    """Choose the unit of an axis."""
    if name + SI not in scene:
        return Unit()
    values = _rows(scene, name)
    return unit_for(name + SI, values[np.isfinite(values)])


def _draw(
    axes: Axes, scene: xarray.Dataset, curve: str, x: str, y: str, units: Mapping[str, Unit], looks: Looks
) -> None:
    """Draw one curve of every state."""
    along, up = (_rows(scene, name) / 10.0 ** units[name].power for name in (x, y))
    gaps = (
        _rows(scene, "surface_gap") / 10.0 ** units[y].power if curve == "surface" and "surface_gap" in scene else None
    )
    labels = _labels(scene)
    limits = []
    for i, (label, dash) in enumerate(zip(labels, cycle(DASHES), strict=False)):
        colour = looks.colours(0.75 * i / max(1, len(labels) - 1))
        drawn = np.isfinite(along[i]) & np.isfinite(up[i])
        if not drawn.any():
            axes.plot([], [], color=colour, ls=dash, label=f"{label} (absent)")
            continue
        axes.plot(along[i], up[i], color=colour, ls=dash, lw=1.2, label=label)
        if gaps is not None:  # the punch itself, where it does not touch
            axes.plot(
                along[i], np.where(gaps[i] > 0.0, up[i] - gaps[i], np.nan), color=colour, lw=0.6, ls=(0, (1, 1.5))
            )
        inner = up[i][drawn & (along[i] <= SHOWN * np.max(along[i][drawn]))]
        limits += [] if inner.size == 0 else [inner.min(), inner.max()]
    axes.axhline(0.0, color="0.85", lw=0.6, zorder=0)
    axes.set_xlim(left=0.0)
    if curve == "pressure" and limits:
        room = 0.08 * (max(limits) - min(limits)) or 1.0
        axes.set_ylim(min(limits) - room, max(limits) + room)
    elif curve != "pressure":
        axes.invert_yaxis()  # into the half-space is downwards


def _labels(scene: xarray.Dataset) -> list[str]:
    """Name the states."""
    return [
        value.replace("_", " ") if isinstance(value, str) else f"$a/R$ = {number(float(value))}"
        for value in scene[STATE].values.tolist()
    ]


def _caption(dataset: xarray.Dataset) -> Iterable[str]:
    """Write the parameters of the scene."""
    for name in effective(dataset):
        values = dataset[name].values
        first = equation(name, np.ravel(values)[0])
        yield first if np.size(values) == 1 else f"{first} (first of {np.size(values)})"
    yield from slope_warnings(dataset)
