"""States of contact as curves: the pressure under the punch, and the surface of the half-space around it.

A state is a contact radius with a depth. Every radius has its state of equilibrium; three states of a loading cycle
have names: `turning_point`, where unloading begins at a rim that is finite; `pull_off`, where the load is lowest; and
`jump_out`, the last before contact is lost. Lengths are in R, pressures in dgamma/R. Source: (2.2), (3.1)-(3.5), (4.2),
(4.9), (4.10) of Jin, Guo & Wan (2013).
"""

import math
from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from gradhesion.core.draw.draw import draw_curves
from gradhesion.core.equations import general, quadrature
from gradhesion.core.equations._arguments import Array
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.outputs import CURVES
from gradhesion.core.problem.profile import Profile
from gradhesion.core.sweep import solve

NAMED_STATES: Final = ("turning_point", "pull_off", "jump_out")
"""The states of a cycle that have a name."""
STATE_CURVES: Final = tuple(name for name, curve in CURVES.items() if curve.of_a_state)
"""The curves of a state."""
_FEWEST, _MOST, _A_WAVE = 96, 4096, 24  # points of a curve: at least, at most, and for each of the shortest waves
_BEYOND: Final = 2.0  # how far the surface is drawn, in contact radii
_WAVES_BEYOND: Final = 2.0  # how far it is drawn beyond the contact at least, in wavelengths of a wavy punch


def series_of(amplitude: float, profile: Profile) -> tuple[list[float], list[float]]:
    """Return a profile's waves of an amplitude A as coefficients of general.py: a_1, a_2, ... and b_1, b_2, ...

    >>> series_of(0.02, Profile())
    ([-0.02], [0.0])
    """
    waves = profile.harmonics if amplitude > 0.0 else ()
    count = max((wave.n for wave in waves), default=0)
    cosines, sines = [0.0] * count, [0.0] * count
    for wave in waves:
        cosines[wave.n - 1] -= amplitude * wave.cos
        sines[wave.n - 1] += amplitude * wave.sin
    return cosines, sines


def equilibrium_states(scene: Mapping[str, float], radii: Sequence[float], profile: Profile | None = None) -> Array:
    """Return the states of equilibrium of given radii a/R: a/R and delta/R, (2, radii).

    `scene` has a number for each name of `PARAMETERS`, `profile` is as in `solve`. NaN for a radius outside (0, a_max]
    or a scene out of range.

    Examples
    --------
    >>> scene = dict(k=1.0, nu=0.5, modulus=500.0, c0_over_R=1.0, lambda_over_R=0.1, A=0.0, a_max_over_R=0.3)
    >>> equilibrium_states(scene, [0.2, 0.4]).round(4).tolist()
    [[0.2, nan], [-0.0694, nan]]
    """
    shape = profile or Profile()
    a = np.asarray(radii, dtype=float)
    a = np.where((a > 0.0) & (a <= scene["a_max_over_R"]), a, np.nan)
    with np.errstate(all="ignore"):
        material = stiffness(scene["k"], scene["nu"], scene["modulus"], scene["c0_over_R"])
        wave = series_of(scene["A"], shape)
        depth = general.indentation(scene["k"], material, a, scene["lambda_over_R"], *wave, shape.exponent)
    return np.array([np.where(np.isnan(depth), np.nan, a), depth])


def named_states(
    scene: Mapping[str, float], profile: Profile | None = None, loading: Loading | None = None
) -> tuple[Array, int]:
    """Return the states of a loading cycle that have a name, and the status of the cycle as `solve` reports it.

    `scene` has a number for each name of `PARAMETERS`, and `machine_stiffness` under machine control; profile and
    loading are as in `solve`. States are a/R and delta/R, (2, 3): the turning point (at the depth to which the rim is
    pressed), the pull-off and the jump-out. NaN for one that is absent: there is no turning point without a rim or a
    depth or load to turn at, and no jump-out where contact shrinks to a point.

    Examples
    --------
    The smooth punch jumps out below its pull-off:

    >>> scene = dict(k=0.0, nu=0.3, modulus=500.0, c0_over_R=1.0, lambda_over_R=0.1, A=0.0, a_max_over_R=0.3)
    >>> states, status = named_states(scene)
    >>> states.round(4).tolist()
    [[0.3, 0.1919, 0.0923], [0.0286, -0.0123, -0.0255]]
    """
    outputs = ["pull_off_radius", "delta_max", "delta_jump_out", "turning_radius"]
    solved = solve(scene, outputs, profile=profile, loading=loading)
    states = np.full((2, 3), np.nan)
    rim, pull_off = float(solved["turning_radius"]), float(solved["pull_off_radius"])
    if 0.0 < rim < math.inf:
        states[:, 0] = rim, float(solved["delta_max"])
    if pull_off > 0.0:
        states[:, 1] = equilibrium_states(scene, [pull_off], profile)[:, 0]
    jumps, _ = draw_curves(scene, ["jumps"], profile, loading)
    away = np.flatnonzero((jumps["jump_radius_after"] == 0.0) & (jumps["jump_unloading"] == 1))
    if away.size:
        states[:, 2] = jumps["jump_radius_before"][away[-1]], float(solved["delta_jump_out"])
    states[:, np.isnan(states).any(axis=0)] = np.nan
    return states, int(solved["status"])


def draw_states(
    scene: Mapping[str, float], states: Array, curves: Sequence[str], profile: Profile | None = None
) -> dict[str, Array]:
    """Return the pressure under the punch and the surface around it, in given states.

    `scene` has a number for each name of `PARAMETERS`; states are a/R and delta/R, (2, states), curves names out of
    `STATE_CURVES`, and `profile` is as in `solve`.

    Returns
    -------
    The variables of the curves, each of shape (states, points), NaN in a state that is absent: `pressure_radius` (r/R,
    from 0 to just short of the edge, where for k < 1 the pressure has no bound, denser there) and `pressure`
    (p R/dgamma, compression positive); `surface_radius` (r/R, from 0 through the edge to two contact radii, and two
    wavelengths beyond the edge at least), `surface_displacement` (u_z/R, positive into the half-space) and
    `surface_gap` (/R; 0 within the contact, NaN beyond the rim, where no punch is).

    Examples
    --------
    >>> scene = dict(k=0.0, nu=0.3, modulus=500.0, c0_over_R=1.0, lambda_over_R=0.1, A=0.0, a_max_over_R=0.3)
    >>> found = draw_states(scene, equilibrium_states(scene, [0.2]), ["pressure"])
    >>> found["pressure"].round(2)[0, :2].tolist(), found["pressure_radius"].max().round(4).item()
    ([23.77, 23.75], 0.2)
    """
    shape = profile or Profile()
    k, wavelength = scene["k"], scene["lambda_over_R"]
    with np.errstate(all="ignore"):
        material = float(stiffness(k, scene["nu"], scene["modulus"], scene["c0_over_R"]))
    cosines, sines = series_of(scene["A"], shape)
    wave = (wavelength, cosines, sines, shape.exponent)
    waves = float(np.nanmax(states[0], initial=0.0)) * len(cosines) / wavelength
    count = int(min(_MOST, max(_FEWEST, math.ceil(_A_WAVE * waves))))
    half = count // 2

    def pressure(a: float, depth: float) -> tuple[Array, ...]:
        """Return the pressure of a state, in steps that fall to zero towards the edge, which is left out."""
        r = a * np.sin(0.5 * math.pi * np.arange(count) / count)
        return r, quadrature.pressure(k, material, r, a, depth, *wave)

    def surface(a: float, depth: float) -> tuple[Array, ...]:
        """Return the surface of a state, dense outside the edge, where it leaves the punch with an upright tangent."""
        end = max(_BEYOND * a, a + (_WAVES_BEYOND * wavelength if cosines else 0.0))
        outside = a + (end - a) * (np.arange(half + 1) / half) ** 2
        r = np.concatenate([a * np.arange(half) / half, outside])
        opening = np.concatenate([np.zeros(half), quadrature.series_gap(k, outside, a, depth, *wave)])
        height = r**shape.exponent / shape.exponent + wavelength * general.waviness(r / wavelength, cosines, sines)
        return r, depth - height + opening, np.where(r <= scene["a_max_over_R"], opening, np.nan)

    found: dict[str, Array] = {}
    for curve, draw, points in (("pressure", pressure, count), ("surface", surface, 2 * half + 1)):
        if curve in curves:
            drawn = np.full((len(CURVES[curve].names), states.shape[1], points), np.nan)
            for i in np.flatnonzero(~np.isnan(states).any(axis=0)):
                drawn[:, i] = draw(*states[:, i])
            found |= dict(zip(CURVES[curve].names, drawn, strict=True))
    return found
