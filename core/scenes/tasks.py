"""Scenes in the order of their exponents, cut into tasks for threads, on tables that reach as far as they must.

Near ones, within 64 of the shortest waves, are solved on bins interpolated in k (table/basis.py), the others on longer
tables of their exponent. Which one it is depends on the scene alone.
"""

import math
import threading
from collections import OrderedDict
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import nullcontext
from typing import Final, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.borrowed import borrowed
from gradhesion.core.curve.values import Curve, bin_of
from gradhesion.core.cycle.disc import disc_of, profile_of
from gradhesion.core.cycle.long import MOST, NEAR, Long, space_for
from gradhesion.core.cycle.pull_off import Lowest, envelope_place, lowest_load, serves
from gradhesion.core.cycle.waves import Waves, reach_of, waves_of
from gradhesion.core.edge.pattern import bins_of_wave, bounds_of, rows_by_number
from gradhesion.core.jit import kernel, leaf
from gradhesion.core.problem.status import NO_VALUE, TOO_MANY_WAVES
from gradhesion.core.processors import processors
from gradhesion.core.scenes.cycles import Task, curve_end, put_force, solve_cycles
from gradhesion.core.scenes.long import fill_saturation, solve_long
from gradhesion.core.scenes.reduced import (
    AMPLITUDE,
    AT_RIM,
    BY_POWER,
    BY_WAVES,
    CLOSING,
    DEPTH,
    NEED,
    PATTERN_AMPLITUDE,
    PATTERN_WAVELENGTH,
    PULL,
    RIM,
    RIM_Y,
    WAVELENGTH,
    WINDOW,
    K,
    Punch,
    depth_factor_of,
    reduced_of,
)
from gradhesion.core.scenes.results import DEEPEST, RESULT_ROWS, SATURATION, SHORT, STATUS, Rooms, Wanted, rooms_for
from gradhesion.core.table.basis import (
    Basis,
    Kept,
    basis_of,
    between,
    empty_table,
    fill_kept,
    is_interpolated,
    kept_table,
    kept_tables,
    mix_bins,
    place_for,
    room_of,
)
from gradhesion.core.table.filling import fill_bins, source_of, waves_at, width_of, with_bounds
from gradhesion.core.table.layout import (
    BY_LOAD,
    EXACT,
    FIRST,
    GEOMETRIC,
    PER_WAVE,
    U1,
    E,
    Source,
    Table,
    U,
    Y,
    end_of,
    span_of,
)
from gradhesion.core.table.leading import crests_of
from gradhesion.core.types import Floats, Integers

_MOST_BINS: Final = 130_000
"""Bins of a table, at most: 76 MB."""
_KEPT_BINS: Final = 260_000
"""Bins of all long tables that are kept between calls."""
_WALKED: Final = 600
"""Waves that are walked; scenes of more are summed."""
_WALKED_WITH_WORK: Final = 2000
"""The same where the loop integral is wanted, which is not summed."""
_WALKED_BINS: Final = 40_000
"""Bins that are walked at most, where waves have many: 23 MB."""
FINEST: Final = 2**12
"""By which bins may be narrower than those of a profile, so that they resolve a pattern."""
_BINS_OF_A_WAVE: Final = 1024
"""Bins of a wave at most, where waves are summed: 5 MB for each doubling of their number."""
_KEPT_WAVES: Final = 64e6
"""Bytes of all waves (cycle/waves.py) that are kept between calls."""
_AROUND: Final = 8
"""Bins around the lowest place of the envelope that are filled at once for a pull-off."""
_LONGEST: Final = 30.0
"""By which a table may be longer than what was asked for at first."""
_SCENES: Final = 1000
"""Scenes of a part, at least: a millisecond or more."""
_MOST_SCENES: Final = 4000
"""And at most: a megabyte of results. (No powers of 2, by which all rows would share the same few lines of a cache.)"""
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
    basis, kept, scenes, reduced, out = borrowed((basis, kept, scenes, reduced, out))
    first, k, place = int(np.int64(0)), math.nan, 0  # a plain 0 would be a type of its own
    while first < scenes.shape[1]:
        last = curve_end(math.inf, scenes, reduced, first, scenes.shape[1], out)
        if last == first:
            first += 1
            continue
        if scenes[K, first] != k:
            k = scenes[K, first]
            place = place_for(basis, kept, k)
        table = empty_table(basis, k, kept.nodes[place], kept.polys[place])
        curve = Curve(table, reduced[BY_POWER, first], reduced[BY_WAVES, first], 0.0, 1.0)
        rim = reduced[RIM_Y, first:last].max()
        while first < last:
            lowest = _near_lowest(basis, kept, place, curve, rim)
            while first < last and serves(lowest, rim, reduced[RIM_Y, first]):
                put_force(lowest, reduced, first, out)
                first += 1
            if first < last:
                rim = reduced[RIM_Y, first]


@kernel
def end_of_exponent(scenes: Floats, first: int) -> int:
    """Return the end of the scenes that share the exponent of the first one."""
    last = first + 1
    while last < scenes.shape[1] and scenes[K, last] == scenes[K, first]:
        last += 1
    return last


class NearTables(NamedTuple):
    """What near scenes are solved on.

    basis, kept         of the cycle, and its tables
    by_load, kept_by_load  of the pull-off: the same but for the leading terms of short waves
    rooms               for curves
    """

    basis: Basis
    kept: Kept
    by_load: Basis
    kept_by_load: Kept
    rooms: Rooms


@kernel
def near_task(
    punch: Punch,
    wanted: Wanted,
    near: NearTables,
    profile: Floats,
    scenes: Floats,
    reduced: Floats,
    first: int,
    last: int,
) -> Task:
    """Return what the scenes `first` to `last` - 1, of one exponent, are solved with, tables filled as they need."""
    basis = near.basis
    most = basis.values.shape[0] - 1
    reach = basis.start + (most - 2 - GEOMETRIC) * basis.width
    k, far = scenes[K, first], 0.0
    for i in range(first, last):
        if reduced[NEED, i] <= reach:
            far = max(far, reduced[NEED, i])
    if not (far > 0.0 and 0.0 <= k <= 1.0):
        k = 0.5  # none can be solved here
    bins = min(GEOMETRIC + max(16, int((far - basis.start) / basis.width) + 2), most)
    table = kept_table(basis, near.kept, k, bins)
    pull = table
    if near.by_load.form != basis.form:
        pull = kept_table(near.by_load, near.kept_by_load, k, bins)
    low, high = between(basis, k)
    crest = 1.01 * max(basis.crest[low], basis.crest[high])
    disc = disc_of(k, punch.exponent, depth_factor_of(k, punch.exponent), punch.waves, profile)
    return Task(punch, wanted, table, pull, crest, disc, near.rooms, reach)


@kernel
def near_cycles(
    punch: Punch, wanted: Wanted, near: NearTables, profile: Floats, scenes: Floats, reduced: Floats, out: Floats
) -> None:
    """Solve cycles in the order of their exponents; scenes that reach beyond the basis are left as SHORT."""
    punch, near, profile, scenes, reduced, out = borrowed((punch, near, profile, scenes, reduced, out))
    first = int(np.int64(0))  # a plain 0 would be a type of its own, for which callees are compiled once more
    while first < scenes.shape[1]:
        last = end_of_exponent(scenes, first)
        task = near_task(punch, wanted, near, profile, scenes, reduced, first, last)
        solve_cycles(task, scenes, reduced, first, last, out)
        first = last


@kernel
def far_rims(punch: Punch, width: float, form: int, scenes: Floats, reduced: Floats, out: Floats) -> None:
    """Fill the depths at rims that are beyond the tables of their scenes, on the endless branch."""
    punch, scenes, reduced, out = borrowed((punch, scenes, reduced, out))
    source = source_of(0.5, punch.exponent, punch.waves, width, 0.0, form)
    for i in range(scenes.shape[1]):
        y = reduced[RIM_Y, i]
        if out[DEEPEST, i] == math.inf and y < math.inf:
            if source.k != scenes[K, i]:
                source = source_of(scenes[K, i], punch.exponent, punch.waves, width, 0.0, form)
            u, _ = waves_at(source, y)
            flat = reduced[BY_POWER, i] * y**punch.exponent + reduced[BY_WAVES, i] * u
            stretch = math.sqrt(reduced[CLOSING, i]) * y ** (0.5 * (1.0 - scenes[K, i]))
            out[DEEPEST, i] = (flat - stretch) * reduced[DEPTH, i]


def near_basis(punch: Punch, form: int, scenes: Floats, finer: int = 1) -> Basis:
    """Return what near bins of scenes are filled from: those of a long series must share their exponent."""
    k = math.nan
    if not is_interpolated(punch.waves):
        k = float(scenes[K, 0]) if 0.0 <= scenes[K, 0] <= 1.0 else 0.5  # no value: any will do
    return basis_of(punch.exponent, punch.waves, form, finer, k)


def _solve_near(
    punch: Punch, wanted: Wanted, form: int, finer: int, profile: Floats, scenes: Floats, reduced: Floats, out: Floats
) -> None:
    """Solve near scenes of one fineness of bins."""
    basis = near_basis(punch, form, scenes, finer)
    by_load = basis if form == EXACT else near_basis(punch, BY_LOAD, scenes, finer)
    patterned = punch.rows.shape[1] > 0
    with kept_tables(basis) as kept, nullcontext(kept) if by_load is basis else kept_tables(by_load) as pulls:
        if wanted.cycle or punch.turn != AT_RIM or patterned:
            near = NearTables(basis, kept, by_load, pulls, rooms_for(basis.values.shape[0] - 1, patterned))
            near_cycles(punch, wanted, near, profile, scenes, reduced, out)
        else:
            near_forces(by_load, pulls, scenes, reduced, out)


_tables: OrderedDict[tuple[object, ...], tuple[Table, Source, float]] = OrderedDict()
_lock = threading.Lock()


def long_table(
    punch: Punch, k: float, form: int, finer: int, y_end: float, *, exactly: bool = False
) -> tuple[Table, Source, float]:
    """Return a table of the exponent k to y = y_end or beyond, the source of its bins, and a bound of -U' y^((k-1)/2).

    `form` is one of table/layout.py; bins are `finer` times narrower than usual. A table that is kept from an earlier
    call serves if it is long enough. With `exactly` the length follows from y_end alone, whatever was asked before:
    what is beyond it is found in another way, with other rounding.
    """
    width = width_of(punch.waves, finer)
    key = (punch.exponent, punch.waves.tobytes(), k, form, finer, y_end if exactly else math.inf)
    with _lock:
        if key in _tables and span_of(_tables[key][0]) >= y_end:
            _tables.move_to_end(key)
            return _tables[key]
        crest, wave, cut = crests_of(k, punch.waves)
        source = source_of(k, punch.exponent, punch.waves, width, cut / width % 1.0, form)
        bins = GEOMETRIC + max(16, int((y_end - source.start) / width) + 10)
        nodes, polys = room_of(bins)
        fill_bins(source, FIRST, GEOMETRIC, bins, nodes, polys)
        lowest = _lowest(nodes, -wave)
        share = (1.0 + k) / (1.0 + k + punch.exponent)
        empty = Table(k, punch.exponent, share, source.start, width, lowest, 0.0, GEOMETRIC, bins, nodes, polys)
        _tables.pop(key, None)
        _tables[key] = with_bounds(empty, crest, bins), source, crest
        while len(_tables) > 1 and sum(table.bins for table, _, _ in _tables.values()) > _KEPT_BINS:
            _tables.popitem(last=False)
        return _tables[key]


@kernel
def far_forces(task: Task, scenes: Floats, reduced: Floats, first: int, last: int, out: Floats) -> None:
    """Solve the pull-off alone of the scenes `first` to `last` - 1 of one exponent."""
    task, scenes, reduced, out = borrowed((task, scenes, reduced, out))
    table = task.by_load
    for i in range(first, last):
        curve = Curve(table, reduced[BY_POWER, i], reduced[BY_WAVES, i], 0.0, 1.0)
        put_force(lowest_load(curve, reduced[RIM_Y, i], 0, table.bins), reduced, i, out)


def _lowest(nodes: Floats, crest: float) -> float:
    """Return a bound below (U - U1)/(y E): that of the leading term, or 2 % more than the values near the centre."""
    near = nodes[:, GEOMETRIC - 20 : GEOMETRIC + 512]
    return min(crest, 1.02 * float(((near[U] - near[U1]) / (near[E] * near[Y])).min()))


def solve_far(
    punch: Punch,
    wanted: Wanted,
    form: int,
    finer: int,
    profile: Floats,
    scenes: Floats,
    reduced: Floats,
    out: Floats,
    most_bins: int = _MOST_BINS,
    solve: Callable[[Task, Floats, Floats, int, int, Floats], None] = solve_cycles,
) -> None:
    """Solve scenes of one exponent beyond near tables, on tables that are tripled where they prove too short.

    `solve` takes a task and scenes as `solve_cycles` does. Tables have `most_bins` bins at most.
    """
    k, most = float(scenes[K, 0]), (most_bins - GEOMETRIC) * width_of(punch.waves, finer)
    left, factor = np.arange(scenes.shape[1]), 1.0
    while left.size:
        need = np.minimum(reduced[NEED, left] * factor, reduced[RIM_Y, left] * 1.01)
        possible = need[need <= most]
        y_end = float(possible.max()) if possible.size else most
        table, _, crest = long_table(punch, k, form, finer, y_end)
        pull = table if form == EXACT else long_table(punch, k, BY_LOAD, finer, y_end)[0]
        disc = disc_of(k, punch.exponent, depth_factor_of(k, punch.exponent), punch.waves, profile)
        rooms = rooms_for(table.bins, punch.rows.shape[1] > 0)
        # those that reach beyond all tables are left for the last, lest they take others of their curve along
        reach = most if possible.size else math.inf
        task = Task(punch, wanted, table, pull, crest, disc, rooms, reach)
        chosen, own = np.ascontiguousarray(scenes[:, left]), np.ascontiguousarray(reduced[:, left])
        found = np.full((len(out), left.size), np.nan)
        solve(task, chosen, own, 0, left.size, found)
        out[:, left] = found
        left = left[found[STATUS] == SHORT]
        factor *= 3.0
        if factor > _LONGEST or y_end >= most:
            break
    out[STATUS, left] = NO_VALUE | TOO_MANY_WAVES


_waves: OrderedDict[tuple[object, ...], Waves] = OrderedDict()


def _long_of(punch: Punch, wanted: Wanted, k: float, form: int, profile: Floats, most: int) -> tuple[Task, Long]:
    """Return what scenes of an exponent are summed with, up to a number of waves."""
    near = NEAR + 3.0
    if punch.exponent - 1.0 < 0.5 * (1.0 - k):  # folds may begin far out
        near = _WALKED_BINS / (PER_WAVE * float(punch.waves[:, 0].max()))
    table, source, crest = long_table(punch, k, form, 1, 2.0 * math.pi * near, exactly=True)
    key = (punch.exponent, punch.waves.tobytes(), k, form)
    with _lock:
        waves = _waves.pop(key, None)
        if waves is None or most + 8 > reach_of(waves):
            waves = waves_of(table, source, crest, crests_of(k, punch.waves)[2], most + 8.0)
        _waves[key] = waves
        while len(_waves) > 1 and sum(own.values.nbytes for own in _waves.values()) > _KEPT_WAVES:
            _waves.popitem(last=False)
    disc = disc_of(k, punch.exponent, depth_factor_of(k, punch.exponent), punch.waves, profile)
    task = Task(punch, wanted, table, table, crest, disc, rooms_for(0, patterned=False), math.inf)
    spaces = (space_for(bins) for bins in (table.bins, 2 * waves.per, 3 * waves.per, 5 * waves.per))
    return task, Long(table, waves, NEAR, most, disc, wanted.contact, *spaces)


def _walked(punch: Punch, wanted: Wanted) -> float:
    """Return the radius up to which scenes are walked, beyond which they are summed: inf for those that cannot be."""
    per = PER_WAVE * float(punch.waves[:, 0].max())
    if punch.rows.shape[1] > 0 or per > _BINS_OF_A_WAVE:
        return math.inf
    waves, bins = (_WALKED_WITH_WORK, _MOST_BINS - 2 * GEOMETRIC) if wanted.residual else (_WALKED, _WALKED_BINS)
    return 2.0 * math.pi * min(waves, max(bins / per, 64.0))


def _sum(
    punch: Punch, wanted: Wanted, form: int, profile: Floats, scenes: Floats, reduced: Floats, out: Floats
) -> None:
    """Solve scenes of one exponent that have more waves than are walked; others are left as SHORT."""
    out[STATUS] = SHORT
    walked = _walked(punch, wanted)
    far = np.flatnonzero(reduced[NEED] > walked)
    if not far.size:
        return
    chosen, own = np.ascontiguousarray(scenes[:, far]), np.ascontiguousarray(reduced[:, far])
    found = np.empty((RESULT_ROWS, far.size))
    k, reach = float(scenes[K, 0]), own[NEED]
    if punch.turn != AT_RIM:  # a jump may pass where a cycle turns
        reach = np.minimum(np.fmax(reach, own[WINDOW]), own[RIM_Y])
    most = int(min(reach.max() / (2.0 * math.pi) + 3.0, MOST + 8.0))
    task, long = _long_of(punch, wanted, k, form, profile, most)
    pull = long
    if form != EXACT:
        by_load, pull = _long_of(punch, wanted, k, BY_LOAD, profile, most)
        task = task._replace(by_load=by_load.table)
    walkable = (_MOST_BINS - 2 * GEOMETRIC) * width_of(punch.waves)
    solve_long(task, long, pull, chosen, own, walkable, found)
    left = np.flatnonzero(found[STATUS] == SHORT)
    if left.size:
        rest = np.full((RESULT_ROWS, left.size), np.nan)
        again, numbers = np.ascontiguousarray(chosen[:, left]), np.ascontiguousarray(own[:, left])
        solve_far(punch, wanted._replace(saturation=False), form, 1, profile, again, numbers, rest)
        found[:, left] = rest
    if wanted.saturation:
        fill_saturation(task, long, own, found)
    out[:, far] = found


def _finer_bins(punch: Punch, scenes: Floats, least: Floats) -> Integers:
    """Return by which power of 2 the bins of each scene must be narrower than those of its profile."""
    if punch.rows.shape[1] == 0:
        return np.ones(scenes.shape[1], dtype=np.int64)
    per = bins_of_wave(punch.rows, scenes[PATTERN_AMPLITUDE], punch.of_work, least)
    with np.errstate(all="ignore"):
        ratio = per * scenes[WAVELENGTH] / scenes[PATTERN_WAVELENGTH] / (PER_WAVE * punch.waves[:, 0].max())
        ratio[~(scenes[PATTERN_WAVELENGTH] > 0.0)] = 1.0
        return 2 ** np.clip(np.nan_to_num(np.ceil(np.log2(ratio))), 0, 30).astype(np.int64)


def prepared(punch: Punch, form: int, scenes: Floats) -> tuple[Floats, Integers]:
    """Return the reduced numbers of scenes, (REDUCED_ROWS, scenes), and by how much their bins are to be narrower.

    The latter are of one item, or one a scene.
    """
    most, steep = np.ones(scenes.shape[1]), np.zeros(scenes.shape[1])
    finer = np.ones(1, dtype=np.int64)
    if punch.rows.shape[1] > 0:
        with np.errstate(all="ignore"):
            reach = scenes[RIM] / scenes[PATTERN_WAVELENGTH]
            least, most, steep = bounds_of(punch.rows, scenes[PATTERN_AMPLITUDE], punch.of_work, reach)
            steep = steep * scenes[WAVELENGTH] / scenes[PATTERN_WAVELENGTH]
        allowed = (least > 0.0) if punch.of_work else (least >= -1e-14)
        most = np.where(allowed, most, np.nan)
        finer = _finer_bins(punch, scenes, least)
    return reduced_of(punch, near_basis(punch, form, scenes), scenes, most, steep), finer


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
    if not is_interpolated(punch.waves) and (scenes[K] != scenes[K, 0]).any():
        begins = np.flatnonzero(np.diff(scenes[K]) != 0.0) + 1
        parts = [
            in_groups(punch, form, np.ascontiguousarray(own), rows, near, far, whole=whole, pull_off=pull_off)
            for own in np.split(scenes, begins, axis=1)
        ]
        return np.hstack([out for out, _ in parts]), np.hstack([reduced for _, reduced in parts])
    out = np.full((rows, scenes.shape[1]), np.nan)
    reduced, finer = prepared(punch, form, scenes)
    if whole:
        reduced[NEED] = np.fmax(reduced[NEED], reduced[WINDOW])
    if pull_off:
        reduced[NEED] = np.fmin(reduced[PULL], reduced[RIM_Y])

    def put(solve: Group, value: int, chosen: Integers) -> None:
        """Solve chosen scenes."""
        own, numbers = (np.ascontiguousarray(array[:, chosen]) for array in (scenes, reduced))
        found = np.full((rows, own.shape[1]), np.nan)
        solve(value, own, numbers, found)
        out[:, chosen] = found

    if (finer == finer[0]).all() and finer[0] <= FINEST:
        near(int(finer[0]), scenes, reduced, out)
    else:
        out[STATUS, finer > FINEST] = NO_VALUE | TOO_MANY_WAVES
        for value in np.unique(finer[finer <= FINEST]):
            put(near, int(value), np.flatnonzero(finer == value))
    short = np.flatnonzero(out[STATUS] == SHORT)
    finer = np.broadcast_to(finer, scenes.shape[1])
    for value in np.unique(finer[short]):
        for k in np.unique(scenes[K, short]):
            index = short[(scenes[K, short] == k) & (finer[short] == value)]
            if index.size:
                put(far, int(value), index)
    return out, reduced


def _solve_task(punch: Punch, wanted: Wanted, form: int, profile: Floats, scenes: Floats) -> Floats:
    """Return the results of scenes in the order of their exponents, of one thread."""
    if wanted.saturation:  # folds beyond the rim are looked for apart, so that asking for them changes no value
        out = _solve_task(punch, wanted._replace(saturation=False), form, profile, scenes)
        alone = Wanted(cycle=True, depth=False, contact=False, residual=False, saturation=True)
        whole, _ = _in_groups(punch, alone, form, profile, scenes)
        too_many = whole[STATUS].astype(np.int64) & TOO_MANY_WAVES
        failed = (out[STATUS].astype(np.int64) & NO_VALUE) > 0
        out[SATURATION] = np.where(failed | (too_many > 0), np.nan, whole[SATURATION])
        out[STATUS] = out[STATUS].astype(np.int64) | too_many
        return out
    out, reduced = _in_groups(punch, wanted, form, profile, scenes)
    if wanted.depth:
        far_rims(punch, width_of(punch.waves), form, scenes, reduced, out)
    return out


def _in_groups(punch: Punch, wanted: Wanted, form: int, profile: Floats, scenes: Floats) -> tuple[Floats, Floats]:
    """Return results and reduced numbers of scenes, as `in_groups`, but for depths at rims beyond their tables."""
    patterned = punch.rows.shape[1] > 0
    cycles = wanted.cycle or punch.turn != AT_RIM or patterned

    def near(finer: int, own: Floats, reduced: Floats, out: Floats) -> None:
        """Solve near scenes."""
        _solve_near(punch, wanted, form, finer, profile, own, reduced, out)

    def far(finer: int, own: Floats, reduced: Floats, out: Floats) -> None:
        """Solve others."""
        _sum(punch, wanted, form, profile, own, reduced, out)
        left = np.flatnonzero(out[STATUS] == SHORT)
        if left.size:
            rest = np.full((RESULT_ROWS, left.size), np.nan)
            numbers = np.ascontiguousarray(reduced[:, left])
            solve = solve_cycles if cycles else far_forces
            solve_far(punch, wanted, form, finer, profile, own[:, left], numbers, rest, _MOST_BINS, solve)
            out[:, left] = rest

    pull_off = patterned and punch.turn == AT_RIM and not wanted.cycle
    return in_groups(punch, form, scenes, RESULT_ROWS, near, far, whole=wanted.saturation, pull_off=pull_off)


class Request(NamedTuple):
    """What a call asks for: the parameters of its scenes, and what all of them share, as `Punch` has it.

    arrays      an array for each row of parameters (reduced.py), all broadcastable
    pattern     the harmonics of the pattern of toughness, rows (n, cos, sin)
    """

    arrays: list[Floats]
    exponent: float
    waves: Floats
    control: int
    turn: int
    pattern: Floats
    of_work: bool


def punch_of(request: Request) -> Punch:
    """Return what the scenes of a request share."""
    rows = rows_by_number(request.pattern)
    return Punch(request.exponent, request.waves, request.control, request.turn, rows, request.of_work)


def columns_of(request: Request) -> tuple[list[Floats], int]:
    """Return each row of parameters, of one item or one a scene, and the number of scenes."""
    shape = np.broadcast_shapes(*(array.shape for array in request.arrays))
    columns = [a.reshape(1) if a.size == 1 else np.broadcast_to(a, shape).reshape(-1) for a in request.arrays]
    return columns, math.prod(shape)


def scenes_of(columns: list[Floats], first: int, last: int) -> Floats:
    """Return the parameters of the scenes `first` to `last` - 1, (PARAMETER_ROWS, scenes)."""
    scenes = np.empty((len(columns), last - first))
    for row, column in enumerate(columns):
        scenes[row] = column if column.size == 1 else column[first:last]
    return scenes


def set_lengths(punch: Punch, scenes: Floats) -> None:
    """Give smooth punches on a pattern its wavelength, where that is shorter: another has no meaning for them."""
    if punch.rows.shape[1] > 0:
        smooth = (scenes[AMPLITUDE] == 0.0) & (scenes[PATTERN_WAVELENGTH] < scenes[WAVELENGTH])
        smooth &= scenes[WAVELENGTH] < np.inf  # which is out of range
        scenes[WAVELENGTH, smooth] = scenes[PATTERN_WAVELENGTH, smooth]


def run_parts(count: int, work: Callable[[int, int], None], threads: int | None) -> None:
    """Do the work on parts of `count` scenes, first to last, on threads that each take the next part."""
    workers = 1 if count < 2 * _SCENES else min(threads or processors(), -(-count // _SCENES))
    size = max(_SCENES, min(_MOST_SCENES, -(-count // (4 * workers)))) if workers > 1 else _MOST_SCENES
    parts = [(first, min(first + size, count)) for first in range(0, count, size)]
    if workers < 2:
        for part in parts:
            work(*part)
        return
    with ThreadPoolExecutor(workers) as pool:
        list(pool.map(lambda part: work(*part), parts))


def solve_all(
    request: Request, wanted: Wanted, form: int, rows: list[int], threads: int | None
) -> tuple[Floats, NDArray[np.int16]]:
    """Return the chosen rows of results, (rows, scenes), and the status of all scenes."""
    punch, profile = punch_of(request), profile_of(request.waves)
    columns, count = columns_of(request)
    out, status = np.empty((len(rows), count)), np.empty(count, dtype=np.int16)

    def work(first: int, last: int) -> None:
        """Solve a part of the scenes, in the order of their exponents."""
        scenes = scenes_of(columns, first, last)
        set_lengths(punch, scenes)
        order = np.argsort(scenes[K], kind="stable")
        found = _solve_task(punch, wanted, form, profile, np.ascontiguousarray(scenes[:, order]))
        for row, wanted_row in enumerate(rows):
            out[row, first + order] = found[wanted_row]
        status[first + order] = found[STATUS]

    run_parts(count, work, threads)
    return out, status
