"""Kernels compiled ahead: a small scene of each kind, solved for the kernels that it compiles."""

import math
import time
from collections.abc import Callable
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
DEEP: Final = {"indentation_max_over_R": 0.05}
PRESSED: Final = {"load_max": 1.0}

SERIES: Final = Profile(exponent=2.5, harmonics=tuple(Harmonic(n=n, cos=1.0 / n) for n in range(1, 25)))
BY_LOAD: Final = Loading(control="load")
BY_MACHINE: Final = Loading(control="machine")
TOUGHNESS: Final = Toughness((ToughnessHarmonic(n=1, cos=0.2, sin=0.1),))
RATE: Final = Rate(exponent=0.6)

_FORCE: Final = ("pull_off_force",)
_OF_BOTH_CONTROLS: Final = ("equilibrium", "closing_equilibrium", "path", "smooth", "jumps")
"""The curves that are drawn under any control."""


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
    fixed = {
        "k": SCENE["k"],
        "nu": SCENE["nu"],
        "R": R,
        "E_star": SCENE["modulus"] * work / R,
        "work_of_adhesion": work,
    }
    fixed |= {"c0": R * SCENE["c0_over_R"], "wavelength": R * SCENE["lambda_over_R"]}
    noise = (1e-4 * R, 1e-3 * R * work)
    fit_loop(R * depth, 1.5 * math.pi * R * work * load, back, fixed, {"A": (0.02, 0.04)}, noise=noise, starts=1)


def _of_maps(scene: dict[str, Any], outputs: tuple[str, ...], **settings: Any) -> Callable[[], object]:
    """Return a call that solves a scene for some outputs."""
    return lambda: solve(scene, outputs, threads=1, **settings)


def _of_curves(scene: dict[str, float], curves: tuple[str, ...], **settings: Any) -> Callable[[], object]:
    """Return a call that draws curves of a scene."""
    return lambda: draw_curves(scene, curves, **settings)


USUAL: Final[dict[str, Callable[[], object]]] = {
    "force": _of_maps(SCENE, _FORCE),
    "force and energy": _of_maps(SCENE, OUTPUTS),
    "smooth punch": _of_maps(SCENE | {"A": 0.0}, OUTPUTS),
    "unbounded punch": _of_maps(SCENE | {"a_max_over_R": math.inf}, OUTPUTS),
    "envelope": _of_maps(SCENE, OUTPUTS, solver="envelope"),
    "curves": _of_curves(SCENE, tuple(CURVES)),
    "curves of a smooth punch": _of_curves(SCENE | {"A": 0.0}, tuple(CURVES)),
    "curves of an unbounded punch": _of_curves(SCENE | {"a_max_over_R": math.inf}, tuple(CURVES)),
}
"""What maps and curves of a paraboloid with one cosine wave compile."""
EVERYTHING: Final[dict[str, Callable[[], object]]] = USUAL | {
    "many smooth punches": _of_maps(SCENE | {"A": 0.0, "a_max_over_R": np.linspace(0.1, 1.0, 4096)}, _FORCE),
    "many waves": _of_maps(MANY_WAVES, OUTPUTS),
    "reports": _of_maps(SCENE, REPORTS),
    "turn at a depth": _of_maps(SCENE | DEEP, OUTPUTS),
    "turn at a load": _of_maps(SCENE | PRESSED, OUTPUTS),
    "closing ratio": _of_maps(SCENE | {"closing_ratio": 0.5}, (*OUTPUTS, "snap_in_force")),
    "sensitivities": _of_maps(SCENE, SENSITIVITIES),
    "sensitivities of turns": _of_maps(SCENE | DEEP | {"closing_ratio": 0.5}, SENSITIVITIES),
    "sensitivities of many waves": _of_maps(MANY_WAVES, SENSITIVITIES),
    "asymptotic": _of_maps(SCENE, OUTPUTS, solver="asymptotic"),
    "series": _of_maps(SCENE, OUTPUTS, profile=SERIES),
    "series, many waves": _of_maps(MANY_WAVES, OUTPUTS, profile=SERIES),
    "series, sensitivities": _of_maps(MANY_WAVES, SENSITIVITIES, profile=SERIES),
    "force of a series": _of_maps(SCENE, _FORCE, profile=SERIES),
    "envelope of a series": _of_maps(SCENE, OUTPUTS, profile=SERIES, solver="envelope"),
    "curves of a series": _of_curves(SCENE, tuple(CURVES), profile=SERIES),
    "load control": _of_maps(SCENE, OUTPUTS, loading=BY_LOAD),
    "machine": _of_maps(MACHINE, (*OUTPUTS, *REPORTS), loading=BY_MACHINE),
    "machine, turned": _of_maps(MACHINE | DEEP, OUTPUTS, loading=BY_MACHINE),
    "machine, sensitivities": _of_maps(MACHINE, SENSITIVITIES, loading=BY_MACHINE),
    "curves of a machine": _of_curves(MACHINE, _OF_BOTH_CONTROLS, loading=BY_MACHINE),
    "pattern": _of_maps(PATTERN, (*OUTPUTS, *REPORTS), toughness=TOUGHNESS),
    "pattern, turned": _of_maps(PATTERN | DEEP, OUTPUTS, toughness=TOUGHNESS),
    "pattern, sensitivities": _of_maps(PATTERN, SENSITIVITIES, toughness=TOUGHNESS),
    "curves of a pattern": _of_curves(PATTERN, ("equilibrium", "path", "jumps"), toughness=TOUGHNESS),
    "speed": _of_maps(SCENE | {"speed_over_reference": 0.1}, OUTPUTS[:1], rate=RATE),
    "speed, same law of closing": _of_maps(
        SCENE | {"speed_over_reference": 0.1, "closing_ratio": 0.5},
        ("dissipated_energy",),
        rate=Rate(exponent=0.6, closing="same"),
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
