"""The cycle of any profile under any control: core/loading.py and core/unloading.py with a coordinate for the depth.

Loading follows the running maximum of the coordinate from 0 outwards, unloading its running minimum from the rim
inwards. A branch is a row (start, Y there, end, Y there) of the trace; the last one may end at the rim.
"""

import math
from typing import Any, Final

from gradhesion.core._jit import kernel
from gradhesion.core.folds import CLOSE
from gradhesion.core.general.curve import Basis, Curve, coordinate, size, slope, state
from gradhesion.core.general.energy import energy_from_zero, jump_energy
from gradhesion.core.struve.circle import TWO_PI

START, START_LEVEL, END, END_LEVEL = 0, 1, 2, 3
_STEPS: Final = 200
_OUTERMOST: Final = 1e100
_PAIR: Final = 8.0 * CLOSE


@kernel()
def fill_branches(basis: Basis, curve: Curve, zeros: Any, count: int, rises: bool, rim: float, trace: Any) -> int:
    """Fill the trace from the folds within the rim; return the number of branches."""
    _, _, _, alpha, _ = curve
    branches = 0
    inside = rises
    if rises:  # k = 1: contact grows from a point, where Y = -alpha
        trace[0, START], trace[0, START_LEVEL] = 0.0, -alpha
    for i in range(count):
        if inside:
            trace[branches, END], trace[branches, END_LEVEL] = zeros[i], coordinate(basis, curve, zeros[i])
            branches += 1
        else:
            trace[branches, START], trace[branches, START_LEVEL] = zeros[i], coordinate(basis, curve, zeros[i])
        inside = not inside
    if inside:
        trace[branches, END] = rim
        trace[branches, END_LEVEL] = coordinate(basis, curve, rim) if rim < math.inf else math.inf
        branches += 1
    return branches


@kernel()
def find_level(basis: Basis, curve: Curve, target: float, branch: Any) -> float:
    """Return where a branch meets a coordinate between those of its ends (Newton, kept in the bracket)."""
    low, high = branch[START], branch[END]
    if high == math.inf:
        high = 2.0 * low if low > 0.0 else 1.0
        while high < _OUTERMOST and not coordinate(basis, curve, high) > target:
            low, high = high, 2.0 * high
    x = 0.5 * (low + high)
    for _ in range(_STEPS):
        rest = coordinate(basis, curve, x) - target
        if rest == 0.0:
            return x
        if rest < 0.0:
            low = x
        else:
            high = x
        _, _, rate = slope(basis, curve, x)
        step = -rest / (TWO_PI * rate)
        if low <= x + step <= high and abs(step) <= 1e-9 * x:  # what is left is its square
            return x + step
        x += step
        if not low < x < high:
            x = 0.5 * (low + high)
            if x <= low or x >= high:
                return x
    return x


@kernel()
def _is_close(basis: Basis, curve: Curve, first: float, other: float, x: float) -> bool:
    """Return whether two coordinates differ by less than CLOSE of their terms."""
    return abs(first - other) <= CLOSE * size(basis, curve, x)


@kernel()
def load_up(basis: Basis, curve: Curve, count: int, trace: Any, rim: float, losses: bool) -> Any:
    """Follow loading from zero contact to the rim.

    Returns
    -------
    What it loses, its jumps, the largest coordinate, and whether a decision was close.
    """
    loss, jumps, level, left = 0.0, 0.0, 0.0, 0.0
    close = False
    for branch in range(count):
        top = trace[branch, END_LEVEL]
        if top < math.inf and _is_close(basis, curve, top, level, trace[branch, END]):
            close = True
        if top <= level:
            continue
        if losses:
            x = find_level(basis, curve, level, trace[branch])
            loss += energy_from_zero(basis, curve, x, 0.0) if left == 0.0 else jump_energy(basis, curve, left, x)
        jumps += 1.0
        level, left = top, trace[branch, END]
    if left < rim < math.inf:
        if losses:
            loss += energy_from_zero(basis, curve, rim, 0.0) if left == 0.0 else jump_energy(basis, curve, left, rim)
        jumps += 1.0
    return loss, jumps, level, close


@kernel()
def unload(basis: Basis, curve: Curve, count: int, trace: Any, rim: float, losses: bool, last_loss: bool) -> Any:
    """Follow unloading from the rim; the jump-out is left out of the loss unless `last_loss`.

    Returns
    -------
    What it loses, its jumps, the radius that the end of contact leaves (0 at a point), whether a decision was close.
    """
    loss, jumps = 0.0, 0.0
    close = False
    now = count - 1
    if now >= 0 and trace[now, END] == rim:
        left, level = trace[now, START], trace[now, START_LEVEL]
        now -= 1
    else:
        left, level = rim, coordinate(basis, curve, rim)
    while left > 0.0:
        while now >= 0:
            bottom = trace[now, START_LEVEL]
            if _is_close(basis, curve, bottom, level, left):
                close = True
            if bottom < level:
                break
            now -= 1
        jumps += 1.0
        if now < 0:
            if losses and last_loss:
                loss -= energy_from_zero(basis, curve, left, level)
            break
        if losses:
            loss += jump_energy(basis, curve, left, find_level(basis, curve, level, trace[now]))
        left, level = trace[now, START], trace[now, START_LEVEL]
        now -= 1
    return loss, jumps, left, close


@kernel()
def folds_are_close(zeros: Any, count: int, rim: float) -> bool:
    """Return whether two folds, or a fold and the rim, can hardly be told apart."""
    for i in range(count):
        if abs(zeros[i] - rim) <= 2.0 * CLOSE * zeros[i]:
            return True
        if i > 0:
            width = TWO_PI * (zeros[i] - zeros[i - 1])
            if width * width <= _PAIR * min(1.0, TWO_PI * zeros[i]) ** 2:
                return True
    return False


@kernel()
def depth_at_full_contact(basis: Basis, curve: Curve, rim: float, level: float) -> float:
    """Return the depth at which loading ends: pinned at the rim, at the coordinate `level` or that of the rim."""
    _, _, _, alpha, beta = curve
    _, _, front, depth, load = state(basis, curve, rim)
    own = alpha * depth + beta * load
    return depth + max(0.0, level - own) / (alpha + beta * front)
