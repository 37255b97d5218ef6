"""The results of a scene: their names, their rows, and how a kernel stores those that were asked for.

Results go to `out[slots[row], rim]`, where `slots` holds -1 for what nobody asked for.
"""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.compiler.jit import constant, kernel
from gradhesion.core.problem.names import REACH, RESULTS

INTEGERS: Final = ("loading_jumps", "unloading_jumps")
"""Those that count."""
FORCE, RADIUS, ENERGY, LOADING, UNLOADING, DEEPEST, LAST, LOADED, UNLOADED = map(constant, range(9))
"""The rows."""
CONTACT = 9
"""One more slot, not -1 if `status` reports where loading does not keep the contact one disc."""
TURNED = 10
"""And another one, 1 if the rims are turning points (turning/cosine.py): places that loading surely reaches."""
OUTERMOST = constant(11)
"""The last one: the row of the largest end of a jump, REACH of names.py, stored of rims at infinity only."""


def slots_of(rows: Sequence[str], *, check_contact: bool, turned: bool) -> NDArray[np.int64]:
    """Return the slots for results that stand in these rows of `out`."""
    places = [rows.index(name) if name in rows else -1 for name in (*RESULTS, REACH)]
    return np.array([*places[:-1], int(check_contact) - 1, int(turned), places[-1]])


def typed(name: str, values: NDArray[np.float64]) -> NDArray[Any]:
    """Return values as the type of their result: counts as int32, -1 for NaN, 2^31 - 1 for more."""
    if name not in INTEGERS:
        return values
    return np.where(np.isnan(values), -1.0, np.minimum(values, np.iinfo(np.int32).max)).astype(np.int32)


@kernel()
def wants_force(slots: Any) -> bool:
    """Return whether anything of the pull-off is asked for."""
    return slots[FORCE] >= 0 or slots[RADIUS] >= 0


@kernel()
def wants_losses(slots: Any) -> bool:
    """Return whether anything is asked for that needs what the jumps lose."""
    return slots[ENERGY] >= 0 or slots[LOADED] >= 0 or slots[UNLOADED] >= 0


@kernel()
def wants_cycle(slots: Any) -> bool:
    """Return whether anything is asked for that needs the jumps."""
    counts = slots[LOADING] >= 0 or slots[UNLOADING] >= 0
    return wants_losses(slots) or counts or slots[LAST] >= 0 or slots[OUTERMOST] >= 0


@kernel()
def wants_folds(slots: Any) -> bool:
    """Return whether anything is asked for that needs the folds: the jumps, or the largest depth."""
    return wants_cycle(slots) or slots[DEEPEST] >= 0


@kernel()
def put(out: Any, slots: Any, row: int, rim: int, value: float) -> None:
    """Store one result if it was asked for."""
    if slots[row] >= 0:
        out[slots[row], rim] = value


@kernel()
def put_all(out: Any, slots: Any, rim: int, values: Any) -> None:
    """Store those of all results, in the order of the rows, that were asked for."""
    for row in range(len(values)):
        put(out, slots, row, rim, values[row])
