"""Closing from zero contact at Y = 0, out to a rim or until the machine turns.

The edge starts at an a where rho is next to 0: it follows the equilibrium of Y = 0 outwards, quickly at first.
"""

import math
from typing import Final, NamedTuple

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.rate.law import Law
from gradhesion.core.rate.place import coordinate_of, place_at
from gradhesion.core.rate.radau import STAGES
from gradhesion.core.rate.step import Room, Start, advance, energy_of, longest, place_in, stride
from gradhesion.core.struve.circle import TWO_PI

_INNERMOST: Final = 1e-12
"""Where the edge starts, over the shortest of wave, rim and the length of a smooth contact."""
_TRIALS: Final = 60
_SURE: Final = 2e-15


class Reached(NamedTuple):
    """Where an edge has come to on its way out, in reduced units; NaN where it could not be followed."""

    x: float
    lag: float
    energy: float  # spent so far
    of_rho: float  # estimated errors
    of_energy: float
    turned: bool  # whether Y is where the machine turns, or has been
    furthest: float  # the last place that was reached


@kernel()
def _level(curve: Series, law: Law, room: Room) -> float:
    """Return Y at the end of a step."""
    return coordinate_of(curve, place_in(room, STAGES - 1), law.root - room.lags[STAGES - 1])


@kernel()
def _turned(
    basis: Basis,
    curve: Series,
    law: Law,
    start: Start,
    state: tuple[float, float],
    ends: tuple[float, float, float, float],
    room: Room,
) -> tuple[float, float, float]:
    """Return length, lag and energy of the step from the state (y, lag) that ends where Y is what it is to be.

    `ends` are the length of a step that goes too far, and Y at the start and at the end of that step, and there. It is
    found by the rule of false position (Illinois).
    """
    high, before, after, target = ends
    low, first, second, side = 0.0, before - target, after - target, 0
    length = high
    for _ in range(_TRIALS):
        length = (low * second - high * first) / (second - first)
        if not low < length < high:
            length = 0.5 * (low + high)
        if not advance(basis, curve, law, start, state, length, room):
            return math.nan, math.nan, math.nan
        value = _level(curve, law, room) - target
        if value == 0.0 or high - low < _SURE * high:
            break
        if value < 0.0:
            low, first = length, value
            second *= 0.5 if side < 0 else 1.0
            side = -1
        else:
            high, second = length, value
            first *= 0.5 if side > 0 else 1.0
            side = 1
    return length, room.lags[STAGES - 1], energy_of(law, length, room)


@kernel()
def close_edge(
    basis: Basis, curve: Series, law: Law, rim: float, shortest: float, ends: tuple[float, float, float], room: Room
) -> Reached:
    """Follow an edge outwards while Y rises, to the rim or to where the machine turns.

    Parameters
    ----------
    rim
        Its place in wavelengths, inf where there is none.
    shortest
        The shortest wave in wavelengths, inf where there is none.
    ends
        The length of a smooth contact and the largest place, both in wavelengths, and the Y at which the machine turns.
    """
    size, furthest, target = ends
    x = _INNERMOST * min(rim, shortest, size)
    place = place_at(basis, curve, x)
    lag = law.root - place.drag / place.z * (curve.alpha * place.depth + curve.beta * place.load)
    start, y, end = Start(x, 1.0, 1.0, 1.0), 0.0, math.log(rim / x)
    h, level, error, energy, of_energy = 1.0, 0.0, 0.0, 0.0, 0.0
    if target <= 0.0:
        return Reached(x, lag, 0.0, 0.0, 0.0, True, x)  # noqa: FBT003
    while y < end:
        here = x * math.exp(y)
        most, area = min(end - y, longest(here, 1.0, shortest)), (TWO_PI * here) ** 2
        step = stride(basis, curve, law, start, (y, lag), (h, most), area, room)
        if not step.good or here > furthest:
            break
        after = _level(curve, law, room)
        error = step.growth * error + step.of_rho * (1.0 + step.lag)
        of_energy += area * step.of_energy + 2.0 * place_in(room, STAGES - 1).z ** 2 * error * step.h
        if after >= target:
            length, lag, spent = _turned(basis, curve, law, start, (y, lag), (step.h, level, after, target), room)
            x *= math.exp(y + length)
            return Reached(x, lag, energy + spent, error, of_energy, True, x)  # noqa: FBT003
        energy += step.energy
        y, lag, h, level = y + step.h if step.h < end - y else end, step.lag, step.next, after
    if y < end:
        return Reached(math.nan, math.nan, math.nan, math.nan, math.nan, False, x * math.exp(y))  # noqa: FBT003
    return Reached(rim, lag, energy, error, of_energy, False, rim)  # noqa: FBT003
