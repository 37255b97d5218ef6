"""What a user should know of a dataset that is written: cells whose answers may not hold, as a share of all."""

import math
from collections.abc import Iterator, Mapping
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.dataset.describe import variables
from gradhesion.cli.dataset.read.model_range import STEEPEST, steepness
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Tiling
from gradhesion.cli.terminal.amounts import counted, percent
from gradhesion.core.answers.flags import ANSWER_FLAGS
from gradhesion.core.closed.reach import SMALL, depends_on_contact
from gradhesion.core.problem.profile import rows_of
from gradhesion.core.problem.status import FLAGS

CONE: Final = "the punch is a cone of slope 1, which is not small, at every contact radius of {}"
"""What is said once of a study of a cone."""
_MANY: Final = 0.1
"""The share of scenes from which on it is said that they are not one disc."""
_NOT_ONE_DISC: Final = "loading_contact_not_one_disc"
_SAID: Final = {
    "steep": (
        f"contact reaches slopes of the punch above {SMALL:g} (a > R) in {{share}}, which are not small; bound it with "
        "a_max_over_R or indentation_max_over_R"
    ),
    "waves": f"the waves have slopes above {STEEPEST:g} in {{share}}, which are not small; lower A",
    _NOT_ONE_DISC: (
        "contact on loading is not one disc in {share}: values of loading are doubtful there; lower A, or look at "
        "johnson_alpha"
    ),
    "resolution_too_coarse": (
        "a sweep finer than the resolution finds another optimum in {share}, and there may be others; raise "
        "resolution = {resolution} under [optimum]"
    ),
    "nothing_feasible": (
        "no point meets the requirements in {share}, which have no optimum; require less, or widen the bounds"
    ),
    "linear_deviation_off": (
        "the linear standard deviation is off in {share}: a kink lies within the spread of the inputs, or the value "
        "bends; use that of samples, with samples = 1024 under [uncertainty]"
    ),
}
"""What is said of a share of the scenes, most of it by the flag."""


def flagged_in(status: NDArray[np.integer]) -> dict[str, int]:
    """Count the cells that have each flag that there is something to say of."""
    flags = ANSWER_FLAGS | {_NOT_ONE_DISC: FLAGS[_NOT_ONE_DISC]}
    return {name: int(np.count_nonzero(status.astype(np.int16) & bit)) for name, bit in flags.items()}


def cautions(study: Study, flagged: Mapping[str, int], steep: int = 0) -> Iterator[str]:
    """Say of each flag in what share of the cells it is set, and what to do; and how many contacts are `steep`."""
    if study.is_cone and depends_on_contact(study.solved):
        yield CONE.format(f"all of {counted(study.scenes, 'scene')}")
        steep = 0
    counts = {"steep": steep, "waves": _steep_waves(study), **flagged}
    if counts.get(_NOT_ONE_DISC, 0) < _MANY * study.scenes:
        counts[_NOT_ONE_DISC] = 0
    for name, sentence in _SAID.items():
        if count := counts.get(name):
            share = f"{count:,} of {counted(study.scenes, 'scene')} ({percent(count, study.scenes)})"
            yield sentence.format(share=share, resolution=study.search.resolution)


def _steep_waves(study: Study) -> int:
    """Count the scenes whose waves are steep; 0 where the study asks for their slope itself, or searches A."""
    amplitude = variables(study).get("A")
    if amplitude is None or "wave_slope" in study.variables:
        return 0
    _, _, profiles = study.apart(tuple(slice(0, size) for size in study.shape))
    slopes = [steepness(rows_of(profile)) for profile in profiles]
    sizes = [study.axes[axis] for axis in amplitude.dimensions]
    steep = 0
    for block in Tiling(tuple(sizes)):
        values = amplitude.made(block) if amplitude.made else np.asarray(amplitude.values)[block]
        steep += sum(int(np.count_nonzero(values * slope > STEEPEST)) for slope in slopes)
    return steep * study.scenes // (math.prod(sizes) * len(slopes))
