"""What a user should know of a fit: where its cycle leaves the model, and what the loop cannot tell apart."""

from collections.abc import Iterator
from typing import Final

import numpy as np

from gradhesion.cli.dataset.cautions import CONE
from gradhesion.cli.dataset.read.model_range import tabor_warnings
from gradhesion.cli.study.fit.study import FitStudy
from gradhesion.cli.work.solve.fitting import range_words, tabor_of
from gradhesion.core.closed.reach import SMALL, is_steep, slopes_of
from gradhesion.core.loops.fitted import FittedLoop
from gradhesion.core.loops.paths.offsets import NAMES as OFFSETS

_CLEAR: Final = 6.0
"""Standard deviations of a tilt that noise does not make: the points of the base line were chosen as level ones."""


def cautions_of_fit(study: FitStudy, found: FittedLoop) -> Iterator[str]:
    """Say where a fitted cycle leaves the range of the model, and what its loop cannot tell apart."""
    if study.profile.exponent == 1.0:
        yield CONE.format("the loop")
    elif is_steep(slopes_of(np.array(found.turning_radius), study.profile)):
        yield (
            f"contact reaches a = {found.turning_radius:.3g} R, where the punch has a slope above {SMALL:g}, which is "
            "not small: the fitted values may be off"
        )
    yield from tabor_warnings(tabor_of(study, found), range_words(study))
    yield from tilt_warnings(found)
    yield from found.alike


def tilt_warnings(found: FittedLoop) -> Iterator[str]:
    """Say that a base line is not level where that is clear and no tilt is fitted."""
    line = found.base_line
    if line is None or OFFSETS[2] in found.names or abs(line.slope) <= _CLEAR * line.slope_deviation:
        return
    yield (
        f"the base line is tilted by {line.slope:.3g} N/m, {abs(line.slope) / line.slope_deviation:.0f} standard "
        "deviations: write offsets = { slope = true } under [fit]"
    )
