"""One record that is the table of one exponent after the other: what is not filled when it is read (filling.py).

Of many exponents with a scene or two each, all the tables would leave the caches between them. So kernels request the
table of the next exponent before they read it: it replaces the last one. A table built for its exponent stays as it is.
"""

import math
from typing import Final

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.numbers.intrinsics import bits_of, numbers_at
from gradhesion.core.struve.filling import fill_theta, refill
from gradhesion.core.struve.table import fill_constants
from gradhesion.core.types import Table, Tables

RECIPE: Final = 3
"""Numbers that an exponent is given by: k, its place t on its piece, and the bits of the address of that."""


@kernel()
def prepare(table: Table, k: float, place: float, source: int) -> None:
    """Make a record the table of k: at t = `place` of the piece whose coefficients stand at `source`."""
    fill_constants(table, k)
    table.place, table.source = place, source
    refill(table, 2.0 ** (-16.0 * k) * 2.0**-16)


@kernel()
def ready(tables: Tables, number: int) -> int:
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
def ready_for_theta(tables: Tables, number: int) -> int:
    """Return the number of the record in which theta, and nothing else, is that of exponent `number` of a task."""
    table = tables[0]
    if table.recipes == 0:
        return number
    recipes = numbers_at(table.recipes)
    table.k = math.nan
    table.place, table.source = recipes[RECIPE * number + 1], bits_of(recipes[RECIPE * number + 2])
    fill_theta(table)
    return 0
