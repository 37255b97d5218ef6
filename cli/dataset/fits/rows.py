"""The values of one fit, and those of several side by side: shorter ones padded, missing ones empty."""

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.cli.errors import StudyError
from gradhesion.cli.names.fits import FIT, FIT_MORE, FIT_POINTS, FitVariable
from gradhesion.cli.names.scenes import STEEP, STEEP_CONTACT
from gradhesion.cli.study.fit.study import FitStudy
from gradhesion.cli.terminal.amounts import bytes_in_words
from gradhesion.cli.work.solve.fitting import Fit, tabor_of
from gradhesion.core.closed.reach import is_steep, slopes_of
from gradhesion.core.loops.fitted import FittedLoop
from gradhesion.core.problem.status import NO_VALUE

Row = dict[str, NDArray[Any]]
"""The values of the variables of a fit."""

VARIABLES: Final[Mapping[str, FitVariable]] = {
    **FIT,
    **FIT_MORE,
    **{name: one for own in FIT_POINTS.values() for name, one in own.items()},
    "status": FitVariable((), "flags of the fitted cycle (0: nothing to report)", "i2"),
    STEEP: FitVariable((), STEEP_CONTACT, "i1"),
}
"""Every variable that a fit may have."""
BYTES: Final = 45
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


def rows_of(study: FitStudy, fit: Fit) -> Row:
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
    path = np.concatenate([found.loading, found.unloading[1:]])
    values: dict[str, ArrayLike] = {
        "value": _along(found, found.values),
        "standard_deviation": _along(found, found.standard_deviations),
        "low": _along(found, found.low),
        "high": _along(found, found.high),
        "low_searched": [found.ranges[name][0] for name in found.names],
        "high_searched": [found.ranges[name][1] for name in found.names],
        "on_bound": [name in found.on_bound for name in found.names],
        "correlation": found.correlation,
        "chi_square": found.chi_square,
        "reduced_chi_square": found.reduced_chi_square,
        "degrees_of_freedom": found.degrees_of_freedom,
        "interval_widening": found.widening,
        "converged": found.converged,
        "tabor_parameter": tabor_of(study, found),
        "residual": found.residual,
        "fitted_indentation": path[:, 0],
        "fitted_load": path[:, 1],
        "fitted_unloading": np.arange(len(path)) >= len(found.loading),
    }
    if found.contact is not None:
        values["contact_depth"], values["contact_depth_deviation"] = found.contact.depth, found.contact.deviation
    if found.others:
        values["minimum_value"] = [_along(found, other.values) for other in found.others]
        values["minimum_chi_square"] = [other.chi_square for other in found.others]
    if is_steep(slopes_of(np.array(found.turning_radius), study.profile)):
        values[STEEP] = 1
    return values


def _along(found: FittedLoop, values: Mapping[str, float]) -> list[float]:
    """Give values in the order of what is fitted."""
    return [values[name] for name in found.names]


def side_by_side(rows: Sequence[Row]) -> Row:
    """Put the variables of several loops along a first dimension."""
    stacked: Row = {}
    for name in dict.fromkeys(name for row in rows for name in row):
        own = [row.get(name) for row in rows]
        there = [values.shape for values in own if values is not None]
        dtype = np.result_type(*(values.dtype for values in own if values is not None))
        empty = -1 if name.endswith("_unloading") else 0 if dtype.kind == "i" else np.nan
        together = np.full((len(rows), *map(max, zip(*there, strict=True))), empty, dtype=dtype)
        for i, values in enumerate(own):
            if values is not None:
                place: tuple[int | slice, ...] = (i, *(slice(size) for size in values.shape))
                together[place] = values
        stacked[name] = together
    return stacked
