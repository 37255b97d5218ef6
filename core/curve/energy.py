"""What a jump dissipates: an integral between two radii at constant depth, by moments of whole bins.

    e = +- int 2 pi a dgamma [kappa^2 - rho^2] da,   rho = (depth_H - depth)/stretch,   depth_H = depth + kappa stretch

in units of 2 pi l^2 dgamma: int y (kappa^2 - rho^2) dy. Over a whole bin rho^2 is a form of the second degree in B, g
and the depth, whose coefficients are moments about the centre of the bin, so that nothing cancels far out; over the two
parts of bins at the ends, eight Gauss points. Under a load, or through a machine, the depth follows: that adds
by_load/(by_depth + by_load T) fall^2/(1 + k), with the fall of the load at the place of landing (physics 9).
"""

from typing import Final

import numpy as np

from gradhesion.core.curve.values import Curve, depth_and_load, place_of, softness
from gradhesion.core.jit import kernel, leaf, quadrature_leaf
from gradhesion.core.table import layout as at
from gradhesion.core.table.layout import LANES, N

GAUSS, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(8)
_POINTS: Final = GAUSS.size


@quadrature_leaf
def _within(curve: Curve, depth: float, i: int, low: float, high: float) -> float:
    """Return int y (kappa^2 - rho^2) dy between two places of bin i."""
    half, middle = 0.5 * (high - low), 0.5 * (high + low)
    polys, nodes = curve.table.polys, curve.table.nodes
    total = 0.0
    for j in range(_POINTS):
        t = middle + half * GAUSS[j]
        flat = stretch = 0.0
        for n in range(N - 1, -1, -1):
            flat = flat * t + (curve.B * polys[i, at.PP, n] + curve.g * polys[i, at.PU, n])
            stretch = stretch * t + polys[i, at.PE, n]
        y = nodes[at.YC, i] + nodes[at.HALF, i] * t
        rho = (flat - depth) / (stretch * y)
        term = y * (1.0 - rho * rho)
        if polys.shape[1] > LANES:  # rho is then that less kappa - 1: kappa^2 - rho^2 gains 2 (kappa - 1) (1 - rho)
            excess = 0.0
            for n in range(N - 1, -1, -1):
                excess = excess * t + polys[i, at.PW, n]
            term += 2.0 * excess / stretch * (1.0 - rho)
        total += GAUSS_WEIGHTS[j] * term
    return total * half * nodes[at.HALF, i]


@quadrature_leaf
def _whole_bins(curve: Curve, depth: float, first: int, last: int) -> float:
    """Return the same over the bins `first` to `last` - 1."""
    B, g, nodes = curve.B, curve.g, curve.table.nodes
    total = 0.0
    for i in range(first, last):
        c = B * nodes[at.PC, i] - depth
        of_depth = c * (c * nodes[at.K0, i] + 2.0 * (B * nodes[at.K1, i] + g * nodes[at.KU, i]))
        of_shape = B * (B * nodes[at.K2, i] + 2.0 * g * nodes[at.KUU, i]) + g * g * nodes[at.KV, i]
        total += nodes[at.M0, i] - of_depth - of_shape
    return total


@quadrature_leaf
def _from_zero(curve: Curve, depth: float, i: int) -> float:
    """Return the same from 0 to the lower edge of bin i, one of the geometric ones or the first of the others."""
    B, g, nodes = curve.B, curve.g, curve.table.nodes
    of_shape = B * (B * nodes[at.HPP, i] + 2.0 * g * nodes[at.HPU, i]) + g * g * nodes[at.HUU, i]
    of_depth = depth * (
        depth * nodes[at.T, i] / (1.0 + curve.table.k) - 2.0 * (B * nodes[at.HP, i] + g * nodes[at.HU, i])
    )
    return nodes[at.HM, i] - of_shape - of_depth


@leaf
def energy_between(curve: Curve, depth: float, low: float, high: float) -> float:
    """Return int y (kappa^2 - rho^2) dy at a depth between two radii, in the order low <= high; low may be 0."""
    j, end = place_of(curve.table, high)
    if low > 0.0:
        i, start = place_of(curve.table, low)
        first = i + 1
        inner = _within(curve, depth, i, start, 1.0 if i < j else end)
    else:  # whatever is below the uniform bins is known from 0 on
        i, first = -1, min(j, curve.table.geometric)
        inner = _from_zero(curve, depth, first)
    outer = _within(curve, depth, j, -1.0, end) if i < j else 0.0
    return inner + _whole_bins(curve, depth, first, j) + outer


@kernel
def jump_energy(curve: Curve, y: float, depth: float, load: float, landing: float) -> float:
    """Return what a jump dissipates, in 2 pi l^2 dgamma, from a state (y, depth, load) to the radius `landing`.

    What is prescribed keeps its value. Either radius may be 0: out of contact depth and load are 0. Where the state is
    further out than the integral is wanted from, y = 0 with its depth and load adds what is below it, which the caller
    takes off. A dead load that lets go falls without end: its jump to 0 has no bounded energy, and is not asked for.
    """
    sign, there, stiffness = 1.0 if landing > y else -1.0, 0.0, 0.0
    lost = sign * energy_between(curve, depth, min(y, landing), max(y, landing))
    if curve.by_load != 0.0 and landing > 0.0:  # the load at the place of landing, at the depth of the state
        i, t = place_of(curve.table, landing)
        depth_there, load_there = depth_and_load(curve, i, t)
        stiffness = landing ** (1.0 + curve.table.k)
        there = load_there + stiffness * (depth - depth_there)
    fall = load - there
    return lost + curve.by_load / softness(curve, stiffness) * fall * fall / (1.0 + curve.table.k)
