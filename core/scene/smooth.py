"""Smooth punches, many at once: each step for a block of them, as a loop of vector operations.

A block has rows of numbers of scenes: their results in the order of problem/results.py, then what these follow from. Of
curves it has the first of the latter. Formulas are those of closed/smooth.py. A long run of rims of one curve that are
all far beyond the radius to which contacts jump is solved once.
"""

import math
from typing import Any, Final, TypeAlias

from gradhesion.core.closed import smooth
from gradhesion.core.closed.power import fill_powers
from gradhesion.core.compiler.jit import NONE, ONE, YES, constant, kernel
from gradhesion.core.problem.curves import Curves, is_in_range
from gradhesion.core.problem.results import (
    DEEPEST,
    ENERGY,
    FORCE,
    LAST,
    LOADED,
    LOADING,
    OUTERMOST,
    RADIUS,
    UNLOADED,
    UNLOADING,
    Results,
    Slots,
    wants_cycle,
    wants_folds,
    wants_force,
    wants_losses,
)
from gradhesion.core.problem.status import JUMP_IN_TO_RIM, NO_VALUE, PULL_OFF_AT_RIM
from gradhesion.core.types import Floats, Integers

ROWS: Final = 19
SCENES: Final = 256
"""Scenes of a block: what is used of it stays in the nearest cache."""
Block: TypeAlias = Floats
"""A block, of shape (ROWS, scenes): the rows of its results in their own units, and those below."""
_RESULTS: Final = 9
_K, _STRETCH, _IN, _OUT, _RIM, _X, _BASE, _EXPONENT, _FLAGS, _REACH = map(constant, range(_RESULTS, ROWS))
"""The rows: k, s, a_2^2, a_4^2, the rim, X there, x and p of a power x^p, flags, and a_2."""


@kernel()
def _take_curves(index: Integers, k: Floats, curves: Curves, block: Block) -> None:
    """Put k and s of the curves of some numbers (n,) into a block, s being NaN where out of range; k is (curves,)."""
    before, factor = math.nan, math.nan
    for j in range(index.size):
        i = index[j]
        if k[i] != before:
            before = k[i]
            factor = 2.0 ** (1.0 + before) * math.pi
        stretch = math.sqrt(factor / curves.stiffness[i])  # s = sqrt(2^(1+k) pi dgamma/M)
        sound = is_in_range(stretch, curves.wavelength[i], curves.amplitude[i])
        block[_K, j], block[_STRETCH, j] = before, stretch if sound else math.nan


@kernel()
def _take_scenes(index: Integers, first: int, count: int, rims: Floats, curves: Block, scenes: Block) -> None:
    """Put `count` rims a_max/R of curves `index`, from scene `first` on, and what is known of the curves into a block.

    `index` is of shape (n,), `rims` of shape (curves, rims) or (1, rims).
    """
    number = rims.shape[1]
    if number == 1:  # curves and scenes are the same block
        for e in range(count):
            scenes[_RIM, e] = rims[index[e] if rims.shape[0] > 1 else 0, 0]
        return
    e, j, rim = 0, first // number, first % number
    while e < count:
        end = min(count, e + number - rim)
        i = index[j] if rims.shape[0] > 1 else 0
        for row in range(_K, _RIM):
            value = curves[row, j]
            for place in range(e, end):
                scenes[row, place] = value
        for place in range(e, end):
            scenes[_RIM, place] = rims[i, rim + place - e]
        e, j, rim = end, j + 1, 0


@kernel()
def _store(index: Integers, first: int, count: int, values: Floats, out: Any) -> None:
    """Store values (count,) of scenes, from number `first` on, in `out`, of shape (curves, rims), at curves `index`."""
    number = out.shape[1]
    if number == 1:
        for e in range(count):
            out[index[e], 0] = values[e]
        return
    e, j, rim = 0, first // number, first % number
    while e < count:
        end = min(count, e + number - rim)
        i = index[j]
        for place in range(e, end):
            out[i, rim + place - e] = values[place]
        e, j, rim = end, j + 1, 0


@kernel()
def _find_squares(count: int, block: Block, start: float, slope: float, row: int) -> None:
    """Put the squares of the radii where X = start + slope k, over R^2, into a row of a block of `count` scenes."""
    for e in range(count):
        k = block[_K, e]
        block[_BASE, e] = smooth.raised_of(k, block[_STRETCH, e], start + slope * k)
        block[_EXPONENT, e] = 4.0 / (3.0 + k)
    fill_powers(count, block[_BASE], block[_EXPONENT], block[row])


@kernel()
def _are_far_out(count: int, block: Block) -> bool:
    """Return whether all rims of a block are far beyond the radius to which contacts jump: X does not matter then."""
    near = 0
    for e in range(count):
        near += 0 if block[_RIM, e] * block[_RIM, e] > 2.0 * block[_IN, e] else 1
    return near == 0


@kernel()
def _find_abscissas(count: int, block: Block, far: bool) -> None:
    """Find X at the rims; infinity for those that are `far` out."""
    if far:
        for e in range(count):
            block[_X, e] = math.inf
        return
    for e in range(count):
        block[_EXPONENT, e] = 0.5 * (3.0 + block[_K, e])
    fill_powers(count, block[_RIM], block[_EXPONENT], block[_X])
    for e in range(count):
        block[_X, e] = smooth.abscissa_of(block[_K, e], block[_STRETCH, e], block[_X, e])


@kernel()
def _find_radii(count: int, block: Block) -> None:
    """Find the radii of the pull-off."""
    _find_squares(count, block, smooth.abscissa_of_pull_off(0.0), 0.5, RADIUS)
    for e in range(count):
        at_rim = smooth.is_pulled_off_at_rim(block[_K, e], block[_X, e])
        block[RADIUS, e] = block[_RIM, e] if at_rim else math.sqrt(block[RADIUS, e])


@kernel()
def _find_losses(count: int, block: Block) -> None:
    """Find the energies of loading and unloading."""
    for e in range(count):
        k, abscissa, rim = block[_K, e], block[_X, e], block[_RIM, e]
        loaded = smooth.smooth_loading(k, abscissa, rim, block[_IN, e])
        unloaded = smooth.smooth_unloading(k, abscissa, rim, block[_OUT, e])
        block[LOADED, e], block[UNLOADED, e], block[ENERGY, e] = loaded, unloaded, loaded + unloaded


@kernel()
def _find_last(count: int, block: Block) -> None:
    """Find the depths at which contact ends."""
    for e in range(count):
        block[_BASE, e] = math.sqrt(min(block[_RIM, e] * block[_RIM, e], block[_OUT, e]))
        block[_EXPONENT, e] = 0.5 * (1.0 - block[_K, e])
    fill_powers(count, block[_BASE], block[_EXPONENT], block[LAST])
    for e in range(count):
        square = min(block[_RIM, e] * block[_RIM, e], block[_OUT, e])
        block[LAST, e] = smooth.smooth_last(block[_K, e], block[_STRETCH, e], square, block[LAST, e])


@kernel()
def _find_flags(count: int, block: Block, force: bool, folds: bool) -> None:
    """Find the status of the scenes."""
    at_rim, in_to_rim = PULL_OFF_AT_RIM if force else 0, JUMP_IN_TO_RIM if folds else 0
    for e in range(count):
        flags = at_rim if smooth.is_pulled_off_at_rim(block[_K, e], block[_X, e]) else 0
        block[_FLAGS, e] = flags | (in_to_rim if smooth.jumps_in_to_rim(block[_X, e]) else 0)


@kernel()
def _solve_block(count: int, block: Block, slots: Slots, far: bool) -> None:
    """Compute the requested results of scenes."""
    _find_abscissas(count, block, far)
    if slots[FORCE] >= 0:
        for e in range(count):
            block[FORCE, e] = smooth.smooth_force(block[_K, e], block[_X, e])
    if slots[RADIUS] >= 0:
        _find_radii(count, block)
    if wants_losses(slots):
        _find_losses(count, block)
    if slots[LOADING] >= 0 or slots[UNLOADING] >= 0:
        for e in range(count):
            block[LOADING, e], block[UNLOADING, e] = 1.0, smooth.smooth_jumps_out(block[_K, e])
    if slots[LAST] >= 0:
        _find_last(count, block)
    if slots[OUTERMOST] >= 0:
        for e in range(count):
            block[_REACH, e] = math.sqrt(block[_IN, e])
    if slots[DEEPEST] >= 0:
        for e in range(count):
            block[DEEPEST, e] = smooth.smooth_deepest(block[_K, e], block[_X, e], block[_RIM, e])
    _find_flags(count, block, wants_force(slots), wants_folds(slots))


@kernel()
def _solve_run(
    number: int, rims: Floats, curve: int, place: int, curves: Block, scenes: Block, results: Results
) -> int:
    """Solve at once the run of rims, from `number` on, that are too far out to change any result of a curve.

    `rims` are a_max/R, of shape (curves, rims) or (1, rims); the curve is number `curve` of all, and stands at `place`
    of the block of curves. Return how many rims they are, and 0 if they would not fill a block of scenes.
    """
    slots, out, status = results
    row, end = curve if rims.shape[0] > 1 else 0, number
    while end < rims.shape[1] and rims[row, end] * rims[row, end] > 2.0 * curves[_IN, place]:
        end += 1
    if end - number < scenes.shape[1]:
        return 0
    for known in range(_K, _RIM):
        scenes[known, 0] = curves[known, place]
    scenes[_RIM, 0] = rims[row, number]
    _solve_block(ONE, scenes, slots, YES)
    for result in range(_RESULTS):
        if slots[result] >= 0:
            value = scenes[result, 0]
            for i in range(number, end):
                out[slots[result], curve, i] = value
    if slots[OUTERMOST] >= 0:
        for i in range(number, end):
            out[slots[OUTERMOST], curve, i] = scenes[_REACH, 0]
    flags = scenes[_FLAGS, 0]
    for i in range(number, end):
        status[curve, i] = flags
    return end - number


@kernel()
def _refuse(index: Integers, block: Block, results: Results) -> None:
    """Give the curves of these numbers (n,) that are out of range no value; the block is theirs, in the same order."""
    for j in range(index.size):
        if not block[_STRETCH, j] > 0.0:
            for rim in range(results.status.shape[1]):
                results.status[index[j], rim] = NO_VALUE
                for row in range(results.out.shape[0]):
                    results.out[row, index[j], rim] = math.nan


@kernel()
def solve_smooth(k: Floats, curves: Curves, results: Results, scratch: Floats) -> None:
    """Solve curves whose waves have no effect, as `solve_curves` (scene/solvers.py); their tables are not read.

    k are the exponents of all curves, of shape (curves,), `scratch` two blocks, of shape (2, ROWS, scenes of a block).
    """
    index, rims = curves.numbers, curves.rims
    slots, out, status = results
    size, number = scratch.shape[2], rims.shape[1]
    block, scenes = scratch[0], scratch[0 if number == 1 else 1]
    for begin in range(0, index.size, size):
        some = index[begin : begin + size]
        _take_curves(some, k, curves, block)
        if wants_cycle(slots) or number > 1:
            _find_squares(some.size, block, smooth.ABSCISSA_OF_JUMP_IN, 0.0, _IN)
        if wants_cycle(slots):
            _find_squares(some.size, block, smooth.abscissa_of_jump_out(0.0), -0.5, _OUT)
        first, total = NONE, some.size * number
        while first < total:
            count = min(size, total - first)
            if number >= size and slots[DEEPEST] < 0:
                j = first // number
                run = _solve_run(first % number, rims, some[j], j, block, scenes, results)
                if run > 0:
                    first += run
                    continue
            _take_scenes(some, first, count, rims, block, scenes)
            far = number > 1 and slots[DEEPEST] < 0 and _are_far_out(count, scenes)
            _solve_block(count, scenes, slots, far)
            for row in range(_RESULTS):
                if slots[row] >= 0:
                    _store(some, first, count, scenes[row], out[slots[row]])
            if slots[OUTERMOST] >= 0:
                _store(some, first, count, scenes[_REACH], out[slots[OUTERMOST]])
            _store(some, first, count, scenes[_FLAGS], status)
            first += count
        _refuse(some, block, results)
