"""Arrays of general scenes, in tasks of one gradient exponent."""

import math
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import beta

from gradhesion.core.general.scene import solve_scenes
from gradhesion.core.loading_control import Loading
from gradhesion.core.material import stiffness
from gradhesion.core.profile import Profile
from gradhesion.core.results import INTEGERS, OUTPUTS
from gradhesion.core.struve.cosine_bins import build_cosine_bins
from gradhesion.core.struve.table import build_table

_TASK: Final = 16
"""Scenes a task: each takes about as long as a hundred of one cosine."""


@lru_cache(maxsize=128)
def tables_of(k: float) -> tuple[Any, NDArray[np.float64]]:
    """Return the tables of an exponent."""
    return build_table(k), build_cosine_bins(k)


def rows_of(profile: Profile) -> NDArray[np.float64]:
    """Return the harmonics that have an amplitude, as rows (n, cos, sin)."""
    rows = [(h.n, h.cos, h.sin) for h in sorted(profile.harmonics, key=lambda h: h.n) if h.cos != 0.0 or h.sin != 0.0]
    return np.array(rows, dtype=float).reshape(-1, 3)


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


def solve_general(
    parameters: Mapping[str, ArrayLike],
    names: Sequence[str],
    outputs: Sequence[str],
    profile: Profile,
    loading: Loading,
    workers: int,
    *,
    check_contact: bool = True,
) -> dict[str, NDArray[Any]]:
    """Solve all scenes of the broadcast parameters `names` for one profile and control, as `solve` of core/sweep.py."""
    keys = [*names, *(["machine_stiffness"] if loading.control == "machine" else [])]
    arrays = np.broadcast_arrays(*(np.asarray(parameters[key], dtype=float) for key in keys))
    shape = arrays[0].shape
    k, nu, modulus, c0, wavelength, amplitude, rim, *machine = (np.ascontiguousarray(a).ravel() for a in arrays)
    material = stiffness(k, nu, modulus, c0)
    with np.errstate(all="ignore"):
        stretch = np.sqrt(2.0 ** (1.0 + k) * math.pi / material)
    compliance = compliance_of(loading, k, modulus, material, *machine)
    rows = list(dict.fromkeys(outputs))
    slots = np.array([*(rows.index(name) if name in rows else -1 for name in OUTPUTS), int(check_contact) - 1])
    out = np.full((len(rows), k.size), np.nan)
    status = np.zeros(k.size, dtype=np.int8)
    series = rows_of(profile)
    amplitude = amplitude if series.size else 0.0 * amplitude

    def work(task: tuple[float, NDArray[np.int64]]) -> None:
        exponent, index = task
        valid = exponent if 0.0 <= exponent <= 1.0 else 0.0  # beyond, the stretch has no value
        table, cosines = tables_of(valid)
        front = front_of(valid, profile.exponent)
        scenes = (stretch, wavelength, amplitude, compliance, rim)
        solve_scenes(table, cosines, series, profile.exponent, front, index, *scenes, slots, out, status)

    order = np.argsort(k, kind="stable")
    first = np.flatnonzero(np.concatenate([[True], k[order][1:] != k[order][:-1]])) if k.size else np.array([], int)
    groups = np.split(order, first[1:]) if k.size else []
    tasks = [(float(k[g[0]]), g[i : i + _TASK]) for g in groups for i in range(0, g.size, _TASK)]
    if min(workers, len(tasks)) > 1:
        with ThreadPoolExecutor(min(workers, len(tasks))) as pool:
            list(pool.map(work, tasks))
    else:
        for task in tasks:
            work(task)
    result: dict[str, NDArray[Any]] = {}
    for name in outputs:
        values: NDArray[Any] = out[rows.index(name)]
        if name in INTEGERS:
            values = np.where(np.isnan(values), -1.0, values).astype(np.int32)
        result[name] = values.reshape(shape)
    result["status"] = status.reshape(shape)
    return result
