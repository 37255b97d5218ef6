"""The solvers, and the one loop over curves that they share.

The solver is a constant of the loop: numba drops the branches of the others before it looks at them, so that only the
solver in use is compiled, and keeps one version of the loop for each. (A loop that took the solver as an argument, or
closed over its kernel, would be compiled anew in every process.)
"""

import math
from collections.abc import Callable
from typing import Any, Final

from gradhesion.core.closed import envelope
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.problem.status import NO_VALUE
from gradhesion.core.scene import cosine as scene
from gradhesion.core.scene import short_wave as asymptotic_cycle
from gradhesion.core.sensitivities.cosine_slopes import of_curve
from gradhesion.core.struve.current import ready

EXACT, ASYMPTOTIC, ENVELOPE, PULL_OFF = 0, 1, 2, 3
"""The last one is the exact solver where nothing but the pull-off is asked for: a third of the code to compile."""


@kernel()
def _refuse(values: Any, flags: Any) -> None:
    """Give a curve out of range no value."""
    values[:, :] = math.nan
    flags[:] = NO_VALUE


def loop_of(solver: int) -> Callable[..., None]:
    """Return the kernel that solves many curves by one solver."""

    @kernel()
    def solve_curves(
        tables: Any,
        which: Any,
        index: Any,
        stiffness: Any,
        wavelength: Any,
        amplitude: Any,
        rims: Any,
        slots: Any,
        out: Any,
        status: Any,
        scratch: Any,
        sense: Any,
    ) -> None:
        """Solve the curves `index`, `which` are the tables of theirs; `rims` has one row, or one a curve.

        `sense` is (), or for the exact solver what its sensitivities need (`solve_curve` of scene/cosine.py), those of
        all exponents and curves: the tables of neighbours and their weights have one
        row for each table, and the sensitivities go to (3, COUNT, curves, rims).
        """
        table = tables[0]
        stretch_factor = math.nan
        for j in range(index.size):
            i = index[j]
            if j == 0 or which[j] != which[j - 1]:
                table = tables[ready(tables, which[j])]
                stretch_factor = 2.0 ** (1.0 + table.k) * math.pi
            row = rims[i if rims.shape[0] > 1 else 0]
            values, flags = out[:, i], status[i]
            stretch = math.sqrt(stretch_factor / stiffness[i])  # s = sqrt(2^(1+k) pi dgamma/M)
            if not (0.0 < stretch < math.inf and 0.0 < wavelength[i] < math.inf and 0.0 <= amplitude[i] < math.inf):
                _refuse(values, flags)
                continue
            for rim in range(flags.size):
                flags[rim] = 0
            if solver == EXACT:
                own = of_curve(sense, i, which[j])
                scene.solve_curve(table, stretch, wavelength[i], amplitude[i], row, slots, values, flags, scratch, own)
            elif solver == PULL_OFF:
                scene.solve_pull_off(table, stretch, wavelength[i], amplitude[i], row, slots, values, flags)
            elif solver == ASYMPTOTIC:
                asymptotic_cycle.solve_curve(table, stretch, wavelength[i], amplitude[i], row, slots, values, flags)
            else:
                envelope.solve_curve(table, stretch, wavelength[i], amplitude[i], row, slots, values)

    return solve_curves


LOOPS: Final = {"exact": loop_of(EXACT), "asymptotic": loop_of(ASYMPTOTIC), "envelope": loop_of(ENVELOPE)}
"""The loop of each of names.SOLVERS."""
PULL_OFF_LOOP: Final = loop_of(PULL_OFF)
