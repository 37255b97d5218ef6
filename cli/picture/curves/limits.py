"""The limits of panels of curves, where a user chooses them."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from matplotlib.axes import Axes

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.picture.inset import fit_heights
from gradhesion.cli.picture.labels import Unit
from gradhesion.cli.picture.looks import Looks
from gradhesion.cli.picture.scales import limit
from gradhesion.cli.picture.spans import ALL, Span

Plane = tuple[str, str]


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
