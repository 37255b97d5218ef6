"""The lines of a page of curves: which there are, over what, and how they look."""

from dataclasses import dataclass
from typing import Final

import numpy as np
import xarray
from matplotlib.colors import to_hex

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.explorer.data import Entry
from gradhesion.cli.explorer.plain import plain
from gradhesion.cli.picture.curves.axes import axis_label, in_si, units_of, variables_of, wants_si
from gradhesion.cli.picture.curves.panels import JUMP, THIN, TRACKS, Dash, Track, faded
from gradhesion.cli.picture.curves.picture import PLANES
from gradhesion.cli.picture.labels import Unit

_WIDTH: Final = 1.5
"""Pixels for a point of a picture: lines are seen from farther away."""

UNLOADING: Final = [9, 6]
"""The dash of unloading, in pixels: what is below it, loading on the same curve, shows in its gaps."""


@dataclass(frozen=True, kw_only=True)
class Lines:
    """The lines of a page."""

    planes: list[tuple[str, str]]
    """What each plane has along and up."""
    labels: dict[str, str]
    """How an axis names each quantity, with its unit."""
    units: dict[str, Unit]
    """The unit of each variable: the same for all that share an axis."""
    tracks: list[Entry]


def lines_of(dataset: xarray.Dataset) -> Lines:
    """
    List the planes that a dataset of curves fills, and the lines in them, in units if it has them.

    Raises
    ------
    DatasetError
        No curve has two variables that could be drawn over each other.
    """
    names = [str(name) for name in dataset.data_vars]
    known = [in_si(track) for track in TRACKS] if wants_si(names, ()) else TRACKS
    there = [track for track in known if sum(name in names for name in variables_of(track).values()) > 1]
    if not there:
        raise DatasetError(
            "a page of curves needs two of contact radius, indentation and load of one curve, and this dataset has "
            'not; name whole curves in the outputs of the study, as in outputs = ["path"]'
        )
    own = {name for track in there for name in variables_of(track).values() if name in names}
    units = units_of(there, [{name: np.asarray(dataset[name].values, dtype=float) for name in own}])
    return Lines(
        planes=[(x, y) for x, y in PLANES if any({getattr(one, x), getattr(one, y)} <= own for one in there)],
        labels={quantity: plain(axis_label(quantity, unit)) for quantity, unit in units.items()},
        units={name: units[quantity] for track in there for quantity, name in variables_of(track).items()},
        tracks=[_line(track) for track in there],
    )


def _line(track: Track) -> Entry:
    """Describe a line for the script."""
    return variables_of(track) | {
        "curve": track.curve,
        "label": track.label,
        "colour": to_hex(track.colour),
        "faded": to_hex(faded(track.colour)),
        "dash": UNLOADING if track.unloading else _pixels(track.dash, track.width),
        "jumpDash": _pixels(JUMP, THIN),
        "jumpWidth": _WIDTH * THIN,
        "width": _WIDTH * track.width,
        "unloading": track.unloading,
        "flag": f"{track.curve}_jump",
    }


def _pixels(dash: Dash, width: float) -> list[int]:
    """
    Write a dash in pixels; none is a full line.

    >>> _pixels("-", 1.0), _pixels((0, (3, 2)), 2.0)
    ([], [9, 6])
    """
    return [] if isinstance(dash, str) else [max(1, round(_WIDTH * width * length)) for length in dash[1]]
