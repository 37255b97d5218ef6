"""The variables of one fit as arrays, and those of several side by side: shorter ones padded, missing ones empty."""

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.cli.errors import StudyError
from gradhesion.cli.names.fits import FIT, FIT_MORE, LOOP
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.study.fit.study import FitStudy
from gradhesion.cli.terminal.amounts import bytes_in_words
from gradhesion.cli.work.solve.fitting import Fit, tabor_of
from gradhesion.core.closed.reach import is_steep, slopes_of
from gradhesion.core.loops.fitted import FittedLoop
from gradhesion.core.problem.status import NO_VALUE

Row = tuple[tuple[str, ...], NDArray[np.generic]]
"""The dimensions of a variable, and its values."""

NONE: Final = {"measured_unloading": -1, "fitted_unloading": -1}
"""What stands behind the last point of a shorter loop, where it is not NaN, nor 0."""
BYTES: Final = 41
"""Of a measured point, in all of its variables."""
MOST: Final = 2**30
"""Bytes of points side by side."""


def refuse_size(study: FitStudy) -> None:
    """
    Refuse loops that would take too much memory side by side, before they are fitted.

    Raises
    ------
    StudyError
        They would.
    """
    longest = max(loop.depth.size for loop in study.loops)
    if not study.is_of_one and (size := BYTES * longest * len(study.loops)) > MOST:
        raise StudyError(
            f"{study.file}: {len(study.loops):,} loops side by side, the longest of {longest:,} points, take "
            f"{bytes_in_words(size)}; write average = true under [fit], or fit them in several studies"
        )


def rows_of(study: FitStudy, fit: Fit) -> dict[str, Row]:
    """Give the variables of one loop; those that a fit finds are missing where there is none."""
    loop = fit.loop
    rows: dict[str, Row] = {}

    def put(name: str, values: ArrayLike, dtype: type[np.generic] = np.float64) -> None:
        dims = next(own[name][0] for own in (FIT, FIT_MORE) if name in own)
        rows[name] = (dims, np.asarray(values, dtype=dtype))

    depth_noise, load_noise = study.noise_of(loop)
    if not loop.problem:
        put("noise_of_indentation", depth_noise)
        put("noise_of_load", load_noise)
    put("raw_points", loop.points, np.int64)
    put("kept_points", loop.depth.size, np.int64)
    _put_points(rows, {"indentation": loop.depth, "load": loop.load}, "measured", loop.unloading)
    rows["measured_cycle"] = (("measured_point",), _narrow(loop.cycle))
    found = fit.found
    rows["status"] = ((), np.asarray(NO_VALUE if found is None else found.status, np.int16))
    if found is None:
        return rows
    for name, by_name in {
        "value": found.values,
        "standard_deviation": found.standard_deviations,
        "low": found.low,
        "high": found.high,
        "low_searched": {name: ends[0] for name, ends in found.ranges.items()},
        "high_searched": {name: ends[1] for name, ends in found.ranges.items()},
    }.items():
        put(name, _along(found, by_name))
    put("on_bound", [name in found.on_bound for name in found.names], np.int8)
    put("correlation", found.correlation)
    put("chi_square", found.chi_square)
    put("reduced_chi_square", found.reduced_chi_square)
    put("degrees_of_freedom", found.degrees_of_freedom, np.int32)
    put("interval_widening", found.widening)
    put("converged", found.converged, np.int8)
    put("tabor_parameter", tabor_of(study, found))
    if found.contact is not None:
        put("contact_depth", found.contact.depth)
        put("contact_depth_deviation", found.contact.deviation)
    if found.others:
        put("minimum_value", [_along(found, other.values) for other in found.others])
        put("minimum_chi_square", [other.chi_square for other in found.others])
    rows["residual"] = (("measured_point",), found.residual)
    path = np.concatenate([found.loading, found.unloading[1:]])
    back = np.arange(len(path)) >= len(found.loading)
    _put_points(rows, {"indentation": path[:, 0], "load": path[:, 1]}, "fitted", back)
    if is_steep(slopes_of(np.array(found.turning_radius), study.profile)):
        rows[STEEP] = ((), np.asarray(1, np.int8))
    return rows


def side_by_side(fits: Sequence[dict[str, Row]]) -> dict[str, Row]:
    """Put the variables of several loops along a first dimension."""
    first: dict[str, Row] = {}
    sizes: dict[str, int] = {}
    for rows in fits:
        for name, (dims, values) in rows.items():
            first.setdefault(name, (dims, values))
            for dim, size in zip(dims, values.shape, strict=True):
                sizes[dim] = max(sizes.get(dim, 0), size)
    stacked: dict[str, Row] = {}
    for name, (dims, _) in first.items():
        kinds = [rows[name][1].dtype for rows in fits if name in rows]
        dtype = np.result_type(*kinds)
        empty = NONE.get(name, 0) if dtype.kind == "i" else np.nan
        together = np.full((len(fits), *(sizes[dim] for dim in dims)), empty, dtype=dtype)
        for i, rows in enumerate(fits):
            if name in rows:
                values = rows[name][1]
                place: tuple[int | slice, ...] = (i, *(slice(size) for size in values.shape))
                together[place] = values
        stacked[name] = ((LOOP, *dims), together)
    return stacked


def _along(found: FittedLoop, values: dict[str, float]) -> NDArray[np.float64]:
    """Give values in the order of what is fitted."""
    return np.array([values[name] for name in found.names])


def _put_points(
    rows: dict[str, Row], columns: dict[str, NDArray[np.float64]], which: str, back: NDArray[np.bool_]
) -> None:
    """Put points of a loop, or of a path, with their branch."""
    along = (f"{which}_point",)
    for name, values in columns.items():
        rows[f"{which}_{name}"] = (along, values)
    rows[f"{which}_unloading"] = (along, back.astype(np.int8))


def _narrow(cycle: NDArray[np.int64]) -> NDArray[np.int32] | NDArray[np.int64]:
    """Give the numbers of cycles in 32 bits, or in 64 where they need them."""
    return cycle.astype(np.int32) if np.abs(cycle).max(initial=0) < 2**31 else cycle
