"""The control of steps: the error of a step, the length of the next one, and how an error propagates.

The error of an integral follows from the last coefficients of the Legendre series through the nodes: where they are t
and the values T it is about T (t/T)^2.2, except where u^(-1/n) is not smooth, and where collocation loses its order.
"""

import math
from typing import Final, NamedTuple

from gradhesion.core.compiler.jit import NO, YES, kernel
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.rate.law import Law
from gradhesion.core.rate.radau import INTEGRALS, ORDER, SPARED, STAGES, TAIL
from gradhesion.core.rate.step import Room, Start, advance

_EPS: Final = 2.0**-52
TOLERANCE: Final = 1e-13
"""Of rho, and of the energy over that of the largest radius, in a step."""
_LOST: Final = 0.01
_STIFF: Final = 10.0
"""Where the edge relaxes within a step, collocation loses its higher order (order reduction): from about such a rate on
by this part of the last coefficients. Both from experiment: without, 1e-11 of the force."""
_KINK: Final = 8.0
"""By how much the error may exceed the last coefficients at a kink: from experiment."""
_SAFE: Final = 0.9
_SHORTER: Final = 0.15
_LONGER: Final = 4.0
"""How much shorter or longer a step is than the one before it, at most."""
_SHORTEST: Final = 1e-40
LONGEST: Final = 2.0
"""Of a step, in ln a."""
PART: Final = 0.25
"""Longest step in parts of the shortest wave: a slow edge follows the curve between nodes, and could miss a fold."""


@kernel()
def energy_of(law: Law, h: float, room: Room) -> float:
    """Return int z rho^2 dz over the step: the work of the edge in 2 pi l^2 dgamma."""
    c, total = room.curve, 0.0
    for j in range(STAGES):
        rho = law.root + law.sense * room.lags[j]
        total += INTEGRALS[STAGES - 1, j] * c[8, j] * (c[0, j] * rho) ** 2
    return h * total


@kernel()
def spared(first: float, second: float, most: float, stiff: float) -> float:
    """Return the error of an integral, by the last two coefficients of its values, the largest `most`."""
    tail = max(abs(first), 0.1 * abs(second))
    return tail * ((tail / most) ** SPARED + stiff) if tail > 0.0 else 0.0


@kernel()
def _nearly_followed(law: Law, room: Room) -> float:
    """Return the estimated error of rho of a step that passes near rho = 0, where u^(-1/n) is not smooth."""
    if law.sense > 0.0 or room.slow[0] + room.slow[STAGES - 1] == 0.0:
        return 0.0
    low, high, first, second = math.inf, -math.inf, 0.0, 0.0
    for j in range(STAGES):
        rho, force = law.root - room.lags[j], room.curve[8, j] * room.curve[7, j] * room.slow[j]
        low, high = min(low, rho), max(high, rho)
        first, second = first + TAIL[0, j] * force, second + TAIL[1, j] * force
    return _KINK * law.pace * max(abs(first), abs(second)) if low < high - low else 0.0


@kernel()
def errors_of(law: Law, h: float, scale: float, room: Room) -> tuple[float, float]:
    """Return the estimated errors of the step: of rho over its size, and of the energy over z^2 = `scale`."""
    c = room.curve
    a0, a1, a_most, e0, e1, e_most = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(STAGES):
        rho = law.root + law.sense * room.lags[j]
        rate, work = room.rates[j], c[8, j] * (c[0, j] * rho) ** 2 / scale
        a0, a1, a_most = a0 + TAIL[0, j] * rate, a1 + TAIL[1, j] * rate, max(a_most, abs(rate))
        e0, e1, e_most = e0 + TAIL[0, j] * work, e1 + TAIL[1, j] * work, max(e_most, work)
    size = 1.0 + room.lags[STAGES - 1]
    stiff = _LOST * min(1.0, (room.sizes[0] / _STIFF) ** (STAGES - 1))
    of_rho = spared(a1, a0, a_most, stiff) + _nearly_followed(law, room)
    return h * of_rho / size, h * spared(e1, e0, e_most, 0.0)


class Stride(NamedTuple):
    """A step of the edge."""

    good: bool
    h: float
    next: float  # the length to try after it
    lag: float  # at its end
    growth: float  # of a small change of the lag over it
    energy: float
    of_rho: float  # errors, as those of `errors_of`
    of_energy: float


@kernel()
def stride(
    basis: Basis,
    curve: Series,
    law: Law,
    start: Start,
    state: tuple[float, float],
    lengths: tuple[float, float],
    scale: float,
    room: Room,
) -> Stride:
    """Take a step as long as `TOLERANCE` allows, from the state (y, lag); `lengths` are one to try and the longest.

    One that cannot be shorter for rounding is accepted, with its errors.
    """
    h, most = lengths
    least = max(_SHORTEST * most, 4.0 * _EPS * state[0])
    h = min(max(h, least), most)
    while True:
        good = advance(basis, curve, law, start, state, h, room)
        first, second = errors_of(law, h, scale, room) if good else (math.inf, math.inf)
        error = max(first, second)
        good = good and error < math.inf
        if error <= TOLERANCE or (good and h <= least):
            longer = h * min(_LONGER, _SAFE * (TOLERANCE / max(error, _EPS * TOLERANCE)) ** (1.0 / ORDER))
            growth = abs(room.matrix[STAGES - 1, STAGES + 1])
            lag, energy = room.lags[STAGES - 1], energy_of(law, h, room)
            return Stride(YES, h, longer, lag, growth, energy, first, second)
        shorter = h * (max(_SHORTER, _SAFE * (TOLERANCE / error) ** (1.0 / ORDER)) if good else _SHORTER)
        if not good and h <= least:
            break
        h = max(shorter, least)
    return Stride(NO, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@kernel()
def longest(x: float, sign: float, shortest: float) -> float:
    """Return the longest step in ln a from x wavelengths: by a part of the shortest wave, and of the radius."""
    part = sign * PART * shortest / x
    return min(LONGEST, abs(math.log1p(part))) if part > -1.0 else LONGEST
