"""Near-degenerate decisions (core/path/ties.py) on the pieces of a long general curve, some whole waves further out."""

import math

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.cosine_folds import CLOSE
from gradhesion.core.curve.general import Basis, Series, size, slope
from gradhesion.core.curve.general_folds import Zeros
from gradhesion.core.path.ties import PAIR
from gradhesion.core.struve.circle import TWO_PI


@kernel()
def is_near(basis: Basis, curve: Series, first: float, other: float, x: float, whole: float) -> bool:
    """Return whether two coordinates differ by less than CLOSE of their terms at whole + x."""
    return abs(first - other) <= CLOSE * size(basis, curve, x, whole)


@kernel()
def first_close_pair(zeros: Zeros, count: int, whole: float) -> float:
    """Return the first of the folds that has another so near that the pair may vanish, inf if none has."""
    for i in range(1, count):
        width = TWO_PI * (zeros[i] - zeros[i - 1])
        if width * width <= PAIR * min(1.0, TWO_PI * (whole + zeros[i])) ** 2:
            return zeros[i]
    return math.inf


@kernel()
def is_at_a_fold(basis: Basis, curve: Series, x: float, whole: float) -> bool:
    """Return whether whole + x is a fold, as far as anybody can tell: by a step of Newton's method."""
    value, rate, _ = slope(basis, curve, x, whole)
    return abs(value) <= 2.0 * CLOSE * TWO_PI * (whole + x) * abs(rate)
