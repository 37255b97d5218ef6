"""The rows of the arrays of scenes, (rows, scenes): parameters and reduced numbers; those of results are in results.py.

They are imported `as at`: `scenes[at.K, i]`, `reduced[at.RIM_Y, i]`.
"""

from typing import Final

# Parameters; those that a study may leave out have what stands beside them.
K, NU, MODULUS, C0, WAVELENGTH, AMPLITUDE, RIM = range(7)
STIFFNESS, TARGET, RATIO, PATTERN_WAVELENGTH, PATTERN_AMPLITUDE = range(7, 12)
# inf; depth or load at which the cycle turns, 0; closing over opening, 1; 1; 1
PARAMETER_ROWS: Final = 12

# Reduced numbers (reduced.py).
BY_POWER, BY_WAVES, BY_DEPTH, BY_LOAD, LENGTH, DEPTH, LOAD = range(7)
# B; g; weights of depth and load; units of length in R, of depth in R, of load in R dgamma
RIM_Y, TARGET_VALUE, CLOSING = 7, 8, 9
# the rim; the target in its unit; w_c/w_o
WINDOW, PULL, FAR, NEED = range(10, 14)
# radii: beyond the first no fold; the pull-off within the second; the table must reach to the third without a rim, to
# the last with it
PATTERN_WAVES, MOST, STEEP, EXPONENT, VALID = range(14, 19)
# waves of the pattern in one of the profile; bounds of kappa and its slope; k; 1 if the scene can have a value, else 0
REDUCED_ROWS: Final = 19
