"""Arrays of scenes on interfaces whose toughness varies with the radius, in tasks of one gradient exponent."""

from __future__ import annotations  # those of inner functions would be made anew in every call: 15 us each

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.cosine import SLOPES
from gradhesion.core.arrays.prepared import Scenes, curves_of, prepared, run_by_exponent
from gradhesion.core.arrays.tables import changes_of, tables_of
from gradhesion.core.problem.curves import Patterns
from gradhesion.core.problem.names import PARAMETERS, PATTERN, REACH, REPORTS, RESULTS
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.results import Results, slots_of, typed
from gradhesion.core.problem.toughness import Toughness, first_violation, lowest, rows_of_pattern
from gradhesion.core.scene.cosine_report import NEEDED
from gradhesion.core.scene.patterned import solve_scenes
from gradhesion.core.sensitivities.neighbours import depth_factor_by_k
from gradhesion.core.sensitivities.patterned_slopes import COUNT, Sense
from gradhesion.core.sensitivities.wanted import NoSense
from gradhesion.core.turning.patterned import turn_scenes
from gradhesion.core.turning.turns import Turns

if TYPE_CHECKING:
    from gradhesion.core.sweep import How

_BEYOND: Final = 0.25
"""Of the least t within a rim beyond which it has the wrong sign: cells reach a little further."""


@lru_cache(maxsize=32)
def _extremes(toughness: Toughness) -> tuple[float, float]:
    """Return the lowest and the highest value of the series."""
    rows = rows_of_pattern(toughness)
    return lowest(rows), -lowest(rows * np.array([1.0, -1.0, -1.0]))


def _patterns_of(toughness: Toughness, scenes: Scenes) -> Patterns:
    """Return the patterns of curves."""
    rims = scenes.rim
    wavelength, amplitude = scenes.others
    rows, (low, high) = rows_of_pattern(toughness), _extremes(toughness)
    with np.errstate(all="ignore"):  # a scene out of range has no value
        least = 1.0 + np.minimum(amplitude * low, amplitude * high)
    limit = np.full(least.shape, math.inf)
    within = rims if rims.shape[0] > 1 else np.broadcast_to(rims, (least.size, rims.shape[1]))
    doubtful = (least < (1e-12 if toughness.of == "work" else 0.0)) & np.isfinite(amplitude) & (wavelength > 0.0)
    for i in np.flatnonzero(doubtful).tolist():
        place = first_violation(toughness, float(amplitude[i]))
        if place < math.inf:
            limit[i] = place * wavelength[i] * (1.0 - 1e-12)
            furthest = np.max(np.where(within[i] <= limit[i], within[i], 0.0)) / wavelength[i]
            least[i] = _BEYOND * (1.0 + lowest(rows * np.array([1.0, amplitude[i], amplitude[i]]), furthest))
    return Patterns(rows, toughness.of == "work", wavelength, amplitude, np.maximum(least, 0.0), limit)


def curves_of_scenes(
    scenes: Scenes, profile: Profile, toughness: Toughness | None
) -> tuple[NDArray[np.float64], Any, Patterns]:
    """Return the series of a profile, a function for the curves of one exponent by their numbers, and the patterns."""
    assert toughness is not None  # noqa: S101 -- else these are not the scenes
    return *curves_of(scenes, profile), _patterns_of(toughness, scenes)


def solve_patterned(
    parameters: Mapping[str, ArrayLike],
    wanted: Sequence[str],
    how: How,
    slopes: tuple[bool, int] | None = None,
    *,
    turned: bool = False,
) -> dict[str, NDArray[Any]]:
    """Solve all scenes of broadcast parameters up to their rims, as `up_to_rims` (core/sweep.py)."""
    scenes = prepared({PATTERN[1]: 1.0, **parameters}, how.loading, more=PATTERN)
    outputs = [name for name in wanted if name in (*RESULTS, REACH)]
    reports = [name for name in wanted if name in REPORTS]
    outputs += [NEEDED[name] for name in reports if name in NEEDED]
    rows = list(dict.fromkeys(outputs))
    slots = slots_of(rows, check_contact=how.check_contact, turned=turned)
    out = np.full((len(rows), scenes.k.size, scenes.rim.shape[1]), np.nan)
    status = np.zeros(out.shape[1:], dtype=np.int16)
    sensed = np.full((3, COUNT, *status.shape), np.nan)
    series, curves_at, patterns = curves_of_scenes(scenes, how.profile, how.toughness)

    def work(exponent: float, index: NDArray[np.int64], interpolated: bool) -> None:
        tables = tables_of(exponent, series, interpolated=interpolated and slopes is None)
        sense: Any = NoSense()
        if slopes is not None:
            by_k = depth_factor_by_k(exponent, how.profile.exponent)
            sense = Sense(changes_of(exponent, series), by_k, sensed, *slopes, turned)
        solve_scenes(*tables, series, curves_at(exponent, index), patterns, Results(slots, out, status), sense)

    run_by_exponent(scenes.k, work, how.threads, scenes.rim.shape[1])
    found = {name: typed(name, out[rows.index(name)]).reshape(scenes.shape) for name in outputs}
    found |= {"status": status.reshape(scenes.shape)}
    if slopes is not None:
        found[SLOPES] = sensed.reshape((3, COUNT, *scenes.shape))
    return found | (_reports(parameters, reports, found, how, turned=turned) if reports else {})


def _reports(
    parameters: Mapping[str, ArrayLike],
    reports: Sequence[str],
    found: Mapping[str, NDArray[Any]],
    how: How,
    *,
    turned: bool,
) -> dict[str, NDArray[Any]]:
    """Report on scenes that are solved, as `report_general` (arrays/general_report.py)."""
    from gradhesion.core.arrays.general_report import gains_of, reported  # noqa: PLC0415 (SciPy)
    from gradhesion.core.scene.patterned_report import report_scenes  # noqa: PLC0415 (kernels of their own)

    def work_of(each: Scenes, solved: Any, wanted: NDArray[np.bool_], out: NDArray[np.float64]) -> Any:
        series, curves_at, patterns = curves_of_scenes(each, how.profile, how.toughness)

        def work(exponent: float, index: NDArray[np.int64], interpolated: bool) -> None:
            tables = tables_of(exponent, series, interpolated=interpolated)
            report_scenes(*tables, series, curves_at(exponent, index), patterns, solved, wanted, out)

        return work

    def solve(other: Mapping[str, ArrayLike], names: list[str]) -> dict[str, NDArray[Any]]:
        return solve_patterned(other, names, how, turned=turned)

    scenes = prepared({PATTERN[1]: 1.0, **parameters}, how.loading, more=PATTERN)
    made = reported(scenes, reports, found, how.profile, work_of, turned=turned, threads=how.threads)
    return made | gains_of(parameters, reports, found, solve)


def turning_patterned(
    parameters: Mapping[str, ArrayLike], turn: str, how: How, *, check_contact: bool = True
) -> tuple[NDArray[np.float64], NDArray[np.int16], NDArray[np.bool_]]:
    """Return where the cycles turn, and the rest, as `turning_general` (arrays/general_turning.py)."""
    scenes = prepared({PATTERN[1]: 1.0, **parameters}, how.loading, (*PARAMETERS[-1:], turn), PATTERN)
    assert scenes.target is not None  # noqa: S101 -- it was requested
    series, curves_at, patterns = curves_of_scenes(scenes, how.profile, how.toughness)
    radii = np.empty((scenes.k.size, scenes.rim.shape[1]))
    flags, passed = np.zeros(radii.shape, dtype=np.int16), np.zeros(radii.shape, dtype=np.bool_)
    turns = Turns(scenes.rim, scenes.target, turn == "load_max", check_contact, radii, flags)

    def work(exponent: float, index: NDArray[np.int64], interpolated: bool) -> None:
        tables = tables_of(exponent, series, interpolated=interpolated)
        turn_scenes(*tables, series, curves_at(exponent, index), patterns, turns, passed)

    run_by_exponent(scenes.k, work, how.threads, scenes.rim.shape[1])
    return radii.reshape(scenes.shape), flags.reshape(scenes.shape), passed.reshape(scenes.shape)
