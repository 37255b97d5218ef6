"""Sums over millions of waves from a few hundred of them.

As long as the pattern of its jumps stays the same, what a wave adds is a smooth function of its number w, which may be
any real one (waves/general.py): what its jumps lose, or the slopes of that (sensitivities/general_wave_slopes.py), all
of them at once. Over such a run a .. b the sum is an integral and Euler's and Maclaurin's terms,

    sum_{w=p}^{q} e_w = int_{p-1/2}^{q+1/2} e dw - [e'/24 - 7 e'''/5760 + 31 e^(5)/967680] between the two limits,

with some waves at either end summed one by one. Patterns change where a pair of folds is born or dies, or where one end
of a branch overtakes another: there e is a power series in the root of the distance. With

    log w = log a + (log b - log a) sin^2(theta/2)

it is analytic in theta, and so are powers of w. The integral uses 17 Chebyshev points of theta, on parts halved until
the last coefficients vanish. Runs are found by their patterns at those points, and their ends by bisection.
"""

import math
from typing import Any, Final, NamedTuple

import numpy as np

from gradhesion.core.compiler.dispatch import face
from gradhesion.core.compiler.jit import NO, kernel
from gradhesion.core.curve.general import Basis, Series
from gradhesion.core.types import Floats
from gradhesion.core.waves.cosine_sum import limit_terms
from gradhesion.core.waves.general import Waves, step_of_wave

_POINTS: Final = 17
_PLACES: Final = np.cos(np.pi * np.arange(_POINTS)[::-1] / (_POINTS - 1))
"""On [-1, 1], from left to right."""
_EDGE: Final = 8
"""Waves at either end of a run that are summed one by one."""
_DIRECT: Final = 48
"""Waves up to which a run is summed one by one."""
_NARROW: Final = 32.0
"""Waves within which the points of an integral need not be put closer: they are summed one by one."""
_TOLERANCE: Final = 1e-12
"""Last coefficients over the integral: what they leave out is smaller still."""
_ROOM: Final = 4096
_TOP: Final = 64
_MOST_STEPS: Final = 400_000


def _coefficients() -> np.ndarray:
    """Return the matrix from values at `_PLACES` to Chebyshev coefficients."""
    return np.ascontiguousarray(np.linalg.inv(np.polynomial.chebyshev.chebvander(_PLACES, _POINTS - 1)))


_MATRIX: Final = _coefficients()
_LAST: Final = 3


@kernel()
def _integrate(values: Floats) -> tuple[float, float]:
    """Return the integral over [-1, 1] of what has values at `_PLACES`, and the size of its last coefficients."""
    total, rest = 0.0, 0.0
    for j in range(_POINTS):
        coefficient = 0.0
        for i in range(_POINTS):
            coefficient += _MATRIX[j, i] * values[i]
        if j % 2 == 0:
            total += 2.0 * coefficient / (1.0 - j * j)
        if j >= _POINTS - _LAST:
            rest = max(rest, abs(coefficient))
    return total, rest


@kernel()
def _angle_of(wave: float, low: float, span: float) -> float:
    """Return theta of a wave; log a = low, log b = low + span."""
    return 2.0 * math.asin(math.sqrt(min(1.0, max(0.0, (math.log(wave) - low) / span))))


@kernel()
def _wave_at(angle: float, low: float, span: float) -> float:
    """Return the wave at theta."""
    return math.exp(low + span * math.sin(0.5 * angle) ** 2)


@kernel()
def _last_of_run(basis: Basis, curve: Series, waves: Waves, low: float, high: float) -> tuple[float, int]:
    """Return the last wave from `low` on, before `high`, of the pattern that `low` has, and the steps it took."""
    _, _, pattern = step_of_wave(basis, curve, waves, low, NO)
    steps = 1
    while high - low > 1.0:
        middle = np.floor(0.5 * (low + high))
        _, _, there = step_of_wave(basis, curve, waves, middle, NO)
        steps += 1
        if there == pattern:
            low = middle
        else:
            high = middle
    return low, steps


class Losses(NamedTuple):
    """The summand: one number, the loss of the jumps of a wave."""

    wanted: bool  # else 0 stands for it, and jumps alone are counted


@face(by="term")
def fill_wave(basis: Basis, curve: Series, term: Any, waves: Waves, wave: float, found: Floats) -> tuple[float, int]:
    """Put the numbers that a wave adds into `found`; return its jumps, and their pattern, negative if not regular."""


@face(by="term")
def common_size(term: Any, sizes: Floats) -> float:
    """Return the size against which all numbers settle, from those of their largest parts."""


@fill_wave.answers(Losses)
@kernel()
def fill_loss(basis: Basis, curve: Series, term: Losses, waves: Waves, wave: float, found: Floats) -> tuple[float, int]:
    """Put the loss of its jumps, in 2 pi l^2 dgamma."""
    found[0], jumps, pattern = step_of_wave(basis, curve, waves, wave, term.wanted)
    return jumps, pattern


@common_size.answers(Losses)
@kernel()
def size_of_losses(_term: Losses, sizes: Floats) -> float:
    """Return the size of the one number."""
    return float(sizes[0])


class Part(NamedTuple):
    """What is known of a run of waves."""

    done: bool  # whether its integrals are: it has one pattern, and the integrals settle
    jumps: float  # of each wave
    pattern: int
    runs: Floats  # else the runs to take instead, rows (first, last), of shape (number or more, 2)
    number: int
    steps: int  # the waves that were evaluated


@kernel()
def _integrate_run(
    basis: Basis, curve: Series, term: Any, waves: Waves, run: tuple[float, float], sizes: Floats, total: Floats
) -> Part:
    """Put the integrals over a run (first, last wave) without its ends into `total`, as long as it has one pattern.

    `sizes` are those of the largest parts of an integral so far; both are of shape (numbers,).
    """
    first, last = run
    low = math.log(first - 0.5)
    span = math.log(last + 0.5) - low
    runs, panels = np.empty((2 * _POINTS, 2)), np.empty((_TOP, 2))
    panels[0, 0] = _angle_of(first + _EDGE - 0.5, low, span)
    panels[0, 1] = _angle_of(last - _EDGE + 0.5, low, span)
    top, steps, jumps, pattern = 0, 0, 0.0, 0
    found, parts, rests = np.empty(total.size), np.empty(total.size), np.empty(total.size)
    values, places, patterns = np.empty((total.size, _POINTS)), np.empty(_POINTS), np.empty(_POINTS, np.int64)
    for j in range(total.size):
        total[j] = 0.0
    while top >= 0:
        begin, end = panels[top]
        top -= 1
        half = 0.5 * (end - begin)
        for i in range(_POINTS):
            angle = begin + half * (1.0 + _PLACES[i])
            places[i] = _wave_at(angle, low, span)
            jumps, patterns[i] = fill_wave(basis, curve, term, waves, places[i], found)
            for j in range(total.size):
                values[j, i] = found[j] * places[i] * 0.5 * span * math.sin(angle)
        steps += _POINTS
        pattern = patterns[0]
        count, start = 0, first
        for i in range(_POINTS - 1):
            if patterns[i + 1] != patterns[i]:
                here = max(start, np.floor(places[i]))
                there = min(last, np.floor(places[i + 1]) + 1.0)
                if there <= here:
                    continue
                here, taken = _last_of_run(basis, curve, waves, here, there)
                steps += taken
                runs[count, 0], runs[count, 1] = start, here
                start = here + 1.0
                count += 1
        if count > 0:
            runs[count, 0], runs[count, 1] = start, last
            return Part(False, 0.0, 0, runs, count + 1, steps)
        for j in range(total.size):
            part, rest = _integrate(values[j])
            parts[j], rests[j] = half * part, half * rest
            sizes[j] = max(sizes[j], abs(parts[j]))
        common, settled = common_size(term, sizes), True
        for j in range(total.size):
            settled = settled and rests[j] <= _TOLERANCE * max(common, sizes[j])
        if settled:
            for j in range(total.size):
                total[j] += parts[j]
        elif places[_POINTS - 1] - places[0] < _NARROW or top + 2 >= _TOP:
            begin, end = np.floor(places[0]), np.floor(places[_POINTS - 1]) + 1.0
            runs[0, 0], runs[0, 1] = first, begin - 1.0
            runs[1, 0], runs[1, 1] = begin, end
            runs[2, 0], runs[2, 1] = end + 1.0, last
            return Part(False, 0.0, 0, runs, 3, steps)
        else:
            panels[top + 1, 0], panels[top + 1, 1] = begin, begin + half
            panels[top + 2, 0], panels[top + 2, 1] = begin + half, end
            top += 2
    return Part(True, jumps, pattern, runs, 0, steps)


@kernel()
def _add_ends(
    basis: Basis, curve: Series, term: Any, waves: Waves, run: tuple[float, float], pattern: int, total: Floats
) -> bool:
    """Add the waves at both ends of a run, and Euler's and Maclaurin's terms; return whether all have one pattern."""
    begin, end = run
    found, values, even = np.empty(total.size), np.empty((total.size, 6)), True
    for side in range(2):
        for i in range(_EDGE + 3):
            wave = begin + i if side == 0 else end - i
            _, there = fill_wave(basis, curve, term, waves, wave, found)
            even = even and there == pattern
            for j in range(total.size):
                if i < _EDGE:
                    total[j] += found[j]
                if i >= _EDGE - 3:
                    values[j, i - _EDGE + 3 if side == 0 else _EDGE + 2 - i] = found[j]
        for j in range(total.size):
            total[j] += limit_terms(values[j]) if side == 0 else -limit_terms(values[j])
    return even


@kernel()
def add_waves(basis: Basis, curve: Series, term: Any, waves: Waves, first: float, last: float, total: Floats) -> float:
    """Add the numbers of the waves `first` to `last` to `total`, of shape (numbers,), NaN where they are not regular.

    `term` is their type: `Losses`, or another one with `fill_wave` and `common_size`. The jumps of these
    waves are returned.
    """
    stack = np.empty((_ROOM, 2))
    stack[0, 0], stack[0, 1] = first, last
    found, part, sizes = np.empty(total.size), np.empty(total.size), np.zeros(total.size)
    top, steps, jumps = 0, 0, 0.0
    while top >= 0:
        begin, end = stack[top]
        top -= 1
        if end - begin < _DIRECT:
            wave = begin
            while wave <= end:
                number, pattern = fill_wave(basis, curve, term, waves, wave, found)
                if pattern < 0:
                    total[:] = math.nan
                    return math.nan
                for j in range(total.size):
                    total[j] += found[j]
                jumps += number
                wave += 1.0
                steps += 1
            continue
        done, number, pattern, runs, count, taken = _integrate_run(basis, curve, term, waves, (begin, end), sizes, part)
        steps += taken
        if steps > _MOST_STEPS or (done and pattern < 0) or top + max(count, 3) >= _ROOM:
            total[:] = math.nan
            return math.nan
        for i in range(count):
            if runs[i, 1] >= runs[i, 0]:
                top += 1
                stack[top, 0], stack[top, 1] = runs[i, 0], runs[i, 1]
        if not done:
            continue
        steps += 2 * _EDGE + 6
        if _add_ends(basis, curve, term, waves, (begin, end), pattern, part):
            for j in range(total.size):
                total[j] += part[j]
            jumps += number * (end - begin + 1.0)
        else:  # a pattern of some waves at an end: these one by one
            stack[top + 1, 0], stack[top + 1, 1] = begin, begin + _EDGE + 3.0
            stack[top + 2, 0], stack[top + 2, 1] = begin + _EDGE + 4.0, end - _EDGE - 4.0
            stack[top + 3, 0], stack[top + 3, 1] = end - _EDGE - 3.0, end
            top += 3
    return jumps


@kernel()
def sum_of_waves(
    basis: Basis, curve: Series, waves: Waves, first: float, last: float, losses: bool
) -> tuple[float, float]:
    """Return what the waves `first` to `last` lose, in 2 pi l^2 dgamma, and their jumps; NaN where not regular."""
    total = np.zeros(1)
    jumps = add_waves(basis, curve, Losses(losses), waves, first, last, total)
    return total[0], jumps
