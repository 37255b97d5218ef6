"""Which flags of `status` cast doubt on a variable of a dataset, whatever it says of its output."""

from typing import Final

from gradhesion.cli.names.curves import curve_of
from gradhesion.cli.names.outputs import BEST, value_of
from gradhesion.core import doubts_about
from gradhesion.core.answers.flags import LINEAR_DEVIATION_OFF, RESOLUTION_TOO_COARSE
from gradhesion.core.problem.status import DOUBTFUL

DOUBTS: Final = DOUBTFUL | LINEAR_DEVIATION_OFF | RESOLUTION_TOO_COARSE
"""All bits that cast doubt on some variable."""


def doubts_of(variable: str, *, turned: bool = False, sampled: bool = False) -> int:
    """
    Give the bits that cast doubt on a variable; `sampled` says that its dataset has deviations of samples.

    >>> doubts_of("dissipated_energy_si") == doubts_of("path_load") == DOUBTFUL
    True
    >>> doubts_of("delta_jump_out_std_si") & ~doubts_of("delta_jump_out") == LINEAR_DEVIATION_OFF
    True
    """
    plain = value_of(variable)
    bits = doubts_about(curve_of(plain) or plain, turned=turned)
    if variable.startswith(BEST):
        bits |= RESOLUTION_TOO_COARSE
    linear = ("_std_linear",) if sampled else ("_std", "_std_linear")
    return bits | LINEAR_DEVIATION_OFF if variable.removesuffix("_si").endswith(linear) else bits
