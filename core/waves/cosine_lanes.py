"""Jumps of sixteen waves far from zero contact, worked on at once.

Here waves/cosine.py's search and integral are steps, each one a loop over sixteen waves without a branch: one
instruction serves several of them, and no search waits for another to end. A fold gets two steps of Halley's method, a
landing four. A wave for which these leave more than waves/cosine.py would, or whose jump has no place to land, is done
there: next to branch points, and with `_FIRST` waves or fewer.

Far out the pair's tail is short: its polynomials are taken in u = 2 (40/z)^2 instead of u - 1 (struve/pair.py), and
end with u^4. That leaves 1e-17 at z = 80. Powers are (1 + e)^p from one place for each wave.
"""

import math
from typing import Any, Final

import numpy as np

from gradhesion.core._jit import kernel
from gradhesion.core.curve.cosine import Curve
from gradhesion.core.curve.cosine_energy import unit_rule
from gradhesion.core.struve.circle import TWO_PI, sine_cosine_of_turns
from gradhesion.core.struve.intrinsics import make_polynomials
from gradhesion.core.struve.layout import SWITCH, TAIL_TERMS
from gradhesion.core.struve.pair import polynomials8
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.waves.cosine import LAST_LANDING, LAST_STEP, WIDE, jump_of_wave

LANES: Final = 16
"""Waves worked on at once."""
WORK: Final = 22
"""Floats at the begin of the room that a jump of one wave works in."""
WAVES: Final = WORK
LOSSES: Final = WORK + LANES
"""Where the waves stand in the room, any real numbers, and where what their jumps lose is put."""
(
    _Z0,
    _STRETCH0,
    _X,
    _D,
    _D1,
    _D2,
    _Z,
    _WAVE,
    _STRETCH,
    _PLACE,
    _GAIN,
    _DONE,
    _GOOD,
    _START,
    _FROM,
    _RISEN,
    _Z1,
    _WAVE1,
    _STRETCH1,
    _FAR,
    _FAR_REST,
    _NEAR,
    _NEAR_REST,
    _LOW,
    _HIGH,
    _REST,
    _END,
) = range(LOSSES + LANES, LOSSES + 28 * LANES, LANES)
ROOM: Final = _END
"""Floats that `jumps_of_waves` works in."""
_FIRST: Final = 8.5
_BETWEEN: Final = 0.875
"""Waves from the centre of a wave to the middle of all places on its jump."""
_slow_tail = make_polynomials(2, TAIL_TERMS)
_inverse_series = make_polynomials(1, 12, 1)
"""Of ((1 + e)^(-c) - 1)/e for |e| < 0.08, five eighths of a wave over its place: 2e-16 is left."""
_FOLD_STEPS: Final = 3
_LANDING_STEPS: Final = 5
_FEW_NODES, _FEW_WEIGHTS = unit_rule(6)
"""Of the smooth part of a jump, which is no longer than a ninth of its place: 1e-16 is left."""
_SHORT: Final = 0.55
_SHORT_NODES, _SHORT_WEIGHTS = unit_rule(11)
_NODES, _WEIGHTS = unit_rule(14)
"""Of jumps of so many waves, and of a wave: 1e-15 of a term cos 2 z is left."""
_ENOUGH: Final = 0.1
"""Of the size of its terms: a smaller loss is left to the nodes, which lose no digits."""


@kernel()
def room_for_lanes() -> Any:
    """Return the room in which sixteen waves are worked on."""
    return np.empty(ROOM)


@kernel(contract=True)
def _arc_cosine(cosine: float) -> float:
    """Return the angle to 2e-8 (Abramowitz & Stegun 4.4.46)."""
    size = abs(cosine)
    root = 0.0066700901 - 0.0012624911 * size
    root = 0.0308918810 + size * (-0.0170881256 + size * root)
    root = 1.5707963050 + size * (-0.2145988016 + size * (0.0889789874 + size * (-0.0501743046 + size * root)))
    angle = math.sqrt(1.0 - size) * root
    return angle if cosine >= 0.0 else math.pi - angle


@kernel(contract=True)
def _inverse_stretch(table: Any, e: float) -> float:
    """Return (1 + e)^(-c) - 1."""
    (series,) = _inverse_series(table.inverse_stretch, e)
    return e * series


@kernel(contract=True)
def _evaluate(table: Any, curve: Curve, middle: float, room: Any) -> None:
    """Put the places x, D at the level of the depth there, its derivatives, z, z S0 and z^c into their rows."""
    b, g, _ = curve
    k = table.k
    n = 0.5 * (1.0 + k)
    cos_phase, sin_phase, tail = table.cos_phase, table.sin_phase, table.tail
    for i in range(LANES):
        x, z0 = room[_X + i], room[_Z0 + i]
        offset = TWO_PI * (x - middle)
        z = z0 + offset
        ratio = 1.0 + _inverse_stretch(table, offset / z0)
        power = 1.0 / (ratio * z)  # one division for both
        inverse, power = ratio * power, room[_STRETCH0 + i] * power
        square = inverse * inverse
        t = 2.0 * SWITCH * SWITCH * square - 1.0
        p0, q0, p1, q1, g0, g1, h0, _ = polynomials8(tail, t)
        sine, cosine = sine_cosine_of_turns(x)
        s = power * (sine * cos_phase - cosine * sin_phase)
        c = power * (cosine * cos_phase + sine * sin_phase)
        wave0 = p0 * s + q0 * inverse * c
        wave1 = q1 * inverse * s - p1 * c
        s0 = g0 * inverse + wave0
        s1 = inverse * (g1 + (k + 1.0) * wave1)
        z_d0 = h0 * inverse - z * wave1
        pull = 0.5 * (1.0 - k) * power
        bend = n * pull * inverse
        room[_D + i] = b * z + g * (s0 + z_d0) - pull
        room[_D1 + i] = b + g * (2.0 * z_d0 * inverse + z * (s1 - s0)) + bend
        room[_D2 + i] = g * ((1.0 - k) * s1 - (2.0 - k) * s0 - z_d0) - (n + 1.0) * bend * inverse
        room[_PLACE + i] = x
        room[_Z + i] = z
        room[_WAVE + i] = g0 + z * wave0
        room[_STRETCH + i] = z * power


@kernel(contract=True)
def _put_rests(table: Any, curve: Curve, room: Any) -> None:
    """Put the depth at the places evaluated last, less that of the jump, into its row."""
    b, g, _ = curve
    for i in range(LANES):
        z1 = room[_Z1 + i]
        step = TWO_PI * (room[_PLACE + i] - room[_FROM + i])
        less = _inverse_stretch(table, step / z1)
        pull = room[_STRETCH1 + i] * (less / (1.0 + less))
        rise = 0.5 * b * (room[_Z + i] + z1) * step + g * (room[_WAVE + i] - room[_WAVE1 + i])
        room[_REST + i] = (rise + pull) - room[_RISEN + i]


@kernel()
def _all_done(room: Any) -> bool:
    """Report whether every search has ended."""
    left = 0
    for i in range(LANES):
        left += 0 if room[_DONE + i] > 0.0 else 1
    return left == 0


@kernel(contract=True)
def _find_folds(table: Any, curve: Curve, middle: float, bracket: tuple[float, float], room: Any) -> None:
    """Move the places x to the folds between two places (Halley).

    The last place before it, what was found there, and what the depth gains from there stand in their rows.
    """
    low, high = bracket
    for _ in range(_FOLD_STEPS):
        _evaluate(table, curve, middle, room)
        for i in range(LANES):
            d, d1, d2, x = room[_D + i], room[_D1 + i], room[_D2 + i], room[_X + i]
            step = -d * d1 / (d1 * d1 - 0.5 * d * d2)
            new = x + step / TWO_PI
            done = (abs(step) * (abs(d2) + abs(d1)) < LAST_STEP * abs(d1)) & (low <= new) & (new <= high)
            room[_DONE + i] = 1.0 if done else 0.0
            room[_GAIN + i] = step * (d + step * (0.5 * d1 + step * d2 / 6.0))
            room[_X + i] = min(max(new, low), high)
        if _all_done(room):
            break


@kernel(contract=True)
def _begin(table: Any, curve: Curve, middle: float, outwards: bool, room: Any) -> None:
    """Put what belongs to the middle of each jump into its rows, and guess the fold that it leaves."""
    b, g, _ = curve
    k = table.k
    c = 0.5 * (1.0 - k)
    centre = table.phase / TWO_PI + 2.0
    for i in range(LANES):
        z0 = TWO_PI * (room[WAVES + i] - 2.0 + middle)
        room[_Z0 + i] = z0
        room[_STRETCH0 + i] = z0 * amplitude_power(table, z0)
    side = 1.0 if outwards else -1.0
    low, high = (centre, centre + 0.5) if outwards else (centre - 0.5, centre)
    for i in range(LANES):
        z0, stretch0 = room[_Z0 + i], room[_STRETCH0 + i]
        offset, angle = TWO_PI * (centre - middle), 0.0
        for _ in range(2):
            beyond = offset + side * angle
            z = z0 + beyond
            cosine = c / z - b * z / stretch0 * (1.0 + _inverse_stretch(table, beyond / z0))
            angle = _arc_cosine(max(-1.0, min(1.0, cosine / (g * table.amplitude))))
        shift = (c + 0.125 * (1.0 - k * k)) / (TWO_PI * (z0 + offset))
        x = centre + shift + side * angle / TWO_PI
        room[_X + i] = x if (low < x) & (x < high) else 0.5 * (low + high)


@kernel()
def _widest(centre: float, room: Any) -> float:
    """Return the largest distance of the places x from a centre, in radians."""
    widest = 0.0
    for i in range(LANES):
        widest = max(widest, abs(room[_X + i] - centre))
    return TWO_PI * widest


@kernel(contract=True)
def _bound(table: Any, curve: Curve, middle: float, outwards: bool, room: Any) -> None:
    """Find between which places the jumps land, and guess where (waves/cosine.py)."""
    _, g, _ = curve
    side = 1.0 if outwards else -1.0
    centre = table.phase / TWO_PI + 2.0 + side
    inner, outer = (centre - 0.5, centre), (centre, centre + 0.5)
    for i in range(LANES):
        room[_X + i] = room[_START + i] + side
    _find_folds(table, curve, middle, outer if outwards else inner, room)
    _put_rests(table, curve, room)
    is_wide = _widest(centre, room) > WIDE
    for i in range(LANES):
        far, rest = room[_X + i], room[_REST + i] + room[_GAIN + i]
        turns = abs(far - centre)
        sine, cosine = sine_cosine_of_turns(turns)
        drop = 2.0 * g * table.amplitude * room[_STRETCH + i] * (sine - TWO_PI * turns * cosine)
        room[_FAR + i], room[_FAR_REST + i] = far, rest
        room[_NEAR + i], room[_NEAR_REST + i] = 2.0 * centre - far, rest - side * drop
        room[_GOOD + i] = room[_GOOD + i] * room[_DONE + i]
        room[_X + i] = 2.0 * centre - far
    if is_wide:
        _find_folds(table, curve, middle, inner if outwards else outer, room)
        _put_rests(table, curve, room)
        for i in range(LANES):
            found = TWO_PI * abs(room[_FAR + i] - centre) > WIDE
            room[_NEAR + i] = room[_X + i] if found else room[_NEAR + i]
            room[_NEAR_REST + i] = room[_REST + i] + room[_GAIN + i] if found else room[_NEAR_REST + i]
            room[_GOOD + i] = room[_GOOD + i] * (room[_DONE + i] if found else 1.0)
    for i in range(LANES):
        far, far_rest, near, near_rest = room[_FAR + i], room[_FAR_REST + i], room[_NEAR + i], room[_NEAR_REST + i]
        low, high = (near, far) if outwards else (far, near)
        low_rest, high_rest = (near_rest, far_rest) if outwards else (far_rest, near_rest)
        share = low_rest / (low_rest - high_rest)
        x = low + (high - low) * (_arc_cosine(max(-1.0, min(1.0, 1.0 - 2.0 * share))) / math.pi)
        room[_GOOD + i] = room[_GOOD + i] if (share > 0.0) & (share < 1.0) else 0.0
        room[_LOW + i], room[_HIGH + i] = low, high
        room[_X + i] = x if (low < x) & (x < high) else 0.5 * (low + high)


@kernel(contract=True)
def _land(table: Any, curve: Curve, middle: float, room: Any) -> None:
    """Move the places x to where the depth is that of the fold (Halley, in a bracket)."""
    for _ in range(_LANDING_STEPS):
        _evaluate(table, curve, middle, room)
        _put_rests(table, curve, room)
        for i in range(LANES):
            x, d, d1, rest = room[_X + i], room[_D + i], room[_D1 + i], room[_REST + i]
            low, high = (x if rest < 0.0 else room[_LOW + i]), (room[_HIGH + i] if rest < 0.0 else x)
            step = -rest * d / (d * d - 0.5 * rest * d1)
            new = x + step / TWO_PI
            inside = (low <= new) & (new <= high)
            done = inside & (abs(step) * (abs(d1) + abs(d)) < LAST_LANDING * abs(d))
            room[_DONE + i] = 1.0 if done else 0.0
            room[_LOW + i], room[_HIGH + i] = low, high
            room[_X + i] = new if inside else 0.5 * (low + high)
        if _all_done(room):
            break


@kernel(contract=True)
def _put_brackets(table: Any, curve: Curve, middle: float, room: Any) -> None:
    """Put z, z S0, z^c, w1, the braces but for their term with q, and z^(-n) of the last places into their rows.

    They are those of curve/cosine_jump.py.
    """
    b, g, _ = curve
    k = table.k
    cos_phase, sin_phase = table.cos_phase, table.sin_phase
    for i in range(LANES):
        x, z0 = room[_PLACE + i], room[_Z0 + i]
        offset = TWO_PI * (x - middle)
        z = z0 + offset
        ratio = 1.0 + _inverse_stretch(table, offset / z0)
        power = 1.0 / (ratio * z)
        inverse, power = ratio * power, room[_STRETCH0 + i] * power
        t = 2.0 * SWITCH * SWITCH * (inverse * inverse) - 1.0
        p0, q0, p1, q1, even1, odd1, even2, odd2 = polynomials8(table.jump_tail, t)
        height, _ = _slow_tail(table.slow_tail, t)
        sine, cosine = sine_cosine_of_turns(x)
        s = power * (sine * cos_phase - cosine * sin_phase)
        c = power * (cosine * cos_phase + sine * sin_phase)
        wave0 = z * (p0 * s + q0 * inverse * c)
        wave1 = q1 * inverse * s - p1 * c
        squares = (c * even1 - s * inverse * odd1) + z * (2.0 * s * c * even2 + (c * c - s * s) * inverse * odd2)
        room[_Z + i], room[_WAVE + i], room[_STRETCH + i] = z, wave0 + height, z * power
        room[_D + i] = wave1
        room[_D1 + i] = 2.0 * b * (wave0 - (k + 2.0) * wave1) - g * squares
        room[_D2 + i] = power


@kernel(contract=True)
def _begin_integral(table: Any, middle: float, room: Any) -> None:
    """Put what does not change along a jump into rows.

    Its width, that over z in its middle, z^(-c) there, and in parts of the stretch there what the one that is left has
    more, less the wave and the level that are left.
    """
    for i in range(LANES):
        width = room[_X + i] - room[_START + i]
        offset = TWO_PI * (room[_START + i] + 0.5 * width - middle)
        z = room[_Z0 + i] + offset
        less = _inverse_stretch(table, TWO_PI * (room[_FROM + i] - (room[_START + i] + 0.5 * width)) / z)
        inverse = (1.0 + _inverse_stretch(table, offset / room[_Z0 + i])) / room[_STRETCH0 + i]
        room[_REST + i] = -less / (1.0 + less)
        room[_D + i] = width
        room[_D1 + i] = 0.5 * TWO_PI * width / z
        room[_Z + i] = z
        room[_STRETCH + i] = inverse
        room[LOSSES + i] = 0.0


@kernel(contract=True)
def _by_form(table: Any, curve: Curve, middle: float, room: Any) -> None:
    """Put what the jumps lose into their row, by the antiderivative of curve/cosine_jump.py.

    What loses more than nine tenths of its digits is no longer good.
    """
    b, g, _ = curve
    strength = 0.5 * (g * table.amplitude) * (g * table.amplitude)
    for i in range(LANES):
        room[_PLACE + i] = room[_START + i]
    _put_brackets(table, curve, middle, room)
    for i in range(LANES):
        power, q = room[_D2 + i], room[_STRETCH + i] - g * room[_WAVE + i]
        room[_FROM + i], room[_RISEN + i], room[_PLACE + i] = room[_START + i], 0.0, room[_X + i]
        room[_Z1 + i], room[_WAVE1 + i] = room[_Z + i], room[_WAVE + i]
        room[_LOW + i] = g * (2.0 * q * room[_D + i] + room[_D1 + i]) / (power * power)
        room[_GAIN + i] = q
    _put_brackets(table, curve, middle, room)
    for i in range(LANES):
        power, z, z1 = room[_D2 + i], room[_Z + i], room[_Z1 + i]
        q = room[_GAIN + i] + 0.5 * b * (z + z1) * (TWO_PI * (room[_X + i] - room[_START + i]))
        room[_HIGH + i] = g * (2.0 * q * room[_D + i] + room[_D1 + i]) / (power * power)
    _begin_integral(table, middle, room)
    for node in range(_FEW_NODES.size):
        share, weight = _FEW_NODES[node], _FEW_WEIGHTS[node]
        for i in range(LANES):
            eta = room[_D1 + i] * (2.0 * share - 1.0)
            less = _inverse_stretch(table, eta)
            z = room[_Z + i] + room[_Z + i] * eta
            inverse = 1.0 / z
            height, square = _slow_tail(table.slow_tail, 2.0 * SWITCH * SWITCH * (inverse * inverse) - 1.0)
            rise = 0.5 * b * (z + room[_Z1 + i]) * (TWO_PI * room[_D + i] * share) + g * (height - room[_WAVE1 + i])
            slow = room[_STRETCH + i] * rise + room[_REST + i]
            excess = (slow + less * slow) + less
            room[LOSSES + i] += weight * z * (-excess * (2.0 + excess) - strength * square)
    for i in range(LANES):
        loss = TWO_PI * room[_D + i] * room[LOSSES + i] - (room[_HIGH + i] - room[_LOW + i])
        room[LOSSES + i] = loss
        room[_DONE + i] = 1.0 if _ENOUGH * (abs(room[_HIGH + i]) + abs(room[_LOW + i])) <= abs(loss) else 0.0


@kernel(contract=True)
def _by_nodes(table: Any, curve: Curve, middle: float, rule: tuple[Any, Any], room: Any) -> None:
    """Put what the jumps lose into their row: curve/cosine_energy.py's `panel_above`, with m for the middle of a jump.

    With (1 + eta)^(-c) = 1 + s it is (1 + s) [(depth_H - depth_j - stretch_m)/stretch_m] + s that is rho - 1, and in it
    the wave at z has the factor 1: nothing is divided by the stretch there.
    """
    b, g, _ = curve
    cos_phase, sin_phase, tail = table.cos_phase, table.sin_phase, table.tail
    nodes, weights = rule
    _begin_integral(table, middle, room)
    for node in range(nodes.size):
        share, weight = nodes[node], weights[node]
        for i in range(LANES):
            eta = room[_D1 + i] * (2.0 * share - 1.0)
            less = _inverse_stretch(table, eta)
            x = room[_START + i] + room[_D + i] * share
            z = room[_Z + i] + room[_Z + i] * eta
            inverse = 1.0 / z
            t = 2.0 * SWITCH * SWITCH * (inverse * inverse) - 1.0
            p, q, _, _, height, _, _, _ = polynomials8(tail, t)
            sine, cosine = sine_cosine_of_turns(x)
            s = sine * cos_phase - cosine * sin_phase
            c = cosine * cos_phase + sine * sin_phase
            rise = 0.5 * b * (z + room[_Z1 + i]) * (TWO_PI * (x - room[_FROM + i])) + g * (height - room[_WAVE1 + i])
            slow = room[_STRETCH + i] * (rise - room[_RISEN + i]) + room[_REST + i]
            excess = (slow + less * slow) + less + g * (p * s + q * inverse * c)  # rho - 1
            room[LOSSES + i] += weight * z * (-excess * (2.0 + excess))
    for i in range(LANES):
        room[LOSSES + i] *= TWO_PI * room[_D + i]


@kernel()
def _longest(room: Any) -> float:
    """Return the length of the longest jump, in waves."""
    longest = 0.0
    for i in range(LANES):
        longest = max(longest, abs(room[_X + i] - room[_START + i]))
    return longest


@kernel()
def jumps_of_waves(table: Any, curve: Curve, outwards: bool, room: Any) -> None:
    """Put what the jumps of the sixteen waves at `WAVES` to their next ones lose at `LOSSES` of the lanes' room."""
    centre = table.phase / TWO_PI + 2.0
    middle = centre + (_BETWEEN if outwards else -_BETWEEN)
    _begin(table, curve, middle, outwards, room)
    _find_folds(table, curve, middle, (centre, centre + 0.5) if outwards else (centre - 0.5, centre), room)
    for i in range(LANES):
        room[_START + i], room[_FROM + i], room[_RISEN + i] = room[_X + i], room[_PLACE + i], room[_GAIN + i]
        room[_Z1 + i], room[_WAVE1 + i], room[_STRETCH1 + i] = room[_Z + i], room[_WAVE + i], room[_STRETCH + i]
        room[_GOOD + i] = room[_DONE + i] if room[WAVES + i] >= _FIRST else 0.0
    _bound(table, curve, middle, outwards, room)
    _land(table, curve, middle, room)
    for i in range(LANES):
        room[_GOOD + i] = room[_GOOD + i] * room[_DONE + i]
    if _longest(room) <= _SHORT:  # far out, where the folds end: little is left of the form
        _by_nodes(table, curve, middle, (_SHORT_NODES, _SHORT_WEIGHTS), room)
    else:
        _by_form(table, curve, middle, room)
        if not _all_done(room):
            _by_nodes(table, curve, middle, (_NODES, _WEIGHTS), room)
    for i in range(LANES):
        if not room[_GOOD + i] > 0.0:
            _, room[LOSSES + i] = jump_of_wave(table, curve, room[WAVES + i], outwards, room)


@kernel()
def jumps_in_a_row(table: Any, curve: Curve, first: float, last: float, outwards: bool, room: Any) -> None:
    """Do the same for the waves from `first` on; where `last` comes before the sixteenth, it fills the rest."""
    for i in range(LANES):
        room[WAVES + i] = min(first + i, last)
    jumps_of_waves(table, curve, outwards, room)
