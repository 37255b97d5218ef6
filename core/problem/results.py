"""The results of a scene: their names, their rows, and how a kernel stores those requested.

They go to `out[slots[row], rim]` of a record `Results`, where `slots` is -1 for those not wanted.
"""

from collections.abc import Sequence
from typing import Any, Final, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.compiler.jit import constant, kernel
from gradhesion.core.problem.names import REACH, RESULTS
from gradhesion.core.types import Bits, Floats, Integers

INTEGERS: Final = ("loading_jumps", "unloading_jumps")
"""Results that are counts."""
FORCE, RADIUS, ENERGY, LOADING, UNLOADING, DEEPEST, LAST, LOADED, UNLOADED = map(constant, range(len(RESULTS)))
"""The rows."""
LOADING_PART, UNLOADING_PART, WHOLE_CYCLE = 1, 2, 3
"""Parts of a cycle whose energy is differentiated."""
CONTACT = len(RESULTS)
"""One more slot, not -1 if `status` reports where loading does not keep the contact one disc."""
TURNED = CONTACT + 1
"""And another one, 1 if the rims are turning points (turning/cosine.py), which loading certainly reaches."""
OUTERMOST = constant(TURNED + 1)
"""The last one: the row of the largest end of a jump, REACH of names.py, stored of rims at infinity only."""


Slots: TypeAlias = Integers
"""The row of the values for each result, -1 for what is not wanted, and three more; of shape (slots,): `slots_of`."""


class Results(NamedTuple):
    """Where the results of one curve go; a loop over curves has one axis more in `out` and `status`, before the last.

    slots       the row of `out` for each result, -1 for what is not wanted, int64 of shape (slots,)
    out         the values, of shape (rows, rims)
    status      bits of problem/status.py, int8 of shape (rims,)
    """

    slots: Slots
    out: Floats
    status: Bits


class Cycle(NamedTuple):
    """A cycle up to one rim in reduced units: energies in 2 pi l^2 dgamma, depths in s l^c."""

    loaded: float  # what the jumps of loading lose, and their number
    loading_jumps: float
    unloaded: float  # the same of unloading
    unloading_jumps: float
    last: float  # the depth at which contact ends
    highest: float  # the largest value of what is prescribed, on the way to the rim


def slots_of(rows: Sequence[str], *, check_contact: bool, turned: bool) -> Integers:
    """Return the slots for results that stand in these rows of `out`."""
    places = [rows.index(name) if name in rows else -1 for name in (*RESULTS, REACH)]
    return np.array([*places[:-1], int(check_contact) - 1, int(turned), places[-1]])


def typed(name: str, values: Floats) -> NDArray[Any]:
    """Return values as the type of their result: counts as int32, -1 for NaN, 2^31 - 1 for more."""
    if name not in INTEGERS:
        return values
    return np.where(np.isnan(values), -1.0, np.minimum(values, np.iinfo(np.int32).max)).astype(np.int32)


@kernel()
def wants_force(slots: Slots) -> bool:
    """Return whether anything of the pull-off is wanted; `slots` as of `Results`."""
    return slots[FORCE] >= 0 or slots[RADIUS] >= 0


@kernel()
def wants_losses(slots: Slots) -> bool:
    """Return whether anything is wanted that needs the energies of jumps; `slots` as of `Results`."""
    return slots[ENERGY] >= 0 or slots[LOADED] >= 0 or slots[UNLOADED] >= 0


@kernel()
def wants_cycle(slots: Slots) -> bool:
    """Return whether anything is wanted that needs the jumps; `slots` as of `Results`."""
    counts = slots[LOADING] >= 0 or slots[UNLOADING] >= 0
    return wants_losses(slots) or counts or slots[LAST] >= 0 or slots[OUTERMOST] >= 0


@kernel()
def wants_folds(slots: Slots) -> bool:
    """Return whether anything is wanted that needs the folds, the jumps or the largest depth; `slots` of `Results`."""
    return wants_cycle(slots) or slots[DEEPEST] >= 0


@kernel()
def part_of(parts: int, loaded: float, unloaded: float) -> float:
    """Return the energy of the parts of a cycle: 1 for loading, 2 for unloading, 3 for both."""
    if parts == LOADING_PART:
        return loaded
    return unloaded if parts == UNLOADING_PART else loaded + unloaded


@kernel()
def energy_of(results: Results, parts: int, rim: int) -> float:
    """Return the stored energy of the parts of a cycle (`part_of`) of a rim."""
    row = LOADED if parts == LOADING_PART else UNLOADED if parts == UNLOADING_PART else ENERGY
    return float(results.out[results.slots[row], rim])


@kernel()
def put(results: Results, row: int, rim: int, value: float) -> None:
    """Store one result of a rim, by its row among all results and the number of the rim, if it is wanted."""
    if results.slots[row] >= 0:
        results.out[results.slots[row], rim] = value


@kernel()
def put_all(results: Results, rim: int, values: tuple[float, ...]) -> None:
    """Store those results of a rim that are wanted; `values` are all nine in the order of the rows."""
    for row in range(len(values)):
        put(results, row, rim, values[row])
