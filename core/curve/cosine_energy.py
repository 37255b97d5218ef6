"""The energy lost in a jump at fixed depth: the drop of the potential energy from one contact radius to another.

    e = int_{z1}^{z2} z [1 - rho^2] dz,   rho = (depth_H - depth_j)/z^c,   depth_H = b z^2/2 + g z S0

in units of 2 pi l^2 dgamma, from the radius where the jump starts to the one where it lands, at the depth depth_j of
the jump; rho = 1 on the equilibrium curve. The sign matters: unloading always loses energy, and so does loading as long
as rho > -1 on the way, but a jump outwards over a deep groove passes states of rho < -1 (the edge pressed shut, where
the contact is no longer one disc) and may gain some. The sum over a cycle is the loop integral of P d(depth) all the
same.

Between two radii the integrand is smooth, and Gauss's rule is used. From or to zero contact it has a branch point z^k
at 0, and an antiderivative is used, in which E1 = int y^(k+1) S0 = z^(k+2) S1/(k+1) and the moments E2 and W of
moments.py enter:

    z^2/2 - [ b^2/4 z^(5+k)/(5+k) + b g E2 + g^2 W ] + d [ b z^(3+k)/(3+k) + 2 g E1 ] - d^2 z^(1+k)/(1+k)

All its terms are of the size of the result there, so nothing cancels.
"""

import math
from typing import Final, TypeAlias

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.cosine import Cosine, wave
from gradhesion.core.curve.cosine_jump import ENOUGH, REACH, beyond_at_once, energy_between, gauss_rule
from gradhesion.core.numbers.circle import TWO_PI, sine_cosine_of_turns
from gradhesion.core.numbers.lanes import LANES, Lanes, chosen, load, size_of, sum_of
from gradhesion.core.struve.layout import SWITCH, TAIL_TERMS
from gradhesion.core.struve.moments import moments
from gradhesion.core.struve.pair import first_functions
from gradhesion.core.struve.power import amplitude_power, amplitude_powers
from gradhesion.core.types import Table, Work

_PANELS: Final = {12: 0.8, 16: 1.25}
"""Gauss nodes, and the longest panel in waves for which they leave 1e-14 of a term cos 2 z, the fastest there is."""


def unit_rule(nodes: int) -> tuple[np.ndarray, np.ndarray]:
    """Return Gauss's rule on [0, 1]."""
    places, weights = gauss_rule(nodes)
    return 0.5 * (1.0 + places), weights


SHORT, LONG = _PANELS.values()
SHORT_NODES, SHORT_WEIGHTS = unit_rule(12)
NODES, WEIGHTS = unit_rule(16)
_FURTHEST: Final = 64.0
"""In waves: over longer jumps the antiderivative loses less to cancellation than the sum of panels costs."""
Left: TypeAlias = tuple[float, float, float]
"""The place that a jump leaves: z, z S0 and z^c there."""
_POWER_TERMS: Final = 12
"""Terms of (1 + eta)^c - 1 for |eta| <= 0.1, the half of a panel over its z."""
_SMALL_LAG: Final = 0.1
"""Distance of the start of a jump from the middle of a panel, over its z, up to which those terms suffice."""


@kernel(contract=True)
def _panel_below(table: Table, curve: Cosine, start: float, left: Left, begin: float, width: float) -> float:
    """Integrate z (1 - rho^2) over one panel of the x axis, per unit of x, eight nodes at a time."""
    b, g, lag = curve
    z1, wave1, stretch1 = left
    total = 0.0
    for first in range(0, NODES.size, LANES):
        x = begin + width * load(NODES, first)
        z = TWO_PI * x
        power = amplitude_powers(table, z)
        s0 = first_functions(table, lag, x, z, power)
        # differences first: each is of the size of the stretch, however large the depths are
        rise = 0.5 * b * (z + z1) * (TWO_PI * (x - start)) + g * (z * s0 - wave1)
        rho = (rise + stretch1) / (z * power)
        total += sum_of(load(WEIGHTS, first) * z * ((1.0 - rho) * (1.0 + rho)))
    return total * width


@kernel(contract=True)
def panel_above(
    table: Table, curve: Cosine, whole: float, start: float, left: Left, begin: float, width: float, work: Work
) -> float:
    """Do the same where all z >= 40: pair.py's expansion, written so that all nodes are worked on at once.

    Places are x beyond `whole` waves, which may be any real number: phases come from x alone (waves/cosine.py). It is
    rho - 1 that is computed, which is of the size of chi: in 1 - rho it would lose 1/chi.
    """
    b, g, _ = curve
    z1, wave1, stretch1 = left
    c = 0.5 * (1.0 - table.k)
    middle = TWO_PI * (whole + (begin + 0.5 * width))
    ratio = TWO_PI * 0.5 * width / middle
    stretch_middle = middle * amplitude_power(table, middle)
    lag = TWO_PI * (start - (begin + 0.5 * width)) / middle
    behind = (stretch1 - stretch_middle) / stretch_middle
    if abs(lag) <= _SMALL_LAG:
        behind = 1.0
        for j in range(_POWER_TERMS, 0, -1):
            behind = 1.0 + behind * lag * ((c - j) / (j + 1.0))
        behind *= c * lag
    tail = table.tail
    cos_phase, sin_phase = table.cos_phase, table.sin_phase
    for i in range(16):
        x = begin + width * NODES[i]
        z = TWO_PI * (whole + x)
        inverse = 1.0 / z
        w = SWITCH * inverse
        t = 2.0 * (w * w) - 1.0
        p, q, height = tail[TAIL_TERMS - 1, 0], tail[TAIL_TERMS - 1, 1], tail[TAIL_TERMS - 1, 4]
        for j in range(TAIL_TERMS - 2, -1, -1):
            p = p * t + tail[j, 0]
            q = q * t + tail[j, 1]
            height = height * t + tail[j, 4]
        eta = ratio * (2.0 * NODES[i] - 1.0)
        power = 1.0
        for j in range(_POWER_TERMS, 0, -1):
            power = 1.0 + power * eta * ((c - j) / (j + 1.0))
        power *= c * eta
        stretch = stretch_middle * (1.0 + power)
        sine, cosine = sine_cosine_of_turns(x)
        s = sine * cos_phase - cosine * sin_phase
        cosine_z = cosine * cos_phase + sine * sin_phase
        wave_z = height + stretch * (p * s + q * inverse * cosine_z)
        rise = 0.5 * b * (z + z1) * (TWO_PI * (x - start)) + g * (wave_z - wave1)
        excess = (rise - stretch_middle * (power - behind)) / stretch  # rho - 1
        work[i] = WEIGHTS[i] * z * (-excess * (2.0 + excess))
    total = 0.0
    for i in range(16):
        total += work[i]
    return total * width


@kernel(contract=True)
def energy_from_zero(table: Table, curve: Cosine, x: float, depth: float) -> float:
    """Return e for a jump at the given depth from zero contact to x; the way back has the other sign."""
    b, g, lag = curve
    k = table.k
    z, power, _, s1, _, _, _ = wave(table, lag, x)
    e2, w = moments(table, x, power)
    front = 1.0 / (power * power)  # z^(1+k)
    square = z * z
    quadratic = front * square * square * (0.25 * b * b / (5.0 + k) + b * g * e2 + g * g * w)
    linear = front * square * (b / (3.0 + k) + 2.0 * g * s1 / (z * (k + 1.0)))
    return 0.5 * square - quadratic + depth * (linear - depth * front / (1.0 + k))


@kernel(contract=True)
def energy_by_panels(table: Table, curve: Cosine, start: float, end: float, work: Work) -> float:
    """Return what `jump_energy` does, by quadrature: slower, but good to the last digits of the smallest loss."""
    b, g, lag = curve
    z1, power, s0, _, _, _, _ = wave(table, lag, start)
    left = (z1, z1 * s0, z1 * power)
    depth = z1 * (0.5 * b * z1 + g * s0 - power)
    if end == 0.0:  # k = 1: the contact shrinks to a point
        return -energy_from_zero(table, curve, start, depth)
    if abs(end - start) > _FURTHEST:
        return energy_from_zero(table, curve, end, depth) - energy_from_zero(table, curve, start, depth)
    begin, high = min(start, end), max(start, end)
    total = 0.0
    while (
        high - begin > 2.0 * begin and begin < 0.5 * LONG
    ):  # panels grow with their distance from the branch point at 0
        total += _panel_below(table, curve, start, left, begin, 2.0 * begin)
        begin *= 3.0
    panels = int((high - begin) / LONG) + 1
    width = (high - begin) / panels
    for _ in range(panels):
        if TWO_PI * begin >= SWITCH:
            # whole waves apart: beyond 10^6 of them a node rounded as a whole would miss its phase by 10^-9
            whole = float(int(begin))
            total += panel_above(table, curve, whole, start - whole, left, begin - whole, width, work)
        else:
            total += _panel_below(table, curve, start, left, begin, width)
        begin += width
    return total * (TWO_PI if end > start else -TWO_PI)


@kernel()
def jump_energy(table: Table, curve: Cosine, start: float, end: float, work: Work) -> float:
    """Return e for a jump that leaves the curve at x = start and ends at x = end; `work` has room for 16 floats."""
    if start == end:
        return 0.0
    if end > 0.0:
        energy, size = energy_between(table, curve, start, end)
        if abs(energy) >= ENOUGH * size:
            return energy
    return energy_by_panels(table, curve, start, end, work)


@kernel(contract=True)
def energies_at_once(table: Table, curve: Cosine, start: Lanes, end: Lanes) -> Lanes:
    """Return what `jump_energy` does for eight jumps with both ends beyond z = 40, NaN where that takes longer."""
    energy, size = beyond_at_once(table, curve, start, end)
    energy = chosen(ENOUGH * size, size_of(energy), energy, math.nan)
    return chosen(size_of(end - start), REACH * (start + end), energy, math.nan)
