"""Arithmetic on unevaluated sums (high, low) of two floats, about 32 digits (Dekker 1971; Hida, Li & Bailey 2001).

Used where a table is made, so that every stored coefficient is the float nearest to the true one.
"""

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.numbers.intrinsics import fma


@kernel()
def two_sum(a: float, b: float) -> tuple[float, float]:
    """Return a + b and its rounding error, exactly."""
    total = a + b
    from_b = total - a
    return total, (a - (total - from_b)) + (b - from_b)


@kernel()
def add(a: tuple[float, float], b: tuple[float, float]) -> tuple[float, float]:
    """Return a + b."""
    high, low = two_sum(a[0], b[0])
    low += a[1] + b[1]
    total = high + low
    return total, low - (total - high)


@kernel()
def scale(a: tuple[float, float], factor: float) -> tuple[float, float]:
    """Return a times a plain float."""
    high = a[0] * factor
    low = fma(a[0], factor, -high) + a[1] * factor
    total = high + low
    return total, low - (total - high)


@kernel()
def multiply(a: tuple[float, float], b: tuple[float, float]) -> tuple[float, float]:
    """Return a b."""
    high = a[0] * b[0]
    low = fma(a[0], b[0], -high) + (a[0] * b[1] + a[1] * b[0])
    total = high + low
    return total, low - (total - high)


@kernel()
def divide(a: tuple[float, float], b: tuple[float, float]) -> tuple[float, float]:
    """Return a / b."""
    first = a[0] / b[0]
    rest = add(a, scale(b, -first))
    second = (rest[0] + rest[1]) / b[0]
    total = first + second
    return total, second - (total - first)


@kernel()
def shrink(a: tuple[float, float], divisor: float) -> tuple[float, float]:
    """Return a divided by a plain float."""
    first = a[0] / divisor
    second = (fma(-first, divisor, a[0]) + a[1]) / divisor
    total = first + second
    return total, second - (total - first)
