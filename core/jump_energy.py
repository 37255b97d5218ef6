"""The energy lost in a jump at fixed depth: the drop of the potential energy from one contact radius to another.

    e = int_{z1}^{z2} z [1 - rho^2] dz,   rho = (depth_H - depth_j)/z^c,   depth_H = b z^2/2 + g z S0

in units of 2 pi l^2 dgamma, from the radius that is left to the one that is reached, where depth_j is the depth of the
jump and rho = 1 on the equilibrium curve. The sign matters: unloading always loses energy, and so does loading as long as
rho > -1 on the way, but a jump outwards over a deep groove passes states of rho < -1 (the edge pressed shut, where the
contact is no longer one disc) and may gain some. The sum over a cycle is the loop integral of P d(depth) all the same.

Between two radii the integrand is smooth and Gauss's rule takes it. From or to zero contact it has a branch point z^k at 0,
and an antiderivative serves, in which E1 = int y^(k+1) S0 = z^(k+2) S1/(k+1) and the moments E2 and W of moments.py enter:

    z^2/2 - [ b^2/4 z^(5+k)/(5+k) + b g E2 + g^2 W ] + d [ b z^(3+k)/(3+k) + 2 g E1 ] - d^2 z^(1+k)/(1+k)

All its terms are of the size of the result there, so nothing cancels.
"""

import math
from typing import Any, Final

import numpy as np

from gradhesion.core._jit import kernel
from gradhesion.core.curve import wave
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.struve.moments import moments

_LONGEST_PANEL: Final = 1.25
"""In waves: 16 nodes leave 1e-17 of a term cos 2 z, the fastest of the integrand, on one wave, 1e-14 on this length."""
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
NODES: Final = 0.5 * (1.0 + _NODES)
WEIGHTS: Final = 0.5 * _WEIGHTS


@kernel(contract=True)
def jump_energy(table: Any, b: float, g: float, start: float, end: float) -> float:
    """Return e for a jump that leaves the curve at x = start and ends at x = end."""
    z1, power, s0, _, _, _, _ = wave(table, start)
    wave1 = z1 * s0
    stretch1 = z1 * power
    length = end - start
    panels = int(abs(length) / _LONGEST_PANEL) + 1
    total = 0.0
    for panel in range(panels):
        panel_start = start + length * panel / panels
        part = 0.0
        for i in range(NODES.size):
            x = panel_start + length / panels * NODES[i]
            z, power, s0, _, _, _, _ = wave(table, x)
            # differences first: each is of the size of the stretch, however large the depths are
            rise = 0.5 * b * (z + z1) * (TWO_PI * (x - start)) + g * (z * s0 - wave1)
            rho = (rise + stretch1) / (z * power)
            part += WEIGHTS[i] * z * ((1.0 - rho) * (1.0 + rho))
        total += part
    return total * (TWO_PI * length / panels)


@kernel(contract=True)
def energy_from_zero(table: Any, b: float, g: float, x: float, depth: float) -> float:
    """Return e for a jump at the given depth from zero contact to x; the way back has the other sign."""
    k = table.k
    z, power, _, s1, _, _, _ = wave(table, x)
    e2, w = moments(table, x, power)
    front = 1.0 / (power * power)  # z^(1+k)
    square = z * z
    quadratic = front * square * square * (0.25 * b * b / (5.0 + k) + b * g * e2 + g * g * w)
    linear = front * square * (b / (3.0 + k) + 2.0 * g * s1 / (z * (k + 1.0)))
    return 0.5 * square - quadratic + depth * (linear - depth * front / (1.0 + k))
