"""Reports on arrays of general scenes: stated errors, the residual of the energy, gains over the smooth punch."""

from __future__ import annotations  # those of inner functions would be made anew in every call: 15 us each

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.general import solve_general
from gradhesion.core.arrays.prepared import prepared, run_by_exponent
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.closed.general_envelope import chis
from gradhesion.core.curve.general import Basis
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.curves import GeneralCurves
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.shape import depth_factor_of, in_own_wavelength
from gradhesion.core.problem.status import NO_VALUE
from gradhesion.core.scene.general_report import ROWS, Solved, report_scenes

_GAINS: Final = {"adhesion_gain": "pull_off_force", "energy_gain": "dissipated_energy"}


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
    scenes = prepared(parameters, loading)
    status = found["status"].ravel()
    n, series = in_own_wavelength(profile)
    k, stretch, wavelength, amplitude, compliance = map(
        scenes.of_each, (scenes.k, scenes.stretch, scenes.wavelength, scenes.amplitude, scenes.compliance)
    )
    amplitude = amplitude if series.size else 0.0 * amplitude
    rim = np.array(np.broadcast_to(scenes.rim, (scenes.k.size, scenes.rim.shape[1])), order="C").reshape(-1, 1)
    out = np.full((len(ROWS), k.size), np.nan)
    wanted = np.array([name in reports for name in ROWS])
    none = np.full(k.size, np.nan)
    radius, energy = (
        found[name].ravel() if name in found else none for name in ("pull_off_radius", "dissipated_energy")
    )

    def work(exponent: float, index: NDArray[np.int64], interpolated: bool) -> None:
        basis = Basis(*tables_of(exponent, series, interpolated=interpolated), series)
        shape = profile.exponent, depth_factor_of(exponent, profile.exponent)
        curves = GeneralCurves(index, *shape, stretch, wavelength / n, n * amplitude, compliance, rim)
        report_scenes(basis, curves, Solved(radius, energy, turned, status), wanted, out)

    if wanted.any():
        run_by_exponent(k, work, threads)
    made: dict[str, NDArray[Any]] = {
        name: row.reshape(scenes.shape) for name, row in zip(ROWS, out, strict=True) if name in reports
    }
    if "roughness_parameter" in reports:
        _, down = chis(np.where(status & NO_VALUE, np.nan, k), stretch, wavelength, amplitude, profile)
        made["roughness_parameter"] = down.reshape(scenes.shape)
    gains = [name for name in reports if name in _GAINS]
    if gains:
        even = {**parameters, "A": 0.0 * np.asarray(parameters["A"], dtype=float)}
        smooth = solve_general(even, [_GAINS[name] for name in gains], profile, loading, threads, check_contact=False)
        with np.errstate(all="ignore"):
            made |= {name: found[_GAINS[name]] / smooth[_GAINS[name]] for name in gains}
    return made
