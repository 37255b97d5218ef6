"""Cycles of long curves: the regular waves between the beginning and the rim, or the end of folds, are summed.

Near its beginning, and near its end, a curve is walked fold by fold (path/general.py). Between them the highest ends of
branches of every wave, and their lowest starts, are computed on some waves: loading goes up, wave by wave, where the
one rise, and unloading goes down where the other fall inwards. Where they do not, waves are passed.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.compiler.jit import NO, kernel
from gradhesion.core.contact.disc import climb_is_one_disc
from gradhesion.core.curve.arches import folds_between
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.curve.general_branches import fill_branches
from gradhesion.core.curve.general_folds import MOST_FOLDS, Search, Zeros, find_folds, room
from gradhesion.core.path.general import first_close_pair, is_at_a_fold
from gradhesion.core.path.general_middle import BEGINNING, Middle, places_between
from gradhesion.core.path.pieces import (
    NOTED_DOWN,
    NOTED_UP,
    Notes,
    Piece,
    State,
    climb,
    descend,
    leave,
    leave_rim,
    note,
    reach_rim,
)
from gradhesion.core.types import Floats
from gradhesion.core.waves.general import (
    DOWN,
    NEAREST,
    NOWHERE,
    UP,
    Room,
    Waves,
    branches_of_wave,
    furthest_end,
    let_reach,
    rises_by,
    room_for_waves,
)
from gradhesion.core.waves.general_sum import sum_of_waves

_TESTED: Final = 12
"""Waves on which the contact is tested."""


class Tasks(NamedTuple):
    """What is wanted of a cycle on a long curve."""

    losses: bool  # whether what it loses is
    last_loss: bool  # whether what the end of contact loses is a part of that
    test: bool  # whether loading is tested for keeping the contact one disc
    turned: bool  # whether the rim is a place that loading surely reaches


@kernel()
def _end_of(basis: Basis, curve: Series, cut: float, wave: float, kind: int, work: Room) -> tuple[float, float]:
    """Return level and place of the highest end of a branch of a wave (UP), or of the lowest start, or none."""
    rows = work[2][0]
    best, level, x = furthest_end(kind, rows, branches_of_wave(basis, curve, wave, cut, work, rows))
    return level, x if best >= 0 else cut


@kernel()
def _goes_on(basis: Basis, curve: Series, cut: float, wave: float, kind: int, work: Room) -> bool:
    """Return whether loading goes up from a wave to the next one, or unloading down from the next one to it."""
    level, x = _end_of(basis, curve, cut, wave, kind, work)
    beyond, _ = _end_of(basis, curve, cut, wave + 1.0, kind, work)
    return rises_by(basis, curve, x, wave, beyond - level) > 0.0


@kernel()
def _reaches(basis: Basis, curve: Series, cut: float, wave: float, kind: int, level: float, work: Room) -> bool:
    """Return whether a wave ends above a level, or starts below it, that of a wave nearer or further out."""
    here, x = _end_of(basis, curve, cut, wave, kind, work)
    return rises_by(basis, curve, x, wave, here - level if kind == UP else level - here) > 0.0


@kernel()
def first_that_reaches(
    basis: Basis, curve: Series, cut: float, places: Floats, now: float, kind: int, level: float, work: Room
) -> float:
    """Return the first wave from `now` on, in the order of `places`, that reaches a level; NaN if none does.

    `places` are waves, of shape (n,): those of `places_between`, inwards for unloading.
    """
    if _reaches(basis, curve, cut, now, kind, level, work):
        return now
    sign = 1.0 if kind == UP else -1.0
    for i in range(places.size):
        if sign * (places[i] - now) <= 0.0 or not _reaches(basis, curve, cut, places[i], kind, level, work):
            continue
        low, high = now, places[i]
        if i > 0 and sign * (places[i - 1] - now) > 0.0:
            low = places[i - 1]
        while abs(high - low) > 1.0:
            middle = np.floor(0.5 * (low + high))
            if _reaches(basis, curve, cut, middle, kind, level, work):
                high = middle
            else:
                low = middle
        return high
    return math.nan


@kernel()
def last_of_climb(basis: Basis, curve: Series, cut: float, places: Floats, now: float, kind: int, work: Room) -> float:
    """Return the wave up to which loading or unloading goes from wave to wave; `places` as of `first_that_reaches`."""
    sign = 1.0 if kind == UP else -1.0
    step = 0.0 if kind == UP else -1.0
    end = places[places.size - 1]
    if now == end or not _goes_on(basis, curve, cut, now + step, kind, work):
        return now
    low = now
    for i in range(places.size):
        if sign * (places[i] - low) <= 0.0:
            continue
        if places[i] != end and _goes_on(basis, curve, cut, places[i] + step, kind, work):
            low = places[i]
            continue
        high = places[i]
        if high == end and _goes_on(basis, curve, cut, end - sign + step, kind, work):
            return end
        while abs(high - low) > 1.0:
            middle = np.floor(0.5 * (low + high))
            if _goes_on(basis, curve, cut, middle + step, kind, work):
                low = middle
            else:
                high = middle
        return high
    return low


@kernel()
def _waves_are_one_disc(basis: Basis, curve: Series, cut: float, first: float, last: float, work: Room) -> bool:
    """Return whether loading keeps the contact one disc on some of the waves `first` to `last`."""
    _, _, rows = work
    for i in range(_TESTED):
        before = np.floor(first * (last / first) ** (i / (_TESTED - 1.0)) + 0.5) - 1.0
        highest, level, x = furthest_end(UP, rows[0], branches_of_wave(basis, curve, before, cut, work, rows[0]))
        count = branches_of_wave(basis, curve, before, cut + 1.0, work, rows[1])
        if highest >= 0 and not climb_is_one_disc(basis, curve, count, rows[1], -math.inf, before + x, level, before):
            return False
    return True


@kernel()
def go_through(
    basis: Basis,
    curve: Series,
    waves: Waves,
    run: tuple[float, float],
    state: State,
    losses: bool,
    test: bool,
    notes: Notes,
) -> tuple[State, bool]:
    """Follow loading from the first wave of a run to the last, or unloading back; the loss is NaN if it cannot be.

    With `losses` energies are found and noted; with `test` loading is tested for keeping the contact one disc. Return
    the state, and whether it does so as far as was tested.
    """
    kind, cut, _, work = waves
    begin, end = run
    one_disc = True
    places = places_between(begin, end)
    if kind == DOWN:
        places = places[::-1].copy()
    sign = 1.0 if kind == UP else -1.0
    now, last = places[0], places[places.size - 1]
    rows = work[2][0]
    while sign * (last - now) >= 0.0:
        now = first_that_reaches(basis, curve, cut, places, now, kind, state.level, work)
        if math.isnan(now):
            break
        count = branches_of_wave(basis, curve, now, cut, work, rows)
        let_reach(kind, rows, count, state.level)
        if kind == UP:
            if test and one_disc:
                left = state.waves + state.left
                one_disc = climb_is_one_disc(basis, curve, count, rows, -math.inf, left, state.level, now)
            state = climb(basis, curve, Piece(count, rows, now), state, -1.0, losses, notes)
        else:
            state = descend(basis, curve, Piece(count, rows, now), state, losses, notes)
        far = last_of_climb(basis, curve, cut, places, now, kind, work)
        if far != now:
            first, final = (now + 1.0, far) if kind == UP else (far + 1.0, now)
            if test and one_disc:
                one_disc = _waves_are_one_disc(basis, curve, cut, first, final, work)
            loss, jumps = sum_of_waves(basis, curve, waves, first, final, losses)
            if losses:
                note(notes, NOTED_UP if kind == UP else NOTED_DOWN, 0.0, first, final, NO)
            _, level, x = furthest_end(kind, rows, branches_of_wave(basis, curve, far, cut, work, rows))
            state = State(state.loss + loss, state.jumps + jumps, level, far, x, state.close)
        now = far + sign
    return state, one_disc


@kernel()
def folds_before(
    basis: Basis, curve: Series, first: float, middle: Middle, search: Search, zeros: Zeros
) -> tuple[int, bool, float]:
    """Put the folds before the regular waves into `zeros`; return what find_folds does, -1 where they do not fit."""
    _, _, cut, again, begin, _, _ = middle
    inner = max(first, NEAREST) + BEGINNING if again > 0.0 else begin + cut
    count, rises, tangency = folds_between(basis, curve, first, inner, search, zeros)
    if count >= 0 and again > 0.0:
        number, still, outermost = find_folds(basis, curve, again, begin + cut, search, zeros[count:], 0.0)
        count = count + number if number >= 0 and still == (rises == (count % 2 == 0)) else -1
        tangency = min(tangency, outermost)
    if count < 0 or rises == (count % 2 == 0):
        return -1, rises, tangency
    return count, rises, tangency


class Strode(NamedTuple):
    """A cycle on a long curve up to one rim."""

    done: bool  # whether it could be followed
    loading: State  # at its end: the coordinate that it ends with, the place that its last jump leaves
    unloading: State  # at its end: the place that it leaves last, 0 if contact ends at a point
    close: bool  # whether a decision was
    one_disc: bool  # whether the contact stays one disc as far as was tested
    whole: float  # the rim: whole waves,
    x: float  # and x beyond them


@kernel()
def stride(
    basis: Basis, curve: Series, first: float, middle: Middle, rim: tuple[float, float], tasks: Tasks, notes: Notes
) -> Strode:
    """Follow the cycle on a long curve up to one rim, x and its rounding error; there is no fold before `first`.

    `middle` is what `middle_of` has returned, REGULAR; `notes` is room for notes of what loses energy (path/pieces.py).
    The contact is tested on the way into the regular waves and out of them, and on some of these.
    """
    losses, last_loss, test, turned = tasks
    _, until, cut, _, begin, end, _ = middle
    nothing = State(0.0, 0.0, 0.0, 0.0, 0.0, NO)
    search = room()
    zeros = np.empty(MOST_FOLDS)
    count, rises, tangency = folds_before(basis, curve, first, middle, search, zeros)
    if count < 0:
        return Strode(False, nothing, nothing, False, True, 0.0, rim[0])
    near = np.empty((4, count // 2 + 2))
    branches = fill_branches(basis, curve, zeros, count, rises, begin + cut, near, 0.0)
    close = tangency < math.inf or first_close_pair(zeros, count, 0.0) < math.inf
    whole = end + 1.0
    x = (rim[0] - whole) + rim[1]
    furthest = min(x, until - whole)
    count, rises, tangency = find_folds(basis, curve, cut, furthest, search, zeros, whole)
    if count < 0 or rises:
        return Strode(False, nothing, nothing, False, True, 0.0, rim[0])
    far = np.empty((4, count // 2 + 2))
    inner = Piece(branches, near, 0.0)
    outer = Piece(fill_branches(basis, curve, zeros, count, rises, x, far, whole), far, whole)
    close = close or tangency < math.inf or first_close_pair(zeros, count, whole) < math.inf
    close = close or (x < math.inf and not turned and is_at_a_fold(basis, curve, x, whole))
    work, run = room_for_waves(basis.series), (begin, end)
    up, down = Waves(UP, cut, NOWHERE, work), Waves(DOWN, cut, NOWHERE, work)
    one_disc = not test or climb_is_one_disc(basis, curve, branches, near, -math.inf, 0.0, 0.0, 0.0)
    loading = climb(basis, curve, inner, nothing, -1.0, losses, notes)
    loading, open_too = go_through(basis, curve, up, run, loading, losses, test and one_disc, notes)
    one_disc = one_disc and open_too
    if test and one_disc:
        left = loading.waves + loading.left
        one_disc = climb_is_one_disc(basis, curve, outer.branches, far, x, left, loading.level, whole)
    loading = climb(basis, curve, outer, loading, x if turned else -1.0, losses, notes)
    loading = reach_rim(basis, curve, x, loading, losses, whole, notes)
    inside, unloading = leave_rim(basis, curve, outer, x)
    unloading = descend(basis, curve, Piece(inside, far, whole), unloading, losses, notes)
    unloading, _ = go_through(basis, curve, down, run, unloading, losses, NO, notes)
    unloading = descend(basis, curve, inner, unloading, losses, notes)
    unloading = leave(basis, curve, unloading, losses and last_loss, notes)
    done = not (math.isnan(loading.loss + loading.jumps) or math.isnan(unloading.loss + unloading.jumps))
    close = close or loading.close or unloading.close
    return Strode(done, loading, unloading, close, one_disc, whole, x)
