"""What casts doubt on values of a dataset: flags of `status`, and numbers beyond the range of the model."""

import math
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from operator import gt, lt
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.reader import tiling_of
from gradhesion.cli.names.curves import curve_of
from gradhesion.cli.names.outputs import BEST, value_of
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.study.tiling import Block, Tiling
from gradhesion.cli.terminal.amounts import counted, share_of
from gradhesion.core import doubts_about
from gradhesion.core.answers.flags import ANSWER_FLAGS, LINEAR_DEVIATION_OFF, RESOLUTION_TOO_COARSE
from gradhesion.core.closed.reach import SMALL, depends_on_contact
from gradhesion.core.problem.names import CONTACT_SLOPE, RANGE, TURNS
from gradhesion.core.problem.profile import Harmonic, Profile, rows_of, swings
from gradhesion.core.problem.status import DOUBTFUL, FLAGS

if TYPE_CHECKING:
    import netCDF4
    import xarray

    from gradhesion.cli.study.study import Study

    Amplitude = xarray.DataArray | netCDF4.Variable[Any]

DOUBTS: Final = DOUBTFUL | LINEAR_DEVIATION_OFF | RESOLUTION_TOO_COARSE
"""All bits that cast doubt on some variable."""
SHORT_RANGED: Final = 5.0
"""The Tabor parameter from which on JKR holds (Johnson & Greenwood 1997)."""
LONG_RANGED: Final = 0.1
"""The Tabor parameter up to which the limit of Derjaguin, Muller & Toporov holds instead."""
ONE_DISC: Final = 2.0 / np.sqrt(np.pi)
"""Johnson's alpha at chi = 1/2, up to which short waves keep the contact one disc (docs/theory.md, section 12)."""
STEEPEST: Final = 0.5
"""A slope of waves that is no longer small: a linear half-space errs by about its square."""
CONE: Final = "the punch is a cone of slope 1, which is not small, at every contact radius of {}"
"""What is said once of a study of a cone."""
_MANY: Final = 0.1
"""The share of scenes from which on it is said that they are not one disc."""
_NOT_ONE_DISC: Final = "loading_contact_not_one_disc"
_SAID: Final = {
    "steep": f"contact reaches slopes above {SMALL:g} (a > R) in {{share}}: not small; bound a_max or indentation_max",
    "waves": f"the waves have slopes above {STEEPEST:g} in {{share}}, which are not small; lower A",
    _NOT_ONE_DISC: "contact on loading is not one disc in {share}, and its values doubtful; lower A, which raises "
    "the output johnson_alpha above 1.13",
    "resolution_too_coarse": "a finer sweep finds another optimum in {share}; raise optimum.resolution ({resolution})",
    "nothing_feasible": "no point meets the requirements in {share}; require less, or widen the bounds",
    "linear_deviation_off": "the linear deviation is off in {share}: the value bends; see uncertainty.samples",
}
"""What is said of a share of the scenes of a run, most of it by the flag."""


def doubts_of(variable: str, dataset: "xarray.Dataset") -> int:
    """Give the bits that cast doubt on a variable of a dataset, whatever it says of its output.

    >>> import xarray
    >>> none = xarray.Dataset()
    >>> doubts_of("dissipated_energy_si", none) == doubts_of("path_load", none) == DOUBTFUL
    True
    >>> doubts_of("delta_max_std_si", none) & ~doubts_of("delta_max", none) == LINEAR_DEVIATION_OFF
    True
    """
    plain = value_of(variable)
    turned = any(name in dataset.coords for name in TURNS)  # at a depth or a load: loading decides on all that follows
    bits = doubts_about(curve_of(plain) or plain, turned=turned)
    if variable.startswith(BEST):
        bits |= RESOLUTION_TOO_COARSE
    sampled = any(str(name).removesuffix("_si").endswith("_std_linear") for name in dataset.data_vars)
    linear = ("_std_linear",) if sampled else ("_std", "_std_linear")  # the deviation of samples is as good as these
    return bits | LINEAR_DEVIATION_OFF if variable.removesuffix("_si").endswith(linear) else bits


class Limit(NamedTuple):
    """When a validity number leaves the range of the model, and what that means."""

    compare: Callable[[Any, float], Any]
    value: float
    condition: str
    words: str


LIMITS: Final = {
    "tabor_parameter": Limit(lt, SHORT_RANGED, f"below {SHORT_RANGED:g}", "the attraction is too long-ranged for JKR"),
    "wave_tabor_parameter": Limit(
        lt, SHORT_RANGED, "below 5, waves higher than the range", "the attraction is too long-ranged for the crests"
    ),
    "wave_slope": Limit(gt, STEEPEST, f"above {STEEPEST:g}", "slopes are not small, as a linear half-space needs"),
    "johnson_alpha": Limit(lt, ONE_DISC, "below 1.13 (chi above 1/2)", "contact on loading may not be one disc"),
    CONTACT_SLOPE: Limit(gt, SMALL, f"above {SMALL:g} (a > R)", "contact reaches slopes that are not small"),
}
"""By the validity number."""


def beyond_by(number: str, dataset: "xarray.Dataset", block: Block = ()) -> "xarray.DataArray | None":
    """Report which scenes of a dataset, or a block of them, a validity number puts beyond its limit; None: unknown.

    The slope of the contact is known of every scene: what is not marked is within its limit.
    """
    if number in dataset.data_vars:
        part = dataset[number][block]
        beyond = part.copy(data=LIMITS[number].compare(part.values, LIMITS[number].value))
        if number == "wave_tabor_parameter":  # waves shallower than the range are not felt
            beyond = beyond & (part["A"] * part["lambda_over_R"] > part[RANGE])
        return beyond
    if number == CONTACT_SLOPE and STEEP in dataset.coords:
        return dataset[STEEP][block] > 0
    return None


def count_beyond(number: str, dataset: "xarray.Dataset") -> int:
    """Count the scenes of a dataset that a validity number puts beyond its limit, as far as that is known."""
    if number == CONTACT_SLOPE and is_cone(dataset):
        return dataset["status"].size
    if number == "wave_slope" and number not in dataset:
        profiles = _profiles_of(dataset) if "A" in dataset.coords else []
        return _steep_waves(dataset["A"], profiles, dataset["status"].size) if profiles else 0
    blocks = (beyond_by(number, dataset, block) for block in tiling_of(dataset["status"]))
    return sum(int(beyond.sum()) for beyond in blocks if beyond is not None)


def is_cone(dataset: "xarray.Dataset") -> bool:
    """Report whether the punch of a dataset is a cone, whose slope is 1 at every radius."""
    return str(dataset.attrs.get("profile", "")).partition(" ")[0] == "r"


def slope_warnings(dataset: "xarray.Dataset") -> Iterator[str]:
    """Say in one line how many scenes reach slopes of the punch that are not small, if any does."""
    scenes = counted(dataset["status"].size, "scene")
    if is_cone(dataset):
        yield f"a cone of slope 1: slopes are not small in any of {scenes}"
    elif steep := count_beyond(CONTACT_SLOPE, dataset):
        yield f"{steep:,} of {scenes}: {LIMITS[CONTACT_SLOPE].words} (a > R)"


def tabor_warnings(number: float, comment: str) -> Iterator[str]:
    """Say where a Tabor parameter is too small for JKR; `comment` says of which range of the attraction it is.

    >>> list(tabor_warnings(12.0, "")), list(tabor_warnings(0.05, "with a range of 1 nm"))[0][:58]
    ([], 'Tabor parameter 0.05 (with a range of 1 nm) is below 0.1: ')
    """
    if number < LONG_RANGED:
        limit, words = LONG_RANGED, "JKR does not apply, but the limit of Derjaguin, Muller & Toporov"
    elif number < SHORT_RANGED:
        limit, words = SHORT_RANGED, "the attraction is too long-ranged for JKR, and the fitted values are doubtful"
    else:
        return
    yield f"Tabor parameter {number:.2g} ({comment}) is below {limit:g}: {words}"


def flagged_in(status: NDArray[np.integer]) -> dict[str, int]:
    """Count the cells that have each flag that a run has something to say of."""
    flags = ANSWER_FLAGS | {_NOT_ONE_DISC: FLAGS[_NOT_ONE_DISC]}
    return {name: int(np.count_nonzero(status.astype(np.int16) & bit)) for name, bit in flags.items()}


def cautions(study: "Study", flagged: Mapping[str, int], steep: int, amplitude: "Amplitude | None") -> Iterator[str]:
    """Say of each flag in what share of the cells it is set, and what to do; and how many contacts are `steep`."""
    counts = {"steep": steep, **flagged}
    if study.is_cone and depends_on_contact(study.solved):
        yield CONE.format(f"all of {counted(study.scenes, 'scene')}")
        counts["steep"] = 0
    if amplitude is not None and "wave_slope" not in study.variables:
        _, _, profiles = study.apart(tuple(slice(0, size) for size in study.shape))
        counts["waves"] = _steep_waves(amplitude, profiles, study.scenes)
    if counts[_NOT_ONE_DISC] < _MANY * study.scenes:
        counts[_NOT_ONE_DISC] = 0
    for name, sentence in _SAID.items():
        if count := counts.get(name):
            yield sentence.format(share=share_of(count, study.scenes), resolution=study.search.resolution)


def _steep_waves(amplitude: "Amplitude", profiles: Sequence[Profile], scenes: int) -> int:
    """Count the scenes whose waves are steep, by their amplitudes and the shapes of their punches."""
    rows = [tuple(map(tuple, rows_of(profile).tolist())) for profile in profiles]
    slopes = [2.0 * math.pi * max(swings(-1.0, own)) for own in rows]  # over A, the steepest of each shape
    steep = 0
    for block in Tiling(amplitude.shape):
        values = np.asarray(amplitude[block or ...])
        steep += sum(int(np.count_nonzero(values * slope > STEEPEST)) for slope in slopes)
    return steep * scenes // (math.prod(amplitude.shape) * len(slopes))


def _profiles_of(dataset: "xarray.Dataset") -> list[Profile]:
    """Give the shape of the punch of a dataset, by its study; none where that is not known, or of random waves."""
    try:
        table: Any = tomllib.loads(dataset.attrs["study"]).get("profile", {})
        table = tomllib.loads(dataset.attrs["profile_fit"]) if "profile_fit" in dataset.attrs else table
        harmonics = tuple(Harmonic(**one) for one in table.get("harmonics", [{"n": 1}]))
    except (LookupError, ValueError, TypeError, AttributeError, RecursionError):
        return []
    return [] if "spectrum" in table else [Profile(harmonics=harmonics)]
