"""Curves of one scene, by name."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.draw.approximations import draw_asymptotic, draw_effective, draw_envelope, draw_smooth
from gradhesion.core.draw.path import draw_equilibrium, draw_jumps, draw_path
from gradhesion.core.draw.scene import Drawn, draw_scene, frame_of
from gradhesion.core.problem.control import BY_DISPLACEMENT, Loading
from gradhesion.core.problem.names import CLOSING, CURVES, GENERAL_CURVES, PATTERN_CURVES, WITHOUT_LOAD
from gradhesion.core.problem.outputs import VARIABLES
from gradhesion.core.problem.profile import WAVY, Profile, starts_downwards
from gradhesion.core.problem.status import FAILED, NO_VALUE
from gradhesion.core.sweep import request_of, solve, turn_of

if TYPE_CHECKING:
    from gradhesion.core.problem.toughness import Rate, Toughness

_TYPES: Final = {name: np.dtype(VARIABLES[name].dtype) for names in CURVES.values() for name in names}
INTEGERS: Final = frozenset(name for name, dtype in _TYPES.items() if dtype.kind == "i")
"""The variables that are integers; the others are float64."""
_Curves = dict[str, NDArray[Any]]
_OF_A_CYCLE: Final = ("path", "jumps", "effective")  # the curves that turn where the cycle does
_OF_SIDES: Final = ("equilibrium", "closing_equilibrium", "path", "jumps")  # those that need a curve that is resolved
_DRAWERS: Final[dict[str, Callable[[Drawn], tuple[NDArray[Any], ...] | None]]] = {
    "equilibrium": draw_equilibrium,
    "closing_equilibrium": partial(draw_equilibrium, closing=True),
    "path": draw_path,
    "jumps": draw_jumps,
    "asymptotic": draw_asymptotic,
    "envelope": draw_envelope,
    "effective": draw_effective,
    "smooth": draw_smooth,
}


def _of_one_point(curve: str, value: float) -> list[NDArray[Any]]:
    """Return all variables of a curve, in the order of CURVES, each a value at one point, (1,); of "jumps" none, (0,).

    Integers are -1 where the value is NaN.
    """
    size = 0 if curve == "jumps" else 1
    return [np.full(size, -1 if math.isnan(value) and name in INTEGERS else value) for name in CURVES[curve]]


def _draw(drawn: Drawn, curve: str) -> tuple[NDArray[Any], ...] | None:
    """Return the variables of a curve, None where it has no value."""
    if (curve in _OF_A_CYCLE and math.isnan(drawn.turn)) or (curve in _OF_SIDES and not drawn.sides):
        return None
    with np.errstate(all="ignore"):
        found = _DRAWERS[curve](drawn)
    return found if found is not None and all(np.isfinite(values).all() for values in found) else None


def _check(
    scene: Mapping[str, float], curves: Sequence[str], loading: Loading, toughness: Toughness | None
) -> str | None:
    """Refuse what cannot be drawn; return the name of what a cycle turns at, None if that is the rim."""
    if unknown := [name for name in curves if name not in CURVES]:
        raise ValueError(f"unknown curves {unknown}")
    turn = turn_of(scene, loading, toughness)
    known = tuple(CURVES) if loading == BY_DISPLACEMENT else GENERAL_CURVES
    known = known if toughness is None else PATTERN_CURVES
    if absent := [name for name in curves if name not in known]:
        one = "asymptotic" if "asymptotic" in absent else "envelope"
        why = f"at a prescribed depth only: {WITHOUT_LOAD[one]}" if toughness is None else "of plain interfaces only"
        raise ValueError(f"curves {absent} are known {why}; there are {', '.join(known)}")
    return turn


def draw_curves(
    scene: Mapping[str, float],
    curves: Sequence[str],
    profile: Profile | None = None,
    loading: Loading | None = None,
    toughness: Toughness | None = None,
    rate: Rate | None = None,
) -> tuple[dict[str, NDArray[Any]], int]:
    """Return curves of one scene at points that adapt to them.

    Parameters
    ----------
    scene
        A number for each name of `PARAMETERS`, in the ranges of `solve`; a_max/R may be inf. Machine control also needs
        `machine_stiffness`, S/(E* R) > 0; `closing_ratio` is optional: "equilibrium" and "smooth" belong to opening.
        With one of `TURNS` path, jumps and the effective path turn where the cycle of `solve` does.
    curves
        Names from `CURVES`: "equilibrium", the whole equilibrium curve, stable and unstable; "closing_equilibrium",
        that of closing; "path", the cycle of loading and unloading; "asymptotic", the curve for short waves
        (5.15)-(5.20); "envelope", its two envelopes (5.21)-(5.27); "effective", the path along them (5.28)-(5.35);
        "smooth", the curve of A = 0; "jumps", the jumps of the cycle, one by one. The equations are those of one
        cosine; other profiles have the same (docs/theory.md, section 15).
    profile, loading
        Shape of the punch and its control, as in `solve`; under a control other than displacement only the curves of
        `GENERAL_CURVES` are available.
    toughness
        How the toughness varies with the radius, as in `solve`: with it only those of `PATTERN_CURVES` are available,
        and `scene` has the parameters of the pattern.
    rate
        How the work of adhesion grows with the speed, as in `solve`: the path is that of the moving edge then
        (rate/cycle.py), and `scene` has speed_over_reference.

    Returns
    -------
    variables
        All variables of each curve, one-dimensional, of the same length within a curve: radii a/R, depths delta/R and
        loads P/(1.5 pi R dgamma), negative where the punch pulls, and energies over R^2 dgamma. Those of `INTEGERS` are
        integers. A curve without a value is one point, NaN (-1 for integers); without jumps their arrays are empty.
    status
        Bits of status.FLAGS: no_value where a parameter is outside its range or a requested curve has more than 16,000
        of the shortest waves within the range of its folds; with the path or its jumps, what `solve` reports of them.

    Raises
    ------
    ValueError
        For an unknown curve, one that the control does not have, or parameters that are missing.

    Notes
    -----
    Stable means stable under the given control. A jump is a straight line at the prescribed depth, load, or
    delta + P/S; a contact that is pinned at the turn is one too. Under load control the path ends at the last fold,
    with radius 0 at its depth and load, since the punch then moves off freely; the energy of that jump is unbounded,
    and the jump is not listed.

    Curves reach from zero contact to the rim; those of an unbounded punch as far as scene.py says. Folds of depth,
    extrema of load, jumps, start and rim are points of their own, exact to rounding. Between them chords stay within
    2e-4 of the drawn span in each of the planes of load and depth, depth and radius, load and radius, measured across
    the chord. Most curves have some hundred points; waves far narrower than the picture need six to eight points each.

    Examples
    --------
    The smooth punch jumps in at depth zero and out at the fold of its depth:

    >>> scene = dict(k=0.0, nu=0.3, modulus=500.0, c0_over_R=0.01, lambda_over_R=0.1, A=0.0, a_max_over_R=np.inf)
    >>> variables, status = draw_curves(scene, ["path"])
    >>> variables["path_load"].min().round(6).item(), status
    (-1.0, 0)
    >>> variables["path_contact_radius"][variables["path_jump"] == 1].round(4).tolist()
    [0.2325, 0.0]
    """
    profile, loading = profile or WAVY, loading or BY_DISPLACEMENT
    turn = _check(scene, curves, loading, toughness)
    if rate is not None:
        from gradhesion.core.rate.cycle import draw_at_speed  # noqa: PLC0415 (seldom wanted)

        own: dict[str, Any] = {"profile": profile, "loading": loading}
        return draw_at_speed(scene, curves, rate, own, partial(draw_curves, **own))
    shape: dict[str, Any] = {"profile": profile, "loading": loading, "toughness": toughness}
    plain = {name: value for name, value in scene.items() if name != turn}
    frame = frame_of(request_of(plain, None, **shape))
    of_cycle = bool({*curves} & {"path", "jumps"})
    status, radius, pulled = 0, None, math.nan
    if turn is not None or of_cycle:
        outputs = ["turning_radius", "dissipated_energy", "loading_jumps", "unloading_jumps"]
        solved = solve(scene, outputs, threads=1, **shape)
        status = int(solved["status"])
        if turn is not None:
            radius = float(solved["turning_radius"])
            if frame is not None and frame.rim == math.inf:
                pulled = float(solve(plain, ["pull_off_radius"], threads=1, **shape)["pull_off_radius"])
    grows = scene.get(CLOSING, 1.0) == 0.0 and not starts_downwards(scene, profile)
    drawn = None if frame is None else draw_scene(frame, radius, pulled)._replace(grows=grows)
    result: _Curves = {}
    failed = drawn_cycle = False
    for curve in curves:
        found: Sequence[NDArray[Any]] | None = None
        if radius == 0.0 and curve in _OF_A_CYCLE:  # the cycle turns before it makes contact
            found = _of_one_point(curve, 0.0)
            if curve != "jumps":
                found[1][:] = scene["indentation_max_over_R"]
        elif drawn is not None:
            found = _draw(drawn, curve)
        failed |= found is None
        drawn_cycle |= found is not None and curve in ("path", "jumps")
        found = _of_one_point(curve, math.nan) if found is None else found
        result |= {name: one.astype(_TYPES[name]) for name, one in zip(CURVES[curve], found, strict=True)}
    return result, (status & ~FAILED if drawn_cycle else 0) | (NO_VALUE if failed else 0)
