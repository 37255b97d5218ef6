"""The names that a study may use, from what is declared of them: importing them costs no compiler and no solver."""

from typing import Final

from gradhesion.core.problem import outputs
from gradhesion.core.problem.inputs import parameters_in
from gradhesion.core.problem.outputs import outputs_in

PARAMETERS: Final = parameters_in("")
"""The seven parameters of a scene, in the order of a dataset's dimensions."""
RESULTS: Final = outputs_in("cycle")
"""The results of a cycle, in the order of their rows."""
INTEGERS: Final = tuple(name for name, one in outputs.OUTPUTS.items() if one.is_count)
"""Those of them that are counts."""
EXACT_ALONE: Final = tuple(name for name, one in outputs.OUTPUTS.items() if one.exact_alone)
"""Those that the exact solver alone has."""
EDGE: Final = outputs_in("edge")
"""Further results of a cycle whose edge opens at a larger work of adhesion than it closes at (scenes/results.py)."""
RATE: Final = outputs_in("rate")
"""Further results of a cycle whose edge opens at a work that grows with its speed (rate/cycle.py)."""
OUTPUTS: Final = outputs_in("cycle", "turn")
"""All results of a scene: those of its cycle, and where it turns."""
REACH: Final = "reach"
"""The largest end of a jump of an unbounded punch, a/R: `contact_slope` is computed from it (closed/reach.py)."""
CONTACT_SLOPE: Final = "contact_slope"
"""The slope (a/R)^(m-1) of the punch at the largest radius on which the other outputs depend (closed/reach.py)."""
TURNS: Final = parameters_in("turn")
"""Where the cycle turns before the rim, at most one of them: a depth in R, or a load in 1.5 pi R dgamma."""
PATTERN: Final = parameters_in("toughness")
"""The parameters of a pattern of toughness (problem/toughness.py); the amplitude is 1 where it is not given."""
(SPEED,) = parameters_in("rate")
"""The parameter V/v* of an edge whose work grows with its speed (problem/toughness.py); 0 where it is not given."""
(CLOSING,) = parameters_in("works")
"""The parameter w_c/w_o in [0, 1]: the work of adhesion of closing over that of opening; 1 where it is not given."""
(MACHINE,) = parameters_in("machine")
"""The parameter S/(E* R) of a machine of finite stiffness (problem/control.py)."""
PULL_OFF: Final = tuple(name for name in RESULTS if outputs.OUTPUTS[name].depends_on == "pull-off")
"""The results that need no path of loading and unloading."""
REPORTS: Final = outputs_in("report")
"""All other outputs on request, in the order of their rows."""
SENSITIVITIES: Final = outputs_in("sensitivity")
"""How strongly a value depends on each parameter: along a last axis of parameters."""
VALIDITY: Final = outputs_in("validity")
"""Measures of where the model applies (closed/applicability.py): they need no solution, whatever the solver."""
(RANGE,) = parameters_in("range")
"""The parameter of the Tabor parameters: the range of the attraction."""
GIVEN_UP: Final = outputs.GIVEN_UP
"""Outputs of earlier versions, with what stands in their place."""
SOLVERS: Final = ("exact", "asymptotic", "envelope")
"""The exact one; and for wavelengths far below the contact radius the leading term, and its envelopes."""
WITHOUT_LOAD: Final[dict[str, str]] = {
    "asymptotic": "the leading terms of depth and load belong to one energy only up to the order of lambda/a, so that "
    "under a load the work of a cycle would not be what its jumps lose",
    "envelope": "the path along the envelopes jumps into and out of contact at a constant depth; under a load or "
    "through a spring it leaves them at other radii, and loses what the load does in its fall, or the spring in its "
    "recoil",
}
"""Why the other solvers, and the curves of short waves, have displacement control only."""
GENERAL_CURVES: Final = tuple(
    name for name, curve in outputs.CURVES.items() if not (curve.needs_depth or curve.of_a_state)
)
"""The curves of any profile under any control."""
PATTERN_CURVES: Final = tuple(name for name, curve in outputs.CURVES.items() if curve.knows_pattern)
"""The curves of an interface whose toughness varies with the radius."""
CURVES: Final = {
    name: tuple(one for one in curve.names if one != curve.count)
    for name, curve in outputs.CURVES.items()
    if not curve.of_a_state
}
"""The variables of every curve of a scene, in order; those of the jumps have an item a jump, the others a point."""
