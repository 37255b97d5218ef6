"""The answers of any profile under any control about the gap outside a contact (core/face.py)."""

import math
from typing import Any

from gradhesion.core import face
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.contact import touch
from gradhesion.core.contact.gap import GROWTH, Edge
from gradhesion.core.curve.branches import Trace
from gradhesion.core.curve.general import Basis, Patterned, Series, coordinate
from gradhesion.core.harmonics.series import highest_harmonic, sums
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.struve.fractional import NODES
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Floats

face.profile_at.answers(Series, Patterned)(touch.profile_at)
face.touches_at_centre.answers(Series, Patterned)(touch.touches_at_centre)
face.coordinate_at.answers(Series, Patterned)(coordinate)


@face.table_of.answers(Series, Patterned)
@kernel()
def table_of(basis: Basis, _curve: Series) -> Any:
    return basis[0]


@face.surely_open.answers(Series)
@kernel()
def surely_open(basis: Basis, curve: Series, x: float) -> float:
    """Return the stretch, with its load."""
    z = TWO_PI * x
    power = amplitude_power(basis[0], z)
    return (curve.alpha + curve.beta / (power * power)) * z * power


@face.is_always_one_disc.answers(Series)
@kernel()
def is_always_one_disc(_basis: Basis, _curve: Series) -> bool:
    """Return False: nothing is known beforehand."""
    return False


@face.waves_are_one_disc.answers(Series, Patterned)
@kernel()
def waves_are_one_disc(_basis: Basis, _curve: Series, _trace: Trace) -> bool:
    """Return True: no waves are left out of a trace."""
    return True


@face.panels_of.answers(Series, Patterned)
@kernel()
def panels_of(basis: Basis, curve: Series) -> tuple[float, float]:
    _, series, _ = face.punch_of(basis, curve)
    highest = highest_harmonic(series)
    return 1.0 / highest if highest > 0.0 else math.inf, math.exp(GROWTH / curve.exponent)


@face.edge_at.answers(Series, Patterned)
@kernel(contract=True)
def edge_at(basis: Basis, curve: Series, x: float) -> Edge:
    table, _, _ = basis
    z = TWO_PI * x
    w0, _, _, _ = face.waves_at(basis, curve, x, 0.0)
    return Edge(x, curve.bend * z**curve.exponent, curve.gain * z * w0, z * amplitude_power(table, z))


@face.excess_at.answers(Series, Patterned)
@kernel(contract=True)
def excess_at(basis: Basis, curve: Series, edge: Edge, x: float) -> tuple[float, float]:
    """Return them by the differences of the terms, each first, as in curve/general_energy.py.

    Of a pattern 1 - kappa at the edge is part of its wave.
    """
    table, _, _ = basis
    cosine_bins, series, gain = face.punch_of(basis, curve)
    z = TWO_PI * x
    w0, _, _, _ = sums(table, cosine_bins, series, x, 0.0)
    bend = edge.bend * math.expm1(curve.exponent * math.log1p((x - edge.x) / edge.x))
    return bend + (gain * z * w0 - edge.wave) + edge.stretch, z * amplitude_power(table, z)


@face.fill_heights.answers(Series, Patterned)
@kernel(contract=True)
def fill_heights(basis: Basis, curve: Series, edge: Edge, low: float, width: float, heights: Floats) -> None:
    for i in range(NODES.size):
        over, stretch = face.excess_at(basis, curve, edge, math.sqrt(low * low + width * NODES[i]))
        heights[i] = over * edge.stretch / (stretch * stretch)
