"""The lines of a page of curves: which there are, over what, and how they look."""

from typing import Final

import xarray
from matplotlib.colors import to_hex

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.explorer.data import Entry
from gradhesion.cli.picture.curve_panels import JUMP, THIN, TRACKS, Dash, Track, faded
from gradhesion.cli.picture.curve_picture import PLANES

_WIDTH: Final = 1.5
"""Pixels for a point of a picture: lines are seen from farther away."""


def planes_of(dataset: xarray.Dataset) -> tuple[list[tuple[str, str]], list[Entry]]:
    """
    List the planes that a dataset of curves fills, and the lines in them.

    Raises
    ------
    DatasetError
        No curve has two variables that could be drawn over each other.
    """
    there = [track for track in TRACKS if sum(name in dataset for name in _variables(track).values()) > 1]
    if not there:
        raise DatasetError(
            "a page of curves needs two of contact radius, indentation and load of one curve, and this dataset has "
            'not; name whole curves in the outputs of the study, as in outputs = ["path"]'
        )
    planes = [
        (x, y) for x, y in PLANES if any({_variables(one)[x], _variables(one)[y]} <= dataset.keys() for one in there)
    ]
    return planes, [_line(track) for track in there]


def _variables(track: Track) -> dict[str, str]:
    """Name the variables of a line by what they are."""
    return {"contact_radius": track.contact_radius, "indentation": track.indentation, "load": track.load}


def _line(track: Track) -> Entry:
    """Describe a line for the script."""
    return _variables(track) | {
        "curve": track.curve,
        "label": track.label,
        "colour": to_hex(track.colour),
        "faded": to_hex(faded(track.colour)),
        "dash": _pixels(track.dash, track.width),
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
