"""The answers of one cosine on a paraboloid about the gap outside a contact (core/face.py): eight radii at once."""

import math
from typing import Any, Final

from gradhesion.core import face
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.contact.gap import Edge
from gradhesion.core.contact.waves import least_of_gap
from gradhesion.core.curve.branches import Trace
from gradhesion.core.curve.cosine import Cosine, depth, wave
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.numbers.lanes import LANES, load, root_of, store
from gradhesion.core.struve.fractional import NODES
from gradhesion.core.struve.pair import first_functions
from gradhesion.core.struve.power import amplitude_power, amplitude_powers
from gradhesion.core.types import Floats, Table

ALWAYS_ONE: Final = 0.5
"""C g up to which every contact under a depth of 0 or more is one disc."""


@face.table_of.answers(Cosine)
@kernel()
def table_of(table: Table, _curve: Cosine) -> Any:
    return table


@face.coordinate_at.answers(Cosine)
@kernel()
def coordinate_at(table: Table, curve: Cosine, x: float, whole: float) -> float:
    return depth(table, curve, whole + x)


@face.surely_open.answers(Cosine)
@kernel()
def surely_open(table: Table, _curve: Cosine, x: float) -> float:
    """Return the stretch: between starts of branches depth_H exceeds the depth of the outer one by it at least."""
    return TWO_PI * x * amplitude_power(table, TWO_PI * x)


@face.is_always_one_disc.answers(Cosine)
@kernel()
def is_always_one_disc(table: Table, curve: Cosine) -> bool:
    return curve.gain * table.amplitude <= ALWAYS_ONE


@face.touches_at_centre.answers(Cosine)
@kernel()
def touches_at_centre(_table: Table, _curve: Cosine, _end: float) -> bool:
    """Return True: the wave has a trough of the gap there, and is no lower anywhere."""
    return True


@face.waves_are_one_disc.answers(Cosine)
@kernel()
def waves_are_one_disc(table: Table, curve: Cosine, trace: Trace) -> bool:
    """Return what is noted of them, else the result of samples."""
    return least_of_gap(table, curve, trace) >= 0.0


@face.panels_of.answers(Cosine)
@kernel()
def panels_of(_table: Table, _curve: Cosine) -> tuple[float, float]:
    """Return no limit for the ratio: the paraboloid is a polynomial."""
    return 1.0, math.inf


@face.profile_at.answers(Cosine)
@kernel()
def profile_at(table: Table, curve: Cosine, x: float) -> float:
    """Return the profile, whose depth without adhesion is depth_H."""
    z, half = TWO_PI * x, math.sin(0.5 * TWO_PI * x)
    return 0.25 * (1.0 + table.k) * curve.bend * z * z + 2.0 * curve.gain * half * half


@face.edge_at.answers(Cosine)
@kernel(contract=True)
def edge_at(table: Table, curve: Cosine, x: float) -> Edge:
    z, power, s0, _, _, _, _ = wave(table, curve.lag, x)
    return Edge(x, 0.5 * curve.bend * z * z, curve.gain * (z * s0), z * power)


@kernel(contract=True)
def _rise(curve: Cosine, edge: Edge, x: float, z: float, s0: float) -> float:
    """Return depth_H at x over that at the edge, at one place or at eight (numbers/lanes.py)."""
    # differences first, as in curve/cosine_energy.py
    bend = 0.5 * curve.bend * (z + TWO_PI * edge.x) * (TWO_PI * (x - edge.x))
    return bend + (curve.gain * (z * s0) - edge.wave)


@face.excess_at.answers(Cosine)
@kernel(contract=True)
def excess_at(table: Table, curve: Cosine, edge: Edge, x: float) -> tuple[float, float]:
    z, power, s0, _, _, _, _ = wave(table, curve.lag, x)
    return _rise(curve, edge, x, z, s0) + edge.stretch, z * power


@face.fill_heights.answers(Cosine)
@kernel(contract=True)
def fill_heights(table: Table, curve: Cosine, edge: Edge, low: float, width: float, heights: Floats) -> None:
    for first in range(0, NODES.size, LANES):
        x = root_of(low * low + width * load(NODES, first))
        z = TWO_PI * x
        power = amplitude_powers(table, z)
        stretch = z * power
        over = _rise(curve, edge, x, z, first_functions(table, curve.lag, x, z, power)) + edge.stretch
        store(heights, first, over * edge.stretch / (stretch * stretch))
