"""Reports on arrays of general scenes: stated errors, the residual of the energy, gains over the smooth punch."""

from __future__ import annotations  # those of inner functions would be made anew in every call: 15 us each

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.general import solve_general
from gradhesion.core.arrays.prepared import curves_of, prepared, run_by_exponent
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.closed.envelope import chis
from gradhesion.core.curve.general import Basis
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.status import NO_VALUE
from gradhesion.core.scene.general_report import ROWS, Solved, report_scenes

if TYPE_CHECKING:
    from gradhesion.core.problem.toughness import Toughness

_GAINS: Final = {"adhesion_gain": "pull_off_force", "energy_gain": "dissipated_energy"}
"""Results compared with the smooth punch on the same interface."""


def report_general(
    parameters: Mapping[str, ArrayLike],
    reports: Sequence[str],
    found: Mapping[str, NDArray[Any]],
    profile: Profile,
    loading: Loading,
    threads: int | None,
    *,
    turned: bool = False,
    toughness: Toughness | None = None,
) -> dict[str, NDArray[Any]]:
    """Report on scenes that `solve_general` has solved, from their results; all have the shape of the scenes.

    `turned` is whether a_max is where the cycles turn, not the rim of a punch.
    """
    scenes = prepared(parameters, loading, toughness=toughness)
    each, status = scenes.one_by_one(), found["status"].ravel()
    none, out = np.full(each.k.size, np.nan), np.full((len(ROWS), each.k.size), np.nan)
    radius, energy = (found.get(name, none).ravel() for name in ("pull_off_radius", "dissipated_energy"))
    solved, wanted = Solved(radius, energy, turned, status), np.array([name in reports for name in ROWS])
    if wanted.any():
        series, curves_at = curves_of(each, profile, toughness)

        def work(exponent: float, index: NDArray[np.int64], interpolated: bool) -> None:
            basis = Basis(*tables_of(exponent, series, interpolated=interpolated), series)
            report_scenes(basis, curves_at(exponent, index), solved, wanted, out)

        run_by_exponent(each.k, work, threads)
    made = {name: row.reshape(scenes.shape) for name, row in zip(ROWS, out, strict=True) if name in reports}
    if "roughness_parameter" in reports:
        k = np.where(status & NO_VALUE, np.nan, each.k)
        _, down = chis(k, each.stretch, each.wavelength, each.amplitude, profile)
        made["roughness_parameter"] = down.reshape(scenes.shape)
    gains = [name for name in reports if name in _GAINS]
    if gains:
        even = {**parameters, "A": 0.0 * np.asarray(parameters["A"], dtype=float)}
        values = [_GAINS[name] for name in gains]
        smooth = solve_general(even, values, profile, loading, threads, check_contact=False, toughness=toughness)
        with np.errstate(all="ignore"):
            made |= {name: found[_GAINS[name]] / smooth[_GAINS[name]] for name in gains}
    return made
