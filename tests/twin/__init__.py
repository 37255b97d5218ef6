"""The slow, independent, high-precision twin of the solver: every number from the definitions, in arb arithmetic."""

from typing import Final

import flint

PRECISION: Final = 170
"""Working precision in bits (51 decimal digits), set on import; results are good to more than 30 digits."""

flint.ctx.prec = PRECISION
