"""Which flags of `status` cast doubt on a variable of a dataset, whatever it says of its output."""

from typing import Final

from xarray import Dataset

from gradhesion.cli.dataset.read.reader import is_turned
from gradhesion.cli.names.curves import curve_of
from gradhesion.cli.names.outputs import BEST, value_of
from gradhesion.core import doubts_about
from gradhesion.core.answers.flags import LINEAR_DEVIATION_OFF, RESOLUTION_TOO_COARSE
from gradhesion.core.problem.status import DOUBTFUL

DOUBTS: Final = DOUBTFUL | LINEAR_DEVIATION_OFF | RESOLUTION_TOO_COARSE
"""All bits that cast doubt on some variable."""


def doubts_of(variable: str, dataset: Dataset) -> int:
    """
    Give the bits that cast doubt on a variable of a dataset.

    >>> doubts_of("dissipated_energy_si", Dataset()) == doubts_of("path_load", Dataset()) == DOUBTFUL
    True
    >>> doubts_of("delta_max_std_si", Dataset()) & ~doubts_of("delta_max", Dataset()) == LINEAR_DEVIATION_OFF
    True
    """
    plain = value_of(variable)
    bits = doubts_about(curve_of(plain) or plain, turned=is_turned(dataset))
    if variable.startswith(BEST):
        bits |= RESOLUTION_TOO_COARSE
    sampled = any(str(name).removesuffix("_si").endswith("_std_linear") for name in dataset.data_vars)
    linear = ("_std_linear",) if sampled else ("_std", "_std_linear")  # the deviation of samples is as good as these
    return bits | LINEAR_DEVIATION_OFF if variable.removesuffix("_si").endswith(linear) else bits
