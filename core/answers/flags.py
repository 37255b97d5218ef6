"""Flags of results of several scenes, in addition to those of one scene (problem/status.py)."""

from typing import Final

from gradhesion.core.problem.status import FLAGS as OF_SCENES

LINEAR_DEVIATION_OFF: Final = 128
"""The linear standard deviation is wrong, because a kink lies within the spread of the inputs or the value bends: by
more than a tenth of that of the samples or, without samples, by 2 % at 32 test samples. With [uncertainty] only."""
RESOLUTION_TOO_COARSE: Final = 256
"""A sweep finer than the stated resolution finds another optimum, and there may be more between its points. Optima
only."""
NOTHING_FEASIBLE: Final = 512
"""No point of the sweep meets the requirements. Optima only."""

ANSWER_FLAGS: Final = {
    "linear_deviation_off": LINEAR_DEVIATION_OFF,
    "resolution_too_coarse": RESOLUTION_TOO_COARSE,
    "nothing_feasible": NOTHING_FEASIBLE,
}
"""Name of every flag of answers, with its bit."""
FLAGS: Final = dict(sorted((OF_SCENES | ANSWER_FLAGS).items(), key=lambda flag: flag[1]))
"""Name of every flag of a dataset, with its bit, in the order of the bits."""
