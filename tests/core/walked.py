"""Energies of long curves with every wave walked: the sums of the solvers are switched off.

The losses of all jumps are added up at once, and rounded once: one after the other, thousands of them lose some 20 eps.
What the walks have in common with the sums is the curve (the rounding of its constants) and what one jump loses.
"""

import math
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np

from gradhesion.core.arrays.prepared import prepared
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.compiler.jit import NO, YES, kernel
from gradhesion.core.curve.branches import ARRIVAL, END, LANDING, NEXT, ROWS, START, START_DEPTH, WORK, Trace
from gradhesion.core.curve.cosine import Cosine, depth
from gradhesion.core.curve.cosine import curve_of as cosine_of
from gradhesion.core.curve.general import Basis, curve_of
from gradhesion.core.curve.general_branches import fill_branches
from gradhesion.core.curve.general_folds import MOST_FOLDS, find_folds, room
from gradhesion.core.curve.window import first_fold_bound, last_fold_bound
from gradhesion.core.face import loss_between, loss_from_zero, loss_to_zero
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path import unloading
from gradhesion.core.path.cosine import extent, is_long, is_unresolved, walk
from gradhesion.core.path.general_long import folds_before
from gradhesion.core.path.general_middle import LONGEST_WALK, REGULAR, middle_of
from gradhesion.core.path.pieces import Piece, State, climb, descend, leave, leave_rim, notes_for, reach_rim
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.shape import depth_factor_of, in_own_wavelength
from gradhesion.core.types import Floats, Table
from gradhesion.core.waves.general import branches_of_wave, room_for_waves

Walked = tuple[float, float, float]
"""Energy in R^2 dgamma, and the jumps of loading and of unloading."""
NOTHING = State(0.0, 0.0, 0.0, 0.0, 0.0, NO)
"""The state before contact."""


def walked_cosine(scene: dict[str, float], table_of: Callable[[float], Any], most: float) -> float | None:
    """Give the energy of a long curve of one cosine, at half a microsecond a wave.

    None where it is not summed, or has more arches.
    """
    material = float(stiffness(scene["k"], scene["nu"], scene["modulus"], scene["c0_over_R"]))
    stretch = math.sqrt(2.0 ** (1.0 + scene["k"]) * math.pi / material)
    table, wavelength = table_of(scene["k"]), scene["lambda_over_R"]
    curve, length, _ = cosine_of(scene["k"], stretch, wavelength, scene["A"] * wavelength)
    arches, x = extent(table, curve), scene["a_max_over_R"] / wavelength
    if is_unresolved(arches, x) or not is_long(table, arches, x) or min(arches[1], 2.0 * x) - arches[0] > most:
        return None
    count, trace = walk(table, curve, arches, min(x, 1e300), np.empty((ROWS, 64)), False)
    rim_depth = depth(table, curve, x) if x < math.inf else math.inf
    losses = np.empty(2 * count + 3)
    jumps = losses_of_jumps(table, curve, count, trace, x, rim_depth, losses)
    return 2.0 * math.pi * length**2 * math.fsum(losses[:jumps])


@kernel()
def losses_of_jumps(
    table: Table, curve: Cosine, count: int, trace: Trace, rim: float, rim_depth: float, losses: Floats
) -> int:
    """Put what each jump of a cycle on a walked curve loses into `losses`; return the number of jumps."""
    jumps, left = 0, -1.0
    for branch in range(count):
        x = trace[ARRIVAL, branch]
        if not (x <= rim and x < math.inf):
            continue
        if left < 0.0:
            losses[jumps] = loss_from_zero(table, curve, x)
        else:
            losses[jumps] = loss_between(table, curve, left, x, trace[WORK])
        left = trace[END, branch]
        jumps += 1
    if left < 0.0:
        losses[jumps] = loss_from_zero(table, curve, rim)
        jumps += 1
    elif left < rim:
        losses[jumps] = loss_between(table, curve, left, rim, trace[WORK])
        jumps += 1
    now, landing = unloading.leave_rim(table, curve, count, trace, rim, rim_depth)
    if landing != rim and now >= 0:
        losses[jumps] = loss_between(table, curve, rim, landing, trace[WORK])
        jumps += 1
    elif landing != rim:
        losses[jumps] = loss_to_zero(table, curve, rim, rim_depth)
        jumps += 1
    if now >= 0:
        unloading.descend(table, curve, trace, now, NO)
    while now >= 0 and trace[START, now] > 0.0:
        start, lower = trace[START, now], int(trace[NEXT, now])
        if lower >= 0:
            losses[jumps] = loss_between(table, curve, start, trace[LANDING, now], trace[WORK])
        else:
            losses[jumps] = loss_to_zero(table, curve, start, trace[START_DEPTH, now])
        jumps += 1
        now = lower
    return jumps


def walked_general(
    scene: dict[str, float], profile: Profile, loading: Loading, waves: tuple[float, float]
) -> Walked | None:
    """Walk a long curve of any profile and control, at 10 to 60 microseconds a wave.

    None where it is not summed, or has fewer or more waves. Near its beginning and its end it is walked by the solver
    itself; each wave between by its own branches, with phases from the part of a wave alone, and the jumps that the
    running maximum of the coordinate makes, and its running minimum on the way back.
    """
    scenes = prepared(scene, loading)
    n, series = in_own_wavelength(profile)
    k, wavelength = float(scenes.k[0]), float(scenes.wavelength[0]) / n
    numbers = (float(scenes.stretch[0]), wavelength, n * float(scenes.amplitude[0]), float(scenes.compliance[0]))
    curve, length, _ = curve_of(k, profile.exponent, depth_factor_of(k, profile.exponent), *numbers)
    basis, edge = Basis(*tables_of(k, series), series), float(scenes.rim[0, 0])
    rim = edge / wavelength
    first, last = first_fold_bound(basis, curve) / TWO_PI, min(rim, last_fold_bound(basis, curve) / TWO_PI)
    if not max(LONGEST_WALK, waves[0]) < last - first <= waves[1]:
        return None
    middle = middle_of(basis, curve, first, last, 0.0)
    kind, until, cut, _, begin, end, _ = middle
    if kind != REGULAR:
        return None
    search, zeros, whole = room(), np.empty(MOST_FOLDS), end + 1.0
    x = rim if rim == math.inf else float(Fraction(edge) / Fraction(wavelength) - Fraction(whole))
    count, rises, _ = folds_before(basis, curve, first, middle, search, zeros)
    near = np.empty((4, count // 2 + 2))
    inner = fill_branches(basis, curve, zeros, count, rises, begin + cut, near, 0.0)
    count, rises, _ = find_folds(basis, curve, cut, min(x, until - whole), search, zeros, whole)
    far = np.empty((4, count // 2 + 2))
    outer = fill_branches(basis, curve, zeros, count, rises, x, far, whole)
    work, numbers_of = room_for_waves(series), np.arange(begin, end + 1.0)
    rows = work[2][0]

    losses: list[float] = []
    unnoted = notes_for(0)

    def alone(state: State) -> State:
        """Keep what is lost apart: thousands of losses are added up at once, and rounded once."""
        losses.append(state.loss)
        return state._replace(loss=0.0)

    first_of_all, last_of_all = Piece(inner, near, 0.0), Piece(outer, far, whole)
    up = alone(climb(basis, curve, first_of_all, NOTHING, -1.0, YES, unnoted))
    for wave in numbers_of.tolist():
        piece = Piece(branches_of_wave(basis, curve, wave, cut, work, rows), rows, wave)
        up = alone(climb(basis, curve, piece, up, -1.0, YES, unnoted))
    up = alone(climb(basis, curve, last_of_all, up, -1.0, YES, unnoted))
    up = alone(reach_rim(basis, curve, x, up, YES, whole, unnoted))
    inside, down = leave_rim(basis, curve, last_of_all, x)
    down = alone(descend(basis, curve, Piece(inside, far, whole), down, YES, unnoted))
    for wave in numbers_of[::-1].tolist():
        piece = Piece(branches_of_wave(basis, curve, wave, cut, work, rows), rows, wave)
        down = alone(descend(basis, curve, piece, down, YES, unnoted))
    down = alone(descend(basis, curve, first_of_all, down, YES, unnoted))
    down = alone(leave(basis, curve, down, loading.control != "load", unnoted))
    return 2.0 * math.pi * length**2 * math.fsum(losses), up.jumps, down.jumps
