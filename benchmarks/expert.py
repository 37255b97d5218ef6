"""Gradhesion against the compiled script of an expert, at equal worst error.

Both solve the same random scenes on one thread, and processor time is compared. What the script needs once (compiling,
a table for each k, the stiffness M of each scene) is not timed for it; a call of gradhesion is timed whole, with its
checks of the parameters and its test of whether contact is one disc, of which the script has none.
"""

from collections.abc import Iterator
from functools import partial
from typing import Any, Final, NamedTuple

import numpy as np

from benchmarks.clock import seconds_of, table
from benchmarks.draw import EXPONENTS
from benchmarks.expert_script import Effort, Values, solve, table_of
from gradhesion.core import PARAMETERS
from gradhesion.core import solve as solve_exactly
from gradhesion.core.problem.material import stiffness

SIZES: Final = (200, 20_000)
TARGETS: Final = {"pull_off_force": (1e-4, 1e-7, 1e-10), "dissipated_energy": (1e-3, 1e-4, 1e-6)}
LADDERS: Final = {
    "pull_off_force": [Effort(radii, step) for radii in (4, 6, 8, 12, 16, 24) for step in (1e-1, 1e-2, 1e-4)],
    "dissipated_energy": [
        Effort(radii, step, nodes)
        for radii in (6, 8, 12, 16, 24, 32, 48, 64)
        for step, nodes in ((1e-1, 3), (1e-2, 4), (1e-3, 6), (1e-4, 8))
    ],
}
"""Efforts of which the script is given the quickest that keeps an error."""


class Scenes(NamedTuple):
    """The same scenes for both."""

    parameters: dict[str, Any]
    """As `gradhesion.core.solve` takes them."""
    which: Any
    """The place of each k among the tables."""
    rows: Values
    """k, M, lambda, A, a_max."""


def draw(number: int) -> Scenes:
    """Draw scenes of one to 16 waves within the rim, folded or not."""
    rng = np.random.default_rng(20)
    which = rng.integers(0, len(EXPONENTS), number)
    k, modulus = np.array(EXPONENTS)[which], 10 ** rng.uniform(2, 3, number)
    wavelength, A = 10 ** rng.uniform(-1.5, -0.5, number), 10 ** rng.uniform(-3, -1.3, number)
    rim = np.full(number, 0.5)
    parameters = dict(zip(PARAMETERS, (k, 0.3, modulus, 0.1, wavelength, A, rim), strict=True))
    return Scenes(parameters, which, np.column_stack([k, stiffness(k, 0.3, modulus, 0.1), wavelength, A, rim]))


def compare(size: int, repeat: int = 7) -> Iterator[list[Any]]:
    """Yield a row for each output and error, in calls of so many scenes."""
    scenes, tables = draw(size), np.array([table_of(k) for k in EXPONENTS])
    for output, targets in TARGETS.items():
        truth = solve_exactly(scenes.parameters, [output], threads=1)[output]
        own = seconds_of(partial(solve_exactly, scenes.parameters, [output], threads=1), repeat=repeat)
        found = []
        for effort in LADDERS[output]:
            call = partial(solve, output, tables, scenes.which, scenes.rows, effort)
            found.append(
                (seconds_of(call, repeat=max(2, repeat // 3)), float(np.max(np.abs(call() / truth - 1.0))), effort)
            )
        for target in targets:
            quickest = min((one for one in found if one[1] <= target), default=None)
            if quickest is not None:
                seconds, error, effort = quickest
                times = [1e6 * seconds / size, 1e6 * own / size, seconds / own]
                yield [output, f"{target:.0e}", size, f"{error:.1e}", effort.radii, *times]


def expert_table(sizes: tuple[int, ...] = SIZES, repeat: int = 7) -> str:
    """Return the comparison as a table."""
    header = ["output", "error", "scenes a call", "its worst error", "radii a wave", "script, us", "gradhesion, us"]
    return table([*header, "times"], [row for size in sizes for row in compare(size, repeat)])
