"""From the numbers of general scenes to their results: one curve at a time, with all its rims.

Sensitivities are read off the trace, or the notes of a long cycle, that the energy comes from; without them `sense` is
an empty tuple, whose length numba knows when it compiles.
"""

import math
from collections.abc import Callable
from typing import Any, Final

import numpy as np

from gradhesion.core.compiler.jit import NONE, kernel
from gradhesion.core.contact.disc import disc_limits, is_one_disc
from gradhesion.core.curve.arches import is_one_cosine
from gradhesion.core.curve.branches import ARRIVAL
from gradhesion.core.curve.cosine import force_unit
from gradhesion.core.curve.cosine_folds import CLOSE
from gradhesion.core.curve.general import Basis, Series, coordinate, curve_of, state
from gradhesion.core.curve.general_energy import energies_in
from gradhesion.core.curve.general_folds import MOST_CELLS, room
from gradhesion.core.curve.window import first_fold_bound, last_fold_bound
from gradhesion.core.face import depth_at
from gradhesion.core.path.general import depth_at_full_contact, walk
from gradhesion.core.path.general_long import FEW, LONGEST_WALK, REGULAR, Middle, middle_of, stride
from gradhesion.core.path.loading import highest_depth, jumps_in_to, loading_to
from gradhesion.core.path.pieces import notes_for
from gradhesion.core.path.ties import is_close_to_a_jump
from gradhesion.core.path.unloading import jumps_out_from, unloading_from
from gradhesion.core.problem.results import (
    CONTACT,
    DEEPEST,
    ENERGY,
    FORCE,
    LAST,
    LOADED,
    LOADING,
    OUTERMOST,
    RADIUS,
    TURNED,
    UNLOADED,
    UNLOADING,
    put,
    wants_folds,
    wants_force,
    wants_losses,
)
from gradhesion.core.problem.status import (
    CLOSE_TO_A_JUMP,
    JUMP_IN_TO_RIM,
    LOADING_NOT_ONE_DISC,
    NO_VALUE,
    PULL_OFF_AT_RIM,
)
from gradhesion.core.pull_off.general import deepest_wave
from gradhesion.core.pull_off.rims import lowest_loads
from gradhesion.core.sensitivities.general_slopes import (
    NOTES,
    of_scene,
    put_energy,
    put_noted,
    put_rest,
    senses_energy,
    slopes_of,
)
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.struve.intrinsics import fma
from gradhesion.core.struve.series import highest_harmonic
from gradhesion.core.waves.general_jump import LONG

_STATIONS: Final = 64
"""Places within the jump-in that a curve has room for."""


@kernel()
def _refuse(slots: Any, out: Any, status: Any, i: int) -> None:
    """Give the scene of a rim out of range no value."""
    for row in range(CONTACT):
        put(out, slots, row, i, math.nan)
    status[i] = NO_VALUE


@kernel()
def _put_cycle(
    basis: Basis,
    curve: Series,
    length: float,
    unit: float,
    place: tuple[float, float],
    loading: tuple[float, float, float],
    unloading: tuple[float, float, float],
    flags: tuple[bool, bool],
    slots: Any,
    out: Any,
    status: Any,
    i: int,
) -> None:
    """Store the cycle of a rim, and what there is to report.

    Parameters
    ----------
    basis, curve, length, unit
        The curve and its units.
    place
        The rim: x, beyond some whole waves.
    loading, unloading
        What they lose, their jumps, and the highest coordinate of the one, the depth of the jump-out of the other.
    flags
        Whether a decision was close, and whether the contact stays one disc as far as was asked.
    slots, out, status, i
        As those of `solve_scenes`; i is the number of the rim.
    """
    close, one_disc = flags
    x, whole = place
    loaded, loading_jumps, highest = loading
    unloaded, unloading_jumps, last = unloading
    if close:
        status[i] |= CLOSE_TO_A_JUMP
    if highest == 0.0:
        status[i] |= JUMP_IN_TO_RIM
    if not one_disc:
        status[i] |= LOADING_NOT_ONE_DISC
    scale = TWO_PI * length * length
    put(out, slots, ENERGY, i, scale * (loaded + unloaded))
    put(out, slots, LOADED, i, scale * loaded)
    put(out, slots, UNLOADED, i, scale * unloaded)
    put(out, slots, LOADING, i, loading_jumps)
    put(out, slots, UNLOADING, i, unloading_jumps)
    put(out, slots, LAST, i, unit * last)
    if slots[DEEPEST] >= 0:
        deepest = depth_at_full_contact(basis, curve, x, highest, whole) if x < math.inf else x
        put(out, slots, DEEPEST, i, unit * deepest)


@kernel()
def _walked(
    basis: Basis,
    curve: Series,
    length: float,
    unit: float,
    first: float,
    last: float,
    rims: Any,
    chosen: Any,
    slots: Any,
    out: Any,
    status: Any,
    own: Any,
) -> bool:
    """Solve the chosen rims of a curve on one trace; return whether it could be walked."""
    losses, turned = wants_losses(slots), slots[TURNED] > 0
    furthest = 0.0
    for i in range(rims.size):
        if chosen[i]:
            furthest = max(furthest, rims[i])
    count, trace, tangency = walk(basis, curve, first, last, furthest, losses)
    if count < 0:
        return False
    stations = np.full((4, _STATIONS), math.inf)
    limits = disc_limits(basis, curve, count, trace, furthest) if slots[CONTACT] >= 0 else (math.inf, math.inf)
    if len(own) > 0:
        slopes = slopes_of(basis, curve, own, count, trace)
    for i in range(rims.size):
        if not chosen[i]:
            continue
        x = rims[i]
        level = coordinate(basis, curve, x) if x < math.inf else math.inf
        shared = losses and x <= LONG and not is_one_cosine(basis[2], curve.exponent)
        jumps_in = shared and jumps_in_to(count, trace, x)
        jumps_out = shared and curve.alpha > 0.0 and jumps_out_from(count, trace, x, level)
        inwards, outwards = 0.0, 0.0
        if jumps_in or jumps_out:
            levels = (0.0 if jumps_in else level, level if jumps_out else 0.0)
            inwards, outwards = energies_in(basis, curve, x, levels[0], levels[1], stations)
        if jumps_in:
            loss, jumps = inwards, 1.0
        else:
            loss, jumps = loading_to(basis, curve, count, trace, x, losses)
        loading = (loss, jumps, highest_depth(count, trace, x, level))
        if jumps_out:
            unloading = (-outwards, 1.0, depth_at(basis, curve, x, level))
        else:
            unloading = unloading_from(basis, curve, count, trace, x, level, losses)
        close = is_close_to_a_jump(basis, curve, count, trace, tangency, x, level, turned)
        flags = (close, is_one_disc(basis, curve, limits, x))
        _put_cycle(basis, curve, length, unit, (x, 0.0), loading, unloading, flags, slots, out, status, i)
        if x == math.inf:  # the last branch has no end, and loading arrives on it
            put(out, slots, OUTERMOST, i, TWO_PI * length * trace[ARRIVAL, count - 1])
        if len(own) > 0:
            put_energy(basis, curve, own, count, trace, slopes, x, loading[0] + unloading[0], i)
    return True


@kernel()
def _strode(
    basis: Basis,
    curve: Series,
    length: float,
    unit: float,
    first: float,
    middle: Middle,
    rim: tuple[float, float],
    slots: Any,
    out: Any,
    status: Any,
    i: int,
    own: Any,
) -> bool:
    """Solve one rim of a long curve; return whether its waves could be summed."""
    _, _, _, alpha, _ = curve
    tasks = (wants_losses(slots), alpha > 0.0, slots[CONTACT] >= 0, slots[TURNED] > 0)
    x, x_low = rim
    notes = notes_for(NOTES if senses_energy(own) else NONE)
    done, loading, unloading, close, one_disc, waves, x = stride(basis, curve, first, middle, x, x_low, tasks, notes)
    if not done:
        return False
    _, _, _, whole, left, _ = unloading
    depth = -1.0
    if whole + left > 0.0:
        _, _, _, depth, _ = state(basis, curve, left, whole)
    up, down = (loading[0], loading[1], loading[2]), (unloading[0], unloading[1], depth)
    _put_cycle(basis, curve, length, unit, (x, waves), up, down, (close, one_disc), slots, out, status, i)
    if x == math.inf:
        put(out, slots, OUTERMOST, i, TWO_PI * length * (loading[3] + loading[4]))
    if len(own) > 0:
        put_noted(basis, curve, own, middle[2], notes, x, waves, loading[0] + unloading[0], i)
    return True


@kernel()
def _cycles(
    basis: Basis,
    curve: Series,
    length: float,
    unit: float,
    wavelength: float,
    rims: Any,
    slots: Any,
    out: Any,
    status: Any,
    own: Any,
) -> None:
    """Follow the cycles of a curve up to all its rims that are not refused: those within a walk share one trace."""
    _, _, series = basis
    count = rims.size
    highest = highest_harmonic(series)
    first, last = first_fold_bound(basis, curve) / TWO_PI, last_fold_bound(basis, curve) / TWO_PI
    places, together, alone = np.empty(count), np.zeros(count, np.bool_), np.zeros(count, np.bool_)
    shared = False
    for i in range(count):
        if not rims[i] > 0.0:
            continue
        x = rims[i] / wavelength
        places[i] = x
        waves = min(x, last) - first
        if series.shape[0] > 0 and LONGEST_WALK < waves < math.inf:
            middle = middle_of(basis, curve, first, min(x, last), 0.0)
            x_low = fma(-x, wavelength, rims[i]) / wavelength if x < math.inf else 0.0
            kind, until, _, _, _, _, _ = middle
            if kind == REGULAR and _strode(
                basis, curve, length, unit, first, middle, (x, x_low), slots, out, status, i, own
            ):
                continue
            alone[i] = True
            if kind == FEW and _walked(
                basis, curve, length, unit, first, until, places, alone, slots, out, status, own
            ):
                alone[i] = False
                continue
            alone[i] = False
        if not waves * highest < MOST_CELLS:
            _refuse(slots, out, status, i)
        elif waves > LONGEST_WALK:
            alone[i] = True
            if not _walked(basis, curve, length, unit, first, last, places, alone, slots, out, status, own):
                _refuse(slots, out, status, i)
            alone[i] = False
        else:
            together[i] = shared = True
    if not shared or _walked(basis, curve, length, unit, first, last, places, together, slots, out, status, own):
        return
    for i in range(count):  # too many folds up to the largest of them
        if together[i]:
            alone[i] = True
            if not _walked(basis, curve, length, unit, first, last, places, alone, slots, out, status, own):
                _refuse(slots, out, status, i)
            alone[i] = False


@kernel()
def _pull_offs(
    basis: Basis,
    curve: Series,
    scales: tuple[float, float],
    rims: Any,
    slots: Any,
    out: Any,
    status: Any,
    work: Any,
    deepest: float,
) -> None:
    """Find the pull-off of a curve for all its rims; `scales` are those of its load and of its places."""
    force_scale, wavelength = scales
    places, lows, found = np.empty(rims.size), np.empty(rims.size), np.empty((rims.size, 3))
    for i in range(rims.size):
        places[i] = rims[i] / wavelength
        lows[i] = fma(-places[i], wavelength, rims[i]) / wavelength if places[i] < math.inf else 0.0
    lowest_loads(basis, curve, places, lows, work, deepest, found)
    for i in range(rims.size):
        if not rims[i] > 0.0:
            continue
        x, lowest, place, second = places[i], found[i, 0], found[i, 1], found[i, 2]
        if not lowest < 0.0:
            status[i] |= NO_VALUE
            lowest = place = math.nan
        elif second < lowest * (1.0 - CLOSE):
            status[i] |= CLOSE_TO_A_JUMP
        put(out, slots, FORCE, i, -force_scale * lowest)
        put(out, slots, RADIUS, i, place * wavelength if place != x else rims[i])
        if place == x:
            status[i] |= PULL_OFF_AT_RIM


def loop_of(*, cycles: bool) -> Callable[..., None]:
    """Return the kernel that solves many scenes; without `cycles` it knows the pull-off alone."""

    @kernel()
    def solve_scenes(
        table: Any,
        cosine_bins: Any,
        series: Any,
        exponent: float,
        depth_factor: float,
        index: Any,
        stretch: Any,
        wavelength: Any,
        amplitude: Any,
        compliance: Any,
        rims: Any,
        slots: Any,
        out: Any,
        status: Any,
        sense: Any,
    ) -> None:
        """Solve the curves `index` of one gradient exponent, each for all its rims (curve_of says what they are).

        The rims are an array of shape (curves, rims), or (1, rims) if they are the same for all curves; `out` has the
        shape (results, curves, rims), `status` (curves, rims). `sense` is () or what sensitivities need
        (sensitivities/general_slopes.py).
        """
        smooth = np.zeros((0, 3))
        work, deepest = room(), deepest_wave(table, series) if wants_force(slots) else 0.0
        for j in range(index.size):
            i = index[j]
            own, results, flags = rims[i if rims.shape[0] > 1 else 0], out[:, i], status[i]
            valid = 0.0 < stretch[i] < math.inf and 0.0 < wavelength[i] < math.inf and 0.0 <= amplitude[i] < math.inf
            valid = valid and compliance[i] >= 0.0
            basis = (table, cosine_bins, series if amplitude[i] > 0.0 else smooth)
            curve, length, unit = curve_of(
                table.k, exponent, depth_factor, stretch[i], wavelength[i], amplitude[i], compliance[i]
            )
            valid = valid and 0.0 < curve.bend < math.inf and 0.0 <= curve.gain < math.inf
            for rim in range(own.size):
                if not (valid and own[rim] > 0.0):
                    _refuse(slots, results, flags, rim)
            if not valid:
                continue
            scene = of_scene(sense, i, stretch[i], wavelength[i], amplitude[i], compliance[i])
            if wants_force(slots):
                scales = (force_unit(table.k, length, unit), wavelength[i])
                _pull_offs(
                    basis, curve, scales, own, slots, results, flags, work, deepest if amplitude[i] > 0.0 else 0.0
                )
            if cycles and wants_folds(slots):
                _cycles(basis, curve, length, unit, wavelength[i], own, slots, results, flags, scene)
            if len(sense) > 0:
                put_rest(basis, curve, scene, unit, wavelength[i], own, slots, results, flags)

    return solve_scenes


solve_scenes: Final = loop_of(cycles=True)
solve_pull_offs: Final = loop_of(cycles=False)
"""The same where nothing but the pull-off is asked for."""
