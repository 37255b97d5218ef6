"""The arches of the fold function, which prove that a search for folds has missed none.

With n = (1+k)/2, V = S0 + z S0' and X = z^(1+n), the folds of any curve of one wave stand where

    b X + g Q = level,    Q = z^n V

(physics in curve/cosine.py): where the curve Q(X), which depends on k alone, meets a straight line. Between two
inflections Q(X) is concave or convex, and a line meets such an *arch* at most twice. So the signs at the two edges of
an arch, and at most one extremum between them, give the exact number of folds on it.

    dQ/dX = R/(1+n),   R = n V/z + V'
    V' = 2 S0' + z (S1 - S0),   V'' = (1-k) S1 - (2-k) S0 - z S0',   V''' = (1-k) S1' - (3-k) S0' - z (S1 - S0)

Arch i reaches from inflection i to i+1, inflection 0 standing for z = 0; its summit, where Q' = 0, lies near
z = phi + i pi, its inner edge near phi + (i - 1/2) pi. Even arches are concave, odd ones convex.
"""

import math

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.struve.filling import ask_for_arches
from gradhesion.core.struve.layout import ARCHES, ARCHES_AT_ONCE
from gradhesion.core.struve.pair import pair
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Table

_STEPS = 8
"""Newton's method needs 3 steps from the asymptotic place, 5 for the first arch."""


@kernel()
def _abscissa_and_height(table: Table, x: float) -> tuple[float, float, float]:
    """Return x, X, Q."""
    z = TWO_PI * x
    s0, _, s0_slope, _ = pair(table, x)
    power = amplitude_power(table, z)
    return x, z / power, (s0 + z * s0_slope) / power


@kernel()
def find_inflection(table: Table, i: int) -> tuple[float, float, float]:
    """Return x, X, Q at the inner edge of arch i."""
    if i == 0:
        return 0.0, 0.0, 0.0
    k = table.k
    n = 0.5 * (1.0 + k)
    place = table.phase + (i - 0.5) * math.pi
    if i > ARCHES:  # with the next term of the expansion the error is 1e-8
        return _abscissa_and_height(table, (place + (2.125 - k - 0.125 * k * k) / place) / TWO_PI)
    x = (place + 0.9 * (2.0 - k) / (place + 1.0)) / TWO_PI
    for _ in range(_STEPS):
        z = TWO_PI * x
        s0, s1, d0, d1 = pair(table, x)
        v = s0 + z * d0
        v1 = 2.0 * d0 + z * (s1 - s0)
        v2 = (1.0 - k) * s1 - (2.0 - k) * s0 - z * d0
        v3 = (1.0 - k) * d1 - (3.0 - k) * d0 - z * (s1 - s0)
        value = n * v1 - n * v / z + z * v2
        slope = n * v2 - n * v1 / z + n * v / (z * z) + v2 + z * v3
        step = value / slope / TWO_PI
        x -= step
        if abs(step) < 1e-12 * x:
            break
    return _abscissa_and_height(table, x)


@kernel()
def find_summit(table: Table, i: int) -> tuple[float, float, float]:
    """Return x, X, Q where arch i is highest (i even) or lowest (i odd)."""
    k = table.k
    n = 0.5 * (1.0 + k)
    place = table.phase + i * math.pi
    if i > ARCHES:
        return _abscissa_and_height(table, (place + (1.625 - 0.5 * k - 0.125 * k * k) / place) / TWO_PI)
    x = (place + 1.2 / (place + 0.5)) / TWO_PI
    for _ in range(_STEPS):
        z = TWO_PI * x
        s0, s1, d0, _ = pair(table, x)
        v = s0 + z * d0
        v1 = 2.0 * d0 + z * (s1 - s0)
        v2 = (1.0 - k) * s1 - (2.0 - k) * s0 - z * d0
        step = (n * v / z + v1) / (n * v1 / z - n * v / (z * z) + v2) / TWO_PI
        x -= step
        if abs(step) < 1e-12 * x:
            break
    return _abscissa_and_height(table, x)


@kernel()
def build_arches(table: Table) -> None:
    """Fill the table's arches; its pair must be complete."""
    for i in range(ARCHES + 1):
        row = table.arches[i]
        row[0], row[1], row[2] = find_inflection(table, i)
        row[3], row[4], row[5] = find_summit(table, i)


@kernel()
def inner_edge(table: Table, i: int) -> tuple[float, float, float]:
    """Return x, X, Q at the inner edge of arch i."""
    if i <= ARCHES:
        ask_for_arches(table, i // ARCHES_AT_ONCE)
        row = table.arches[i]
        return row[0], row[1], row[2]
    return find_inflection(table, i)


@kernel()
def summit(table: Table, i: int) -> tuple[float, float, float]:
    """Return x, X, Q at the summit of arch i."""
    if i <= ARCHES:
        ask_for_arches(table, i // ARCHES_AT_ONCE)
        row = table.arches[i]
        return row[3], row[4], row[5]
    return find_summit(table, i)
