"""Tables of many exponents at once: each entry is a polynomial in k, between tables of a few exponents.

A table of its own costs 0.2 ms, hundreds of times a force. Over G((1+k)/2), or its square where squares of S0 are
integrated, every entry is so smooth on 0 <= k <= 1 that the polynomial of degree 15 through 24 tables at Chebyshev
nodes is accurate to its rounding. It is expanded anew on each of 24 pieces of [0, 1], where 8 coefficients suffice
(against tables of their own, on scenes of random k: forces within 3e-15 of the terms they are the difference of,
energies within 5e-14). Bins, moments and arches are filled when they are read (filling.py), all else at once.
"""

import math
from functools import lru_cache
from typing import Any, Final

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.numbers.chebyshev import chebyshev_fit
from gradhesion.core.numbers.intrinsics import bits_of
from gradhesion.core.struve.current import RECIPE, prepare
from gradhesion.core.struve.filling import ask_for_arches, ask_for_bin, ask_for_moments
from gradhesion.core.struve.layout import ALL, TABLE
from gradhesion.core.struve.table import build_table
from gradhesion.core.types import Floats, Tables

_NODES: Final = 24
_DEGREES: Final = 16
_PIECES: Final = 24
_EDGES: Final = 0.5 - 0.5 * np.cos(np.pi / _PIECES * np.arange(_PIECES + 1))
"""Pieces are narrow near the ends, where a polynomial through the nodes, and so its rounding, bends most."""
_CENTRES, _HALVES = 0.5 * (_EDGES[1:] + _EDGES[:-1]), 0.5 * np.diff(_EDGES)
ROUNDING: Final = 4.0
"""Errors of an interpolated table over those of one built for its exponent: a factor of stated errors."""
_WORD: Final = 8


@lru_cache(maxsize=1)
def _at_nodes() -> tuple[Floats, list[Floats]]:
    """Return the exponents of the nodes, and the numbers of their tables, of the shape (blocks, nodes, numbers)."""
    places, _ = chebyshev_fit(_NODES, _DEGREES)
    exponents = 0.5 * (1.0 + places)
    tables = np.array([build_table(k) for k in exponents.tolist()]).view(np.float64).reshape(_NODES, -1)
    gamma = np.array([[math.gamma(0.5 * (1.0 + k))] for k in exponents.tolist()])
    found = []
    for blocks in ALL:
        first = TABLE.fields[blocks.field][1] // _WORD  # type: ignore[index]
        begins = np.minimum(np.arange(blocks.number) * blocks.size, blocks.total - blocks.size)
        of_field = tables[:, first + begins[:, None] + np.arange(blocks.size)] / gamma[:, :, None] ** blocks.power
        found.append(np.ascontiguousarray(of_field.transpose(1, 0, 2)))
    return exponents, found


@lru_cache(maxsize=2)
def _expansions(terms: int) -> tuple[Floats, Floats]:
    """Return the matrices from values at the nodes to Chebyshev coefficients on pieces, and from these to powers of t.

    Shapes (_PIECES, terms, nodes) and (terms, terms).
    """
    _, fit = chebyshev_fit(_NODES, _DEGREES)
    places, fit_of_piece = chebyshev_fit(_DEGREES, terms)
    whole = chebyshev.chebvander(2.0 * (_CENTRES[:, None] + _HALVES[:, None] * places) - 1.0, _DEGREES - 1)
    powers = np.zeros((terms, terms))
    for j, row in enumerate(np.eye(terms)):
        powers[: j + 1, j] = chebyshev.cheb2poly(row)[: j + 1]
    return fit_of_piece @ whole @ fit, powers


def _made(piece: int) -> Floats:
    """Return the coefficients of a piece, block by block (filling.py), of shape (floats,)."""
    exponents, values_of_all = _at_nodes()
    nearest = np.argmin(np.abs(exponents - _CENTRES[piece]))
    parts = []
    for blocks, values in zip(ALL, values_of_all, strict=True):
        expansions, powers = _expansions(blocks.terms)
        middle = values[:, nearest]
        # rounding leaves parts of the differences, and of powers parts of the Chebyshev coefficients, which fall off;
        # these are small products, which no library does by threads of its own
        coefficients = powers @ (expansions[piece] @ (values - middle[:, None]))
        coefficients[:, 0] += middle
        parts.append(coefficients.ravel())
    return np.concatenate(parts)


_pieces: Final[dict[int, Floats]] = {}
"""Coefficients made so far, kept for good: tables have their addresses."""


def _piece(piece: int) -> Floats:
    """Return the coefficients of a piece, of shape (floats,); if many threads make them, those of the first one."""
    if piece not in _pieces:
        return _pieces.setdefault(piece, _made(piece))
    return _pieces[piece]


@kernel()
def complete(tables: Tables) -> None:
    """Fill the missing bins, moments and arches of some records, shape (n,)."""
    for j in range(tables.size):
        for i in range(tables[j].lacks_bin.size):
            ask_for_bin(tables[j], i)
        for i in range(tables[j].lacks_moments.size):
            ask_for_moments(tables[j], i)
        for i in range(tables[j].lacks_arches.size):
            ask_for_arches(tables[j], i)


@kernel(entry=True)
def _prepare(recipes: Floats, tables: Tables) -> None:
    """Make each of some records the table of its recipe, a row of them."""
    for i in range(tables.size):
        prepare(tables[i], recipes[i, 0], recipes[i, 1], bits_of(recipes[i, 2]))


def _fill_recipes(exponents: Floats, recipes: Floats) -> None:
    """Put exponents (n,), their places on their pieces, and bits of the addresses of these into the rows of recipes."""
    pieces = np.searchsorted(_EDGES[1:-1], exponents)
    addresses = np.zeros(_PIECES, dtype=np.int64)
    for piece in np.flatnonzero(np.bincount(pieces)).tolist():
        addresses[piece] = _piece(piece).ctypes.data
    recipes[:, 0] = exponents
    recipes[:, 1] = (exponents - _CENTRES[pieces]) / _HALVES[pieces]
    recipes[:, 2] = addresses[pieces].view(np.float64)


def interpolated_tables(exponents: Floats, *, whole: bool = False) -> NDArray[Any]:
    """Return the tables of some exponents, records of layout.TABLE.

    Parameters
    ----------
    exponents
        Gradient exponents, 0 to 1, shape (n,).
    whole
        Whether to fill everything (2 us a table): for kernels that do not request blocks before they read them.

    Returns
    -------
    Array of shape (n,). Bins, moments and arches are filled by the thread that reads them first (filling.py): no other
    may read them, unless the tables are whole. Errors are at most `ROUNDING` times those of `build_table`.
    """
    tables, recipes = np.empty(exponents.size, dtype=TABLE), np.empty((exponents.size, RECIPE))
    _fill_recipes(exponents, recipes)
    tables["rounding"], tables["recipes"], tables["for_forces"] = ROUNDING, 0, 0
    _prepare(recipes, tables)
    if whole:
        complete(tables)
    return tables


def table_of_each(exponents: Floats, *, forces: bool) -> NDArray[Any]:
    """Return one record that becomes the table of one exponent after the other (current.py).

    Parameters
    ----------
    exponents
        Gradient exponents, 0 to 1, shape (n,).
    forces
        Whether only pull-off forces are computed from them: fields that no force reads are left out.

    Returns
    -------
    Array of shape (1,), for one thread. Errors are as those of `interpolated_tables`.
    """
    memory = np.empty(TABLE.itemsize + exponents.size * RECIPE * _WORD, dtype=np.uint8)  # of both: one keeps the other
    table = memory[: TABLE.itemsize].view(TABLE)
    recipes = memory[TABLE.itemsize :].view(np.float64).reshape(-1, RECIPE)
    _fill_recipes(exponents, recipes)
    table["rounding"], table["recipes"], table["for_forces"] = ROUNDING, recipes.ctypes.data, forces
    table["k"] = np.nan
    return table
