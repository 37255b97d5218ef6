"""Curves of one scene, by name."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.curves import general
from gradhesion.core.curves.asymptotic import draw_asymptotic
from gradhesion.core.curves.effective import draw_effective
from gradhesion.core.curves.envelope import draw_envelope
from gradhesion.core.curves.equilibrium import draw_equilibrium
from gradhesion.core.curves.forms import General
from gradhesion.core.curves.jumps import list_jumps
from gradhesion.core.curves.path import draw_path
from gradhesion.core.curves.smooth import draw_smooth
from gradhesion.core.curves.subject import BEYOND, Subject, subject_of
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.names import CLOSING, CURVES, PARAMETERS, PATTERN, PATTERN_CURVES, TURNS, WITHOUT_LOAD
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.status import FAILED, NO_VALUE
from gradhesion.core.sweep import solve

if TYPE_CHECKING:
    from gradhesion.core.problem.rate import Rate
    from gradhesion.core.problem.toughness import Toughness

_TYPES: Final[dict[str, type[np.signedinteger[Any]]]] = {
    "stable": np.int8,
    "closing_stable": np.int8,
    "path_branch": np.int32,
    "path_jump": np.int8,
    "path_unloading": np.int8,
    "effective_jump": np.int8,
    "jump_unloading": np.int8,
    "jump_at_rim": np.int8,
}
INTEGERS: Final = frozenset(_TYPES)
"""The variables that are integers; the others are float64."""
_OF_A_CYCLE: Final = ("path", "jumps", "effective")
"""The curves that turn where the cycle does."""
_EXACT: Final = {"equilibrium": draw_equilibrium, "path": draw_path, "jumps": list_jumps}
_OF_PROFILES: Final = {"asymptotic": draw_asymptotic, "envelope": draw_envelope, "effective": draw_effective}
"""Approximations, under displacement control."""

GENERAL_CURVES: Final = ("equilibrium", "closing_equilibrium", "path", "smooth", "jumps")
"""The curves of any profile under any control."""


def subject_for(
    scene: Mapping[str, float], profile: Profile, loading: Loading, toughness: Toughness | None = None
) -> Subject | None:
    """Return a scene of any kind ready for drawing, None where a parameter is outside its range."""
    if toughness is not None:
        from gradhesion.core.curves import patterned  # noqa: PLC0415 (kernels of their own)

        return patterned.subject_of(scene, profile, loading, toughness)
    default = profile == Profile() and loading == Loading()
    return subject_of(scene) if default else general.subject_of(scene, profile, loading)


def _draw(subject: Subject | None, curve: str, profile: Profile) -> dict[str, NDArray[Any]] | None:
    """Return the variables of a curve, None where it has no value."""
    if subject is None or (curve in _EXACT and subject.trace is None):
        return None
    of_curve: dict[str, Any] = {name: partial(draw, profile=profile) for name, draw in _OF_PROFILES.items()}
    of_curve |= {"smooth": general.draw_smooth if isinstance(subject.exact.numbers, General) else draw_smooth}
    of_curve |= _EXACT
    with np.errstate(all="ignore"):
        variables = of_curve[curve](subject)
    if variables is None or not all(np.isfinite(values).all() for values in variables.values()):
        return None
    return variables


def _without_contact(curve: str, scene: Mapping[str, float]) -> dict[str, NDArray[Any]]:
    """Return the path or the jumps of a cycle that turns before it makes contact: one point, no jump."""
    size = 0 if curve == "jumps" else 1
    variables: dict[str, NDArray[Any]] = {name: np.zeros(size, _TYPES.get(name, np.float64)) for name in CURVES[curve]}
    if curve == "path":
        variables["path_indentation"][:] = scene["indentation_max_over_R"]
    return variables


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
        `machine_stiffness`, S/(E* R) > 0; `closing_ratio` is optional (works/curves.py). With one of `TURNS` path,
        jumps and the effective path turn where the cycle of `solve` does.
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
        How the toughness varies with the radius, as in `solve`: with it only "equilibrium", "path" and "jumps" are
        available, and `scene` has the parameters of the pattern.
    rate
        How the work of adhesion grows with the speed, as in `solve`: the path is that of the moving edge then
        (rate/curves.py), and `scene` has speed_over_reference.

    Returns
    -------
    variables
        All variables of each curve, one-dimensional, of the same length within a curve: radii a/R, depths delta/R and
        loads P/(1.5 pi R dgamma), negative where the punch pulls, and energies over R^2 dgamma. Those of `INTEGERS` are
        integers. A curve without a value is one point, NaN (-1 for integers); without jumps their arrays are empty.
    status
        Bits of status.FLAGS: no_value where a parameter is outside its range or a requested curve can fold
        more than 100,000 times within the range (20,000 times for another profile or control); with the path or its
        jumps, what `solve` reports of them.

    Raises
    ------
    ValueError
        For an unknown curve, one that the control does not have, or parameters that are missing.

    Notes
    -----
    Stable means stable under the given control. A jump is a straight line at the prescribed depth, load, or
    delta + P/S; a contact that is pinned at the rim is one too. Under load control the path ends at the last fold, with
    radius 0 at its depth and load, since the punch then moves off freely; the energy of that jump is unbounded, and
    the jump is not listed.

    Curves reach from zero contact to the rim. Those of an unbounded punch end at 1.5 times the radius where the smooth
    curve crosses zero depth, or 5 % beyond the last fold of depth, extremum of load or jump of loading; where a cycle
    turns at a depth or a load, 5 % beyond that and the pull-off. Folds of depth, extrema of load, jumps, start and rim
    are points of their own, exact to rounding. Between them chords stay within
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
    unknown = [name for name in curves if name not in CURVES]
    missing = [name for name in PARAMETERS if name not in scene]
    if unknown or missing:
        raise ValueError(f"unknown curves {unknown}, missing parameters {missing}")
    profile, loading = profile or Profile(), loading or Loading()
    if ("machine_stiffness" in scene) != (loading.control == "machine"):
        raise ValueError(f"machine_stiffness belongs to control 'machine' and to no other; control {loading.control!r}")
    if (PATTERN[0] in scene) != (toughness is not None):
        raise ValueError(f"{PATTERN[0]} belongs to a pattern of toughness, which needs it")
    known = tuple(CURVES) if loading == Loading() else GENERAL_CURVES
    if toughness is not None:
        known = PATTERN_CURVES
    absent = [name for name in curves if name not in known]
    if absent:
        one = "asymptotic" if "asymptotic" in absent else "envelope"
        why = f"at a prescribed depth only: {WITHOUT_LOAD[one]}" if toughness is None else "of plain interfaces only"
        raise ValueError(f"curves {absent} are known {why}; there are {', '.join(known)}")
    if rate is not None:
        from gradhesion.core.rate.curves import draw_at_speed  # noqa: PLC0415 (seldom wanted)

        return draw_at_speed(scene, curves, profile, loading, rate)
    if CLOSING in scene or "closing_equilibrium" in curves:
        from gradhesion.core.works.curves import draw_two_works  # noqa: PLC0415 (seldom wanted)

        return draw_two_works({CLOSING: 1.0, **scene}, curves, profile, loading, toughness)
    turns = [name for name in TURNS if name in scene]
    if len(turns) > 1:
        raise ValueError(f"{' and '.join(turns)} are given: a cycle turns at one of them")
    plain = {name: value for name, value in scene.items() if name not in turns}
    of = partial(subject_for, profile=profile, loading=loading, toughness=toughness)
    driven: dict[str, Any] = {"threads": 1, "profile": profile, "loading": loading, "toughness": toughness}
    subject = round_trip = of(plain)
    radius = math.inf
    if turns:
        radius = float(solve(scene, ["turning_radius"], **driven)["turning_radius"])
        round_trip = of(plain | {"a_max_over_R": radius})
        if subject is not None and not subject.bounded:
            pulled = float(solve(plain, ["pull_off_radius"], **driven)["pull_off_radius"])
            subject = of(plain | {"a_max_over_R": BEYOND * max(radius, pulled)})
    result: dict[str, NDArray[Any]] = {}
    status, cycle = 0, False
    for curve in curves:
        variables: dict[str, NDArray[Any]] | None
        if radius == 0.0 and curve in _OF_A_CYCLE:
            variables = _without_contact(curve, scene)
        else:
            variables = _draw(round_trip if curve in _OF_A_CYCLE else subject, curve, profile)
        if turns and variables is not None and "jump_at_rim" in variables and radius < scene["a_max_over_R"]:
            variables["jump_at_rim"][:] = 0
        if variables is None:
            status |= NO_VALUE
            size = 0 if curve == "jumps" else 1
            result |= {
                name: np.full(size, -1, _TYPES[name]) if name in _TYPES else np.full(size, np.nan)
                for name in CURVES[curve]
            }
        else:
            result |= variables
            cycle = cycle or curve in ("path", "jumps")
    if cycle:
        outputs = ["dissipated_energy", "loading_jumps", "unloading_jumps"]
        solved = solve(scene, outputs, **driven)
        status |= int(solved["status"]) & ~FAILED
    return result, status
