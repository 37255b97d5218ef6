"""Compilation ahead of the first use: small work of a kind, done for its kernels."""

import math
from typing import Any, Final

import numpy as np

from gradhesion.core.arrays.cosine import run_tasks
from gradhesion.core.arrays.grouping import grouped
from gradhesion.core.compiler.marks import note_compiled
from gradhesion.core.kinds import KINDS, MANY_SMOOTH
from gradhesion.core.problem.control import BY_DISPLACEMENT, Loading
from gradhesion.core.problem.curves import Curves, GeneralCurves
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import OUTPUTS, REPORTS, SENSITIVITIES
from gradhesion.core.problem.profile import WAVY, Harmonic, Profile
from gradhesion.core.problem.results import Results, slots_of
from gradhesion.core.sensitivities.wanted import NoSense
from gradhesion.core.struve.interpolated import interpolated_tables
from gradhesion.core.struve.layout import TABLE
from gradhesion.core.struve.table import build_table, struve_pair
from gradhesion.core.sweep import solve

SCENE: Final[dict[str, float]] = {
    "k": 0.3,
    "nu": 0.3,
    "modulus": 500.0,
    "c0_over_R": 0.01,
    "lambda_over_R": 0.1,
    "A": 0.03,
    "a_max_over_R": 0.5,
}
FAR: Final = {"lambda_over_R": 1e-3, "a_max_over_R": 1.0}
"""A thousand waves that fold: more than are walked of any profile."""
SPRING: Final[dict[str, float]] = {"machine_stiffness": 3.0}
LOOPS: Final = ("force", "energy", "general_force", "general_energy")
"""The kinds whose loop over curves can be compiled before the tables that it reads."""
MANY: Final = Profile(exponent=2.5, harmonics=tuple(Harmonic(n=n, cos=1.0 / n) for n in range(1, 25)))
"""More harmonics than are summed one by one (harmonics/series_table.py)."""


def compile_loop(kind: str) -> None:
    """Compile the loop over curves of one of `LOOPS`, of no curve: it needs no table for that, nor its kernels.

    So one process compiles the tables meanwhile. Afterwards `compile_kind` compiles what else the kind has.
    """
    none, numbers, rims = np.empty(0), np.empty(0, dtype=np.int64), np.empty((1, 1))
    tables = np.zeros(1, dtype=TABLE)
    results = Results(
        slots_of([], check_contact=False, turned=False), np.empty((0, 0, 1)), np.empty((0, 1), dtype=np.int8)
    )
    if not kind.startswith("general_"):
        from gradhesion.core.scene.solvers import LOOPS as SOLVERS  # noqa: PLC0415 (kernels of their own)
        from gradhesion.core.scene.solvers import PULL_OFF_LOOP  # noqa: PLC0415

        of_cosine = PULL_OFF_LOOP if kind == "force" else SOLVERS["exact"]
        of_cosine(Curves(tables, numbers, numbers, none, none, none, rims), results, np.empty((1, 1)), NoSense())
        return
    from gradhesion.core.curve.general import Basis  # noqa: PLC0415 (kernels of their own)
    from gradhesion.core.scene.general import solve_pull_offs, solve_scenes  # noqa: PLC0415

    curves = GeneralCurves(numbers, 2.0, 1.0, none, none, none, none, rims)
    loop = solve_pull_offs if kind == "general_force" else solve_scenes
    loop(Basis(tables[0], none, np.empty((0, 3))), curves, results, NoSense())


def _compile_curves() -> None:
    """Draw a wavy punch with a rim, one without, and a smooth one."""
    from gradhesion.core.curves import CURVES, draw_curves  # noqa: PLC0415 (kernels of their own)

    for change in ({}, {"a_max_over_R": math.inf}, {"A": 0.0}):
        draw_curves(SCENE | change, list(CURVES))


def _compile_general_curves() -> None:
    """Do the same for another profile, by a machine."""
    from gradhesion.core.curves import GENERAL_CURVES, draw_curves  # noqa: PLC0415 (kernels of their own)

    for change in ({}, {"a_max_over_R": math.inf}, {"A": 0.0}):
        draw_curves(SCENE | SPRING | change, list(GENERAL_CURVES), MANY, Loading(control="machine"))
    draw_curves(SCENE, ("asymptotic", "envelope"), MANY)


def _compile_patterned(what: str) -> None:
    """Do some work of a kind on an interface with a pattern of toughness: "" is a map."""
    from gradhesion.core.curves import draw_curves  # noqa: PLC0415 (kernels of their own)
    from gradhesion.core.problem.toughness import Toughness, ToughnessHarmonic  # noqa: PLC0415

    pattern = Toughness((ToughnessHarmonic(n=1, cos=0.2, sin=0.1),))
    scene = SCENE | {"toughness_wavelength_over_R": 0.07}
    if what == "curves":
        draw_curves(scene, ("equilibrium", "path", "jumps"), toughness=pattern)
        return
    turns = ({"indentation_max_over_R": 0.05}, {"load_max": 1.0}) if what == "turning" else ({},)
    outputs = {"reports": (*OUTPUTS, *REPORTS), "sensitivities": SENSITIVITIES}.get(what, OUTPUTS)
    for turn in turns:
        solve(scene | turn, outputs, toughness=pattern, threads=1)


def _compile_edge() -> None:
    """Find a pull after a jump, and how a turning point moves."""
    from gradhesion.core.sweep import How  # noqa: PLC0415 (kernels of their own)
    from gradhesion.core.works.snap_in import pulls_at  # noqa: PLC0415
    from gradhesion.core.works.turn_slopes import turn_slopes  # noqa: PLC0415

    how = How("exact", False, 1, WAVY, BY_DISPLACEMENT, is_one_wave=True)
    pulls_at(SCENE, how)
    turn_slopes(SCENE, False, how)


def _compile_loops() -> None:
    """Find the pair at a radius, the distance of a point to a line, the way up a slope, and a place on it."""
    from gradhesion.core.loops.paths.distance import feet  # noqa: PLC0415 (kernels of their own)
    from gradhesion.core.loops.paths.walk import climb, crossing  # noqa: PLC0415

    struve_pair(0.3, 0.0)
    feet(np.zeros((1, 2)), np.eye(2))
    climb(np.arange(4.0), np.arange(4.0), 0.0)
    crossing(np.arange(4.0), np.arange(4.0), 1, 0.5)


def _compile_rate() -> None:
    """Open and close a wavy punch at a speed."""
    from gradhesion.core.arrays.rate import close_at_speed, open_at_speed  # noqa: PLC0415 (kernels of their own)
    from gradhesion.core.problem.rate import Rate  # noqa: PLC0415

    for solve_at_speed in (open_at_speed, close_at_speed):
        solve_at_speed(SCENE | {"speed_over_reference": 0.1}, Rate(exponent=0.6), WAVY, Loading(), 1)


def compile_kind(kind: str) -> None:
    """Compile the kernels of a kind of work, or read them from the cache.

    Processes may do so side by side, each kind after those of `NEEDS`. Two that compile the same kernel at once do no
    harm to the values, but may leave an index of the cache that forgets one of them.

    Parameters
    ----------
    kind
        One of `KINDS`.

    Raises
    ------
    ValueError
        For an unknown kind.
    """
    family: dict[str, Any] = {"profile": MANY} if kind.startswith("general_") else {}
    driven = family | {"loading": Loading(control="machine")} if family else {}
    scene = SCENE | SPRING if family else SCENE
    match kind.removeprefix("general_"):
        case "tables":
            stiffness(0.3, 0.3, 500.0, 0.01)
            build_table(0.3)
            interpolated_tables(np.array([0.3]), whole=True)
            run_tasks(grouped(SCENE), 1, lambda *_: None)
        case "force":
            solve(scene, ["pull_off_force"], threads=1, **driven)
        case "long":
            solve(scene | FAR, OUTPUTS, threads=1, **driven)
        case "long_sensitivities":
            solve(scene | FAR, SENSITIVITIES, threads=1, **driven)
        case "energy":
            solve(scene, OUTPUTS, threads=1, **driven)
        case "smooth":
            rims = np.linspace(0.1, 1.0, MANY_SMOOTH)
            solve(SCENE | {"A": 0.0, "a_max_over_R": rims}, ["pull_off_force"], threads=1)
        case "turning":
            for turn in ({"indentation_max_over_R": 0.05}, {"load_max": 1.0}):
                solve(scene | turn, OUTPUTS, threads=1, **driven)
        case "reports":
            solve(scene, (*OUTPUTS, *REPORTS), threads=1, **driven)
        case "asymptotic" | "envelope" as solver:
            solve(SCENE, OUTPUTS, solver=solver, threads=1, **family)
        case "curves" if family:
            _compile_general_curves()
        case "curves":
            _compile_curves()
        case "edge":
            _compile_edge()
        case "rate":
            _compile_rate()
        case "loops":
            _compile_loops()
        case _ if kind.partition("_")[0] == "patterned":
            _compile_patterned(kind.partition("_")[2])
        case "sensitivities":
            solve(scene, SENSITIVITIES, threads=1, **driven)
        case _:
            raise ValueError(f"kind {kind!r}: it is one of {', '.join(KINDS)}")
    note_compiled(kind)
