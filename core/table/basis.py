"""Tables of any exponent near the centre: bins interpolated in k, filled only as far as they are needed.

All that a bin holds is a smooth function of k, once the powers of the radius are taken out. A basis holds the bins of
one power, series and form at 49 exponents, the Chebyshev points of each quarter of [0, 1]; the bins of any k are sums
over the 13 of its quarter, at a fraction of the price of new ones. A quarter is known once an exponent of it has been
asked for. (Those of a long series are not interpolated: a quarter costs as much as 13 exponents, of which a study of
rough profiles has one or two.) All scenes within its reach are solved on such tables, whatever else is in their call,
so that a value does not depend on its neighbours.
"""

import threading
from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np

from gradhesion.core.jit import kernel, leaf, quadrature
from gradhesion.core.table import layout as at
from gradhesion.core.table.filling import fill_bins, fill_bounds, source_of, width_of
from gradhesion.core.table.layout import EXACT, FIRST, GEOMETRIC, LANES, N, Table
from gradhesion.core.table.leading import crests_of
from gradhesion.core.types import Floats, Integers, Truths

PANELS: Final = 4
"""Equal parts of [0, 1], the range of k."""
NODES: Final = 13
"""Exponents of a part at which bins are known: what they miss is 2^-52. Neighbours share one."""
_MOST_HARMONICS: Final = 8
"""Harmonics of a series whose bins are interpolated: those of a longer one are filled for each exponent by itself."""
UNIFORM: Final = 512
"""Uniform bins of a basis: 64 of the shortest waves."""
SIZE: Final = 3 * N + 10
"""Numbers of a bin that depend on k: three lanes; V, U and U1 at the lower edge; six moments; the bound of U'."""
FIXED: Final = (at.Y, at.P, at.SLOPE, at.BP, at.M0, at.PC, at.YC, at.HALF)
"""Rows that do not depend on k."""
_KEPT: Final = 14
"""Bases kept, of 11 megabytes each: the bins of patterns have up to 13 widths."""
_TABLES: Final = 8
"""Tables of a basis that a thread keeps, of 0.4 MB each."""


class Basis(NamedTuple):
    """The bins of one power, series and form at the exponents `k`.

    exponent    m, the power of the punch
    waves       the harmonics of its series, (harmonics, 3)
    form        exact, or leading terms (layout.py)
    start, width  of the uniform bins, as of a table
    k           the exponents, (PANELS (NODES - 1) + 1,), or one alone
    known       which of them have been asked for: whatever is kept of the others has no meaning
    values      what depends on k, powers of the radius taken out, (bins, exponents, SIZE)
    fixed       the rows FIXED, (8, bins + 1)
    powers      the lane of y^m, (bins, N)
    crest, lowest  bounds at the exponents: those of `fill_bounds` and of a table
    """

    exponent: float
    waves: Floats
    form: int
    start: float
    width: float
    k: Floats
    known: Truths
    values: Floats
    fixed: Floats
    powers: Floats
    crest: Floats
    lowest: Floats


@kernel
def _pack(k: float, node: int, nodes: Floats, polys: Floats, values: Floats) -> None:
    """Put the bins of one exponent into column `node` of `values`, powers of the radius taken out."""
    for i in range(values.shape[0]):
        stretch = nodes[at.YC, i] ** (-0.5 * (1.0 + k))
        power = 1.0 / (stretch * stretch * nodes[at.YC, i])
        out = values[i, node]
        for n in range(N):
            out[n], out[N + n], out[2 * N + n] = polys[i, at.PU, n], polys[i, at.PU1, n], polys[i, at.PE, n] / stretch
        out[3 * N], out[3 * N + 1], out[3 * N + 2] = nodes[at.V, i], nodes[at.U, i], nodes[at.U1, i]
        for row in range(6):
            out[3 * N + 3 + row] = nodes[at.K0 + row, i] / power
        out[SIZE - 1] = nodes[at.BV, i]


def is_interpolated(waves: Floats) -> bool:
    """Return whether bins of a series are interpolated in k."""
    return len(waves) <= _MOST_HARMONICS


@lru_cache(maxsize=_KEPT)
def _make_basis(exponent: float, harmonics: bytes, form: int, finer: int, k: float | None) -> Basis:
    """Return the basis of `basis_of`, harmonics as bytes, of which the first exponent alone is known."""
    waves = np.frombuffer(harmonics).reshape(-1, 3).copy()  # a read-only array is another type to kernels
    width = width_of(waves, finer)
    bins = GEOMETRIC + UNIFORM + 1  # one more than tables have, for the last edge
    panel = 0.5 - 0.5 * np.cos(np.pi * np.arange(NODES - 1) / (NODES - 1))
    ends = np.append((np.arange(PANELS)[:, None] + panel).ravel(), PANELS) / PANELS
    if k is not None:
        ends = np.array([k])
    basis = Basis(
        exponent, waves, form, FIRST * width, width, ends, np.zeros(ends.size, dtype=np.bool_),
        np.empty((bins, ends.size, SIZE)), np.empty((len(FIXED), bins + 1)), np.empty((bins, N)),
        np.empty(ends.size), np.empty(ends.size),
    )  # fmt: skip
    _fill_node(basis, 0)
    return basis


def _fill_node(basis: Basis, node: int) -> None:
    """Fill a basis at one of its exponents."""
    k, bins = basis.k[node], basis.values.shape[0]
    nodes, polys = np.zeros((at.ROWS, bins + 1)), np.empty((bins, LANES, N))
    source = source_of(k, basis.exponent, basis.waves, basis.width, 0.0, basis.form)
    fill_bins(source, source.shift, FIRST, GEOMETRIC, bins, nodes, polys)
    _pack(k, node, nodes, polys, basis.values)
    if not basis.known.any():
        basis.fixed[:], basis.powers[:] = nodes[list(FIXED)], polys[:, at.PP]
    basis.crest[node], wave, _ = crests_of(k, basis.waves)
    near = ((nodes[at.U] - nodes[at.U1]) / (nodes[at.E] * nodes[at.Y]))[GEOMETRIC - 20 :].min()
    basis.lowest[node] = min(-wave, 1.02 * near)
    basis.known[node] = True


_lock = threading.Lock()


def basis_of(exponent: float, waves: Floats, form: int = EXACT, finer: int = 1, k: float | None = None) -> Basis:
    """Return the basis of a punch of a power with harmonics (n, cos, sin), one of the last few if it is among them.

    Its bins are `finer` times narrower than usual. It is that of the exponent `k` alone, if one is given. Before it is
    used, `make_known` must have been told between which exponents.
    """
    with _lock:  # of threads that need the same, one makes it
        return _make_basis(exponent, waves.tobytes(), form, finer, k)


def make_known(basis: Basis, least: float, greatest: float) -> None:
    """Fill the parts of a basis in which exponents from the least to the greatest lie, where they are not yet."""
    first = max(min(int(PANELS * least), PANELS - 1), 0) * (NODES - 1)
    last = min(int(PANELS * greatest), PANELS - 1) * (NODES - 1)
    if basis.known[first : last + NODES].all():
        return
    with _lock:
        for node in np.flatnonzero(~basis.known[first : last + NODES]).tolist():
            _fill_node(basis, first + node)


@leaf
def _panel_of(basis: Basis, k: float) -> tuple[int, int]:
    """Return the first of the exponents from which the bins of k are summed, and their number."""
    if basis.k.size == 1:
        return 0, 1
    return min(max(int(PANELS * k), 0), PANELS - 1) * (NODES - 1), NODES


@kernel
def fill_weights(basis: Basis, k: float, weights: Floats) -> None:
    """Put the weights by which the values of its panel add up to the one at k into `weights`, (NODES,)."""
    first, count = _panel_of(basis, k)
    total = 0.0
    for n in range(count):
        away = k - basis.k[first + n]
        if away == 0.0:
            weights[:] = 0.0
            weights[n] = 1.0
            return
        sign = 1.0 if n % 2 == 0 else -1.0
        weights[n] = sign * (0.5 if n == 0 or n == count - 1 else 1.0) / away
        total += weights[n]
    for n in range(count):
        weights[n] /= total


@quadrature
def mix_bins(basis: Basis, k: float, weights: Floats, first: int, last: int, nodes: Floats, polys: Floats) -> None:
    """Fill the bins `first` to `last` - 1 of an exponent, whose weights are given, and the edge of `last`.

    `nodes` and `polys` have what does not depend on k.
    """
    power = -0.5 * (1.0 + k)
    mixed = np.zeros(SIZE)
    node, count = _panel_of(basis, k)
    for i in range(first, last + 1):
        for c in range(SIZE):
            mixed[c] = 0.0
        for n in range(count):
            weight = weights[n]
            for c in range(SIZE):
                mixed[c] += weight * basis.values[i, node + n, c]
        nodes[at.V, i], nodes[at.U, i], nodes[at.U1, i] = mixed[3 * N], mixed[3 * N + 1], mixed[3 * N + 2]
        centre, half, low = nodes[at.YC, i], nodes[at.HALF, i], nodes[at.Y, i]
        at_centre = centre**power
        stretch, sign = 0.0, 1.0  # at the lower edge, t = -1
        for n in range(N):
            stretch += sign * mixed[2 * N + n]
            sign = -sign
        stretch *= at_centre
        nodes[at.E, i] = nodes[at.KE, i] = stretch
        nodes[at.T, i] = 1.0 / (stretch * stretch)
        if i == last:
            return
        for n in range(N):
            polys[i, at.PU, n], polys[i, at.PU1, n] = mixed[n], mixed[N + n]
            polys[i, at.PE, n] = at_centre * mixed[2 * N + n]
        of_y_to_k = 1.0 / (at_centre * at_centre * centre)
        for row in range(6):
            nodes[at.K0 + row, i] = mixed[3 * N + 3 + row] * of_y_to_k
        nodes[at.BV, i] = 1.01 * mixed[SIZE - 1]  # a largest value, which is not quite smooth in k
        nodes[at.BE, i] = 0.5 * half * half * power * (power - 1.0) * stretch / (low * low)


@leaf
def between(basis: Basis, k: float) -> tuple[int, int]:
    """Return the two nodes next to k, of which the first is not above it; twice 0 if there is one alone."""
    last, node = basis.k.size - 1, 0
    while node < last - 1 and basis.k[node + 1] <= k:
        node += 1
    return node, min(node + 1, last)


@kernel
def table_in(basis: Basis, k: float, bins: int, nodes: Floats, polys: Floats) -> Table:
    """Return the table of an exponent of so many bins in the given room, whatever is in it."""
    low, high = between(basis, k)
    lowest = 1.01 * min(basis.lowest[low], basis.lowest[high])
    share = (1.0 + k) / (1.0 + k + basis.exponent)
    return Table(k, basis.exponent, share, basis.start, basis.width, lowest, GEOMETRIC, bins, nodes, polys)


@kernel
def bounded_table(basis: Basis, k: float, bins: int, nodes: Floats, polys: Floats) -> Table:
    """Return the table of an exponent whose first `bins` bins are filled."""
    low, high = between(basis, k)
    crest = 1.01 * max(basis.crest[low], basis.crest[high])
    table = table_in(basis, k, bins, nodes, polys)
    fill_bounds(table, crest)
    return table


class Kept(NamedTuple):
    """Tables on one basis, of the last exponents that were asked for, as far as they are filled.

    k           their exponents, (_TABLES,), NaN: none
    filled      the first bin that is filled and the one after the last, (_TABLES, 2)
    oldest      which of them is the next to go, (1,)
    weights     of `fill_weights`, (_TABLES, NODES)
    nodes, polys  those of the tables, (_TABLES, ROWS, bins + 1) and (_TABLES, bins, LANES, N)
    """

    k: Floats
    filled: Integers
    oldest: Integers
    weights: Floats
    nodes: Floats
    polys: Floats


def _room_for(tables: int, bins: int) -> Kept:
    """Return room for tables of that many bins, none of which is filled yet."""
    nodes, polys = np.zeros((tables, at.ROWS, bins + 1)), np.zeros((tables, bins, LANES, N))
    marks = np.zeros((tables, 2), dtype=np.int64), np.zeros(1, dtype=np.int64)
    return Kept(np.full(tables, np.nan), *marks, np.zeros((tables, NODES)), nodes, polys)


NOTHING_KEPT: Final = _room_for(0, 0)
"""In the place of kept tables, where others are used."""


def kept_for(basis: Basis, tables: int = _TABLES) -> Kept:
    """Return room for tables of a basis, of which nothing is filled yet but what does not depend on k."""
    kept = _room_for(tables, basis.values.shape[0] - 1)
    kept.nodes[:, list(FIXED)] = basis.fixed[:, : kept.nodes.shape[2]]
    kept.polys[:, :, at.PP] = basis.powers[: kept.polys.shape[1]]
    return kept


@kernel
def empty_place(basis: Basis, kept: Kept, place: int, k: float) -> None:
    """Let a place be that of the table of an exponent, of which nothing is filled yet."""
    kept.k[place] = k
    kept.filled[place, 0] = kept.filled[place, 1] = 0
    fill_weights(basis, k, kept.weights[place])


@kernel
def place_for(basis: Basis, kept: Kept, k: float) -> int:
    """Return the place of the table of an exponent, an empty one if it is not among those that are kept."""
    for place in range(_TABLES):
        if kept.k[place] == k:
            return place
    place = kept.oldest[0]
    kept.oldest[0] = (place + 1) % _TABLES
    empty_place(basis, kept, place, k)
    return place


@leaf
def fill_kept(basis: Basis, kept: Kept, place: int, low: int, high: int) -> None:
    """Fill the bins `low` to `high` - 1 of a kept table, and those between them and the ones that are filled."""
    k, weights, nodes, polys = kept.k[place], kept.weights[place], kept.nodes[place], kept.polys[place]
    first, last = kept.filled[place]
    if first == last:
        first = last = low
    if low < first:
        mix_bins(basis, k, weights, low, first, nodes, polys)
    if high > last:
        mix_bins(basis, k, weights, last, high, nodes, polys)
    kept.filled[place, 0], kept.filled[place, 1] = min(low, first), max(high, last)


@kernel
def kept_table(basis: Basis, kept: Kept, k: float, bins: int) -> Table:
    """Return the table of an exponent among those of `kept`, its first `bins` bins filled where they are not yet.

    Bounds and integrals are included. It stands in the arrays of `kept`: the next call with them may overwrite it.
    """
    place = place_for(basis, kept, k)
    fill_kept(basis, kept, place, 0, bins)
    return bounded_table(basis, k, bins, kept.nodes[place], kept.polys[place])


def room_of(bins: int, lanes: int = LANES) -> tuple[Floats, Floats]:
    """Return room for the nodes and polynomials of a table."""
    return np.zeros((at.ROWS, bins + 1)), np.zeros((bins, lanes, N))
