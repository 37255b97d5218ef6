"""Derivatives of pull-off force and dissipated energy by the reduced numbers of scenes.

At frozen radii of its jumps (frozen.py) a difference over half of B or of g is exact; others are of fourth order, those
by k on tables of four neighbouring exponents. The turn is added by its own condition.
"""

import math
from typing import Final, NamedTuple, TypeAlias

import numpy as np

from gradhesion.core.curve.trace import END, LANDING
from gradhesion.core.curve.values import Curve, bin_of, load_curve
from gradhesion.core.cycle.jumps import LANDED, LEFT, list_loading_jumps, list_unloading_jumps
from gradhesion.core.cycle.path import visited_within
from gradhesion.core.cycle.pull_off import lowest_load
from gradhesion.core.edge.pattern import Pattern, toughness_at
from gradhesion.core.jit import kernel, leaf
from gradhesion.core.scenes import results
from gradhesion.core.scenes import rows as at
from gradhesion.core.scenes.cycles import Walked, curve_end, curves_of, pattern_of, walk_curve
from gradhesion.core.scenes.reduced import AT_RIM, MACHINE, Punch
from gradhesion.core.scenes.requests import Wanted
from gradhesion.core.scenes.tables import Rooms, Tables, Task, end_of_exponent, task_of
from gradhesion.core.slopes.frozen import (
    AREA,
    GAP,
    LOADING,
    PULL,
    UNLOADING,
    Frozen,
    loading_by_turn,
    measured_by,
    observe,
    rate_at,
    unloading_by_turn,
)
from gradhesion.core.table.basis import Basis, Kept, bounded_table, empty_place, fill_kept, table_in
from gradhesion.core.table.layout import Table, end_of
from gradhesion.core.types import Floats

# Rows of derivatives: d ln(value)/d ln of the reduced numbers B, g, by_load, waves and amplitude of the pattern, k (by
# itself, at fixed others), radius of the rim, target and ratio.
OF_POWER, OF_WAVES, OF_MACHINE, OF_PATTERN_WAVES, OF_PATTERN, OF_EXPONENT, OF_RIM, OF_TARGET, OF_RATIO = range(9)
ROWS: Final = 9
FORCE, ENERGY, ALL_ROWS = results.RESULT_ROWS, results.RESULT_ROWS + ROWS, results.RESULT_ROWS + 2 * ROWS
"""Where the rows of each value begin, behind those of results, of which TURN and STATUS are used; and all of them."""
STEP: Final = 2.0**-11
"""Of a difference of fourth order: it leaves step^4/30 of the fifth derivative, and of rounding eps/step."""
_PHASE_STEP: Final = 2.0**-9
"""The same for a pattern, in its phase."""
PLACES, _WEIGHTS = np.array([-2.0, -1.0, 1.0, 2.0]), np.array([1.0, -8.0, 8.0, -1.0]) / 12.0
_OF_HALVES: Final = np.array([0.0, -0.5, 0.5, 0.0])
_NUMBERS: Final = np.array([at.BY_POWER, at.BY_WAVES, at.BY_LOAD, at.PATTERN_WAVES, at.PATTERN_AMPLITUDE, at.K])
"""Where the numbers of the first rows stand, among reduced ones or (of the pattern's amplitude) parameters."""
FourTables: TypeAlias = tuple[Table, Table, Table, Table]
"""Of the exponents k + STEP PLACES."""


class Near(NamedTuple):
    """What neighbours of a scene are made from, and room that each scene overwrites.

    kept        near tables of the four neighbouring exponents, filled as far as scenes have needed
    rooms       for tables of interfaces with a pattern
    scene, numbers  one scene and its reduced numbers, (PARAMETER_ROWS, 1) and (REDUCED_ROWS, 1)
    by          derivatives of what is observed, (ROWS, OBSERVED)
    value       what is observed, (OBSERVED,)
    """

    kept: Kept
    rooms: Rooms
    scene: Floats
    numbers: Floats
    by: Floats
    value: Floats


@kernel
def _fill_near_tables(basis: Basis, kept: Kept, bins: int) -> None:
    """See to it that the first bins of the near tables of neighbouring exponents are filled."""
    filled = kept.filled[0, 1]
    if bins > filled:
        bins = min(max(bins, 2 * filled), kept.polys.shape[1])
        for place in range(4):
            fill_kept(basis, kept, place, 0, bins)
            bounded_table(basis, kept.k[place], bins, kept.nodes[place], kept.polys[place])


@kernel
def _freeze(task: Task, walked: Walked, y: float, pull: float, turns: bool) -> Frozen:
    """Return the radii of the cycle of a scene that turns at y, short of its rim if it `turns`.

    `pull` is the radius of the lowest load: where that is y, it moves with the turn. A turn that a jump has passed lies
    where that jump lands. Where no energy is wanted there are no jumps.
    """
    own, visited, jumps = walked.loading, walked.columns[0], task.rooms.jumps
    loading = list_loading_jumps(walked.closing, y, own, visited, walked.visits, jumps)
    n = visited_within(own, visited, walked.visits, y)
    passed = turns and n > 0 and own[LANDING, visited[n - 1]] == y
    turn = y
    if passed:
        turn = jumps[LANDED, loading - 1]
    pull = turn if pull == y else pull
    left, count = jumps[LEFT, loading - 1] if passed else 0.0, 0
    if task.wanted.cycle:
        count = list_unloading_jumps(walked.opening, turn, walked.unloading, walked.opened, jumps, loading)
    return Frozen(pull, turn, turns, passed, left, task.punch.turn, jumps, min(loading, count), count)


@kernel
def _farthest(frozen: Frozen, patterned: bool) -> float:
    """Return the largest radius at which anything is observed: with a pattern the area of the edge up to the turn."""
    y = frozen.pull
    if frozen.moves or (patterned and frozen.turn < math.inf):
        y = frozen.turn
    for n in range(frozen.total):
        y = max(y, frozen.jumps[LEFT, n], frozen.jumps[LANDED, n])
    return y


@kernel
def _least_of(pattern: Pattern) -> float:
    """Return the least value of a pattern of the work of adhesion, from the bound of its root's slope; 1 of others."""
    if not pattern.of_work or pattern.steep == 0.0:
        return 1.0
    size = 0.0
    for n in range(pattern.rows.shape[1]):
        size += (n + 1.0) * math.hypot(pattern.rows[0, n], pattern.rows[1, n])
    root = 0.5 * abs(pattern.amplitude) * size * pattern.waves / pattern.steep
    return min(1.0, root * root)


@kernel
def _step_of(near: Near, pattern: Pattern, y_end: float, row: int) -> float:
    """Return the step of the differences of a row: a half where they are exact in the second order."""
    if row in (OF_POWER, OF_WAVES):
        return 0.5
    if row not in (OF_PATTERN, OF_PATTERN_WAVES):
        return STEP
    phase = near.numbers[at.PATTERN_WAVES, 0] * pattern.rows.shape[1] * y_end
    return _PHASE_STEP * _least_of(pattern) / (max(1.0, phase) if row == OF_PATTERN_WAVES else 1.0)


@leaf
def _fill_by(task: Task, near: Near, tables: FourTables, pattern: Pattern, frozen: Frozen, y_end: float) -> None:
    """Fill the derivatives of what is observed, nowhere beyond y_end, by all numbers but those of the turn."""
    near.by[:] = 0.0
    for row in range(OF_RIM):
        fixed = row == OF_MACHINE and task.punch.control != MACHINE
        if fixed or (row in (OF_PATTERN, OF_PATTERN_WAVES) and pattern.rows.shape[1] == 0):
            continue
        numbers, number = near.scene if row == OF_PATTERN else near.numbers, _NUMBERS[row]
        value, step = numbers[number, 0], _step_of(near, pattern, y_end, row)
        for j in range(4):
            weight, table = _OF_HALVES[j] if step == 0.5 else _WEIGHTS[j], task.table
            if weight == 0.0:
                continue
            if row == OF_EXPONENT:
                table = tables[j]
            else:
                numbers[number, 0] = value * (1.0 + step * PLACES[j])
            own = pattern_of(task.punch, near.scene, near.numbers, 0)
            closing, opening = curves_of(table, task.crest, near.rooms, own, near.numbers, 0, y_end)
            observe(closing, opening, own, frozen, weight / step, near.by[row])
        numbers[number, 0] = value


@leaf
def _move_of(near: Near, closing: Curve, frozen: Frozen, target: float, row: int) -> float:
    """Return d ln y/d ln(number of this row), for k d ln y/dk, of the radius y at which the cycle turns.

    It keeps what is measured there at its `target`, in units of closing: -(d measured/d ln number)/(d measured/d ln y).
    """
    if not frozen.moves:
        return 1.0 if row == OF_RIM else 0.0
    by = near.by[row, GAP] if row < OF_RIM else 0.0
    if row == OF_RATIO:
        by = -0.5 * (near.by[OF_POWER, GAP] + near.by[OF_WAVES, GAP])
    if not frozen.passed:
        by += 0.5 * target if row == OF_RATIO else -target if row == OF_TARGET else 0.0
    return -by / rate_at(measured_by(closing, frozen), frozen.turn)


@leaf
def _put_slopes(near: Near, walked: Walked, frozen: Frozen, target: float, out: Floats, i: int) -> None:
    """Store the derivatives of force and energy of scene i, by the chain rule from those of what is observed.

    energy = ratio LOADING + UNLOADING + (1 - ratio) AREA;   d/d ln(number) = that at a fixed turn y, plus
    d/d ln y times d ln y/d ln(number) of `_move_of`. `target` is as there.
    """
    by, value, y, ratio = near.by, near.value, frozen.turn, walked.ratio
    energy = ratio * value[LOADING] + value[UNLOADING]
    force_by_turn = energy_by_turn = 0.0
    if frozen.pull == y:
        force_by_turn = rate_at(load_curve(walked.opening), y)
    if y < math.inf:
        kappa = toughness_at(walked.pattern, y)
        energy += (1.0 - ratio) * value[AREA]
        energy_by_turn = ratio * loading_by_turn(walked.closing, kappa, frozen)
        energy_by_turn += unloading_by_turn(walked.opening, frozen) + (1.0 - ratio) * (kappa * y) ** 2
    elif ratio < 1.0:
        energy = math.nan  # it has no bound
    else:
        value[AREA] = math.nan
    for row in range(ROWS):
        force = loss = 0.0
        if row < OF_RIM:
            force = by[row, PULL]
            loss = ratio * by[row, LOADING] + by[row, UNLOADING] + (1.0 - ratio) * by[row, AREA]
        elif row == OF_RATIO:  # B and g of closing go with its root
            loading = value[LOADING] - 0.5 * (by[OF_POWER, LOADING] + by[OF_WAVES, LOADING])
            loss = ratio * (loading - value[AREA])
        move = _move_of(near, walked.closing, frozen, target, row)
        out[FORCE + row, i] = (force + force_by_turn * move) / value[PULL]
        out[ENERGY + row, i] = (loss + energy_by_turn * move) / energy


@leaf
def _fill_scene(
    task: Task,
    basis: Basis,
    near: Near,
    tables: FourTables,
    walked: Walked,
    y: float,
    scenes: Floats,
    reduced: Floats,
    i: int,
    out: Floats,
) -> bool:
    """Store the derivatives of scene i, which turns at y; return False if the table is too short.

    `tables` are of the exponents k + STEP PLACES: near ones, in `near`, if there are any there.
    """
    closing, opening, pattern = walked.closing, walked.opening, walked.pattern
    own, n = walked.loading, walked.visits
    lowest = lowest_load(opening, y, 0, opening.table.bins)
    beyond = y > end_of(closing.table) and (n == 0 or own[END, walked.columns[0, n - 1]] < y)
    if walked.branches < 0 or walked.opened < 0 or beyond or not (lowest.known and lowest.load < 0.0):
        return False
    turns = task.punch.turn != AT_RIM and y < reduced[at.RIM_Y, i]
    frozen = _freeze(task, walked, y, lowest.y, turns)
    for row in range(scenes.shape[0]):  # one by one: numba would copy whole columns by way of an array of its own
        near.scene[row, 0] = scenes[row, i]
    for row in range(reduced.shape[0]):
        near.numbers[row, 0] = reduced[row, i]
    near.value[:] = 0.0
    observe(closing, opening, pattern, frozen, 1.0, near.value)
    y_end = _farthest(frozen, pattern.rows.shape[1] > 0)
    if near.kept.k.size > 0:
        _fill_near_tables(basis, near.kept, bin_of(tables[0], y_end) + 1)
    _fill_by(task, near, tables, pattern, frozen, y_end)
    _put_slopes(near, walked, frozen, reduced[at.TARGET_VALUE, i] / math.sqrt(walked.ratio), out, i)
    return True


@kernel
def solve_slopes(
    punch: Punch,
    wanted: Wanted,
    tables: Tables,
    near: Near,
    neighbours: FourTables,
    scenes: Floats,
    reduced: Floats,
    out: Floats,
) -> None:
    """Store the derivatives of scenes in the order of their exponents; those that reach beyond the tables are SHORT.

    `neighbours` are the long tables of the exponents next to that of `tables`, if it is long; else they are made here.
    `out` has the rows of results, of force and of energy, (ALL_ROWS, scenes).
    """
    first, basis, kept = int(np.int64(0)), tables.basis, near.kept  # a plain 0 would be a type of its own to callees
    while first < scenes.shape[1]:
        last, k = end_of_exponent(scenes, first), scenes[at.K, first]
        task = task_of(punch, wanted, tables, scenes, reduced, first, last)
        if tables.long.bins == 0:
            for place in range(4):
                empty_place(basis, kept, place, k + STEP * PLACES[place])
            bins = kept.polys.shape[1]
            neighbours = (
                table_in(basis, kept.k[0], bins, kept.nodes[0], kept.polys[0]),
                table_in(basis, kept.k[1], bins, kept.nodes[1], kept.polys[1]),
                table_in(basis, kept.k[2], bins, kept.nodes[2], kept.polys[2]),
                table_in(basis, kept.k[3], bins, kept.nodes[3], kept.polys[3]),
            )
        while first < last:
            end = curve_end(task.reach, scenes, reduced, first, last, out)
            if end > first:
                walked = walk_curve(task, scenes, reduced, first, end, out)
                for i in range(first, end):
                    y = out[results.TURN, i]
                    known = not y > 0.0 or _fill_scene(
                        task, basis, near, neighbours, walked, y, scenes, reduced, i, out
                    )
                    if not known:
                        results.no_value(out, i, results.SHORT)
            first = max(end, first + 1)
