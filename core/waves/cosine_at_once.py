"""Jumps of eight waves far from zero contact, computed at once: each is that of waves/cosine.py.

No search waits for another to end, and one instruction does all eight (numbers/lanes.py). Guesses are so good out here
that a fold takes one step or two of Halley's method, and a landing two or three; a wave that needs more, or whose jump
has no place to land, has NaN here. Powers are (1 + e)^(-c) from one place near the middle of each jump.

What a jump loses comes from the antiderivative of curve/cosine_jump.py, whose bracket keeps its digits here. Where the
folds are about to end, jumps are short and it cancels: there Gauss's rule is used for all of the integrand.
"""

import math
from typing import Final, TypeAlias

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.at_once import find_zeros, guess_zeros
from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.curve.cosine_energy import unit_rule
from gradhesion.core.curve.cosine_folds import half_wave
from gradhesion.core.curve.cosine_jump import beyond_from, inverse_stretch
from gradhesion.core.numbers.circle import TWO_PI, sine_cosine_of_turns
from gradhesion.core.numbers.lanes import LANES, Lanes, any_above, chosen, eight, load, rounded, size_of, store
from gradhesion.core.struve.layout import SWITCH
from gradhesion.core.struve.pair import horner8
from gradhesion.core.struve.power import amplitude_powers
from gradhesion.core.types import Floats, Table
from gradhesion.core.waves.cosine import LAST_LANDING, LAST_STEP, WIDE, Left, jump_of_wave, slope_of

Middle: TypeAlias = tuple[float, Lanes, Lanes]
"""A place x beyond whole waves, near the middle of a jump, and z and z^c there."""
FIRST: Final = 8.5
"""The innermost wave: z > 40 from the one before it on."""
BATCH: Final = 16
"""Waves that sums take together."""
WORK: Final = 22
WAVES: Final = WORK
LOSSES: Final = WORK + BATCH
"""Rows of the room for the waves, and for the losses of their jumps; a single jump uses the rows before them."""
Batch: TypeAlias = Floats
"""Room for a batch of waves, of shape (LOSSES + BATCH,)."""
_BETWEEN: Final = 0.875
"""Waves from the centre of a wave to the middle of all places on its jump."""
_FOLD_STEPS: Final = 3
_LANDING_STEPS: Final = 5
_SHORT: Final = 0.55
_SHORT_NODES, _SHORT_WEIGHTS = unit_rule(11)
_NODES, _WEIGHTS = unit_rule(14)
"""For jumps of so many waves, and of a wave: the error is 1e-15 of a term cos 2 z."""
_ENOUGH: Final = 0.1
"""Loss over the size of its terms, below which quadrature is used: it loses no digits."""


@kernel()
def room_for_batch() -> Batch:
    """Return room for a batch of waves."""
    return np.empty(LOSSES + BATCH)


@kernel(contract=True, inline=True)
def _within(low: Lanes, value: Lanes, high: Lanes) -> Lanes:
    """Return values that lie between two others, NaN for the rest."""
    return chosen(low, value, chosen(value, high, value, math.nan), math.nan)


@kernel(contract=True, inline=True)
def _powers_at(table: Table, middle: Middle, x: Lanes) -> tuple[Lanes, Lanes]:
    """Return z and z^(-n) at the places x beyond the whole waves."""
    place, z0, stretch0 = middle
    beyond = TWO_PI * (x - place)
    z = z0 + beyond
    return z, stretch0 / (z * (1.0 + inverse_stretch(table, beyond / z0)))


@kernel(contract=True, inline=True)
def _slope(table: Table, curve: Cosine, middle: Middle, x: Lanes) -> tuple[Lanes, Lanes, Lanes, Lanes, Lanes, Lanes]:
    """Return D at the level of the depth, its first two derivatives, z, z S0 and z^c."""
    z, power = _powers_at(table, middle, x)
    return slope_of(table, curve, x, z, power)


@kernel(contract=True, inline=True)
def _rise(table: Table, curve: Cosine, left: Left, step: Lanes, z: Lanes, wave: Lanes) -> Lanes:
    """Return the depth less that of the place that is left, `step` waves further in; `wave` is z S0 here."""
    b, g, _ = curve
    z1, wave1, stretch1 = left
    less = inverse_stretch(table, TWO_PI * step / z1)
    return 0.5 * b * (z + z1) * (TWO_PI * step) + g * (wave - wave1) + stretch1 * (less / (1.0 + less))


@kernel(contract=True)
def _guess(table: Table, curve: Cosine, middle: Middle, centre: float, side: float) -> Lanes:
    """Return about where the branches around a centre end (side = 1) or start (-1), as `_fold` of waves/cosine.py."""
    b, g, _ = curve
    k = table.k
    place, z0, _ = middle
    x = centre + 0.0 * z0
    for _ in range(2):
        z, power = _powers_at(table, middle, x)
        cosine = (0.5 * (1.0 - k) / z - b / power) / (g * table.amplitude)
        share = 0.5 - 0.5 * chosen(cosine, -1.0, -1.0, chosen(1.0, cosine, 1.0, cosine))
        x = centre + (0.5 * side) * half_wave(share)
    return x + (0.5 * (1.0 - k) + 0.125 * (1.0 - k * k)) / (TWO_PI * (z0 + TWO_PI * (centre - place)))


@kernel(contract=True)
def _find_folds(
    table: Table, curve: Cosine, middle: Middle, low: float, high: float, x: Lanes
) -> tuple[Lanes, Lanes, Left, Lanes]:
    """Return the folds between two places (NaN if they take longer), from guesses x.

    Then the last places before them, z, z S0 and z^c there, and what the depth gains from there.
    """
    place, found, gain = x, x, x
    z, wave, stretch = x, x, x
    for _ in range(_FOLD_STEPS):
        x = chosen(x, low, low + 0.0 * x, chosen(high, x, high + 0.0 * x, x))
        d, d1, d2, z, wave, stretch = _slope(table, curve, middle, x)
        step = -(d * d1) / (d1 * d1 - 0.5 * d * d2)
        place, x, size = x, x + step / TWO_PI, size_of(d1)
        gain = step * (d + step * (0.5 * d1 + step * d2 * (1.0 / 6.0)))
        found = _within(low, chosen(size_of(step) * (size_of(d2) + size), LAST_STEP * size, x, math.nan), high)
        if not any_above(found, math.inf):
            break
    return found, place, (z, wave, stretch), rounded(gain)


@kernel(contract=True)
def _land(
    table: Table, curve: Cosine, middle: Middle, start: tuple[Lanes, Lanes, Left, Lanes], centre: float, side: float
) -> Lanes:
    """Return where the branches around a centre meet the depth of the folds that are left, NaN where that takes longer.

    The bounds of the search and the guess are those of `_landing` of waves/cosine.py.
    """
    _, g, _ = curve
    fold, origin, left, risen = start
    inner, outer = centre - 0.5, centre + 0.5
    low, high = (centre, outer) if side > 0.0 else (inner, centre)
    far, place, (z, wave, stretch), gain = _find_folds(table, curve, middle, low, high, fold + side)
    far_rest = _rise(table, curve, left, place - origin, z, wave) + (gain - risen)
    turns = size_of(far - centre)
    sine, cosine = sine_cosine_of_turns(turns)
    drop = 2.0 * g * table.amplitude * stretch * (sine - TWO_PI * turns * cosine)
    near, near_rest = 2.0 * centre - far, far_rest - side * drop
    if any_above(TWO_PI * turns, WIDE):
        low, high = (inner, centre) if side > 0.0 else (centre, outer)
        found, place, (z, wave, stretch), gain = _find_folds(table, curve, middle, low, high, near)
        found_rest = _rise(table, curve, left, place - origin, z, wave) + (gain - risen)
        near_rest = chosen(TWO_PI * turns, WIDE, near_rest, found_rest)
        near = chosen(TWO_PI * turns, WIDE, near, found)
    lows, highs = (near, far) if side > 0.0 else (far, near)
    lowest, highest = (near_rest, far_rest) if side > 0.0 else (far_rest, near_rest)
    x = lows + (highs - lows) * half_wave(lowest / (lowest - highest))
    landing = eight(math.nan)
    for _ in range(_LANDING_STEPS):
        d, d1, _, z, wave, _ = _slope(table, curve, middle, x)
        rest = _rise(table, curve, left, x - origin, z, wave) - risen
        lows, highs = chosen(rest, 0.0, x, lows), chosen(rest, 0.0, highs, x)
        step = -(rest * d) / (d * d - 0.5 * rest * d1)
        new = _within(lows, x + step / TWO_PI, highs)
        enough = chosen(size_of(step) * (size_of(d1) + size_of(d)), LAST_LANDING * size_of(d), new, math.nan)
        landing = chosen(landing, landing, landing, enough)
        if not any_above(landing, math.inf):
            break
        x = chosen(new, new, new, 0.5 * (lows + highs))
    return landing


@kernel(contract=True)
def _by_nodes(
    table: Table,
    curve: Cosine,
    middle: Middle,
    start: tuple[Lanes, Lanes, Left, Lanes],
    landing: Lanes,
    nodes: Floats,
    weights: Floats,
) -> Lanes:
    """Return what the jumps lose by Gauss's rule, as `panel_above` of curve/cosine_energy.py, with m for the middle.

    A jump leaves the curve at a fold and lands at x = `landing`; `start` has the x of the folds, where their waves
    begin, the curve there, and by how much it has risen. Nodes and weights, of shape (n,), are those on [0, 1].

    With (1 + eta)^(-c) = 1 + s it is (1 + s) [(depth_H - depth_j - stretch_m)/stretch_m] + s that is rho - 1, and in it
    the wave at z has the factor 1: nothing is divided by the stretch there.
    """
    b, g, _ = curve
    fold, origin, (z1, wave1, _), risen = start
    width = landing - fold
    centre = fold + 0.5 * width
    middle_z, power = _powers_at(table, middle, centre)
    inverse_m = 1.0 / (middle_z * power)
    ratio = 0.5 * TWO_PI * width / middle_z
    less = inverse_stretch(table, TWO_PI * (origin - centre) / middle_z)
    behind = -less / (1.0 + less)
    total = 0.0 * width
    for i in range(nodes.size):
        eta = ratio * (2.0 * nodes[i] - 1.0)
        less = inverse_stretch(table, eta)
        x = fold + width * nodes[i]
        z = middle_z + middle_z * eta
        inverse = 1.0 / z
        p, q, _, _, height, _, _, _ = horner8(table.tail, 2.0 * SWITCH * SWITCH * (inverse * inverse) - 1.0)
        sine, cosine = sine_cosine_of_turns(x)
        s = sine * table.cos_phase - cosine * table.sin_phase
        c = cosine * table.cos_phase + sine * table.sin_phase
        rise = 0.5 * b * (z + z1) * (TWO_PI * (x - origin)) + g * (height - wave1) - risen
        slow = inverse_m * rise + behind
        excess = (slow + less * slow) + less + g * (p * s + q * inverse * c)  # rho - 1
        total = total - weights[i] * z * (excess * (2.0 + excess))
    return TWO_PI * width * total


@kernel(contract=True)
def folds_at_once(table: Table, curve: Cosine, waves: Lanes, signs: Lanes) -> tuple[Lanes, Lanes]:
    """Return the places in waves where branches start (sign 1) or end (-1), and the depths there.

    They are those of `fold_of_wave`, for waves whose place and phase a double resolves; NaN where that takes longer.
    """
    level = 0.5 * (1.0 - table.k)
    low = waves + (table.phase / TWO_PI - 0.25) - 0.25 * signs
    return find_zeros(table, curve, level, low, low + 0.5, guess_zeros(table, curve, level, 2.0 * waves, signs))


@kernel(contract=True)
def jumps_at_once(table: Table, curve: Cosine, waves: Lanes, outwards: bool) -> Lanes:
    """Return what the jumps of eight waves to the next ones lose, NaN where that takes longer.

    Outwards each leaves the end of its wave's branch, inwards the start. Waves are real numbers from FIRST on.
    """
    side = 1.0 if outwards else -1.0
    centre = table.phase / TWO_PI + 2.0
    place = centre + side * _BETWEEN
    z0 = TWO_PI * ((waves - 2.0) + place)
    middle = (place, z0, z0 * amplitude_powers(table, z0))
    low, high = (centre, centre + 0.5) if outwards else (centre - 0.5, centre)
    guess = _guess(table, curve, middle, centre, side)
    start = _find_folds(table, curve, middle, low, high, guess)
    landing = _land(table, curve, middle, start, centre + side, side)
    fold = start[0]
    if not any_above(size_of(landing - fold), _SHORT):
        return _by_nodes(table, curve, middle, start, landing, _SHORT_NODES, _SHORT_WEIGHTS)
    z1, power1 = _powers_at(table, middle, fold)
    z2, power2 = _powers_at(table, middle, landing)
    loss, size = beyond_from(table, curve, (fold, z1, power1), (landing, z2, power2), TWO_PI * (landing - fold))
    if any_above(_ENOUGH * size - size_of(loss), 0.0):
        return _by_nodes(table, curve, middle, start, landing, _NODES, _WEIGHTS)
    return loss


@kernel()
def jumps_of_batch(table: Table, curve: Cosine, outwards: bool, room: Batch) -> None:
    """Put what the jumps of a batch of waves to their next ones lose into its room."""
    for first in range(0, BATCH, LANES):
        store(room, LOSSES + first, jumps_at_once(table, curve, load(room, WAVES + first), outwards))
    for i in range(BATCH):
        if math.isnan(room[LOSSES + i]) or room[WAVES + i] < FIRST:
            _, room[LOSSES + i] = jump_of_wave(table, curve, room[WAVES + i], outwards, room)


@kernel()
def jumps_in_a_row(table: Table, curve: Cosine, first: float, last: float, outwards: bool, room: Batch) -> None:
    """Do the same for the waves from `first` on; where `last` comes before the end of the batch, it fills the rest."""
    for i in range(BATCH):
        room[WAVES + i] = min(first + i, last)
    jumps_of_batch(table, curve, outwards, room)
