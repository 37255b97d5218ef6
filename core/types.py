"""Short names of types of arrays, for the arguments of kernels; shapes and units stand with each argument."""

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = NDArray[np.float64]
Integers: TypeAlias = NDArray[np.int64]
Truths: TypeAlias = NDArray[np.bool_]
Bits: TypeAlias = NDArray[np.int8]
"""Bits of problem/status.py."""
