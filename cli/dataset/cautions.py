"""What a user should know of a dataset that is written: cells whose answers may not hold, as a share of all."""

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.study.study import Study
from gradhesion.cli.terminal.amounts import counted
from gradhesion.core.answers.flags import ANSWER_FLAGS


def flagged_in(status: NDArray[np.integer]) -> dict[str, int]:
    """Count the cells that have each flag of answers."""
    return {name: int(np.count_nonzero(status.astype(np.int16) & bit)) for name, bit in ANSWER_FLAGS.items()}


def cautions(study: Study, flagged: Mapping[str, int]) -> Iterator[str]:
    """Say of each flag in what share of the cells it is set, and what to do."""
    coarse, nothing = flagged.get("resolution_too_coarse", 0), flagged.get("nothing_feasible", 0)
    if coarse:
        share = f"{coarse:,} of {counted(study.scenes, 'scene')}"
        yield (
            f"a sweep finer than the resolution finds another optimum in {share}, and there may be more between; raise "
            f"resolution = {study.search.resolution} under [optimum]"
        )
    if nothing:
        yield (
            f"no point meets the requirements in {nothing:,} of {counted(study.scenes, 'scene')}, which have no "
            "optimum; require less, or widen the bounds"
        )
    off = flagged.get("linear_deviation_off", 0)
    if off:
        share = f"{off:,} of {counted(study.scenes, 'scene')} ({off / study.scenes:.1%})"
        if study.uncertainty.samples:
            yield (
                f"the linear and the sampled standard deviation differ by more than a tenth in {share}: a kink lies "
                "within the spread of the inputs, or the value bends; use the samples there"
            )
        else:
            yield (
                f"the linear standard deviation is off in {share}: a kink lies within the spread of the inputs, or the "
                "value bends; draw samples there, with samples = 1024 under [uncertainty]"
            )
