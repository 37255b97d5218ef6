"""Reports on arrays of general scenes: stated errors, the residual of the energy, gains over the smooth punch.

The code between is the same on a plain interface and on one with a pattern of toughness (arrays/patterned.py).
"""

from __future__ import annotations  # those of inner functions would be made anew in every call: 15 us each

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.general import solve_general
from gradhesion.core.arrays.prepared import Scenes, curves_of, prepared, run_by_exponent
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.closed.general_envelope import chis
from gradhesion.core.curve.general import Basis
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.status import NO_VALUE
from gradhesion.core.scene.general_report import ROWS, Solved, report_scenes

_GAINS: Final = {"adhesion_gain": "pull_off_force", "energy_gain": "dissipated_energy"}
"""Results compared with the smooth punch on the same interface."""
Found: TypeAlias = dict[str, NDArray[Any]]
Work: TypeAlias = Callable[[float, NDArray[np.int64], bool], None]


def reported(
    scenes: Scenes,
    reports: Sequence[str],
    found: Mapping[str, NDArray[Any]],
    profile: Profile,
    work_of: Callable[[Scenes, Solved, NDArray[np.bool_], NDArray[np.float64]], Work],
    *,
    turned: bool,
    threads: int | None,
) -> Found:
    """Return the reports on scenes but their gains, of the shape of the scenes, from their results `found`.

    `work_of` takes the scenes one by one and what else `report_scenes` (scene/general_report.py) does, and returns the
    work on the curves of one exponent.
    """
    each, status = scenes.one_by_one(), found["status"].ravel()
    none, out = np.full(each.k.size, np.nan), np.full((len(ROWS), each.k.size), np.nan)
    radius, energy = (found.get(name, none).ravel() for name in ("pull_off_radius", "dissipated_energy"))
    wanted = np.array([name in reports for name in ROWS])
    if wanted.any():
        run_by_exponent(each.k, work_of(each, Solved(radius, energy, turned, status), wanted, out), threads)
    made: Found = {name: row.reshape(scenes.shape) for name, row in zip(ROWS, out, strict=True) if name in reports}
    if "roughness_parameter" in reports:
        k = np.where(status & NO_VALUE, np.nan, each.k)
        _, down = chis(k, each.stretch, each.wavelength, each.amplitude, profile)
        made["roughness_parameter"] = down.reshape(scenes.shape)
    return made


def gains_of(
    parameters: Mapping[str, ArrayLike],
    reports: Sequence[str],
    found: Mapping[str, NDArray[Any]],
    solve: Callable[[Mapping[str, ArrayLike], list[str]], Found],
) -> Found:
    """Return the gains among some reports; `solve` gives values of other scenes."""
    gains = [name for name in reports if name in _GAINS]
    if not gains:
        return {}
    even = {**parameters, "A": 0.0 * np.asarray(parameters["A"], dtype=float)}
    smooth = solve(even, [_GAINS[name] for name in gains])
    with np.errstate(all="ignore"):
        return {name: found[_GAINS[name]] / smooth[_GAINS[name]] for name in gains}


def report_general(
    parameters: Mapping[str, ArrayLike],
    reports: Sequence[str],
    found: Mapping[str, NDArray[Any]],
    profile: Profile,
    loading: Loading,
    threads: int | None,
    *,
    turned: bool = False,
) -> dict[str, NDArray[Any]]:
    """Report on scenes that `solve_general` has solved, from their results; all have the shape of the scenes.

    `turned` is whether a_max is where the cycles turn, not the rim of a punch.
    """

    def work_of(each: Scenes, solved: Solved, wanted: NDArray[np.bool_], out: NDArray[np.float64]) -> Work:
        series, curves_at = curves_of(each, profile)

        def work(exponent: float, index: NDArray[np.int64], interpolated: bool) -> None:
            basis = Basis(*tables_of(exponent, series, interpolated=interpolated), series)
            report_scenes(basis, curves_at(exponent, index), solved, wanted, out)

        return work

    def solve(other: Mapping[str, ArrayLike], names: list[str]) -> Found:
        return solve_general(other, names, profile, loading, threads, check_contact=False)

    scenes = prepared(parameters, loading)
    made = reported(scenes, reports, found, profile, work_of, turned=turned, threads=threads)
    return made | gains_of(parameters, reports, found, solve)
