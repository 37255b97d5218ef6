"""The law of the moving edge, for both directions, in the lag of rho behind equilibrium.

    opening  rho = 1 + lag            u = rho^2 - 1
    closing  rho = sqrt(Gamma) - lag  u = Gamma/rho^2 - 1

v = v* u^(1/n) is the speed of the edge. Its slowness u^(-1/n) falls from infinity at lag = 0; where closing meets
rho <= 0 it is 0: the edge follows at once.
"""

from typing import NamedTuple

import numpy as np

from gradhesion.core.compiler.jit import kernel


class Law(NamedTuple):
    """How an edge moves."""

    exponent: float  # n
    root: float  # rho in equilibrium: 1 of opening, sqrt(Gamma) of closing
    sense: float  # 1 where rho is above that, -1 where it is below
    pace: float  # eps l alpha/unit, with the unit of depth


@kernel()
def slowness(law: Law, lag: float) -> tuple[float, float]:
    """Return u^(-1/n) at a lag > 0, and its slope over it, which is negative."""
    n, root, sense, _ = law
    if sense > 0.0:
        u = lag * (2.0 + lag)
        value = u ** (-1.0 / n)
        return value, -2.0 * (1.0 + lag) / (n * u)
    rho = root - lag
    if rho <= 0.0:
        return 0.0, 0.0
    u = lag * (root + rho) / (rho * rho)
    return u ** (-1.0 / n), -2.0 * root * root / (n * u * rho * rho * rho)


@kernel()
def lag_of(law: Law, slow: float) -> float:
    """Return the lag at which the slowness has a positive value."""
    n, root, sense, _ = law
    u = slow ** (-n)
    far = np.sqrt(1.0 + u)
    return u / (1.0 + far) if sense > 0.0 else root * u / (far * (1.0 + far))
