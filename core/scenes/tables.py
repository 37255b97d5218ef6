"""What scenes are solved with: tables kept between calls, near ones of any exponent and long ones of one, and room.

Near scenes, within 64 of the shortest waves, are solved on bins interpolated in k (table/basis.py), the others on
longer tables of their exponent. Which one it is depends on the scene alone.
"""

import math
import threading
from collections import OrderedDict
from collections.abc import Callable
from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.curve.trace import room_for
from gradhesion.core.cycle.disc import RULE, Disc
from gradhesion.core.cycle.jumps import JUMP_ROWS
from gradhesion.core.jit import kernel
from gradhesion.core.scenes import rows as at
from gradhesion.core.scenes.reduced import Punch, disc_of
from gradhesion.core.scenes.requests import Wanted
from gradhesion.core.table.basis import (
    Basis,
    Kept,
    basis_of,
    between,
    is_interpolated,
    kept_for,
    kept_table,
    make_known,
    room_of,
)
from gradhesion.core.table.filling import fill_bins, fill_bounds, source_of, width_of
from gradhesion.core.table.layout import BY_LOAD, EXACT, FIRST, GEOMETRIC, LANES, U1, E, Source, Table, U, Y, span_of
from gradhesion.core.table.leading import crests_of
from gradhesion.core.types import Floats, Integers

MOST_BINS: Final = 130_000
"""Bins of a table, at most: 76 MB."""
_KEPT_BINS: Final = 260_000
"""Bins of all long tables that are kept between calls."""
_KEPT: Final = 28
"""Near tables that are kept, of up to 4 MB: the bins of patterns have up to 13 widths, and threads have their own."""


class Rooms(NamedTuple):
    """Room for the curves of one task, so that little is allocated in its loops.

    traces      of closing, of opening, and of what is measured for the turn, (3, ROWS, branches)
    columns     those that loading visits, and a stack of unloading, (2, branches)
    jumps       of one cycle (cycle/jumps.py): on each way one more than branches at most, (JUMP_ROWS, .)
    nodes       of the tables of closing and of opening of interfaces with a pattern, (2, ROWS, bins + 1)
    polys       their polynomials, (2, bins, LANES + 1, N)
    limits      those of `loading_is_one_disc` of the last curve, (2,)
    weights     of the rule of `Task.disc`, (RULE,)
    """

    traces: Floats
    columns: Integers
    jumps: Floats
    nodes: Floats
    polys: Floats
    limits: Floats
    weights: Floats


def rooms_for(bins: int, patterned: bool) -> Rooms:
    """Return room for tables of that many bins."""
    nodes, polys = room_of(bins if patterned else 0, LANES + 1)
    traces = np.empty((3, *room_for(bins).shape))
    columns, jumps = np.empty((2, traces.shape[2]), dtype=np.int64), np.empty((JUMP_ROWS, 2 * traces.shape[2]))
    two = np.stack((nodes, nodes)), np.stack((polys, polys))
    return Rooms(traces, columns, jumps, *two, np.empty(2), np.empty(RULE))


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
    finer           by how much their bins are narrower than those of a profile
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
    finer: int
    rooms: Rooms


@kernel
def task_of(
    punch: Punch, wanted: Wanted, tables: Tables, scenes: Floats, reduced: Floats, first: int, last: int
) -> Task:
    """Return what the scenes `first` to `last` - 1, of one exponent, are solved with, tables filled as they need."""
    k, table, pull, crest = scenes[at.K, first], tables.long, tables.long_by_load, tables.crest
    if table.bins == 0:
        basis, far = tables.basis, 0.0
        for i in range(first, last):
            if reduced[at.NEED, i] <= tables.reach:
                far = max(far, reduced[at.NEED, i])
        if not 0.0 <= k <= 1.0:
            k = 0.5  # none can be solved
        most = basis.values.shape[0] - 1
        bins = min(GEOMETRIC + max(16, int((far - basis.start) / basis.width) + 2), most)
        pull = table = kept_table(basis, tables.kept, k, bins)
        if tables.by_load.form != basis.form:
            pull = kept_table(tables.by_load, tables.kept_by_load, k, bins)
        low, high = between(basis, k)
        crest = 1.01 * max(basis.crest[low], basis.crest[high])
    disc = disc_of(punch, k, tables.rooms.weights)
    return Task(punch, wanted, table, pull, crest, disc, tables.rooms, tables.reach)


def solve_some(solve: Callable[..., None], chosen: Integers, scenes: Floats, reduced: Floats, out: Floats) -> None:
    """Solve chosen scenes: `solve` takes them, their reduced numbers, which it may change, and room for results."""
    if chosen.size == scenes.shape[1]:
        solve(scenes, reduced, out)
    elif chosen.size:
        own, numbers, found = (np.ascontiguousarray(array[:, chosen]) for array in (scenes, reduced, out))
        solve(own, numbers, found)
        reduced[:, chosen], out[:, chosen] = numbers, found


def ends_of_exponents(k: Floats) -> tuple[float, float]:
    """Return the least and the greatest of the exponents of scenes, which rise; 0 and 1 if one can have no value."""
    least, greatest = float(k[0]), float(k[-1])
    return (least, greatest) if least >= 0.0 and greatest <= 1.0 else (0.0, 1.0)


def own_exponent(punch: Punch, scenes: Floats) -> float | None:
    """Return the exponent that scenes of a long series share, whose bins are not interpolated; None for others."""
    if is_interpolated(punch.waves):
        return None
    return float(scenes[at.K, 0]) if 0.0 <= scenes[at.K, 0] <= 1.0 else 0.5  # no value: any will do


@lru_cache(maxsize=_KEPT)
def _tables_of_thread(
    _thread: int, exponent: float, waves: bytes, form: int, finer: int, k: float | None, patterned: bool
) -> Tables:
    """Return the tables of `near_tables` for a thread, harmonics as bytes."""
    rows = np.frombuffer(waves).reshape(-1, 3).copy()  # a read-only array is another type to kernels
    basis = basis_of(exponent, rows, form, finer, k)
    by_load = basis if form == EXACT else basis_of(exponent, rows, BY_LOAD, finer, k)
    kept = kept_for(basis)
    bins = basis.values.shape[0] - 1
    reach = basis.start + (bins - 2 - GEOMETRIC) * basis.width
    none = Table(0.5, exponent, 0.5, basis.start, basis.width, 0.0, GEOMETRIC, 0, *room_of(0))
    pulls = kept if by_load is basis else kept_for(by_load)
    return Tables(basis, kept, by_load, pulls, none, none, 0.0, reach, finer, rooms_for(bins, patterned))


def near_tables(punch: Punch, form: int, finer: int, scenes: Floats) -> Tables:
    """Return this thread's tables for near scenes of one fineness of bins, and of one exponent where a series is long.

    There are no long tables among them. What is filled stays filled between calls.
    """
    shape = punch.exponent, punch.waves.tobytes(), form, finer, own_exponent(punch, scenes), punch.rows.shape[1] > 0
    tables, ends = _tables_of_thread(threading.get_ident(), *shape), ends_of_exponents(scenes[at.K])
    make_known(tables.basis, *ends)
    if tables.by_load is not tables.basis:
        make_known(tables.by_load, *ends)
    return tables


_lock = threading.Lock()
_long: OrderedDict[tuple[object, ...], tuple[Table, Source, float]] = OrderedDict()
"""Long tables of the last calls, with their sources and bounds."""


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
        fill_bins(source, source.shift, FIRST, GEOMETRIC, bins, nodes, polys)
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
