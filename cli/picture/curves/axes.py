"""The axes of panels of curves: which variables lines are drawn from, their units, and the limits that are chosen."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Final

import numpy as np
from matplotlib.axes import Axes

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.outputs import SI
from gradhesion.cli.names.units import UNITS
from gradhesion.cli.picture.curves.panels import Track, Values
from gradhesion.cli.picture.inset import fit_heights
from gradhesion.cli.picture.labels import Unit, unit_for
from gradhesion.cli.picture.looks import Looks
from gradhesion.cli.picture.scales import limit
from gradhesion.cli.picture.spans import ALL, Span

Plane = tuple[str, str]

LABELS: Final = {
    "contact_radius": "contact radius $a/R$",
    "indentation": r"depth $\delta/R$",
    "load": r"load $P\,/\,(\frac{3}{2}\pi R\Delta\gamma)$",
}
"""The quantities of a track, as an axis names them."""

LABELS_IN_SI: Final = {
    "contact_radius": "contact radius $a$",
    "indentation": r"depth $\delta$",
    "load": "load $P$",
}
"""The same in units."""


def wants_si(there: Iterable[str], requested: Sequence[str]) -> bool:
    """
    Choose whether curves are drawn in units: they are if the dataset has them, unless variables without are asked for.

    >>> wants_si(["path_load", "path_load_si"], ["path"]), wants_si(["path_load", "path_load_si"], ["path_load"])
    (True, False)

    Raises
    ------
    DatasetError
        Some variables with a unit and some without are asked for: they have no axis in common.
    """
    plain = [name for name in requested if name in UNITS]
    units = [name for name in requested if name.endswith(SI)]
    if plain and units:
        raise DatasetError(
            f"--variable {plain[0]} has no unit and {units[0]} has one: they have no axis in common; "
            f"ask for {plain[0]}{SI} instead"
        )
    return not plain and any(name.endswith(SI) for name in there)


def in_si(track: Track) -> Track:
    """Draw a line from its variables in SI units."""
    return replace(
        track,
        contact_radius=track.contact_radius + SI,
        indentation=track.indentation + SI,
        load=track.load + SI,
    )


def variables_of(track: Track) -> dict[str, str]:
    """Name the variables of a line by what they are."""
    return {quantity: getattr(track, quantity) for quantity in LABELS}


def units_of(
    tracks: Sequence[Track], scenes: Sequence[Mapping[str, Values]], spans: Mapping[str, Span] = MappingProxyType({})
) -> dict[str, Unit]:
    """Choose the unit of each quantity, one for all lines and scenes, to suit what is seen of it."""
    units = {}
    for quantity in LABELS:
        names = [variables_of(track)[quantity] for track in tracks]
        rows = [scene[name] for scene in scenes for name in names if name in scene and np.isfinite(scene[name]).any()]
        ends = np.array([end for row in rows for end in (np.nanmin(row), np.nanmax(row))])
        sizes = np.clip(ends, *spans[quantity].limits(names[0])) if quantity in spans else ends
        units[quantity] = unit_for(names[0], sizes) if names else Unit()
    return units


def in_unit(tracks: Sequence[Track], scene: Mapping[str, Values], units: Mapping[str, Unit]) -> dict[str, Values]:
    """Give the rows of a scene with those that tracks are drawn from in their units."""
    powers = {name: units[quantity].power for track in tracks for quantity, name in variables_of(track).items()}
    return {name: row / 10.0 ** powers[name] if powers.get(name) else row for name, row in scene.items()}


def axis_label(quantity: str, unit: Unit) -> str:
    r"""
    Label an axis.

    >>> axis_label("load", Unit(symbol="nN", power=-9)), axis_label("indentation", Unit())
    ('load $P$ (nN)', 'depth $\\delta/R$')
    """
    return f"{LABELS_IN_SI[quantity]} ({unit.symbol})" if unit.symbol else LABELS[quantity]


def spans_of(looks: Looks, planes: Sequence[Plane]) -> dict[str, Span]:
    """
    Name the quantities that have limits.

    Raises
    ------
    DatasetError
        Panels have different quantities there, or an inset has several panels to choose from.
    """
    for span, place in ((looks.xlim, 0), (looks.ylim, 1)):
        if span and len({plane[place] for plane in planes}) > 1:
            raise DatasetError(f"{span}: the panels have different axes; choose one with --x indentation --y load")
    if looks.inset and len(planes) > 1:
        raise DatasetError(
            f"{looks.inset}: an inset goes into a single panel; choose one with --x indentation --y load"
        )
    along, up = planes[0]
    return {quantity: span for quantity, span in ((along, looks.xlim), (up, looks.ylim)) if span}


def in_units(looks: Looks, planes: Sequence[Plane], units: Mapping[str, Unit]) -> dict[str, Span]:
    """Give limits and inset, by their options, in the units of the first panel."""
    along, up = (units[quantity].power for quantity in planes[0])
    spans = {"xlim": replace(looks.xlim, power=along), "ylim": replace(looks.ylim, power=up)}
    return spans | {"inset": replace(looks.inset, power=along)}


def set_limits(axes: Axes, names: Sequence[str], spans: Mapping[str, Span]) -> None:
    """Give a panel its limits; what is seen between those along sets those up, unless they are chosen."""
    along, up = (spans.get(option, ALL) for option in ("xlim", "ylim"))
    limit(axes, "x", along.within(names[0], *axes.get_xlim()))
    if up:
        limit(axes, "y", up.within(names[1], *axes.get_ylim()))
    elif along:
        fit_heights(axes)
