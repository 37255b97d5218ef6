"""All zeros of a smooth function on a cell: isolated on its interpolant by the signs of Bernstein coefficients.

On a cell of three quarters of the shortest wave, no longer than 0.7 of its distance from z = 0, the function D of
curve/general.py is its Hermite interpolant at nine places, by D at all and dD/dx at eight of them, to 3e-13, and
rounding moves Bernstein coefficients by `NOISE`. A polynomial has no more zeros in an interval than its Bernstein
coefficients change sign there, and as many up to an even number; intervals with two changes or more are halved (de
Casteljau). A pair that is not separated after 16 halvings is two zeros on either side of an extremum of the function
itself, or none.
"""

import math
from math import comb
from typing import Final

import numpy as np

from gradhesion.core.compiler.jit import NONE, kernel
from gradhesion.core.types import Floats

DEGREE: Final = 16
HALVINGS: Final = 16
STACK: Final = HALVINGS + 2
MOST: Final = 2 * DEGREE


NODES: Final = 0.5 + 0.5 * np.array(
    [-1.0, -0.931893, -0.736770, -0.440985, -0.084483, 0.284587, 0.616381, 0.866087, 1.0]
)
"""On [0, 1], the ends among them: the product of the distances from them, squared but for that from the first, is as
small as it can be (test_cells.py)."""
PLACES: Final = NODES.size


def _to_bernstein() -> np.ndarray:
    """Return what the values at `NODES`, and then the rates at all but the first, add to the Bernstein coefficients."""

    def polynomials(u: float, degree: int) -> np.ndarray:
        return np.array([comb(degree, j) * u**j * (1.0 - u) ** (degree - j) for j in range(degree + 1)])

    values = [polynomials(u, DEGREE) for u in NODES]
    steps = [polynomials(u, DEGREE - 1) for u in NODES[1:]]
    rates = [DEGREE * (np.append(0.0, step) - np.append(step, 0.0)) for step in steps]
    return np.ascontiguousarray(np.linalg.inv(np.array(values + rates)).T)


_STEEPEST: Final = 1.5 * math.pi
"""Rate over value of three quarters of a wave."""
MATRIX: Final = _to_bernstein()
NOISE: Final = 2.0**-53 * float(
    (np.abs(MATRIX[:PLACES]).sum(axis=0) + _STEEPEST * np.abs(MATRIX[PLACES:]).sum(axis=0)).max()
)
"""Rounding of a Bernstein coefficient over the largest value, or over the terms that cancel in it (1e-12)."""


BINOMIALS: Final = np.array([float(comb(DEGREE, j)) for j in range(DEGREE + 1)])
_NEWTON: Final = 4
"""Steps from the control polygon's zero: the error is then mostly below 1e-9 of a wave."""


@kernel(contract=True)
def _zero(stack: Floats, top: int) -> float:
    """Return about where a polynomial in [0, 1] whose Bernstein coefficients, row `top`, change sign once is zero.

    Over (1 - u)^DEGREE it is a polynomial in r = u/(1 - u), on which Newton's method is used.
    """
    first = 0
    while first < DEGREE - 1 and (stack[top, first] < 0.0) == (stack[top, first + 1] < 0.0):
        first += 1
    before, behind = stack[top, first], stack[top, first + 1]
    guess = (first + before / (before - behind)) / DEGREE
    back = guess > 0.5
    r = (1.0 - guess) / guess if back else guess / (1.0 - guess)
    for _ in range(_NEWTON):
        value, rate = 0.0, 0.0
        for j in range(DEGREE, -1, -1):
            rate = rate * r + value
            value = value * r + BINOMIALS[j] * stack[top, DEGREE - j if back else j]
        step = value / rate
        if not abs(step) < 0.5 * r:
            return guess
        r -= step
    return 1.0 / (1.0 + r) if back else r / (1.0 + r)


@kernel()
def _changes(stack: Floats, top: int) -> int:
    """Return how often the sign changes in row `top`; zero counts as positive."""
    count = 0
    for j in range(DEGREE):
        if (stack[top, j] < 0.0) != (stack[top, j + 1] < 0.0):
            count += 1
    return count


@kernel()
def isolate(values: Floats, stack: Floats, spans: Floats, found: Floats) -> tuple[int, float]:
    """Put the parts of [0, 1] that hold zeros of an interpolant into `found`, from left to right.

    Parameters
    ----------
    values
        Those at `NODES`, and behind them the rates on [0, 1] at all of these but the first.
    stack, spans
        Room, of shapes (STACK, DEGREE + 1) and (STACK, 3).
    found
        Rows (left, right, sign, kind, guess): kind 1 holds one zero, about at the guess, kind 2 a close pair or none;
        sign is that of the value at the left end. Shape (MOST, 5).

    Returns
    -------
    The number of rows, and a number below |interpolant| wherever it is in no row: nearly zero at a near miss.
    """
    for j in range(DEGREE + 1):
        stack[0, j] = 0.0
    for i in range(DEGREE + 1):
        for j in range(DEGREE + 1):
            stack[0, j] += MATRIX[i, j] * values[i]
    stack[0, 0], stack[0, DEGREE] = values[0], values[PLACES - 1]
    spans[0, 0], spans[0, 1], spans[0, 2] = 0.0, 1.0, 0.0
    top, count = NONE, NONE
    nearest = math.inf
    while top >= 0:
        changes = _changes(stack, top)
        left, right, halvings = spans[top, 0], spans[top, 1], spans[top, 2]
        if changes == 0:
            for j in range(DEGREE + 1):
                nearest = min(nearest, abs(stack[top, j]))
            top -= 1
        elif changes == 1 or halvings >= HALVINGS:
            if count == MOST:
                return count, nearest
            found[count, 0], found[count, 1] = left, right
            found[count, 2] = -1.0 if stack[top, 0] < 0.0 else 1.0
            found[count, 3] = 1.0 if changes % 2 == 1 else 2.0
            found[count, 4] = left + (right - left) * (_zero(stack, top) if changes == 1 else 0.5)
            count += 1
            top -= 1
        else:  # the left half goes on top, the right half below it
            middle = 0.5 * (left + right)
            for j in range(DEGREE + 1):
                stack[top + 1, j] = stack[top, j]
            for step in range(DEGREE):
                # after step s the last item is final: the right half's coefficient of that rank
                stack[top, DEGREE - step] = stack[top + 1, DEGREE]
                for j in range(DEGREE, step, -1):
                    stack[top + 1, j] = 0.5 * (stack[top + 1, j - 1] + stack[top + 1, j])
            stack[top, 0] = stack[top + 1, DEGREE]
            spans[top, 0], spans[top, 1], spans[top, 2] = middle, right, halvings + 1.0
            spans[top + 1, 0], spans[top + 1, 1], spans[top + 1, 2] = left, middle, halvings + 1.0
            top += 1
    return count, nearest
