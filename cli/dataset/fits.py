"""The dataset of fits: values with intervals, correlations, the data, the fitted path, residuals; and doubts."""

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.cli.dataset.describe import driven_in_words, flags_of, origin
from gradhesion.cli.dataset.read.model_range import CONE, tabor_warnings
from gradhesion.cli.errors import StudyError
from gradhesion.cli.names import fits as names
from gradhesion.cli.names.outputs import PARAMETER
from gradhesion.cli.names.scenes import STEEP, STEEP_CONTACT
from gradhesion.cli.study.fit.loops import fingerprint
from gradhesion.cli.study.fit.study import FitStudy, unit_of_parameter
from gradhesion.cli.study.shape_words import shape_in_words
from gradhesion.cli.terminal.amounts import bytes_in_words
from gradhesion.cli.work.compiling import prepare
from gradhesion.cli.work.solve.fitting import Fit, fits_of, range_words, tabor_of
from gradhesion.core.closed.reach import SMALL, is_steep, slopes_of
from gradhesion.core.loops.fitted import OFFSETS, FittedLoop
from gradhesion.core.loops.paths.model import EXPONENT
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.status import FLAGS, NO_VALUE, OF_FITS

if TYPE_CHECKING:
    import xarray

Row = dict[str, NDArray[Any]]
"""The values of the variables of a fit."""
VARIABLES: Final[Mapping[str, names.FitVariable]] = {
    **names.FIT,
    **names.FIT_MORE,
    **{name: one for own in names.FIT_POINTS.values() for name, one in own.items()},
    "status": names.FitVariable((), "flags of the fitted cycle (0: nothing to report)", "i2"),
    STEEP: names.FitVariable((), STEEP_CONTACT, "i1"),
}
"""Every variable that a fit may have."""
_BYTES: Final = 45
"""Of a measured point, in all of its variables."""
_MOST: Final = 2**30
"""Bytes of points side by side."""
_CLEAR: Final = 6.0
"""Standard deviations of a tilt that noise does not make: the points of the base line were chosen as level ones."""


def compute_fit(study: FitStudy) -> "xarray.Dataset":
    """Fit a study in memory: the dataset that `gradhesion run` writes to a file."""
    refuse_size(study)
    prepare()
    return dataset_of(study, fits_of(study), "computed in memory")


def refuse_size(study: FitStudy) -> None:
    """Refuse loops that would take too much memory side by side, before they are fitted (StudyError)."""
    longest = max(loop.depth.size for loop in study.loops)
    if not study.is_of_one and (size := _BYTES * longest * len(study.loops)) > _MOST:
        many = f"{len(study.loops):,} loops side by side, of up to {longest:,} points, take {bytes_in_words(size)}"
        raise StudyError(f"{study.file}: {many}; write average = true under [fit], or fit them in several studies")


def dataset_of(study: FitStudy, fits: Sequence[Fit], history: str) -> "xarray.Dataset":
    """Put the fits of a study into a dataset: that of one loop, or of several along a first dimension."""
    import xarray  # noqa: PLC0415 (450 ms)

    each = [_row_of(study, fit) for fit in fits]
    rows, along = (each[0], ()) if study.is_of_one else (side_by_side(each), (names.LOOP,))
    made = {
        name: xarray.Variable((*along, *VARIABLES[name].dims), values, _attributes_of(study, name))
        for name, values in rows.items()
    }

    def words(dimension: str, items: Sequence[str], about: str) -> "xarray.Variable":
        return xarray.Variable((dimension,), np.array(items, dtype=object), {"long_name": about})

    coordinates = {
        name: words(name, study.parameters, "fitted quantity") for name in (PARAMETER, names.OTHER_PARAMETER)
    }
    units = [*map(unit_of_parameter, study.parameters)]
    coordinates[names.PARAMETER_UNITS] = words(PARAMETER, units, "unit of the fitted quantity")
    if not study.is_of_one:
        own = {
            "file": [fit.loop.file for fit in fits],
            "sha256": [fit.loop.sha256 for fit in fits],
            "problem": [fit.problem for fit in fits],
            "alike": ["; ".join(fit.found.alike) if fit.found else "" for fit in fits],
        }
        coordinates |= {name: words(names.LOOP, items, names.FIT_WORDS[name]) for name, items in own.items()}
    for name, key in INPUTS.items():
        value = study.adhesion_range if name == "adhesion_range" else study.fixed.get(name)
        if value is not None:
            coordinates[name] = xarray.Variable((), value, {"units": key.unit, "long_name": key.about})
    if STEEP in made:
        coordinates[STEEP] = made.pop(STEEP)
    return xarray.Dataset(made, coordinates, origin(study, history, _attributes(study, fits)))


def _attributes(study: FitStudy, fits: Sequence[Fit]) -> dict[str, Any]:
    """List the attributes that fits alone have."""
    found = [fit.found for fit in fits if fit.found is not None]
    methods = {one.contact.method for one in found if one.contact is not None}
    driven = driven_in_words(study)
    if EXPONENT in study.free:
        driven["rate"] += ", with a fitted exponent"
    return {
        "profile": shape_in_words(study.profile),
        **driven,
        "data_file": study.file,
        "data_sha256": fingerprint(study.loops),
        "data_rows_left_out": np.int64(sum(loop.dropped for loop in study.loops)),
        "data_rows_of_pauses": np.int64(sum(loop.paused for loop in study.loops)),
        "noise_is": "given" if study.given_noise else "estimated from differences of neighbours",
        "intervals": "profile likelihoods" if study.intervals == "profile" else "linear",
        **({"contact_point": "; ".join(sorted(methods))} if methods else {}),
        **({"alike": "; ".join(found[0].alike)} if study.is_of_one and found[0].alike else {}),
    }


def _attributes_of(study: FitStudy, name: str) -> dict[str, Any]:
    """Describe a variable."""
    one = VARIABLES[name]
    words = one.about
    if study.loading.control == "machine" and name.endswith("_indentation") and one.dims:
        words = words.replace("indentation depth", "displacement of the machine")
    attributes: dict[str, Any] = {"long_name": words} | ({"units": one.unit} if one.unit else {})
    if one.meanings:
        padded = not study.is_of_one and name.endswith("_unloading")
        attributes["flag_values"] = np.array([-1, 0, 1][not padded :], np.int8)
        attributes["flag_meanings"] = "none " * padded + one.meanings
    if name == "tabor_parameter":
        attributes["comment"] = range_words(study)
    return attributes | (flags_of(FLAGS | OF_FITS, "i2") if name == "status" else {})


def _row_of(study: FitStudy, fit: Fit) -> Row:
    """Give the variables of one loop; those that a fit finds are missing where there is none."""
    loop, found = fit.loop, fit.found
    values: dict[str, ArrayLike] = {
        "raw_points": loop.points,
        "kept_points": loop.depth.size,
        "measured_indentation": loop.depth,
        "measured_load": loop.load,
        "measured_unloading": loop.unloading,
        "measured_cycle": loop.cycle if np.abs(loop.cycle).max(initial=0) >= 2**31 else loop.cycle.astype(np.int32),
        "status": NO_VALUE if found is None else found.status,
    }
    if not loop.problem:
        values["noise_of_indentation"], values["noise_of_load"] = study.noise_of(loop)
    if found is not None:
        values |= _found(study, found)
    return {name: np.asarray(value, VARIABLES[name].dtype or None) for name, value in values.items()}


def _found(study: FitStudy, found: FittedLoop) -> dict[str, ArrayLike]:
    """Give what a fit has found."""

    def along(values: Mapping[str, Any]) -> list[Any]:
        return [values[name] for name in found.names]

    same = ("correlation", "chi_square", "reduced_chi_square", "degrees_of_freedom", "converged", "residual")
    path = np.concatenate([found.loading, found.unloading[1:]])
    low, high = zip(*along(found.ranges), strict=True)
    values: dict[str, ArrayLike] = {name: getattr(found, name) for name in same} | {
        "value": along(found.values),
        "standard_deviation": along(found.standard_deviations),
        "low": along(found.low),
        "high": along(found.high),
        "low_searched": low,
        "high_searched": high,
        "on_bound": [name in found.on_bound for name in found.names],
        "interval_widening": found.widening,
        "tabor_parameter": tabor_of(study, found),
        "fitted_indentation": path[:, 0],
        "fitted_load": path[:, 1],
        "fitted_unloading": np.arange(len(path)) >= len(found.loading),
    }
    if found.contact is not None:
        values |= {"contact_depth": found.contact.depth, "contact_depth_deviation": found.contact.deviation}
    if found.others:
        values["minimum_value"] = [along(other.values) for other in found.others]
        values["minimum_chi_square"] = [other.chi_square for other in found.others]
    if is_steep(slopes_of(np.array(found.turning_radius), study.profile)):
        values[STEEP] = 1
    return values


def side_by_side(rows: Sequence[Row]) -> Row:
    """Put the variables of several loops along a first dimension: shorter ones padded, missing ones empty."""
    stacked: Row = {}
    for name in dict.fromkeys(name for row in rows for name in row):
        there = {i: row[name] for i, row in enumerate(rows) if name in row}
        dtype = np.result_type(*(values.dtype for values in there.values()))
        empty = -1 if name.endswith("_unloading") else 0 if dtype.kind == "i" else np.nan
        longest = map(max, zip(*(values.shape for values in there.values()), strict=True))
        stacked[name] = np.full((len(rows), *longest), empty, dtype=dtype)
        for i, values in there.items():
            place: tuple[int | slice, ...] = (i, *(slice(size) for size in values.shape))
            stacked[name][place] = values
    return stacked


def cautions_of_fit(study: FitStudy, found: FittedLoop) -> Iterator[str]:
    """Say where a fitted cycle leaves the range of the model, and what its loop cannot tell apart."""
    if study.profile.exponent == 1.0:
        yield CONE.format("the loop")
    elif is_steep(slopes_of(np.array(found.turning_radius), study.profile)):
        slope = f"contact reaches a = {found.turning_radius:.3g} R, where the punch has a slope above {SMALL:g}"
        yield f"{slope}, which is not small: the fitted values may be off"
    yield from tabor_warnings(tabor_of(study, found), range_words(study))
    line = found.base_line
    if line and OFFSETS[2] not in found.names and abs(line.slope) > _CLEAR * line.slope_deviation:
        tilt = f"{line.slope:.3g} N/m, {abs(line.slope) / line.slope_deviation:.0f} standard deviations"
        yield f"the base line is tilted by {tilt}: write offsets = {{ slope = true }} under [fit]"
    yield from found.alike
