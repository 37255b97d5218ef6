"""Scenes in the order of their exponents, on tables that reach as far as they must, and what each kind is solved by."""

import math
from collections.abc import Callable
from functools import partial
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.curve.values import Curve, bin_of
from gradhesion.core.cycle.pull_off import Lowest, envelope_place, lowest_load, serves
from gradhesion.core.edge.pattern import bins_of_wave, bounds_of
from gradhesion.core.jit import allocating, kernel, leaf
from gradhesion.core.problem.status import NO_VALUE, TOO_MANY_WAVES
from gradhesion.core.scenes import results
from gradhesion.core.scenes import rows as at
from gradhesion.core.scenes.cycles import curve_end, solve_exponent
from gradhesion.core.scenes.long import solve_summed
from gradhesion.core.scenes.reduced import AT_RIM, Punch, reduced_of
from gradhesion.core.scenes.requests import Places, Request, Wanted, run_parts
from gradhesion.core.scenes.tables import (
    MOST_BINS,
    Tables,
    end_of_exponent,
    ends_of_exponents,
    long_table,
    near_tables,
    own_exponent,
    rooms_for,
    solve_some,
    task_of,
)
from gradhesion.core.table.basis import Basis, Kept, basis_of, fill_kept, make_known, mix_bins, place_for, table_in
from gradhesion.core.table.filling import source_of, waves_at, width_of
from gradhesion.core.table.layout import BY_LOAD, EXACT, GEOMETRIC, PER_WAVE, end_of
from gradhesion.core.types import Floats, Integers

FINEST: Final = 2**12
"""By which bins may be narrower than those of a profile, so that they resolve a pattern."""
_AROUND: Final = 8
"""Bins around the lowest place of the envelope that are filled at once for a pull-off."""
_LONGEST: Final = 30.0
"""By which a table may be longer than what was asked for at first."""
Summed: TypeAlias = Callable[[Floats, Floats, Floats], None]
"""What solves scenes: takes them, their reduced numbers, and room for results."""
Solve: TypeAlias = Callable[[Tables, Floats, Floats, Floats], None]
"""The same on tables, which it takes first."""


@leaf
def _near_lowest(basis: Basis, kept: Kept, place: int, curve: Curve, rim: float) -> Lowest:
    """Return the lowest load of a curve on a kept table, whose bins are filled where the search arrives."""
    table, most, around = curve.table, basis.values.shape[0] - 1, _AROUND
    at_rim, middle = bin_of(table, min(rim, end_of(table))), bin_of(table, min(envelope_place(curve), rim))
    if rim <= end_of(table) and not kept.filled[place, 0] <= at_rim < kept.filled[place, 1]:
        mix_bins(basis, table.k, kept.weights[place], at_rim, at_rim + 1, table.nodes, table.polys)
    lowest = Lowest(0.0, 0.0, 0.0, 0.0, False)
    while not lowest.known and around < 3 * most:
        low, high = max(middle - around, 0) // _AROUND * _AROUND, min(middle + around, most)
        fill_kept(basis, kept, place, low, high)
        lowest = lowest_load(curve, rim, kept.filled[place, 0], kept.filled[place, 1])
        around *= 3
    return lowest


@kernel
def near_forces(basis: Basis, kept: Kept, scenes: Floats, reduced: Floats, out: Floats) -> None:
    """Solve the pull-off alone of scenes in the order of their exponents, once for neighbours of the same curve."""
    first, k, place = int(np.int64(0)), math.nan, 0  # a plain 0 would be a type of its own
    while first < scenes.shape[1]:
        last = curve_end(math.inf, scenes, reduced, first, scenes.shape[1], out)
        if last == first:
            first += 1
            continue
        if scenes[at.K, first] != k:
            k = scenes[at.K, first]
            place = place_for(basis, kept, k)
        table = table_in(basis, k, kept.polys.shape[1], kept.nodes[place], kept.polys[place])
        curve = Curve(table, reduced[at.BY_POWER, first], reduced[at.BY_WAVES, first], 0.0, 1.0)
        furthest = 0.0
        for i in range(first, last):
            furthest = max(furthest, reduced[at.RIM_Y, i])
        lowest = _near_lowest(basis, kept, place, curve, furthest)
        for i in range(first, last):
            rim, own = reduced[at.RIM_Y, i], lowest
            if not serves(lowest, furthest, rim):
                own = _near_lowest(basis, kept, place, curve, rim)
            results.put_force(own, reduced, i, out)
        first = last


@kernel
def solve_cycles(punch: Punch, wanted: Wanted, tables: Tables, scenes: Floats, reduced: Floats, out: Floats) -> None:
    """Solve cycles in the order of their exponents; scenes that reach beyond the tables are left as SHORT."""
    first = int(np.int64(0))  # a plain 0 would be a type of its own, for which callees are compiled once more
    while first < scenes.shape[1]:
        last = end_of_exponent(scenes, first)
        task = task_of(punch, wanted, tables, scenes, reduced, first, last)
        solve_exponent(task, scenes, reduced, first, last, out)
        first = last


@allocating
def far_rims(punch: Punch, width: float, form: int, scenes: Floats, reduced: Floats, out: Floats) -> None:
    """Fill the depths at rims that are beyond the tables of their scenes, on the endless branch."""
    source = source_of(0.5, punch.exponent, punch.waves, width, 0.0, form)
    for i in range(scenes.shape[1]):
        y = reduced[at.RIM_Y, i]
        if out[results.DEEPEST, i] == math.inf and y < math.inf:
            if source.k != scenes[at.K, i]:
                source = source_of(scenes[at.K, i], punch.exponent, punch.waves, width, 0.0, form)
            u, _ = waves_at(source, y)
            flat = reduced[at.BY_POWER, i] * y**punch.exponent + reduced[at.BY_WAVES, i] * u
            stretch = math.sqrt(reduced[at.CLOSING, i]) * y ** (0.5 * (1.0 - scenes[at.K, i]))
            out[results.DEEPEST, i] = (flat - stretch) * reduced[at.DEPTH, i]


def _finer_bins(punch: Punch, scenes: Floats, least: Floats) -> Integers:
    """Return by which power of 2 the bins of each scene must be narrower than those of its profile."""
    per = bins_of_wave(punch.rows, scenes[at.PATTERN_AMPLITUDE], punch.of_work, least)
    with np.errstate(all="ignore"):
        ratio = per * scenes[at.WAVELENGTH] / scenes[at.PATTERN_WAVELENGTH] / (PER_WAVE * punch.waves[:, 0].max())
        ratio[~(scenes[at.PATTERN_WAVELENGTH] > 0.0)] = 1.0
        return 2 ** np.clip(np.nan_to_num(np.ceil(np.log2(ratio))), 0, 30).astype(np.int64)


def prepared(punch: Punch, form: int, scenes: Floats) -> tuple[Floats, Integers]:
    """Return the reduced numbers of scenes, (REDUCED_ROWS, scenes), and by how much their bins are to be narrower."""
    most, steep = np.ones(scenes.shape[1]), np.zeros(scenes.shape[1])
    finer = np.ones(scenes.shape[1], dtype=np.int64)
    if punch.rows.shape[1] > 0:
        with np.errstate(all="ignore"):
            reach = scenes[at.RIM] / scenes[at.PATTERN_WAVELENGTH]
            least, most, steep = bounds_of(punch.rows, scenes[at.PATTERN_AMPLITUDE], punch.of_work, reach)
            steep = steep * scenes[at.WAVELENGTH] / scenes[at.PATTERN_WAVELENGTH]
        allowed = (least > 0.0) if punch.of_work else (least >= -1e-14)
        most = np.where(allowed, most, np.nan)
        finer = _finer_bins(punch, scenes, least)
    basis = basis_of(punch.exponent, punch.waves, form, 1, own_exponent(punch, scenes))
    make_known(basis, *ends_of_exponents(scenes[at.K]))
    return reduced_of(punch, basis, scenes, most, steep), finer


def _solve_far(
    punch: Punch, form: int, near: Tables, most: float, solve: Solve, scenes: Floats, reduced: Floats, out: Floats
) -> None:
    """Solve scenes of one exponent beyond near tables, on tables that are tripled where they prove too short.

    No table is longer than `most`.
    """
    k = float(scenes[at.K, 0])
    left, factor, y_end = np.arange(scenes.shape[1]), 1.0, 0.0
    while left.size and factor <= _LONGEST and y_end < most:
        with np.errstate(over="ignore"):  # what is endless stays so
            need = np.minimum(reduced[at.NEED, left] * factor, reduced[at.RIM_Y, left] * 1.01)
        possible = need[need <= most]
        y_end = float(possible.max()) if possible.size else most
        table, _, crest = long_table(punch, k, form, near.finer, y_end)
        pull = table if form == EXACT else long_table(punch, k, BY_LOAD, near.finer, y_end)[0]
        # those that reach beyond all tables are left for the last, lest they take others of their curve along
        reach = most if possible.size else math.inf
        rooms = rooms_for(table.bins, punch.rows.shape[1] > 0)
        tables = near._replace(long=table, long_by_load=pull, crest=crest, reach=reach, rooms=rooms)
        solve_some(partial(solve, tables), left, scenes, reduced, out)
        left = np.flatnonzero(out[results.STATUS] == results.SHORT)
        factor *= 3.0
    out[results.STATUS, left] = NO_VALUE | TOO_MANY_WAVES


def solve_groups(
    punch: Punch,
    form: int,
    scenes: Floats,
    out: Floats,
    solve: Solve,
    *,
    summed: Summed | None = None,
    pull_off: bool = False,
    most_bins: float = math.inf,
) -> Floats:
    """Solve scenes in the order of their exponents, those of a long series of one; return their reduced numbers.

    `solve` takes tables, scenes, their reduced numbers, and room for results, STATUS among them. First it solves near
    scenes, those of one fineness of bins at a time; those of one exponent that it leaves as SHORT are passed to
    `summed`, which takes the last three, and what that leaves to `solve` with long tables. `pull_off`: nothing else is
    wanted, and no more need be known. Scenes that must be known beyond `most_bins` bins are not tried.
    """
    reduced, finer = prepared(punch, form, scenes)
    if pull_off:
        reduced[at.NEED] = np.fmin(reduced[at.PULL], reduced[at.RIM_Y])
    out[results.STATUS] = NO_VALUE | TOO_MANY_WAVES  # where finer bins than FINEST are needed
    finenesses = np.unique(finer[finer <= FINEST]).tolist() if punch.rows.shape[1] > 0 else [1]
    for fineness in finenesses:
        chosen = np.flatnonzero(finer == fineness)
        near = near_tables(punch, form, fineness, scenes)
        solve_some(partial(solve, near), chosen, scenes, reduced, out)
        short = chosen[out[results.STATUS, chosen] == results.SHORT]
        if not short.size:
            continue
        most, longest = ((bins - GEOMETRIC) * width_of(punch.waves, fineness) for bins in (most_bins, MOST_BINS))
        out[results.STATUS, short[reduced[at.NEED, short] > most]] = NO_VALUE | TOO_MANY_WAVES
        short, most = short[reduced[at.NEED, short] <= most], min(most, longest)
        for k in np.unique(scenes[at.K, short]):
            own = short[scenes[at.K, short] == k]
            if summed is not None:
                solve_some(summed, own, scenes, reduced, out)
                own = own[out[results.STATUS, own] == results.SHORT]
            solve_some(partial(_solve_far, punch, form, near, most, solve), own, scenes, reduced, out)
    return reduced


def _solve_task(punch: Punch, wanted: Wanted, form: int, scenes: Floats, *, depth: bool = False) -> Floats:
    """Return the results of scenes in the order of their exponents, those of a long series of one; of one thread.

    `depth`: that at rims beyond the tables is wanted as well.
    """
    alone = not (wanted.cycle or wanted.saturation or punch.turn != AT_RIM)
    plain = punch.rows.shape[1] == 0

    def solve(tables: Tables, own: Floats, reduced: Floats, found: Floats) -> None:
        """Solve scenes on tables: on near ones the pull-off alone needs but a few bins."""
        if alone and plain and tables.long.bins == 0:
            near_forces(tables.by_load, tables.kept_by_load, own, reduced, found)
        else:
            solve_cycles(punch, wanted, tables, own, reduced, found)

    out = np.full((results.RESULT_ROWS, scenes.shape[1]), np.nan)
    summed = partial(solve_summed, punch, wanted, form) if plain else None
    reduced = solve_groups(punch, form, scenes, out, solve, summed=summed, pull_off=alone)
    if depth:
        far_rims(punch, width_of(punch.waves), form, scenes, reduced, out)
    return out


def _with_saturation(punch: Punch, form: int, scenes: Floats, out: Floats) -> None:
    """Store the radii of outermost folds, wherever the rim is; NaN, and flagged: too many waves up to there."""
    wanted = Wanted(cycle=False, contact=False, residual=False, saturation=True)
    endless = scenes.copy()
    endless[at.RIM] = np.inf
    whole = _solve_task(punch._replace(turn=AT_RIM), wanted, form, endless)
    known, status = whole[results.STATUS].astype(np.int64), out[results.STATUS].astype(np.int64)
    out[results.SATURATION] = np.where((known | status) & NO_VALUE, np.nan, whole[results.SATURATION])
    out[results.STATUS] = status | (known & TOO_MANY_WAVES)


def solve_all(
    request: Request, wanted: Wanted, form: int, rows: list[int], threads: int | None
) -> tuple[Floats, NDArray[np.int16]]:
    """Return the chosen rows of results, (rows, scenes), and the status of all scenes."""
    punch, count = request.punch, math.prod(request.shape)
    out, status = np.empty((len(rows), count)), np.empty(count, dtype=np.int16)

    def work(scenes: Floats, places: Places) -> None:
        """Solve a part of the scenes."""
        found = _solve_task(punch, wanted._replace(saturation=False), form, scenes, depth=results.DEEPEST in rows)
        if wanted.saturation:
            _with_saturation(punch, form, scenes, found)
        for row, wanted_row in enumerate(rows):
            out[row, places] = found[wanted_row]
        status[places] = found[results.STATUS]

    run_parts(request, work, threads)
    return out, status
