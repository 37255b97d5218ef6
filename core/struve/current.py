"""One record that is the table of one exponent after the other: what is not filled when it is read (filling.py).

Of many exponents with a scene or two each, all the tables would leave the caches between them. So kernels ask for the
table of the next exponent before they read it: it takes the place of the last one. A table of its own stays what it is.
"""

import math
from typing import Any, Final

from gradhesion.core._jit import kernel
from gradhesion.core.struve.filling import (
    OF_CYCLES,
    OF_ENERGIES,
    OF_FORCES,
    OF_POWERS,
    POWERS_AT_ONCE,
    fill_for_cycles,
    fill_for_energies,
    fill_for_forces,
    fill_mantissas,
    fill_powers,
)
from gradhesion.core.struve.intrinsics import bits_of, numbers_at
from gradhesion.core.struve.layout import EXPONENT_SPAN
from gradhesion.core.struve.table import fill_constants

RECIPE: Final = 3
"""Numbers that an exponent is given by: k, its place t on its piece, and the bits of the address of that."""
_FOR_FORCES, _OF_POWERS = OF_FORCES.number, OF_POWERS.number
_FOR_CYCLES, _FOR_ENERGIES = OF_CYCLES.number, OF_ENERGIES.number


@kernel()
def _fill_powers(table: Any, k: float) -> None:
    """Fill the powers 2^(-(1+k)/2 e): roots of that for 32, their products, and multiples of these."""
    powers = table.power_exponent[EXPONENT_SPAN : EXPONENT_SPAN + POWERS_AT_ONCE]
    root = 2.0 ** (-0.5 * POWERS_AT_ONCE * k) * 2.0 ** (-0.5 * POWERS_AT_ONCE)
    up, down = root, 1.0 / root
    powers[0] = 1.0
    e = POWERS_AT_ONCE
    while e > 1:
        e //= 2
        root = math.sqrt(root)
        powers[e] = root
    while e < POWERS_AT_ONCE:
        for m in range(1, e):
            powers[e + m] = powers[e] * powers[m]
        e *= 2
    fill_powers(table, up, down)


@kernel()
def prepare(table: Any, k: float, place: float, source: int) -> None:
    """Make a record the table of k: at t = `place` of the piece whose coefficients stand at `source`."""
    fill_constants(table, k)
    table.place, table.source = place, source
    table.lacks_bin[:] = 1
    table.lacks_moments[:] = 1
    table.lacks_arches[:] = 1
    for block in range(_FOR_FORCES):
        fill_for_forces(table, block)
    for block in range(_OF_POWERS):
        fill_mantissas(table, block)
    if table.for_forces == 0:
        for block in range(_FOR_CYCLES):
            fill_for_cycles(table, block)
        for block in range(_FOR_ENERGIES):
            fill_for_energies(table, block)
    _fill_powers(table, k)


@kernel()
def ready(tables: Any, number: int) -> int:
    """Return the number of the record that is now the table of exponent `number` of a task."""
    table = tables[0]
    if table.recipes == 0:
        return number
    recipes = numbers_at(table.recipes)
    k = recipes[RECIPE * number]
    if k != table.k:
        prepare(table, k, recipes[RECIPE * number + 1], bits_of(recipes[RECIPE * number + 2]))
    return 0


@kernel()
def ready_for_theta(tables: Any, number: int) -> int:
    """Return the number of the record in which theta, and nothing else, is that of exponent `number` of a task."""
    table = tables[0]
    if table.recipes == 0:
        return number
    recipes = numbers_at(table.recipes)
    table.k = math.nan
    table.place, table.source = recipes[RECIPE * number + 1], bits_of(recipes[RECIPE * number + 2])
    fill_for_forces(table, 0)
    return 0
