"""The lines of a page of curves: which there are, over what, and how they look."""

from typing import Final

import numpy as np
import xarray
from matplotlib.colors import to_hex

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.explorer.data import Entry
from gradhesion.cli.explorer.plain import plain
from gradhesion.cli.picture.curves import PLANES, wants_si
from gradhesion.cli.picture.labels import Unit, label, unit_for
from gradhesion.cli.picture.looks import PLAIN
from gradhesion.cli.picture.tracks import JUMP, QUANTITIES, THIN, TRACKS, Dash, Plane, Track, faded, tracks_in

_WIDTH: Final = 1.5
"""Pixels for a point of a picture: lines are seen from farther away."""

UNLOADING: Final = [9, 6]
"""The dash of unloading, in pixels: what is below it, loading on the same curve, shows in its gaps."""


def lines_of(dataset: xarray.Dataset) -> tuple[list[Plane], dict[str, Unit], Entry]:
    """List the planes that a dataset of curves fills, and the lines in them, in units if it has them.

    Returns
    -------
    The planes, the unit of each variable (the same for all that share an axis), and for the script `tracks`, the lines,
    and `labels`, how an axis names each quantity.
    """
    names = [str(name) for name in dataset.data_vars]
    there = tracks_in(names, TRACKS, si=wants_si(names, ()))
    if not there:
        raise DatasetError(
            "a page of curves needs two of contact radius, indentation and load of one curve, and this dataset has "
            'not; name whole curves in the outputs of the study, as in outputs = ["path"]'
        )
    labels: dict[str, str] = {}
    units: dict[str, Unit] = {}
    for quantity in QUANTITIES:
        own = [track.variables[quantity] for track in there]
        values = [dataset[name].values.ravel() for name in own if name in dataset]
        unit = unit_for(own[0], np.concatenate([np.empty(0), *values]))
        labels[quantity] = plain(label(own[0], unit))
        units |= dict.fromkeys(own, unit)
    planes = [plane for plane in PLANES if any({track.variables[one] for one in plane} <= {*names} for track in there)]
    return planes, units, {"tracks": [_line(track) for track in there], "labels": labels}


def _line(track: Track) -> Entry:
    """Describe a line for the script."""
    colour = track.colour(PLAIN.colours)
    return {**track.variables} | {
        "curve": track.curve,
        "label": track.label,
        "colour": to_hex(colour),
        "faded": to_hex(faded(colour)),
        "dash": UNLOADING if track.unloading else _pixels(track.dash, track.width),
        "jumpDash": _pixels(JUMP, THIN),
        "jumpWidth": _WIDTH * THIN,
        "width": _WIDTH * track.width,
        "unloading": track.unloading,
        "flag": f"{track.curve}_jump",
    }


def _pixels(dash: Dash, width: float) -> list[int]:
    """Write a dash in pixels; none is a full line.

    >>> _pixels("-", 1.0), _pixels((0, (3, 2)), 2.0)
    ([], [9, 6])
    """
    return [] if isinstance(dash, str) else [max(1, round(_WIDTH * width * length)) for length in dash[1]]
