"""Scenes in the order of their exponents, cut into tasks for threads, on tables that reach as far as they must.

Near ones, within 64 of the shortest waves, are solved on bins interpolated in k (table/basis.py), the others on longer
tables of their exponent. Which one it is depends on the scene alone.
"""

import math
import threading
from collections import OrderedDict
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.cycle.disc import disc_of, profile_of
from gradhesion.core.cycle.long import MOST, NEAR, Long, space_for
from gradhesion.core.cycle.pull_off import ALL, Filling
from gradhesion.core.cycle.waves import Waves, reach_of, waves_of
from gradhesion.core.edge.pattern import bins_of_wave, bounds_of, rows_by_number
from gradhesion.core.jit import kernel
from gradhesion.core.problem.status import NO_VALUE, TOO_MANY_WAVES
from gradhesion.core.processors import processors
from gradhesion.core.scenes.cycles import Task, solve_cycles, solve_forces
from gradhesion.core.scenes.long import solve_long
from gradhesion.core.scenes.reduced import (
    AT_RIM,
    NEED,
    PATTERN_AMPLITUDE,
    PATTERN_WAVELENGTH,
    RIM_Y,
    WAVELENGTH,
    WINDOW,
    K,
    Punch,
    depth_factor_of,
    reduced_of,
)
from gradhesion.core.scenes.results import RESULT_ROWS, SHORT, STATUS, Rooms, Wanted, rooms_for
from gradhesion.core.table.basis import (
    NODES,
    Basis,
    basis_of,
    between,
    empty_table,
    fill_table,
    fill_weights,
    room_of,
)
from gradhesion.core.table.filling import fill_bins, source_of, width_of, with_bounds
from gradhesion.core.table.layout import BY_DEPTH, BY_LOAD, EXACT, FIRST, GEOMETRIC, PER_WAVE, Source, Table, end_of
from gradhesion.core.table.leading import crests_of
from gradhesion.core.types import Floats, Integers

_MOST_BINS: Final = 130_000
"""Bins of a table, at most: 76 MB."""
_KEPT_BINS: Final = 260_000
"""Bins of all long tables that are kept between calls."""
_WALKED: Final = 300
"""Waves that are walked; scenes of more are summed."""
_WALKED_BINS: Final = 40_000
"""Bins that are walked at most, where waves have many: 23 MB."""
_BINS_OF_A_WAVE: Final = 1024
"""Bins of a wave at most, where waves are summed: 5 MB for each doubling of their number."""
_KEPT_WAVES: Final = 64e6
"""Bytes of all waves (cycle/waves.py) that are kept between calls."""
_SCENES: Final = 1024
"""Scenes of a part, at least: a millisecond or more."""
_MOST_SCENES: Final = 32768
"""And at most: some megabytes."""


@kernel
def source_for(punch: Punch, basis: Basis, k: float, needed: bool) -> Source:
    """Return what is needed of an exponent at rims beyond a near table: its functions; of any exponent if it is not."""
    no_waves = np.zeros((0, 3))
    return source_of(k if needed else 0.5, punch.exponent, punch.waves if needed else no_waves, basis.width, 0.0, EXACT)


@kernel
def near_forces(
    punch: Punch,
    wanted: Wanted,
    basis: Basis,
    profile: Floats,
    rooms: Rooms,
    nodes: Floats,
    polys: Floats,
    scenes: Floats,
    reduced: Floats,
    out: Floats,
) -> None:
    """Solve the pull-off of scenes in the order of their exponents; bins are filled where the search arrives."""
    weights, filled = np.zeros(NODES), np.zeros(2, np.int64)
    source, disc = source_for(punch, basis, 0.5, False), disc_of(0.5, 2.0, 1.0, punch.waves, profile)
    first = 0
    while first < scenes.shape[1]:
        k, last = scenes[K, first], first + 1
        while last < scenes.shape[1] and scenes[K, last] == k:
            last += 1
        filled[:] = 0
        fill_weights(basis.k, k, weights)
        table = empty_table(basis, k, nodes, polys)
        filling = Filling(basis, weights, filled)
        task = Task(punch, wanted, table, table, 0.0, source, disc, filling, rooms, math.inf)
        solve_forces(task, scenes, reduced, first, last, out)
        first = last


@kernel
def near_cycles(
    punch: Punch,
    wanted: Wanted,
    basis: Basis,
    by_load: Basis,
    profile: Floats,
    rooms: Rooms,
    nodes: Floats,
    polys: Floats,
    load_nodes: Floats,
    load_polys: Floats,
    scenes: Floats,
    reduced: Floats,
    out: Floats,
) -> None:
    """Solve the cycles of scenes in the order of their exponents; those that reach beyond the basis are left as SHORT.

    `by_load` is the basis of the pull-off, which is that of the cycle but for the leading terms of short waves.
    """
    weights, filled = np.zeros(NODES), np.array([ALL, ALL])
    reach = basis.start + (basis.values.shape[0] - 3 - GEOMETRIC) * basis.width
    first = 0
    while first < scenes.shape[1]:
        k, last = scenes[K, first], first + 1
        while last < scenes.shape[1] and scenes[K, last] == k:
            last += 1
        far, at_far_rim = 0.0, False
        for i in range(first, last):
            if reduced[NEED, i] <= reach:
                far = max(far, reduced[NEED, i])
                at_far_rim = at_far_rim or (wanted.depth and reduced[NEED, i] < reduced[RIM_Y, i] < math.inf)
        if not (far > 0.0 and 0.0 <= k <= 1.0):
            k = 0.5  # none can be solved here
        bins = GEOMETRIC + max(16, int((far - basis.start) / basis.width) + 2)
        table = fill_table(basis, k, weights, min(bins, basis.values.shape[0] - 1), nodes, polys)
        pull = table
        if load_nodes.shape[1] > 1:
            pull = fill_table(by_load, k, weights, table.bins, load_nodes, load_polys)
        source = source_for(punch, basis, k, at_far_rim)
        node = between(basis, k)
        crest = 1.01 * max(basis.crest[node], basis.crest[node + 1])
        disc = disc_of(k, punch.exponent, depth_factor_of(k, punch.exponent), punch.waves, profile)
        task = Task(punch, wanted, table, pull, crest, source, disc, Filling(basis, weights, filled), rooms, reach)
        solve_cycles(task, scenes, reduced, first, last, out)
        first = last


def _solve_near(
    punch: Punch, wanted: Wanted, form: int, finer: int, profile: Floats, scenes: Floats, reduced: Floats, out: Floats
) -> None:
    """Solve near scenes of one fineness of bins."""
    basis = basis_of(punch.exponent, punch.waves, EXACT if form == EXACT else BY_DEPTH, finer)
    patterned = punch.rows.shape[1] > 0
    bins = basis.values.shape[0] - 1
    plain = punch.turn == AT_RIM and not patterned
    if not wanted.cycle and plain:
        pull = basis if form == EXACT else basis_of(punch.exponent, punch.waves, BY_LOAD, finer)
        near_forces(punch, wanted, pull, profile, rooms_for(1, patterned=False), *room_of(bins), scenes, reduced, out)
        return
    by_load = basis if form == EXACT else basis_of(punch.exponent, punch.waves, BY_LOAD, finer)
    second = room_of(0 if form == EXACT else bins)
    near_cycles(
        punch,
        wanted,
        basis,
        by_load,
        profile,
        rooms_for(bins, patterned),
        *room_of(bins),
        *second,
        scenes,
        reduced,
        out,
    )


_tables: OrderedDict[tuple[object, ...], tuple[Table, Source, float]] = OrderedDict()
_lock = threading.Lock()


def long_table(punch: Punch, k: float, form: int, finer: int, y_end: float) -> tuple[Table, Source, float]:
    """Return a table of one exponent to y_end or beyond, what its bins are filled from, and the crest of -U'.

    One of the last few, if it is long enough.
    """
    width = width_of(punch.waves, finer)
    key = (punch.exponent, punch.waves.tobytes(), k, form, finer)
    with _lock:
        if key in _tables and end_of.py_func(_tables[key][0]) >= y_end:
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


def _lowest(nodes: Floats, crest: float) -> float:
    """Return a bound below (U - U1)/(y E): that of the leading term, or 2 % more than the values near the centre."""
    from gradhesion.core.table.layout import U1, E, U, Y  # noqa: PLC0415

    near = nodes[:, GEOMETRIC - 20 : GEOMETRIC + 512]
    return min(crest, 1.02 * float(((near[U] - near[U1]) / (near[E] * near[Y])).min()))


_waves: OrderedDict[tuple[object, ...], Waves] = OrderedDict()


def _long_of(punch: Punch, wanted: Wanted, k: float, form: int, profile: Floats, most: int) -> tuple[Task, Long]:
    """Return what scenes of an exponent are summed with, up to a number of waves."""
    y_end = 2.0 * math.pi * (NEAR + 3)
    table, source, crest = long_table(punch, k, form, 1, y_end)
    key = (punch.exponent, punch.waves.tobytes(), k, form)
    with _lock:
        waves = _waves.pop(key, None)
        if waves is None or most + 8 > reach_of(waves):
            waves = waves_of(table, source, crest, crests_of(k, punch.waves)[2], most + 8.0)
        _waves[key] = waves
        while len(_waves) > 1 and sum(own.values.nbytes for own in _waves.values()) > _KEPT_WAVES:
            _waves.popitem(last=False)
    disc = disc_of(k, punch.exponent, depth_factor_of(k, punch.exponent), punch.waves, profile)
    filling = Filling(basis_of(punch.exponent, punch.waves, form, 1), np.zeros(NODES), np.array([ALL, ALL]))
    task = Task(punch, wanted, table, table, crest, source, disc, filling, rooms_for(8, patterned=False), math.inf)
    per = waves.per
    rooms = (space_for(bins) for bins in (table.bins, 2 * per, 3 * per, 5 * per))
    return task, Long(table, source, waves, NEAR, most, disc, wanted.contact, *rooms)


def _solve_long(
    punch: Punch, wanted: Wanted, form: int, profile: Floats, scenes: Floats, reduced: Floats, out: Floats
) -> None:
    """Solve scenes of one exponent, without pattern, that have more waves than are walked."""
    k = float(scenes[K, 0])
    far = reduced[NEED].max() if punch.turn == AT_RIM else np.minimum(np.fmax(reduced[NEED], reduced[WINDOW]), reduced[RIM_Y]).max()
    most = int(min(far / (2.0 * math.pi) + 3.0, MOST + 8.0))  # a jump may pass where a cycle turns
    task, long = _long_of(punch, wanted, k, EXACT if form == EXACT else BY_DEPTH, profile, most)
    pull = long
    if form != EXACT:
        by_load, pull = _long_of(punch, wanted, k, BY_LOAD, profile, most)
        task = task._replace(by_load=by_load.table)
    solve_long(task, long, pull, scenes, reduced, out)


def _may_be_summed(punch: Punch) -> bool:
    """Return whether scenes of many waves can be summed: not those with a pattern, or of a great many bins a wave."""
    return punch.rows.shape[1] == 0 and bool(PER_WAVE * punch.waves[:, 0].max() <= _BINS_OF_A_WAVE)


def _walked(punch: Punch) -> float:
    """Return the radius up to which scenes are walked that may be summed."""
    per = PER_WAVE * punch.waves[:, 0].max()
    return float(2.0 * math.pi * min(_WALKED, max(_WALKED_BINS / per, 64.0)))


def _solve_far(
    punch: Punch, wanted: Wanted, form: int, finer: int, profile: Floats, scenes: Floats, reduced: Floats, out: Floats
) -> None:
    """Solve scenes of one exponent that reach beyond near tables, on tables that are tripled where they prove too short."""
    k, most = float(scenes[K, 0]), (_MOST_BINS - GEOMETRIC) * width_of(punch.waves, finer)
    filling_basis = basis_of(punch.exponent, punch.waves, EXACT if form == EXACT else BY_DEPTH, finer)
    filling = Filling(filling_basis, np.zeros(NODES), np.array([ALL, ALL]))
    left, factor = np.arange(scenes.shape[1]), 1.0
    if _may_be_summed(punch):
        most = _walked(punch)
        far = np.flatnonzero(reduced[NEED] > most)
        if far.size:
            found = np.empty((RESULT_ROWS, far.size))
            chosen, own = np.ascontiguousarray(scenes[:, far]), np.ascontiguousarray(reduced[:, far])
            _solve_long(punch, wanted, form, profile, chosen, own, found)
            out[:, far] = found
            left = np.setdiff1d(left, far[found[STATUS] != SHORT])
            reduced[NEED] = np.minimum(reduced[NEED], most)  # what is left turns next to the centre
    while left.size:
        need = np.minimum(reduced[NEED, left] * factor, reduced[RIM_Y, left] * 1.01)
        possible = need[need <= most]
        if not possible.size and factor > 1.0:
            break
        y_end = float(possible.max()) if possible.size else most
        table, source, crest = long_table(punch, k, EXACT if form == EXACT else BY_DEPTH, finer, min(y_end, most))
        pull = table if form == EXACT else long_table(punch, k, BY_LOAD, finer, min(y_end, most))[0]
        disc = disc_of(k, punch.exponent, depth_factor_of(k, punch.exponent), punch.waves, profile)
        rooms = rooms_for(table.bins, punch.rows.shape[1] > 0)
        task = Task(punch, wanted, table, pull, crest, source, disc, filling, rooms, math.inf)
        chosen, own = np.ascontiguousarray(scenes[:, left]), np.ascontiguousarray(reduced[:, left])
        found = np.empty((RESULT_ROWS, left.size))
        solve = solve_cycles if wanted.cycle or punch.turn != AT_RIM or punch.rows.shape[1] else solve_forces
        solve(task, chosen, own, 0, left.size, found)
        out[:, left] = found
        left = left[found[STATUS] == SHORT]
        factor *= 3.0
        if factor > 30.0 or y_end >= most:
            break
    out[STATUS, left] = NO_VALUE | TOO_MANY_WAVES


def _finer_bins(punch: Punch, scenes: Floats, least: Floats) -> Integers:
    """Return by which power of 2 the bins of each scene must be narrower than those of its profile."""
    if punch.rows.shape[1] == 0:
        return np.ones(scenes.shape[1], dtype=np.int64)
    per = bins_of_wave(punch.rows, scenes[PATTERN_AMPLITUDE], punch.of_work, least)
    ratio = per * scenes[WAVELENGTH] / scenes[PATTERN_WAVELENGTH] / (PER_WAVE * punch.waves[:, 0].max())
    with np.errstate(all="ignore"):
        return 2 ** np.clip(np.nan_to_num(np.ceil(np.log2(ratio))), 0, 12).astype(np.int64)


def _solve_task(punch: Punch, wanted: Wanted, form: int, profile: Floats, scenes: Floats) -> Floats:
    """Return the results of scenes in the order of their exponents, of one thread."""
    out = np.full((RESULT_ROWS, scenes.shape[1]), np.nan)
    most, steep = np.ones(scenes.shape[1]), np.zeros(scenes.shape[1])
    finer = np.ones(1, dtype=np.int64)
    if punch.rows.shape[1] > 0:
        least, most, steep = bounds_of(punch.rows, scenes[PATTERN_AMPLITUDE], punch.of_work)
        steep = steep * scenes[WAVELENGTH] / scenes[PATTERN_WAVELENGTH]
        allowed = (least > 0.0) if punch.of_work else (least >= -1e-14)
        most = np.where(allowed, most, np.nan)
        finer = _finer_bins(punch, scenes, least)
    basis = basis_of(punch.exponent, punch.waves, EXACT if form == EXACT else BY_DEPTH)
    reduced = reduced_of(punch, basis, scenes, most, steep)
    if wanted.saturation:  # all folds are needed, wherever the rim is
        reduced[NEED] = np.fmax(reduced[NEED], reduced[WINDOW])
    groups = (
        [(int(finer[0]), slice(None))]
        if (finer == finer[0]).all()
        else [(int(value), np.flatnonzero(finer == value)) for value in np.unique(finer)]
    )
    for value, chosen in groups:
        own = np.ascontiguousarray(scenes[:, chosen])
        found = np.empty((RESULT_ROWS, own.shape[1]))
        _solve_near(punch, wanted, form, value, profile, own, np.ascontiguousarray(reduced[:, chosen]), found)
        out[:, chosen] = found
    short = np.flatnonzero(out[STATUS] == SHORT)
    finer = np.broadcast_to(finer, scenes.shape[1])
    for value in np.unique(finer[short]):
        for k in np.unique(scenes[K, short]):
            index = short[(scenes[K, short] == k) & (finer[short] == value)]
            if index.size:
                found = np.empty((RESULT_ROWS, index.size))
                _solve_far(
                    punch,
                    wanted,
                    form,
                    int(value),
                    profile,
                    np.ascontiguousarray(scenes[:, index]),
                    np.ascontiguousarray(reduced[:, index]),
                    found,
                )
                out[:, index] = found
    return out


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


def run_parts(count: int, work: Callable[[int, int], None], threads: int | None) -> None:
    """Do the work on parts of `count` scenes, from a first one to a last one, on threads that each take the next part."""
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
        order = np.argsort(scenes[K], kind="stable")
        found = np.empty((RESULT_ROWS, last - first))
        found[:, order] = _solve_task(punch, wanted, form, profile, scenes[:, order])
        out[:, first:last], status[first:last] = found[rows], found[STATUS]

    run_parts(count, work, threads)
    return out, status
