"""Closing from zero contact at Y = 0, out to a rim or until the machine turns.

The edge starts at an a where rho is next to 0: it follows the equilibrium of Y = 0 outwards, quickly at first.
"""

import math
from typing import Final, NamedTuple

from gradhesion.core.compiler.jit import NO, YES, kernel
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.rate.bracket import TRIALS, Bracket, is_found, narrowed, place_to_try
from gradhesion.core.rate.law import Law
from gradhesion.core.rate.place import coordinate_of, place_at
from gradhesion.core.rate.radau import STAGES
from gradhesion.core.rate.step import Room, Start, advance, note_nodes, place_in
from gradhesion.core.rate.stride import energy_of, longest, stride

_INNERMOST: Final = 1e-12
"""Where the edge starts, over the shortest of wave, rim and the length of a smooth contact."""


class Reached(NamedTuple):
    """The state of an edge on its way outwards, in reduced units; NaN where it could not be followed."""

    x: float
    lag: float
    energy: float  # spent so far
    of_rho: float  # estimated errors
    of_energy: float
    turned: bool  # whether Y is where the machine turns, or has been
    furthest: float  # the last place that was reached


@kernel()
def _value(curve: Series, law: Law, room: Room, of_rho: bool) -> float:
    """Return Y at the end of a step, or rho."""
    rho = law.root - room.lags[STAGES - 1]
    return rho if of_rho else coordinate_of(curve, place_in(room, STAGES - 1), rho)


class _Target(NamedTuple):
    """The target of a step, and the values at its start and at the end of one that goes too far."""

    before: float
    after: float
    target: float
    of_rho: bool  # what it is: rho, not Y


@kernel()
def _step_to(
    basis: Basis, curve: Series, law: Law, start: Start, state: tuple[float, float], h: float, ends: _Target, room: Room
) -> tuple[float, float, float]:
    """Return length, lag and energy of the step from the state (y, lag) that meets its target, shorter than h."""
    bracket, length = Bracket(0.0, h, ends.before - ends.target, ends.after - ends.target, 0), h
    for _ in range(TRIALS):
        length = place_to_try(bracket)
        if not advance(basis, curve, law, start, state, length, room):
            return math.nan, math.nan, math.nan
        value = _value(curve, law, room, ends.of_rho) - ends.target
        if is_found(bracket, value, 0.0):
            break
        bracket = narrowed(bracket, length, value)
    return length, room.lags[STAGES - 1], energy_of(law, length, room)


@kernel()
def close_edge(
    basis: Basis, curve: Series, law: Law, rim: float, shortest: float, ends: tuple[float, float, float], room: Room
) -> Reached:
    """Follow an edge outwards while Y rises, to the rim or to where the machine turns.

    The rim and the shortest wave are in wavelengths, inf where there is none; `ends` are the length of a smooth contact
    and the largest place, both in wavelengths, and the Y at which the machine turns.
    """
    size, furthest, target = ends
    x = _INNERMOST * min(rim, shortest, size)
    place = place_at(basis, curve, x)
    lag = law.root - place.drag / place.z * (curve.alpha * place.depth + curve.beta * place.load)
    start, y, end = Start(x, 1.0, 1.0, 1.0), 0.0, math.log(rim / x)
    h, level, error, energy, of_energy = 1.0, 0.0, 0.0, 0.0, 0.0
    if target <= 0.0:
        return Reached(x, lag, 0.0, 0.0, 0.0, True, x)
    while y < end:
        here = x * math.exp(y)
        most, area = min(end - y, longest(here, 1.0, shortest)), (TWO_PI * here) ** 2
        step = stride(basis, curve, law, start, (y, lag), (h, most), area, room)
        if not step.good or here > furthest:
            break
        after, place = _value(curve, law, room, NO), place_in(room, STAGES - 1)
        error = step.growth * error + step.of_rho * (1.0 + step.lag)
        of_energy += area * step.of_energy + 2.0 * place.z**2 * error * step.h
        if after >= target:
            turn = _Target(level, after, target, NO)
            length, lag, spent = _step_to(basis, curve, law, start, (y, lag), step.h, turn, room)
            note_nodes(law, room)
            x *= math.exp(y + length)
            return Reached(x, lag, energy + spent, error, of_energy, True, x)
        h, length, spent, last = step.next, step.h, step.energy, step.lag
        if (lag - law.root) * (last - law.root) < 0.0:  # u^(-1/n) is not smooth at rho = 0: a step ends there
            zero = _Target(law.root - lag, law.root - last, 0.0, YES)
            length, last, spent = _step_to(basis, curve, law, start, (y, lag), step.h, zero, room)
            after = _value(curve, law, room, NO)
            h, last = step.h - length, law.root
        note_nodes(law, room)
        energy += spent
        y, lag, level = y + length if length < end - y else end, last, after
    if y < end:
        return Reached(math.nan, math.nan, math.nan, math.nan, math.nan, False, x * math.exp(y))
    return Reached(rim, lag, energy, error, of_energy, False, rim)
