"""The solvers of one cosine, and the one loop over curves that they share.

The solver is a constant of the loop: numba drops the branches of the others before it compiles them, so that only the
solver in use is compiled, and keeps one version of the loop for each. (A loop that took the solver as an argument, or
closed over its kernel, would be compiled anew in every process.)
"""

import math
from collections.abc import Callable
from typing import Final

from gradhesion.core.closed import envelope
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.problem.curves import Curves, is_in_range
from gradhesion.core.problem.results import Results
from gradhesion.core.scene import cosine as scene
from gradhesion.core.scene.cosine_long import solve_left
from gradhesion.core.scene.scene import has_left
from gradhesion.core.sensitivities.cosine_slopes import of_curve
from gradhesion.core.sensitivities.wanted import AnySense
from gradhesion.core.struve.current import ready
from gradhesion.core.types import Floats

EXACT, LONG, ENVELOPE, PULL_OFF = range(4)
"""The second one solves what the first leaves, the last is the first where only the pull-off is requested: each
compiles its own part of the code."""


def loop_of(solver: int) -> Callable[..., int]:
    """Return the kernel that solves many curves by one solver."""

    @kernel()
    def solve_curves(curves: Curves, results: Results, scratch: Floats, sense: AnySense) -> int:
        """Solve curves, each for its rims; return of how many the exact solver has left rims with many waves.

        `scratch` is room for a trace, of shape (ROWS, branches). Values go to `results` in the shape (results, curves,
        rims), flags in (curves, rims); only the exact solver knows sensitivities.
        """
        tables, which, index, stiffness, wavelengths, amplitudes, rims = curves
        table = tables[0]
        stretch_factor = math.nan
        left, known = 0, -1
        for j in range(index.size):
            i = index[j]
            own = Results(results.slots, results.out[:, i], results.status[i])
            if solver == LONG and not has_left(own.status):
                continue
            if which[j] != known:
                known = which[j]
                table = tables[ready(tables, known)]
                stretch_factor = 2.0 ** (1.0 + table.k) * math.pi
            row = rims[i if rims.shape[0] > 1 else 0]
            wavelength, amplitude = wavelengths[i], amplitudes[i]
            stretch = math.sqrt(stretch_factor / stiffness[i])  # s = sqrt(2^(1+k) pi dgamma/M)
            if not is_in_range(stretch, wavelength, amplitude):
                scene.refuse(own)
                continue
            if solver == LONG:
                solve_left(table, stretch, wavelength, amplitude, row, own, scratch, of_curve(sense, i, which[j]))
                continue
            for rim in range(own.status.size):
                own.status[rim] = 0
            if solver == EXACT:
                sense_of_it = of_curve(sense, i, which[j])
                left += scene.solve_curve(table, stretch, wavelength, amplitude, row, own, scratch, sense_of_it)
            elif solver == PULL_OFF:
                scene.solve_pull_off(table, stretch, wavelength, amplitude, row, own)
            else:
                envelope.solve_curve(table, stretch, wavelength, amplitude, row, own)
        return left

    return solve_curves


LOOPS: Final = {"exact": loop_of(EXACT), "envelope": loop_of(ENVELOPE)}
"""The loop of each of names.SOLVERS that is one of one cosine alone."""
LONG_LOOP: Final = loop_of(LONG)
PULL_OFF_LOOP: Final = loop_of(PULL_OFF)
