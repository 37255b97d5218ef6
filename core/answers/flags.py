"""Flags of results of several scenes, in addition to those of one scene (problem/status.py)."""

from typing import Final

from gradhesion.core.problem.status import OF_LOOPS, OF_SCENES, Flag

LINEAR_DEVIATION_OFF: Final = 128
"""The linear standard deviation is wrong, because a kink lies within the spread of the inputs or the value bends: by
more than a tenth of that of the samples or, without samples, by 2 % at 32 test samples. With [uncertainty] only."""
RESOLUTION_TOO_COARSE: Final = 256
"""A sweep finer than the stated resolution finds another optimum, and there may be more between its points. Optima
only."""
NOTHING_FEASIBLE: Final = 512
"""No point of the sweep meets the requirements. Optima only."""

_OF_ANSWERS: Final = (
    Flag(
        LINEAR_DEVIATION_OFF,
        "linear_deviation_off",
        "a linear standard deviation is off: the value bends, or a kink is near",
    ),
    Flag(RESOLUTION_TOO_COARSE, "resolution_too_coarse", "a sweep finer than the resolution finds another optimum"),
    Flag(NOTHING_FEASIBLE, "nothing_feasible", "no point of the sweep meets the requirements"),
)
ANSWER_FLAGS: Final = {flag.name: flag.bit for flag in _OF_ANSWERS}
"""Name of every flag of answers, with its bit."""
_BY_BIT: Final = sorted((*OF_SCENES, *_OF_ANSWERS), key=lambda flag: flag.bit)
FLAGS: Final = {flag.name: flag.bit for flag in _BY_BIT}
"""Name of every flag of a dataset, with its bit, in the order of the bits."""
FLAG_WORDS: Final = {flag.name: flag.about for flag in (*_BY_BIT, *OF_LOOPS)}
"""Every flag of `status`, in words."""
