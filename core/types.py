"""Short names of types of arrays, for the arguments of kernels; shapes and units are given with the arguments."""

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = NDArray[np.float64]
Integers: TypeAlias = NDArray[np.int64]
Truths: TypeAlias = NDArray[np.bool_]
Bits: TypeAlias = NDArray[np.int8]
"""Bits of problem/status.py."""
AnyBits: TypeAlias = NDArray[np.int8] | NDArray[np.int16]
"""The same, in studies that have more of them as well."""
Harmonics: TypeAlias = NDArray[np.float64]
"""The waves of a profile: rows (n, cos, sin), of shape (harmonics, 3); all cosines and sines are in units of A."""
Slopes: TypeAlias = NDArray[np.float64]
"""Slopes of an energy, by the numbers of sensitivities/jump_slopes.py, of shape (SLOPES,), in 2 pi l^2 dgamma."""
Work: TypeAlias = NDArray[np.float64]
"""Room that a function works in, of shape (floats,); the function says how many it needs."""
Table: TypeAlias = Any
"""The table of an exponent, one record `TABLE` of struve/layout.py; numba knows its fields."""
Tables: TypeAlias = Any
"""Such records, of shape (exponents,)."""
