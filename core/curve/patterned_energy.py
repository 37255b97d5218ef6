"""The energy lost in a jump on an interface whose toughness varies with the radius.

    e = int_{z1}^{z2} z [kappa^2 - rho^2] dz,    rho = kappa + (Y(z) - Y_j)/((alpha + beta z^(1+k)) z^c)

in units of 2 pi l^2 dgamma, as curve/general_energy.py. rho knows nothing of kappa, and kappa^2 is a series or its
square: even where kappa is a root Gauss's rule needs no more than the waves of the two.
"""

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.general import Basis, coordinate
from gradhesion.core.curve.general_energy import balance, place_left, rise_from
from gradhesion.core.curve.panels import (
    INNER_PLACES,
    INNER_SHARES,
    PLACES,
    SHARES,
    panel_inwards,
    panel_outwards,
    panels_to_zero,
)
from gradhesion.core.curve.patterned import Patterned, shortest_of, toughness_at
from gradhesion.core.struve.circle import TWO_PI


@kernel()
def energy_between(basis: Basis, curve: Patterned, start: float, end: float) -> float:
    """Return e of a jump from x = start > 0 on the curve to x = end >= 0."""
    if end == 0.0:
        return -energy_to(basis, curve, start, coordinate(basis, curve, start))
    left, shortest = place_left(basis, curve, start, 0.0), shortest_of(basis)
    total, low, high = 0.0, min(start, end), max(start, end)
    while low < high:
        width, beyond, first, last = panel_outwards(low, high, 0.0, shortest)
        part = 0.0
        for i in range(first, last):
            x = low + width * PLACES[i]
            u = rise_from(basis, curve, left, x, 0.0)
            own, _, _ = toughness_at(basis, x)
            part -= SHARES[i] * x * u * (2.0 * own + u)
        total += width * part
        low = beyond
    return total * (TWO_PI * TWO_PI if end > start else -TWO_PI * TWO_PI)


@kernel()
def _density(basis: Basis, curve: Patterned, x: float, level: float) -> float:
    """Return x [kappa^2 - rho^2] at a radius of a jump from or to zero contact."""
    value, scale = balance(basis, curve, x)
    u = (value - level) / scale
    own, _, _ = toughness_at(basis, x)
    return -x * u * (2.0 * own + u)


@kernel()
def energy_to(basis: Basis, curve: Patterned, x: float, level: float) -> float:
    """Return e of a jump at Y = level from zero contact to x >= 0; the way back has the other sign."""
    if x == 0.0:
        return 0.0
    shortest = shortest_of(basis)
    inner, growth = panels_to_zero(basis.table.k, curve.alpha, curve.beta, x, shortest)
    total, high = 0.0, x
    while high > inner:
        low, first, last = panel_inwards(high, growth, shortest)
        part = 0.0
        for i in range(first, last):
            part += SHARES[i] * _density(basis, curve, low + (high - low) * PLACES[i], level)
        total += (high - low) * part
        high = low
    part = 0.0
    for i in range(INNER_PLACES.size):
        part += INNER_SHARES[i] * _density(basis, curve, high * INNER_PLACES[i], level)
    return (total + high * part) * TWO_PI * TWO_PI
