"""Arrays of general scenes, in tasks of one gradient exponent."""

import math
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import beta

from gradhesion.core.general.scene import solve_pull_offs, solve_scenes
from gradhesion.core.general.series import with_table
from gradhesion.core.general.series_table import has_table
from gradhesion.core.grouping import grouped
from gradhesion.core.loading_control import Loading
from gradhesion.core.material import stiffness
from gradhesion.core.names import PARAMETERS, PULL_OFF, RESULTS
from gradhesion.core.profile import Profile
from gradhesion.core.results import typed
from gradhesion.core.struve.cosine_bins import build_cosine_bins
from gradhesion.core.struve.table import build_table

_TASK: Final = 16
"""Scenes a task: each takes longer than one of one cosine."""


@lru_cache(maxsize=128)
def _tables(k: float) -> tuple[Any, NDArray[np.float64]]:
    return build_table(k), build_cosine_bins(k)


@lru_cache(maxsize=16)
def _waves(k: float, rows: bytes) -> NDArray[np.float64]:
    table, bins = _tables(k)
    return with_table(table, bins, np.frombuffer(rows).reshape(-1, 3).copy())


def tables_of(k: float, rows: NDArray[np.float64] | None = None) -> tuple[Any, NDArray[np.float64]]:
    """Return the tables of an exponent, the second with that of a series if there are many harmonics."""
    table, bins = _tables(k)
    if rows is None or not has_table(rows):
        return table, bins.ravel()
    return table, _waves(k, rows.tobytes())


def rows_of(profile: Profile) -> NDArray[np.float64]:
    """Return the harmonics that have an amplitude, as rows (n, cos, sin)."""
    rows = [(h.n, h.cos, h.sin) for h in sorted(profile.harmonics, key=lambda h: h.n) if h.cos != 0.0 or h.sin != 0.0]
    return np.array(rows, dtype=float).reshape(-1, 3)


def in_own_wavelength(profile: Profile) -> tuple[float, NDArray[np.float64]]:
    """Return n and the harmonics of a wavelength n times shorter, over which A is n times as large.

    n is 1 but for a single harmonic, which is the first one of its own wavelength.
    """
    rows = rows_of(profile)
    if len(rows) != 1:
        return 1.0, rows
    n, even, odd = rows[0].tolist()
    return n, np.array([[1.0, even, odd]])


def front_of(k: float, exponent: float) -> float:
    """Return G(m/2) G((1+k)/2)/(2 G((1+k+m)/2)), by which r^m/m presses a^m deep."""
    return 1.0 / (1.0 + k) if exponent == 2.0 else float(0.5 * beta(0.5 * exponent, 0.5 * (1.0 + k)))


def equivalent_wave(profile: Profile) -> tuple[int, float] | None:
    """Return n and the factor of A for which a profile is a paraboloid with one cosine wave of length lambda/n.

    None where it is not. A is over the wavelength, so that a wave n times shorter has an A n times as large.
    """
    rows = rows_of(profile)
    if profile.exponent != 2.0 or len(rows) > 1:
        return None
    if len(rows) == 0:
        return 1, 0.0
    n, even, odd = rows[0].tolist()
    return (int(n), n * even) if even > 0.0 and odd == 0.0 else None


def compliance_of(
    loading: Loading,
    k: NDArray[np.float64],
    modulus: NDArray[np.float64],
    material: NDArray[np.float64],
    machine: NDArray[np.float64] | None = None,
) -> NDArray[np.float64]:
    """Return K/S over 1/R^(1+k): 0 under displacement control, inf under load control, NaN where S is out of range."""
    if machine is None:
        return np.full(k.shape, math.inf if loading.control == "load" else 0.0)
    with np.errstate(all="ignore"):
        spring = np.where(machine > 0.0, machine * modulus, np.nan)
        compliance = 2.0 ** (1.0 - k) / (1.0 + k) * material / spring
    return np.where(compliance == np.inf, np.nan, compliance)


@dataclass(frozen=True)
class Scenes:
    """The scenes of broadcast parameters as curves with their rims, and what the kernels take of them.

    `rim`, and `target` at which cycles turn, have the shape (curves, rims), or (1, rims) where all curves have the
    same; the others have the shape (curves,). `shape` is that of the parameters, in the order of curves and rims.
    """

    shape: tuple[int, ...]
    k: NDArray[np.float64]
    stretch: NDArray[np.float64]
    wavelength: NDArray[np.float64]
    amplitude: NDArray[np.float64]
    compliance: NDArray[np.float64]
    rim: NDArray[np.float64]
    target: NDArray[np.float64] | None = None

    def of_each(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the values of the curves for each scene, flat."""
        return np.repeat(values, self.rim.shape[1])


def prepared(parameters: Mapping[str, ArrayLike], loading: Loading, along: Sequence[str] = PARAMETERS[-1:]) -> Scenes:
    """Return the scenes of broadcast parameters.

    Those that differ along the last axes only in what is named by `along` (a_max, and where the cycle turns) are one
    curve.
    """
    curves = grouped(parameters, along, ("machine_stiffness",) if loading.control == "machine" else ())
    material = stiffness(curves.k, curves.nu, curves.modulus, curves.c0_over_R)
    with np.errstate(all="ignore"):
        stretch = np.sqrt(2.0 ** (1.0 + curves.k) * math.pi / material)
    compliance = compliance_of(loading, curves.k, curves.modulus, material, *curves.others)
    return Scenes(curves.shape, curves.k, stretch, curves.lambda_over_R, curves.A, compliance, *curves.rims)


def run_by_exponent(
    k: NDArray[np.float64], work: Callable[[float, NDArray[np.int64]], None], workers: int, rims: int = 1
) -> None:
    """Do the work on curves by their numbers, in tasks of one gradient exponent each."""
    size = max(1, _TASK // max(1, rims))

    def one(task: tuple[float, NDArray[np.int64]]) -> None:
        exponent, index = task
        work(exponent if 0.0 <= exponent <= 1.0 else 0.0, index)  # beyond, the stretch has no value

    order = np.argsort(k, kind="stable")
    first = np.flatnonzero(np.concatenate([[True], k[order][1:] != k[order][:-1]])) if k.size else np.array([], int)
    groups = np.split(order, first[1:]) if k.size else []
    tasks = [(float(k[g[0]]), g[i : i + size]) for g in groups for i in range(0, g.size, size)]
    if min(workers, len(tasks)) > 1:
        with ThreadPoolExecutor(min(workers, len(tasks))) as pool:
            list(pool.map(one, tasks))
    else:
        for task in tasks:
            one(task)


def solve_general(
    parameters: Mapping[str, ArrayLike],
    outputs: Sequence[str],
    profile: Profile,
    loading: Loading,
    workers: int,
    *,
    check_contact: bool = True,
    turned: bool = False,
) -> dict[str, NDArray[Any]]:
    """Solve all scenes of broadcast parameters for one profile and control, as `solve` of core/sweep.py.

    Scenes that differ along the last axes in a_max alone are solved on one trace.
    `turned` is whether a_max is where the cycles turn, not the rim of a punch.
    """
    scenes = prepared(parameters, loading)
    rows = list(dict.fromkeys(outputs))
    places = [rows.index(name) if name in rows else -1 for name in RESULTS]
    slots = np.array([*places, int(check_contact) - 1, int(turned)])
    out = np.full((len(rows), scenes.k.size, scenes.rim.shape[1]), np.nan)
    status = np.zeros(out.shape[1:], dtype=np.int8)
    n, series = in_own_wavelength(profile)
    wavelength, amplitude = scenes.wavelength / n, n * scenes.amplitude if series.size else 0.0 * scenes.amplitude

    solve = solve_pull_offs if set(rows) <= set(PULL_OFF) else solve_scenes

    def work(exponent: float, index: NDArray[np.int64]) -> None:
        table, cosines = tables_of(exponent, series)
        front = front_of(exponent, profile.exponent)
        arrays = (scenes.stretch, wavelength, amplitude, scenes.compliance, scenes.rim)
        solve(table, cosines, series, profile.exponent, front, index, *arrays, slots, out, status)

    run_by_exponent(scenes.k, work, workers, scenes.rim.shape[1])
    result: dict[str, NDArray[Any]] = {}
    for name in outputs:
        result[name] = typed(name, out[rows.index(name)]).reshape(scenes.shape)
    result["status"] = status.reshape(scenes.shape)
    return result
