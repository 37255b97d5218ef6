"""General scenes as curves with their rims, and their tasks of one gradient exponent."""

from __future__ import annotations  # those of inner functions would be made anew in every call: 15 us each

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.grouping import are_few, grouped
from gradhesion.core.arrays.tasks import Task, run_one_by_one, tasks_of
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.curves import GeneralCurves, PatternedCurves
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import PARAMETERS, PATTERN
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.shape import depth_factor_of, in_own_wavelength

if TYPE_CHECKING:
    from gradhesion.core.problem.toughness import Toughness

_TASK: Final = 16
"""Scenes a task: each takes longer than one of one cosine."""


def compliance_of(
    loading: Loading,
    k: NDArray[np.float64],
    modulus: NDArray[np.float64],
    material: NDArray[np.float64],
    machine: NDArray[np.float64] | None = None,
) -> NDArray[np.float64]:
    """Return K/S in 1/R^(1+k), (curves,): 0 under displacement control, inf under load, NaN where S is out of range."""
    if machine is None:
        return np.full(k.shape, math.inf if loading.control == "load" else 0.0)
    with np.errstate(all="ignore"):
        spring = np.where(machine > 0.0, machine * modulus, np.nan)
        compliance = 2.0 ** (1.0 - k) / (1.0 + k) * material / spring
    return np.where(compliance == np.inf, np.nan, compliance)


@dataclass(frozen=True)
class Scenes:
    """The scenes of broadcast parameters as curves with their rims, and the arguments of the kernels.

    `rim`, and `target` at which cycles turn, have the shape (curves, rims), or (1, rims) where all curves have the
    same; the others have the shape (curves,). `shape` is that of the parameters, in the order of curves and rims.
    `others` are further parameters of the curves.
    """

    shape: tuple[int, ...]
    k: NDArray[np.float64]
    stretch: NDArray[np.float64]
    wavelength: NDArray[np.float64]
    amplitude: NDArray[np.float64]
    compliance: NDArray[np.float64]
    rim: NDArray[np.float64]
    target: NDArray[np.float64] | None = None
    others: tuple[NDArray[np.float64], ...] = ()

    def of_each(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the values of the curves for each scene, flat."""
        return np.repeat(values, self.rim.shape[1])

    def one_by_one(self) -> Scenes:
        """Return the same scenes, each as a curve with one rim."""
        names = ("k", "stretch", "wavelength", "amplitude", "compliance")
        own: dict[str, Any] = {name: self.of_each(getattr(self, name)) for name in names}
        rim = np.array(np.broadcast_to(self.rim, (self.k.size, self.rim.shape[1])), order="C").reshape(-1, 1)
        return replace(self, rim=rim, others=tuple(map(self.of_each, self.others)), **own)


def prepared(
    parameters: Mapping[str, ArrayLike],
    loading: Loading,
    along: Sequence[str] = PARAMETERS[-1:],
    toughness: Toughness | None = None,
) -> Scenes:
    """Return the scenes of broadcast parameters, those of `PATTERN` among them if the toughness has a pattern.

    Those that differ along the last axes only in what is named by `along` (a_max, and where the cycle turns) are one
    curve.
    """
    more = PATTERN if toughness is not None else ()
    parameters = {**dict.fromkeys(more[1:], 1.0), **parameters}
    machine = ("machine_stiffness",) if loading.control == "machine" else ()
    curves = grouped(parameters, along, (*machine, *more))
    spring, others = curves.others[: len(machine)], curves.others[len(machine) :]
    material = stiffness(curves.k, curves.nu, curves.modulus, curves.c0_over_R)
    with np.errstate(all="ignore"):
        stretch = np.sqrt(2.0 ** (1.0 + curves.k) * math.pi / material)
    compliance = compliance_of(loading, curves.k, curves.modulus, material, *spring)
    own = curves.k, stretch, curves.lambda_over_R, curves.A, compliance
    return Scenes(curves.shape, *own, curves.rims[0], curves.rims[1] if len(along) > 1 else None, others)


def curves_of(
    scenes: Scenes, profile: Profile, toughness: Toughness | None = None
) -> tuple[NDArray[np.float64], Callable[[float, NDArray[np.int64]], GeneralCurves]]:
    """Return the series of a profile, and what makes the curves of one exponent k from that and their numbers."""
    n, series = in_own_wavelength(profile)
    kind: type[GeneralCurves] = GeneralCurves
    patterns: Any = ()
    if toughness is not None:
        from gradhesion.core.arrays.patterns import patterns_of  # noqa: PLC0415 (seldom wanted)

        kind, patterns = PatternedCurves, patterns_of(toughness, scenes)
    own = scenes.stretch, scenes.wavelength / n, n * scenes.amplitude if series.size else 0.0 * scenes.amplitude

    def curves_at(exponent: float, index: NDArray[np.int64]) -> GeneralCurves:
        shape = profile.exponent, depth_factor_of(exponent, profile.exponent)
        return kind(index, *shape, *own, scenes.compliance, scenes.rim, patterns)

    return series, curves_at


def run_by_exponent(
    k: NDArray[np.float64], work: Callable[[float, NDArray[np.int64], bool], None], threads: int | None, rims: int = 1
) -> None:
    """Do the work on curves by their numbers, in tasks of one gradient exponent each; k is of shape (curves,).

    Its arguments are the exponent, the curves, and whether its table is interpolated (arrays/grouping.py).
    """
    tasks = tasks_of(k, max(1, _TASK // max(1, rims)))
    few = set(k[tasks.order[tasks.ends[:-1][are_few(np.diff(tasks.ends))]]].tolist())

    def one(task: Task) -> None:
        exponent, index = task
        work(exponent if 0.0 <= exponent <= 1.0 else 0.0, index, exponent in few)  # beyond, the stretch has no value

    run_one_by_one(tasks, one, threads)
