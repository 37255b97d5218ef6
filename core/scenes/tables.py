"""What scenes are solved with: tables kept between calls, near ones of any exponent and long ones of one, and room.

Near scenes, within 64 of the shortest waves, are solved on bins interpolated in k (table/basis.py), the others on
longer tables of their exponent. Which one it is depends on the scene alone.
"""

import math
import threading
from collections import OrderedDict
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.curve.trace import room_for
from gradhesion.core.cycle.disc import RULE, Disc, disc_of
from gradhesion.core.jit import kernel
from gradhesion.core.problem.status import NO_VALUE, TOO_MANY_WAVES
from gradhesion.core.scenes import rows as at
from gradhesion.core.scenes.reduced import Punch, depth_factor_of
from gradhesion.core.scenes.requests import Wanted
from gradhesion.core.table.basis import Basis, Kept, basis_of, between, is_interpolated, kept_for, kept_table, room_of
from gradhesion.core.table.filling import fill_bins, fill_bounds, source_of, width_of
from gradhesion.core.table.layout import BY_LOAD, EXACT, FIRST, GEOMETRIC, LANES, U1, E, Source, Table, U, Y, span_of
from gradhesion.core.table.leading import crests_of
from gradhesion.core.types import Floats, Integers

MOST_BINS: Final = 130_000
"""Bins of a table, at most: 76 MB."""
_KEPT_BINS: Final = 260_000
"""Bins of all long tables that are kept between calls."""
_LONGEST: Final = 30.0
"""By which a table may be longer than what was asked for at first."""
_KEPT: Final = 14
"""Punches of which near tables are kept: the bins of patterns have up to 13 widths."""
_LENT: Final = 4
"""Threads for which those of a punch are kept between calls."""


class Rooms(NamedTuple):
    """Room for the curves of one task, so that little is allocated in its loops.

    traces      of closing, of opening, and of what is measured for the turn, (3, ROWS, branches)
    columns     those that loading visits, and a stack of unloading, (2, branches)
    nodes       of the tables of closing and of opening of interfaces with a pattern, (2, ROWS, bins + 1)
    polys       their polynomials, (2, bins, LANES + 1, N)
    limits      those of `loading_is_one_disc` of the last curve, (2,)
    weights     of the rule of `Task.disc`, (RULE,)
    """

    traces: Floats
    columns: Integers
    nodes: Floats
    polys: Floats
    limits: Floats
    weights: Floats


def rooms_for(bins: int, patterned: bool) -> Rooms:
    """Return room for tables of that many bins."""
    nodes, polys = room_of(bins if patterned else 0, LANES + 1)
    traces = np.empty((3, *room_for(bins).shape))
    columns = np.empty((2, traces.shape[2]), dtype=np.int64)
    return Rooms(traces, columns, np.stack((nodes, nodes)), np.stack((polys, polys)), np.empty(2), np.empty(RULE))


class Task(NamedTuple):
    """What scenes of one exponent are solved with.

    punch     what all scenes share
    wanted    what is wanted of them
    table     without pattern
    by_load   the table of the pull-off: the same, but for the leading terms of short waves
    crest     a bound of -U' y^((k-1)/2) beyond the table
    disc      what the tests of the contact need
    rooms     room
    reach     scenes that must be known beyond it are left as SHORT
    """

    punch: Punch
    wanted: Wanted
    table: Table
    by_load: Table
    crest: float
    disc: Disc
    rooms: Rooms
    reach: float


@kernel
def end_of_exponent(scenes: Floats, first: int) -> int:
    """Return the end of the scenes that share the exponent of the first one."""
    last = first + 1
    while last < scenes.shape[1] and scenes[at.K, last] == scenes[at.K, first]:
        last += 1
    return last


class Tables(NamedTuple):
    """What scenes are solved on: near ones on kept tables, which are filled as they need, others on a long table.

    basis, kept     of the cycle, and its tables
    by_load, kept_by_load   of the pull-off: the same but for the leading terms of short waves
    long, long_by_load      the long tables of the two, of one exponent; without bins, if scenes are near
    crest           a bound of -U' y^((k-1)/2) beyond them
    reach           scenes that must be known beyond it are left as SHORT
    rooms           for curves
    """

    basis: Basis
    kept: Kept
    by_load: Basis
    kept_by_load: Kept
    long: Table
    long_by_load: Table
    crest: float
    reach: float
    rooms: Rooms


@kernel
def task_of(
    punch: Punch,
    wanted: Wanted,
    tables: Tables,
    profile: Floats,
    scenes: Floats,
    reduced: Floats,
    first: int,
    last: int,
) -> Task:
    """Return what the scenes `first` to `last` - 1, of one exponent, are solved with, tables filled as they need."""
    k, table, pull, crest = scenes[at.K, first], tables.long, tables.long_by_load, tables.crest
    if table.bins == 0:
        basis, far = tables.basis, 0.0
        for i in range(first, last):
            if reduced[at.NEED, i] <= tables.reach:
                far = max(far, reduced[at.NEED, i])
        if not (far > 0.0 and 0.0 <= k <= 1.0):
            k = 0.5  # none can be solved here
        most = basis.values.shape[0] - 1
        bins = min(GEOMETRIC + max(16, int((far - basis.start) / basis.width) + 2), most)
        pull = table = kept_table(basis, tables.kept, k, bins)
        if tables.by_load.form != basis.form:
            pull = kept_table(tables.by_load, tables.kept_by_load, k, bins)
        low, high = between(basis, k)
        crest = 1.01 * max(basis.crest[low], basis.crest[high])
    disc = disc_of(k, punch.exponent, depth_factor_of(k, punch.exponent), punch.waves, profile, tables.rooms.weights)
    return Task(punch, wanted, table, pull, crest, disc, tables.rooms, tables.reach)


def own_exponent(punch: Punch, scenes: Floats) -> float:
    """Return the exponent that scenes of a long series share, whose bins are not interpolated; NaN for others."""
    if is_interpolated(punch.waves):
        return math.nan
    return float(scenes[at.K, 0]) if 0.0 <= scenes[at.K, 0] <= 1.0 else 0.5  # no value: any will do


def _new_near_tables(punch: Punch, form: int, finer: int, k: float) -> Tables:
    """Return the tables of `near_tables` for a thread that finds none."""
    basis = basis_of(punch.exponent, punch.waves, form, finer, k)
    by_load = basis if form == EXACT else basis_of(punch.exponent, punch.waves, BY_LOAD, finer, k)
    kept = kept_for(basis)
    bins = basis.values.shape[0] - 1
    reach = basis.start + (bins - 2 - GEOMETRIC) * basis.width
    none = Table(0.5, punch.exponent, 0.5, basis.start, basis.width, 0.0, GEOMETRIC, 0, *room_of(0))
    rooms = rooms_for(bins, punch.rows.shape[1] > 0)
    pulls = kept if by_load is basis else kept_for(by_load)
    return Tables(basis, kept, by_load, pulls, none, none, 0.0, reach, rooms)


_lock = threading.Lock()
_free: OrderedDict[tuple[object, ...], list[Tables]] = OrderedDict()
"""Near tables of the last punches that no thread uses."""
_long: OrderedDict[tuple[object, ...], tuple[Table, Source, float]] = OrderedDict()
"""Long tables of the last calls, with their sources and bounds."""


@contextmanager
def near_tables(punch: Punch, form: int, finer: int, k: float) -> Iterator[Tables]:
    """Lend a thread the tables of near scenes of one fineness of bins, and of one exponent if k is a number.

    There are no long tables among them. What is filled stays filled between calls.
    """
    patterned = punch.rows.shape[1] > 0
    key = (punch.exponent, punch.waves.tobytes(), form, finer, k if k >= 0.0 else None, patterned)
    with _lock:
        free = _free.setdefault(key, [])
        _free.move_to_end(key)
        while len(_free) > _KEPT:
            _free.popitem(last=False)
        tables = free.pop() if free else None
    if tables is None:
        tables = _new_near_tables(punch, form, finer, k)
    yield tables
    with _lock:
        if len(free) < _LENT:
            free.append(tables)


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
        if key in _long and span_of(_long[key][0]) >= y_end:
            _long.move_to_end(key)
            return _long[key]
        crest, wave, cut = crests_of(k, punch.waves)
        source = source_of(k, punch.exponent, punch.waves, width, cut / width % 1.0, form)
        bins = GEOMETRIC + max(16, int((y_end - source.start) / width) + 10)
        nodes, polys = room_of(bins)
        fill_bins(source, FIRST, GEOMETRIC, bins, nodes, polys)
        lowest = _lowest(nodes, -wave)
        share = (1.0 + k) / (1.0 + k + punch.exponent)
        table = Table(k, punch.exponent, share, source.start, width, lowest, GEOMETRIC, bins, nodes, polys)
        fill_bounds(table, crest)
        _long.pop(key, None)
        _long[key] = table, source, crest
        while len(_long) > 1 and sum(table.bins for table, _, _ in _long.values()) > _KEPT_BINS:
            _long.popitem(last=False)
        return _long[key]


def _lowest(nodes: Floats, crest: float) -> float:
    """Return a bound below (U - U1)/(y E): that of the leading term, or 2 % more than the values near the centre."""
    near = nodes[:, GEOMETRIC - 20 : GEOMETRIC + 512]
    return min(crest, 1.02 * float(((near[U] - near[U1]) / (near[E] * near[Y])).min()))


def solve_far(
    punch: Punch,
    form: int,
    finer: int,
    scenes: Floats,
    reduced: Floats,
    out: Floats,
    solve: Callable[[Tables, Floats, Floats, Floats], None],
    most_bins: int,
) -> None:
    """Solve scenes of one exponent beyond near tables, on tables that are tripled where they prove too short.

    `solve` takes tables, scenes, their reduced numbers and room for results. Tables have `most_bins` bins at most.
    """
    k, most = float(scenes[at.K, 0]), (most_bins - GEOMETRIC) * width_of(punch.waves, finer)
    left, factor = np.arange(scenes.shape[1]), 1.0
    while left.size:
        with np.errstate(over="ignore"):  # what is endless stays so
            need = np.minimum(reduced[at.NEED, left] * factor, reduced[at.RIM_Y, left] * 1.01)
        possible = need[need <= most]
        y_end = float(possible.max()) if possible.size else most
        table, _, crest = long_table(punch, k, form, finer, y_end)
        pull = table if form == EXACT else long_table(punch, k, BY_LOAD, finer, y_end)[0]
        # those that reach beyond all tables are left for the last, lest they take others of their curve along
        reach = most if possible.size else math.inf
        rooms = rooms_for(table.bins, punch.rows.shape[1] > 0)
        chosen, own = np.ascontiguousarray(scenes[:, left]), np.ascontiguousarray(reduced[:, left])
        found = np.full((len(out), left.size), np.nan)
        with near_tables(punch, form, finer, own_exponent(punch, scenes)) as tables:
            tables = tables._replace(long=table, long_by_load=pull, crest=crest, reach=reach, rooms=rooms)
            solve(tables, chosen, own, found)
        out[:, left] = found
        left = left[found[at.STATUS] == at.SHORT]
        factor *= 3.0
        if factor > _LONGEST or y_end >= most:
            break
    out[at.STATUS, left] = NO_VALUE | TOO_MANY_WAVES
