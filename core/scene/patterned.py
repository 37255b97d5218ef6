"""What scenes on an interface whose toughness varies with the radius do in a way of their own (scene/general_rim.py).

Each wave is walked, to the last fold.
"""

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.branches import ARRIVAL, Trace
from gradhesion.core.curve.general import Basis, Patterned
from gradhesion.core.curve.patterned import are_too_many
from gradhesion.core.path.loading import highest_depth, loading_to
from gradhesion.core.path.unloading import unloading_from
from gradhesion.core.problem.results import Cycle, Results
from gradhesion.core.problem.status import TOO_MANY_WAVES
from gradhesion.core.scene import general_rim
from gradhesion.core.scene.scene import refuse
from gradhesion.core.types import Floats


@general_rim.cycle_to.answers(Patterned)
@kernel()
def cycle_to(
    basis: Basis, curve: Patterned, count: int, trace: Trace, x: float, level: float, losses: bool, _stations: Floats
) -> Cycle:
    """Return it jump by jump."""
    loaded, jumps = loading_to(basis, curve, count, trace, x, losses)
    if count > 0 and trace[ARRIVAL, 0] == 0.0:  # without adhesion at the centre contact grows from a point
        jumps -= 1.0
    unloaded, jumps_back, last = unloading_from(basis, curve, count, trace, x, level, losses)
    return Cycle(loaded, jumps, unloaded, jumps_back, last, highest_depth(count, trace, x, level))


@general_rim.shares_trace.answers(Patterned)
@kernel()
def shares_trace(basis: Basis, _curve: Patterned, bounds: tuple[float, float], x: float) -> bool:
    """Return whether there are not too many waves: all others share a trace."""
    return not are_too_many(basis, bounds[0], min(x, bounds[1]))


@general_rim.is_left.answers(Patterned)
@kernel()
def is_left(curve: Patterned, results: Results, i: int) -> bool:
    """Refuse it."""
    general_rim.refuse_waves(curve, results, i)
    return False


@general_rim.refuse_waves.answers(Patterned)
@kernel()
def refuse_waves(_curve: Patterned, results: Results, i: int) -> None:
    """Flag it as well."""
    refuse(results, i)
    results.status[i] |= TOO_MANY_WAVES
