"""A study's dataset in memory, as xarray reads that which a run writes; its attributes, and what to know of it."""

import math
import platform
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from importlib.metadata import version
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.dataset.describe import steep_contact, variables
from gradhesion.cli.dataset.read.model_range import STEEPEST, steepness
from gradhesion.cli.names.curves import INTEGERS, is_ragged
from gradhesion.cli.names.scenes import REFERENCES, STEEP
from gradhesion.cli.study.fit.study import FitStudy
from gradhesion.cli.study.shape_words import profile_table, rate_in_words, shape_in_words, toughness_in_words
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Tiling
from gradhesion.cli.terminal import messages
from gradhesion.cli.terminal.amounts import counted, share_of
from gradhesion.cli.work.compiling import prepare
from gradhesion.cli.work.solve.blocks import in_threads, within
from gradhesion.cli.work.solve.scenes import Arrays, blank_of
from gradhesion.core.answers.flags import ANSWER_FLAGS
from gradhesion.core.closed.reach import SMALL, depends_on_contact
from gradhesion.core.problem.profile import rows_of
from gradhesion.core.problem.status import FLAGS

if TYPE_CHECKING:
    import xarray


CONE: Final = "the punch is a cone of slope 1, which is not small, at every contact radius of {}"
"""What is said once of a study of a cone."""
_MANY: Final = 0.1
"""The share of scenes from which on it is said that they are not one disc."""
_NOT_ONE_DISC: Final = "loading_contact_not_one_disc"
_SAID: Final = {
    "steep": f"contact reaches slopes above {SMALL:g} (a > R) in {{share}}: not small; bound a_max or indentation_max",
    "waves": f"the waves have slopes above {STEEPEST:g} in {{share}}, which are not small; lower A",
    _NOT_ONE_DISC: "contact on loading is not one disc in {share}, and its values doubtful; lower A (johnson_alpha)",
    "resolution_too_coarse": "a finer sweep finds another optimum in {share}; raise optimum.resolution ({resolution})",
    "nothing_feasible": "no point meets the requirements in {share}; require less, or widen the bounds",
    "linear_deviation_off": "the linear deviation is off in {share}: the value bends; see uncertainty.samples",
}
"""What is said of a share of the scenes, most of it by the flag."""


def compute(study: Study, *, threads: int | None = None) -> "xarray.Dataset":
    """Compute a study in memory.

    Parameters
    ----------
    study
        From `load_study` or `study_from`.
    threads
        Threads to use, as many as the process may use if None; the values do not depend on it.

    Returns
    -------
    The dataset that `gradhesion run` writes to a file, as xarray reads it.

    Notes
    -----
    The first study of a version compiles the solver, which a line on stderr reports.
    """
    prepare(study)
    found = _joined(study, in_threads(study, range(len(study.tiling)), threads))
    steep = int(np.count_nonzero(found.get(STEEP, 0)))
    messages.say(*(f"{study.name}: {sentence}" for sentence in cautions(study, flagged_in(found["status"]), steep)))
    return assembled(study, found, "computed in memory")


def _joined(study: Study, parts: Iterable[tuple[int, Arrays]]) -> Arrays:
    """Join blocks, padded to the longest where their lengths differ: those of curves, and of fronts."""
    parts = parts if study.in_blocks else list(parts)  # of maps one at a time is in memory
    whole: Arrays = {}
    for number, values in parts:
        block = study.tiling[number]
        for name, part in values.items():
            if is_ragged(name):
                continue
            if name not in whole:
                every = [part] if study.in_blocks else [one[name] for _, one in parts]
                longest = np.max([one.shape[len(block) :] for one in every], axis=0).astype(int)
                blank = blank_of(name) if part.dtype.kind == "f" or name in INTEGERS else 0
                whole[name] = np.full((*study.shape, *longest), blank, part.dtype)
            whole[name][within(name, block, part)] = part
    ragged = [name for name in study.variables if is_ragged(name)]
    return whole | {name: np.concatenate([values[name] for _, values in parts]) for name in ragged}


def assembled(study: Study, found: Mapping[str, NDArray[Any]], history: str) -> "xarray.Dataset":
    """Put the values of all variables, and the marks of steep contacts, into the dataset of a study."""
    import xarray  # noqa: PLC0415 (450 ms that `run` does not need)

    made = {}
    for name, variable in variables(study).items():
        if variable.made:
            values = variable.made(tuple(slice(0, study.axes[axis]) for axis in variable.dimensions))
        else:
            values = found[name] if variable.values is None else variable.values
        blank = {} if variable.blank is None else {"_FillValue": values.dtype.type(variable.blank)}
        made[name] = xarray.Variable(variable.dimensions, values, variable.attributes | blank)
    coded = xarray.Dataset(made, attrs=attributes(study, history))
    return with_steep_contact(xarray.decode_cf(coded), study, found.get(STEEP, np.zeros(1, np.int8)))


def with_steep_contact(dataset: "xarray.Dataset", study: Study, steep: NDArray[np.int8]) -> "xarray.Dataset":
    """Mark the scenes of a dataset in memory whose contact reaches a slope that is not small, if any does."""
    variable = steep_contact(study) if steep.any() else None
    return dataset.assign_coords({STEEP: (dataset["status"].dims, steep, variable.attributes)}) if variable else dataset


def attributes(study: Study, history: str) -> dict[str, Any]:
    """List the global attributes of a study's dataset: what it is, where it comes from, how to make it again."""
    own: dict[str, Any] = {"profile": shape_in_words(study.profile, study.spectrum)}
    if (fit := study.measured.fit) is not None:
        own |= {"profile_file": study.measured.file, "profile_sha256": study.measured.sha256}
        own |= {"profile_fit": profile_table(study.profile)}
        own |= {"profile_residual_rms": fit.residual_rms, "profile_residual_max": fit.residual_max}
    return origin(study, history, own | driven_in_words(study))


def driven_in_words(study: Study | FitStudy) -> dict[str, Any]:
    """Say how the punch is driven; how its toughness varies, and grows with the speed of its edge, if it does."""
    toughness = {} if study.toughness is None else {"toughness": toughness_in_words(study.toughness)}
    rate = {} if study.rate is None else {"rate": rate_in_words(study.rate)}
    return {"control": study.loading.control, **toughness, **rate}


def origin(study: Study | FitStudy, history: str, own: Mapping[str, Any]) -> dict[str, Any]:
    """List the global attributes of any dataset, those of its `own` among them."""
    known = _versions()
    return {
        "Conventions": "CF-1.11",
        "title": study.title,
        "source": f"gradhesion {known['gradhesion_version']}",
        "history": history,
        "references": REFERENCES,
        **own,
        "study": study.text,
        "study_sha256": study.sha256,
        **{name: one for name, one in known.items() if name != "gradhesion_version"},
    }


@cache
def _versions() -> Mapping[str, str]:
    """List the versions of what the values come from, which are read once: that takes a millisecond each."""
    packages = {f"{package}_version": version(package) for package in ("gradhesion", "numpy", "numba", "scipy")}
    return {"python_version": platform.python_version(), **packages}


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
            yield sentence.format(share=share_of(count, study.scenes), resolution=study.search.resolution)


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
