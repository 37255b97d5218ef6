"""The slow, independent twin of the solver: every number from the definitions, in ball arithmetic of 51 digits.

It shares no line with gradhesion.core and needs python-flint, whose precision it sets on import.
"""

from typing import Final

import flint

PRECISION: Final = 170
"""Working precision in bits (51 decimal digits), set on import; results are good to more than 30 digits."""

flint.ctx.prec = PRECISION
