"""The derivative by the gradient exponent: values at four neighbouring exponents, each with a table of its own.

What is differentiated is a smooth function of k (sensitivities/jump_slopes.py), so that five points give it to some
1e-10 of the value (3e-10 at most, against reference values of 24 scenes): centred, or one-sided next to the ends of 0
<= k <= 1.
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

_STEP: Final = 2.0**-9
"""Rounding leaves some eps/step, 1e-13, and the formula step^4/30 of the fifth derivative, which is (ln z)^5/32."""
_CENTRED: Final = ((-2.0, -1.0, 1.0, 2.0), (1.0 / 12.0, -2.0 / 3.0, 2.0 / 3.0, -1.0 / 12.0), 0.0)
_FORWARD: Final = ((1.0, 2.0, 3.0, 4.0), (4.0, -3.0, 4.0 / 3.0, -0.25), -25.0 / 12.0)
"""Places in steps, their weights, and the weight of the middle (Fornberg 1988)."""


def exponents_beside(k: float) -> tuple[list[float], NDArray[np.float64], float]:
    """Return four exponents next to k, 0 to 1, their weights in d/dk, and the weight of k itself."""
    sign = 1.0
    places, weights, middle = _CENTRED
    if not 2.0 * _STEP <= k <= 1.0 - 2.0 * _STEP:
        places, weights, middle = _FORWARD
        sign = 1.0 if k < 0.5 else -1.0
    return [k + sign * _STEP * place for place in places], sign / _STEP * np.array(weights), sign / _STEP * middle
