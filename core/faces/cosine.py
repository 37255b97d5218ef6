"""The answers of one cosine on a paraboloid under displacement control (core/face.py)."""

from gradhesion.core import face
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.branches import GAP, RUN, Trace, ends, find_depth
from gradhesion.core.curve.cosine import Cosine, depth_size, most_depth_size, slope
from gradhesion.core.curve.cosine_energy import energy_from_zero, jump_energy
from gradhesion.core.types import Table


@face.find_place.answers(Cosine)
@kernel()
def find_place(table: Table, curve: Cosine, level: float, trace: Trace, branch: int) -> float:
    return find_depth(table, curve, level, ends(trace, branch))


face.loss_between.answers(Cosine)(jump_energy)


@face.loss_from_zero.answers(Cosine)
@kernel()
def loss_from_zero(table: Table, curve: Cosine, x: float) -> float:
    return energy_from_zero(table, curve, x, 0.0)


@face.loss_to_zero.answers(Cosine)
@kernel()
def loss_to_zero(table: Table, curve: Cosine, x: float, level: float) -> float:
    return -energy_from_zero(table, curve, x, level)


@face.depth_at.answers(Cosine)
@kernel()
def depth_at(_table: Table, _curve: Cosine, _x: float, level: float) -> float:
    """Return the depth: it is the coordinate."""
    return level


face.size_at.answers(Cosine)(depth_size)
face.most_size_at.answers(Cosine)(most_depth_size)


@face.fold_at.answers(Cosine)
@kernel()
def fold_at(table: Table, curve: Cosine, x: float) -> tuple[float, float]:
    value, rate, _, _ = slope(table, curve, 0.5 * (1.0 - table.k), x)
    return value, rate


@face.gap_in.answers(Cosine)
@kernel()
def gap_in(_curve: Cosine, trace: Trace) -> float:
    gap: float = trace[RUN, GAP]
    return gap
