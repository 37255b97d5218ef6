"""Arrays of scenes whose edge moves at a speed, in tasks of one gradient exponent."""

from __future__ import annotations  # those of inner functions would be made anew in every call: 15 us each

import math
from collections.abc import Callable, Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.general import solve_general
from gradhesion.core.arrays.prepared import compliance_of, run_by_exponent
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve.general import Basis
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import PARAMETERS, PULL_OFF
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.rate import Rate
from gradhesion.core.problem.shape import depth_factor_of, in_own_wavelength
from gradhesion.core.rate.scenes import CLOSED, OPENED, Edges, close_scenes, open_scenes

SPEED: Final = "speed_over_reference"
"""The parameter V/v*: the speed of the depth, or of the far end of the spring, over the speed of the law."""
_NEEDED: Final = {"displacement": (), "machine": ("machine_stiffness",)}
_OF_CLOSING: Final = {"closing_ratio": 1.0, "delta_max": math.inf}
_Results = dict[str, NDArray[Any]]


def _solved(
    parameters: Mapping[str, ArrayLike],
    rate: Rate,
    profile: Profile,
    loading: Loading,
    threads: int | None,
    rows: tuple[str, ...],
    solve: Callable[..., None],
) -> _Results:
    """Solve all scenes by a loop over scenes of one exponent of the gradient."""
    names = (*PARAMETERS, SPEED, *_NEEDED[loading.control], *(name for name in _OF_CLOSING if name in parameters))
    arrays = np.broadcast_arrays(*(np.asarray(parameters[name], dtype=float) for name in names))
    shape = arrays[0].shape
    flat = dict(zip(names, (array.ravel() for array in arrays), strict=True))
    k, modulus = flat["k"], flat["modulus"]
    material = stiffness(k, flat["nu"], modulus, flat["c0_over_R"])
    with np.errstate(all="ignore"):
        stretch = np.sqrt(2.0 ** (1.0 + k) * math.pi / material)
    compliance = compliance_of(loading, k, modulus, material, *(flat[name] for name in _NEEDED[loading.control]))
    count = k.size
    n, series = in_own_wavelength(profile)
    wavelength, amplitude = flat["lambda_over_R"] / n, n * flat["A"] if series.size else 0.0 * flat["A"]
    ratios, turns = (flat.get(name, np.full(count, value)) for name, value in _OF_CLOSING.items())
    out, status = np.full((len(rows), count), np.nan), np.zeros(count, dtype=np.int64)

    def work(exponent: float, index: NDArray[np.int64], _interpolated: bool) -> None:  # noqa: FBT001
        basis = Basis(*tables_of(exponent, series), series)
        own = stretch, wavelength, amplitude, compliance
        factor = depth_factor_of(exponent, profile.exponent)
        edges = Edges(
            index, profile.exponent, factor, *own, flat["a_max_over_R"], flat[SPEED], rate.exponent, ratios, turns
        )
        solve(basis, edges, out, status)

    run_by_exponent(k, work, threads)
    found: _Results = {name: out[i].reshape(shape) for i, name in enumerate(rows)}
    return found | {"status": status.astype(np.int16).reshape(shape)}


def open_at_speed(
    parameters: Mapping[str, ArrayLike], rate: Rate, profile: Profile, loading: Loading, threads: int | None
) -> _Results:
    return _solved(parameters, rate, profile, loading, threads, OPENED, open_scenes)


def close_at_speed(
    parameters: Mapping[str, ArrayLike], rate: Rate, profile: Profile, loading: Loading, threads: int | None
) -> _Results:
    return _solved(parameters, rate, profile, loading, threads, CLOSED, close_scenes)
