"""What a user should know of a fit: where its cycle leaves the model, and what the loop cannot tell apart."""

from collections.abc import Iterator

import numpy as np

from gradhesion.cli.dataset.cautions import CONE
from gradhesion.cli.dataset.model_range import tabor_warnings
from gradhesion.cli.study.fit_study import FitStudy
from gradhesion.cli.work.fitting import range_words, tabor_of
from gradhesion.core.arrays.reach import SMALL, is_steep, slopes_of
from gradhesion.core.loops.fitted import FittedLoop


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
    yield from found.alike
