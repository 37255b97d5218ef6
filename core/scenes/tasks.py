"""Scenes in the order of their exponents, on tables that reach as far as they must, and what each kind is solved by."""

import math
from collections.abc import Callable
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.curve.values import Curve, bin_of
from gradhesion.core.cycle.disc import profile_of
from gradhesion.core.cycle.pull_off import Lowest, envelope_place, lowest_load, serves
from gradhesion.core.edge.pattern import bins_of_wave, bounds_of
from gradhesion.core.jit import allocating, kernel, leaf
from gradhesion.core.problem.status import NO_VALUE, TOO_MANY_WAVES
from gradhesion.core.scenes import rows as at
from gradhesion.core.scenes.cycles import curve_end, solve_exponent
from gradhesion.core.scenes.long import solve_summed
from gradhesion.core.scenes.reduced import AT_RIM, Punch, reduced_of
from gradhesion.core.scenes.requests import (
    Request,
    Wanted,
    columns_of,
    punch_of,
    run_parts,
    scenes_by_exponent,
    set_lengths,
)
from gradhesion.core.scenes.results import put_force
from gradhesion.core.scenes.tables import (
    MOST_BINS,
    Tables,
    end_of_exponent,
    near_tables,
    own_exponent,
    solve_far,
    task_of,
)
from gradhesion.core.table.basis import Basis, Kept, basis_of, fill_kept, is_interpolated, mix_bins, place_for, table_in
from gradhesion.core.table.filling import source_of, waves_at, width_of
from gradhesion.core.table.layout import PER_WAVE, end_of
from gradhesion.core.types import Floats, Integers

FINEST: Final = 2**12
"""By which bins may be narrower than those of a profile, so that they resolve a pattern."""
_AROUND: Final = 8
"""Bins around the lowest place of the envelope that are filled at once for a pull-off."""
Group: TypeAlias = Callable[[int, Floats, Floats, Floats], None]
"""What solves scenes of one fineness of bins: takes that, scenes, their reduced numbers, and room for results."""


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
        furthest = reduced[at.RIM_Y, first:last].max()
        lowest = _near_lowest(basis, kept, place, curve, furthest)
        for i in range(first, last):
            rim, own = reduced[at.RIM_Y, i], lowest
            if not serves(lowest, furthest, rim):
                own = _near_lowest(basis, kept, place, curve, rim)
            put_force(own, reduced, i, out)
        first = last


@kernel
def solve_cycles(
    punch: Punch, wanted: Wanted, tables: Tables, profile: Floats, scenes: Floats, reduced: Floats, out: Floats
) -> None:
    """Solve cycles in the order of their exponents; scenes that reach beyond the tables are left as SHORT."""
    first = int(np.int64(0))  # a plain 0 would be a type of its own, for which callees are compiled once more
    while first < scenes.shape[1]:
        last = end_of_exponent(scenes, first)
        task = task_of(punch, wanted, tables, profile, scenes, reduced, first, last)
        solve_exponent(task, scenes, reduced, first, last, out)
        first = last


@allocating
def far_rims(punch: Punch, width: float, form: int, scenes: Floats, reduced: Floats, out: Floats) -> None:
    """Fill the depths at rims that are beyond the tables of their scenes, on the endless branch."""
    source = source_of(0.5, punch.exponent, punch.waves, width, 0.0, form)
    for i in range(scenes.shape[1]):
        y = reduced[at.RIM_Y, i]
        if out[at.DEEPEST, i] == math.inf and y < math.inf:
            if source.k != scenes[at.K, i]:
                source = source_of(scenes[at.K, i], punch.exponent, punch.waves, width, 0.0, form)
            u, _ = waves_at(source, y)
            flat = reduced[at.BY_POWER, i] * y**punch.exponent + reduced[at.BY_WAVES, i] * u
            stretch = math.sqrt(reduced[at.CLOSING, i]) * y ** (0.5 * (1.0 - scenes[at.K, i]))
            out[at.DEEPEST, i] = (flat - stretch) * reduced[at.DEPTH, i]


@kernel
def far_forces(tables: Tables, scenes: Floats, reduced: Floats, out: Floats) -> None:
    """Solve the pull-off alone of scenes on a long table."""
    table = tables.long_by_load
    for i in range(scenes.shape[1]):
        curve = Curve(table, reduced[at.BY_POWER, i], reduced[at.BY_WAVES, i], 0.0, 1.0)
        put_force(lowest_load(curve, reduced[at.RIM_Y, i], 0, table.bins), reduced, i, out)


def _finer_bins(punch: Punch, scenes: Floats, least: Floats) -> Integers:
    """Return by which power of 2 the bins of each scene must be narrower than those of its profile."""
    if punch.rows.shape[1] == 0:
        return np.ones(scenes.shape[1], dtype=np.int64)
    per = bins_of_wave(punch.rows, scenes[at.PATTERN_AMPLITUDE], punch.of_work, least)
    with np.errstate(all="ignore"):
        ratio = per * scenes[at.WAVELENGTH] / scenes[at.PATTERN_WAVELENGTH] / (PER_WAVE * punch.waves[:, 0].max())
        ratio[~(scenes[at.PATTERN_WAVELENGTH] > 0.0)] = 1.0
        return 2 ** np.clip(np.nan_to_num(np.ceil(np.log2(ratio))), 0, 30).astype(np.int64)


def prepared(punch: Punch, form: int, scenes: Floats) -> tuple[Floats, Integers]:
    """Return the reduced numbers of scenes, (REDUCED_ROWS, scenes), and by how much their bins are to be narrower.

    The latter are of one item, or one a scene.
    """
    most, steep = np.ones(scenes.shape[1]), np.zeros(scenes.shape[1])
    finer = np.ones(1, dtype=np.int64)
    if punch.rows.shape[1] > 0:
        with np.errstate(all="ignore"):
            reach = scenes[at.RIM] / scenes[at.PATTERN_WAVELENGTH]
            least, most, steep = bounds_of(punch.rows, scenes[at.PATTERN_AMPLITUDE], punch.of_work, reach)
            steep = steep * scenes[at.WAVELENGTH] / scenes[at.PATTERN_WAVELENGTH]
        allowed = (least > 0.0) if punch.of_work else (least >= -1e-14)
        most = np.where(allowed, most, np.nan)
        finer = _finer_bins(punch, scenes, least)
    basis = basis_of(punch.exponent, punch.waves, form, 1, own_exponent(punch, scenes))
    return reduced_of(punch, basis, scenes, most, steep), finer


def in_groups(
    punch: Punch,
    form: int,
    scenes: Floats,
    rows: int,
    near: Group,
    far: Group,
    *,
    whole: bool = False,
    pull_off: bool = False,
) -> tuple[Floats, Floats]:
    """Return the results of scenes in the order of their exponents, (rows, scenes), and their reduced numbers.

    STATUS is among the results. `near` solves scenes of one fineness of bins, `far` those of one exponent that it
    leaves as SHORT; each takes the fineness, scenes, their reduced numbers, and room for results. `whole`: all folds
    are needed, wherever the rim is; `pull_off`: nothing but the pull-off.
    """
    if not is_interpolated(punch.waves) and (scenes[at.K] != scenes[at.K, 0]).any():
        begins = np.flatnonzero(np.diff(scenes[at.K]) != 0.0) + 1
        parts = [
            in_groups(punch, form, np.ascontiguousarray(own), rows, near, far, whole=whole, pull_off=pull_off)
            for own in np.split(scenes, begins, axis=1)
        ]
        return np.hstack([out for out, _ in parts]), np.hstack([reduced for _, reduced in parts])
    out = np.full((rows, scenes.shape[1]), np.nan)
    reduced, finer = prepared(punch, form, scenes)
    if whole:
        reduced[at.NEED] = np.fmax(reduced[at.NEED], reduced[at.WINDOW])
    if pull_off:
        reduced[at.NEED] = np.fmin(reduced[at.PULL], reduced[at.RIM_Y])

    def put(solve: Group, value: int, chosen: Integers) -> None:
        """Solve chosen scenes."""
        own, numbers = (np.ascontiguousarray(array[:, chosen]) for array in (scenes, reduced))
        found = np.full((rows, own.shape[1]), np.nan)
        solve(value, own, numbers, found)
        out[:, chosen] = found

    if (finer == finer[0]).all() and finer[0] <= FINEST:
        near(int(finer[0]), scenes, reduced, out)
    else:
        out[at.STATUS, finer > FINEST] = NO_VALUE | TOO_MANY_WAVES
        for value in np.unique(finer[finer <= FINEST]):
            put(near, int(value), np.flatnonzero(finer == value))
    short = np.flatnonzero(out[at.STATUS] == at.SHORT)
    if short.size:
        finenesses, exponents = np.broadcast_to(finer, scenes.shape[1])[short], scenes[at.K, short]
        for value, k in sorted({*zip(finenesses.tolist(), exponents.tolist(), strict=True)}):
            put(far, value, short[(exponents == k) & (finenesses == value)])
    return out, reduced


def _solve_task(punch: Punch, wanted: Wanted, form: int, profile: Floats, scenes: Floats) -> Floats:
    """Return the results of scenes in the order of their exponents, of one thread."""
    if wanted.saturation:  # folds beyond the rim are looked for apart, so that asking for them changes no value
        out = _solve_task(punch, wanted._replace(saturation=False), form, profile, scenes)
        alone = Wanted(cycle=True, depth=False, contact=False, residual=False, saturation=True)
        whole, _ = _in_groups(punch, alone, form, profile, scenes)
        too_many = whole[at.STATUS].astype(np.int64) & TOO_MANY_WAVES
        failed = (out[at.STATUS].astype(np.int64) & NO_VALUE) > 0
        out[at.SATURATION] = np.where(failed | (too_many > 0), np.nan, whole[at.SATURATION])
        out[at.STATUS] = out[at.STATUS].astype(np.int64) | too_many
        return out
    out, reduced = _in_groups(punch, wanted, form, profile, scenes)
    if wanted.depth:
        far_rims(punch, width_of(punch.waves), form, scenes, reduced, out)
    return out


def _solver(punch: Punch, wanted: Wanted, profile: Floats) -> Callable[[Tables, Floats, Floats, Floats], None]:
    """Return what solves scenes on given tables: cycles, or the pull-off alone if that is all that is wanted."""
    cycles = wanted.cycle or punch.turn != AT_RIM or punch.rows.shape[1] > 0

    def solve(tables: Tables, scenes: Floats, reduced: Floats, out: Floats) -> None:
        """Solve scenes in the order of their exponents."""
        if cycles:
            solve_cycles(punch, wanted, tables, profile, scenes, reduced, out)
        elif tables.long.bins > 0:
            far_forces(tables, scenes, reduced, out)
        else:
            near_forces(tables.by_load, tables.kept_by_load, scenes, reduced, out)

    return solve


def _in_groups(punch: Punch, wanted: Wanted, form: int, profile: Floats, scenes: Floats) -> tuple[Floats, Floats]:
    """Return results and reduced numbers of scenes, as `in_groups`, but for depths at rims beyond their tables."""
    solve = _solver(punch, wanted, profile)

    def near(finer: int, own: Floats, reduced: Floats, out: Floats) -> None:
        """Solve near scenes."""
        with near_tables(punch, form, finer, own_exponent(punch, own)) as tables:
            solve(tables, own, reduced, out)

    def far(finer: int, own: Floats, reduced: Floats, out: Floats) -> None:
        """Solve others."""

        def walk(irregular: Floats, numbers: Floats, found: Floats) -> None:
            """Solve scenes that cannot be summed."""
            alone = _solver(punch, wanted._replace(saturation=False), profile)
            solve_far(punch, form, 1, irregular, numbers, found, alone, MOST_BINS)

        solve_summed(punch, wanted, form, profile, own, reduced, out, walk)
        left = np.flatnonzero(out[at.STATUS] == at.SHORT)
        if left.size:
            rest = np.full((at.RESULT_ROWS, left.size), np.nan)
            solve_far(punch, form, finer, own[:, left], np.ascontiguousarray(reduced[:, left]), rest, solve, MOST_BINS)
            out[:, left] = rest

    pull_off = punch.rows.shape[1] > 0 and punch.turn == AT_RIM and not wanted.cycle
    return in_groups(punch, form, scenes, at.RESULT_ROWS, near, far, whole=wanted.saturation, pull_off=pull_off)


def solve_all(
    request: Request, wanted: Wanted, form: int, rows: list[int], threads: int | None
) -> tuple[Floats, NDArray[np.int16]]:
    """Return the chosen rows of results, (rows, scenes), and the status of all scenes."""
    punch, profile = punch_of(request), profile_of(request.waves)
    columns, count = columns_of(request)
    out, status = np.empty((len(rows), count)), np.empty(count, dtype=np.int16)

    def work(first: int, last: int) -> None:
        """Solve a part of the scenes."""
        scenes, places = scenes_by_exponent(columns, first, last)
        set_lengths(punch, scenes)
        found = _solve_task(punch, wanted, form, profile, scenes)
        for row, wanted_row in enumerate(rows):
            out[row, places] = found[wanted_row]
        status[places] = found[at.STATUS]

    run_parts(count, work, threads)
    return out, status
