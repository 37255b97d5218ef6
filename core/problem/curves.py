"""Curves of one call as kernels read them: the numbers of each, and its rims.

A curve is one punch, surface and wave; its rims, or other values that vary along it, are solved together. The first
record is that of one cosine under displacement control, the second that of any profile under any control, and the last
that of the same on interfaces whose toughness varies with the radius.
"""

import math
from typing import Any, NamedTuple

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.types import Floats, Harmonics, Integers, Tables


class Curves(NamedTuple):
    """Curves of one cosine."""

    tables: Tables  # tables of exponents
    which: Integers  # the table of each curve that is to be solved, int64 of shape (n,)
    numbers: Integers  # the number of each of these curves among all, int64 of shape (n,)
    stiffness: Floats  # M in dgamma/R^(1+k), of all curves, of shape (curves,)
    wavelength: Floats  # lambda/R, of shape (curves,)
    amplitude: Floats  # A, of shape (curves,)
    rims: Floats  # a_max/R, of shape (curves, rims), or (1, rims) where all curves have the same


class GeneralCurves(NamedTuple):
    """Curves of one profile, control and exponent of the gradient."""

    numbers: Integers  # the number of each curve that is to be solved among all, int64 of shape (n,)
    exponent: float  # m of the punch r^m/(m R^(m-1))
    depth_factor: float  # G(m/2) G(n)/(2 G(n + m/2)), n = (1+k)/2
    stretch: Floats  # s in R^((1+k)/2), of all curves, of shape (curves,)
    wavelength: Floats  # lambda/R, of shape (curves,)
    amplitude: Floats  # A, of shape (curves,); 0 for a smooth punch
    compliance: Floats  # K/S in 1/R^(1+k), of shape (curves,): 0 under displacement control, inf under load control
    rims: Floats  # a_max/R, of shape (curves, rims), or (1, rims) where all curves have the same
    patterns: Any = ()  # of toughness, a record `Patterns` of `PatternedCurves`


class PatternedCurves(GeneralCurves):
    """The same on interfaces with a pattern of toughness each."""

    __slots__ = ()


class Patterns(NamedTuple):
    """The patterns of toughness of such curves (problem/toughness.py)."""

    rows: Harmonics  # (n, cos, sin) in units of the amplitude
    of_work: bool  # whether they multiply the work of adhesion
    wavelength: Floats  # lambda_t/R, of shape (curves,)
    amplitude: Floats  # of shape (curves,)
    least: Floats  # a bound below t within the rims, of shape (curves,)
    limit: Floats  # a/R from which on t has a wrong sign, of shape (curves,), inf where it has none


@kernel()
def is_in_range(stretch: float, wavelength: float, amplitude: float) -> bool:
    """Return whether s > 0, lambda > 0 and A >= 0 are finite."""
    return 0.0 < stretch < math.inf and 0.0 < wavelength < math.inf and 0.0 <= amplitude < math.inf
