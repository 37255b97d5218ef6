"""Kernels compiled ahead: a small scene of each kind, solved for the kernels that it compiles."""

import math
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final

import numpy as np

from gradhesion.core.draw.draw import draw_curves
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.names import CURVES, OUTPUTS, PARAMETERS, REPORTS, SENSITIVITIES
from gradhesion.core.problem.profile import Harmonic, Profile
from gradhesion.core.problem.toughness import Rate, Toughness, ToughnessHarmonic
from gradhesion.core.sweep import solve

SCENE: Final = dict(zip(PARAMETERS, (0.3, 0.3, 500.0, 0.01, 0.1, 0.03, 0.5), strict=True))
"""A punch whose curve folds, so that there are jumps both ways."""
MANY_WAVES: Final = SCENE | {"lambda_over_R": 1e-3, "a_max_over_R": 1.0}
MACHINE: Final = SCENE | {"machine_stiffness": 3.0}
PATTERN: Final = SCENE | {"toughness_wavelength_over_R": 0.07}
SLOW: Final = SCENE | {"speed_over_reference": 0.1}
DEEP: Final = {"indentation_max_over_R": 0.05}
SERIES: Final = Profile(exponent=2.5, harmonics=tuple(Harmonic(n=n, cos=1.0 / n) for n in range(1, 25)))
BY_MACHINE: Final = Loading(control="machine")
TOUGHNESS: Final = Toughness((ToughnessHarmonic(n=1, cos=0.2, sin=0.1),))
FORCE: Final = ("pull_off_force",)


def _states() -> None:
    """Draw pressure and surface of the states of a cycle."""
    from gradhesion.core.draw import states  # noqa: PLC0415 (SciPy)

    chosen, _ = states.named_states(SCENE, Profile(), Loading())
    states.draw_states(SCENE, chosen, ("pressure", "surface"), Profile())


def _fit() -> None:
    """Fit the amplitude of the waves to a path that is drawn."""
    from gradhesion.core.loops.fit import fit_loop  # noqa: PLC0415 (SciPy)

    path, _ = draw_curves(SCENE | DEEP, ("path",))
    depth, load, back = (path[f"path_{name}"][::8] for name in ("indentation", "load", "unloading"))
    R, work = 1e-6, 0.05  # m, N/m
    fixed = {"k": SCENE["k"], "nu": SCENE["nu"], "R": R, "E_star": SCENE["modulus"] * work / R}
    fixed |= {"c0": R * SCENE["c0_over_R"], "wavelength": R * SCENE["lambda_over_R"], "work_of_adhesion": work}
    noise = (1e-4 * R, 1e-3 * R * work)
    fit_loop(R * depth, 1.5 * math.pi * R * work * load, back, fixed, {"A": (0.02, 0.04)}, noise=noise, starts=1)


def _solve(outputs: Sequence[str], scene: Mapping[str, Any] = SCENE, **settings: Any) -> Callable[[], object]:
    """Return a call that solves a scene for some outputs."""
    return lambda: solve(scene, outputs, threads=1, **settings)


def _draw(curves: Sequence[str], scene: Mapping[str, float] = SCENE, **settings: Any) -> Callable[[], object]:
    """Return a call that draws curves of a scene."""
    return lambda: draw_curves(scene, curves, **settings)


USUAL: Final[dict[str, Callable[[], object]]] = {
    "force": _solve(FORCE),
    "force and energy": _solve(OUTPUTS),
    "smooth punch": _solve(OUTPUTS, SCENE | {"A": 0.0}),
    "unbounded punch": _solve(OUTPUTS, SCENE | {"a_max_over_R": math.inf}),
    "envelope": _solve(OUTPUTS, solver="envelope"),
    "curves": _draw(tuple(CURVES)),
}
"""What maps and curves of a paraboloid with one cosine wave compile."""
EVERYTHING: Final[dict[str, Callable[[], object]]] = USUAL | {
    "many smooth punches": _solve(FORCE, SCENE | {"A": 0.0, "a_max_over_R": np.linspace(0.1, 1.0, 4096)}),
    "many waves": _solve(OUTPUTS, MANY_WAVES),
    "reports": _solve(REPORTS),
    "reports of many waves": _solve(REPORTS, MANY_WAVES),
    "turn at a depth": _solve(OUTPUTS, SCENE | DEEP),
    "turn at a load": _solve(OUTPUTS, SCENE | {"load_max": 1.0}),
    "closing ratio": _solve((*OUTPUTS, "snap_in_force"), SCENE | {"closing_ratio": 0.5}),
    "sensitivities": _solve(SENSITIVITIES),
    "asymptotic": _solve(OUTPUTS, solver="asymptotic"),
    "series": _solve(OUTPUTS, profile=SERIES),
    "series, many waves": _solve(OUTPUTS, MANY_WAVES, profile=SERIES),
    "force of a series": _solve(FORCE, profile=SERIES),
    "envelope of a series": _solve(OUTPUTS, profile=SERIES, solver="envelope"),
    "load control": _solve(OUTPUTS, loading=Loading(control="load")),
    "machine": _solve((*OUTPUTS, *REPORTS), MACHINE, loading=BY_MACHINE),
    "curves of a machine": _draw(("path", "jumps"), MACHINE, loading=BY_MACHINE),
    "pattern": _solve((*OUTPUTS, *REPORTS), PATTERN, toughness=TOUGHNESS),
    "pattern, sensitivities": _solve(SENSITIVITIES, PATTERN, toughness=TOUGHNESS),
    "curves of a pattern": _draw(("path", "jumps"), PATTERN, toughness=TOUGHNESS),
    "speed": _solve(FORCE, SLOW, rate=Rate(exponent=0.6)),
    "speed, same law of closing": _solve(
        ("dissipated_energy",), SLOW | {"closing_ratio": 0.5}, rate=Rate(exponent=0.6, closing="same")
    ),
    "states": _states,
    "fit": _fit,
}
"""What anything compiles: a name for each kind of scene, and its call."""


def warm_up(report: Callable[[str, float], None] = lambda *_: None, *, everything: bool = True) -> None:
    """Compile kernels, or read those that are kept, by solving a scene of each kind.

    Parameters
    ----------
    report
        Called after each kind with its name and the seconds that it took.
    everything
        Whether all kinds are solved, or only maps and curves of a paraboloid with one cosine wave.
    """
    for name, call in (EVERYTHING if everything else USUAL).items():
        start = time.monotonic()
        call()
        report(name, time.monotonic() - start)
