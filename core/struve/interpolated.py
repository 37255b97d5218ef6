"""Tables of many exponents at once: each entry is a polynomial in k, between tables of a few exponents.

A table of its own costs 0.2 ms, a hundred times a force. Over G((1+k)/2), or its square where squares of S0 are
integrated, every entry is so smooth on 0 <= k <= 1 that a polynomial of degree 15 through Chebyshev nodes leaves its
rounding (against tables of their own, on scenes of random k: forces within 3e-15 of the terms they are the difference
of, energies within 5e-14). A batch of tables takes some 10 us a table.
"""

import math
from functools import lru_cache
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core._jit import kernel
from gradhesion.core.struve.chebyshev import chebyshev_fit
from gradhesion.core.struve.layout import EXPONENT_SPAN, TABLE
from gradhesion.core.struve.table import build_table, fill_constants

_NODES: Final = 24
_TERMS: Final = 16
ROUNDING: Final = 4.0
"""Errors of an interpolated table over those of one of its own: what stated errors multiply by."""
_POWERS: Final = {
    "bins": 1,
    "tail": 0,
    "power_mantissa": 0,
    "moment_series": 2,
    "moment_bins": 2,
    "moment_tail": 2,
    "jump_tail": 0,
    "slow_tail": 0,
    "inverse_stretch": 0,
    "moment_constant": 2,
    "moment_logarithm": 2,
    "arches": 1,
    "fractional": 0,
    "theta": 0,
    "theta_front": 0,
}
"""The power of G((1+k)/2) that is taken out of each field."""
_FOR_FORCES: Final = ("bins", "tail", "power_mantissa", "arches", "theta", "theta_front")
"""Fields that a pull-off force reads."""
_WORD: Final = 8
_BLOCK: Final = 256
"""Columns that are filled for all tables before the next: their coefficients stay in the nearest cache."""
_STEP: Final = 32
"""Powers of 2^e are products of one for e/32 and one for the rest."""


def _columns(field: str) -> slice:
    """Return where a field stands among the numbers of a record."""
    shape, offset = TABLE.fields[field][:2]  # type: ignore[index]
    return slice(offset // _WORD, (offset + shape.itemsize) // _WORD)


_COLUMNS: Final = {
    forces: np.array([(_columns(f).start, _columns(f).stop, _POWERS[f]) for f in (_FOR_FORCES if forces else _POWERS)])
    for forces in (False, True)
}
"""The first column of each field, the one behind its last, and its power of G((1+k)/2)."""


@lru_cache(maxsize=1)
def _coefficients() -> NDArray[np.float64]:
    """Return the Chebyshev coefficients of all numbers of a record, shape (_TERMS, numbers)."""
    places, fit = chebyshev_fit(_NODES, _TERMS)
    exponents = 0.5 * (1.0 + places)
    values = np.array([build_table(k) for k in exponents.tolist()]).view(np.float64).reshape(_NODES, -1)
    gamma = np.array([[math.gamma(0.5 * (1.0 + k))] for k in exponents.tolist()])
    for field, power in _POWERS.items():
        values[:, _columns(field)] /= gamma**power
    found: NDArray[np.float64] = fit @ values
    return found


@kernel(entry=True)
def _powers(table: Any, k: float, high: Any, low: Any) -> None:
    """Fill the powers of 2^e."""
    power = -0.5 * (1.0 + k)
    for j in range(high.size):
        high[j] = 2.0 ** (power * (j * _STEP - EXPONENT_SPAN))
    for j in range(_STEP):
        low[j] = 2.0 ** (power * j)
    for j in range(high.size):
        for m in range(_STEP):
            table.power_exponent[j * _STEP + m] = high[j] * low[m]


@kernel(contract=True, entry=True)
def _add(a: Any, rows: tuple[Any, Any, Any, Any], out: Any) -> None:
    """Add four rows of coefficients, each by its weight, to `out`."""
    one, two, three, four = rows
    weight_one, weight_two, weight_three, weight_four = a[0], a[1], a[2], a[3]
    for i in range(out.size):
        out[i] += (weight_one * one[i] + weight_two * two[i]) + (weight_three * three[i] + weight_four * four[i])


@kernel(entry=True)
def _fill(exponents: Any, coefficients: Any, columns: Any, rounding: float, tables: Any, numbers: Any) -> None:
    """Fill tables, block by block of their columns; `numbers` are their numbers, shape (tables, numbers)."""
    weights = np.empty((3, exponents.size, _TERMS))
    for i in range(exponents.size):
        gamma, place = math.gamma(0.5 * (1.0 + exponents[i])), 2.0 * exponents[i] - 1.0
        here, before = 1.0, place
        for j in range(_TERMS):
            weights[0, i, j], weights[1, i, j], weights[2, i, j] = here, here * gamma, here * (gamma * gamma)
            here, before = (place, 1.0) if j == 0 else (2.0 * place * here - before, here)
    for f in range(columns.shape[0]):
        begin, last, power = columns[f]
        while begin < last:
            end = min(last, begin + _BLOCK)
            for i in range(exponents.size):
                out, own = numbers[i, begin:end], weights[power, i]
                out[:] = 0.0
                for j in range(0, _TERMS, 4):
                    one, two = coefficients[j, begin:end], coefficients[j + 1, begin:end]
                    three, four = coefficients[j + 2, begin:end], coefficients[j + 3, begin:end]
                    _add(own[j : j + 4], (one, two, three, four), out)
            begin = end
    high, low = np.empty(2 * EXPONENT_SPAN // _STEP), np.empty(_STEP)
    for i in range(exponents.size):
        table = tables[i]
        fill_constants(table, exponents[i])
        table.rounding = rounding
        _powers(table, exponents[i], high, low)


def interpolated_tables(exponents: NDArray[np.float64], *, forces: bool) -> NDArray[Any]:
    """Return the tables of some exponents, records of layout.TABLE.

    Parameters
    ----------
    exponents
        Gradient exponents, 0 to 1, shape (n,).
    forces
        Whether only pull-off forces are read from them: the moments and fractional integrals are left out.

    Returns
    -------
    Array of shape (n,). Errors are at most `ROUNDING` times those of `build_table`.
    """
    tables = np.empty(exponents.size, dtype=TABLE)
    numbers = tables.view(np.float64).reshape(exponents.size, TABLE.itemsize // _WORD)
    _fill(exponents, _coefficients(), _COLUMNS[forces], ROUNDING, tables, numbers)
    return tables
