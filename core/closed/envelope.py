"""The envelopes of short waves, for any power and series under displacement control: closed forms for lambda << a.

Far out the waves swing between +r_+ a^c and -r_- a^c about their mean height, c = (1-k)/2, as `chis` has them over the
stretch s (of one cosine both are r, (5.26)). With z = a/l and l^(m-c) = s/F, F the factor of the depth of r^m/m, depths
in s l^c and loads in K l^(1+k) s l^c,

    depth = z^m - (1 - chi_+) z^c on loading,  z^m - (1 + chi_-) z^c on unloading
    load  = z^(1+k) [m/(1+k+m) z^m - (1 + chi_-) z^c],   least where z^(m-c) = (3+k)(1+chi_-)/(2m)

each a smooth punch of another work of adhesion. Loading jumps in at the depth 0, to z_2^(m-c) = 1 - chi_+ (0 if chi_+ >
1), unloading out at z_4^(m-c) = c (1+chi_-)/m, both at most the rim, and the energy is int z [rho_unloading^2 -
rho_loading^2] dz, rho = (depth_H - depth)/z^c: a sum of powers, for m = 2 that of (5.36)-(5.43) for any rim. It grows
with the square of the rim without bound: the envelopes do not include the radius at which folds end.

The printed formulae leave out the mean height of the waves. It is added to delta_max and delta_jump_out. The energy
leaves it out, as printed: its jump-in is at the mean surface, which makes an error of the order (lambda/a)^c beside the
lambda/a of all else. The force has an error of the order (lambda/a)^2, one wave not being at its lowest point. Without
waves all is exact. Jin, Guo & Wan (2013).
"""

import math
from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.equations._crests import swings_of
from gradhesion.core.equations.envelopes import waviness_strength
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import INTEGERS, REACH, RESULTS
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.shape import rows_of
from gradhesion.core.problem.status import NO_VALUE

_Array = NDArray[np.float64]
_FORCE: Final = 8.0 / 3.0
"""4 pi over the 3 pi/2 of the unit of force."""


def chis(k: _Array, stretch: _Array, wavelength: _Array, amplitude: _Array, profile: Profile) -> tuple[_Array, _Array]:
    """Return chi_+ and chi_-, by which loading and unloading are off the mean of the waves, over s: (curves,)."""
    up, down = swings_of(k, tuple(map(tuple, rows_of(profile).tolist())))
    one = waviness_strength(k, wavelength, amplitude) / stretch
    return one * up, one * down


def scales_of(k: _Array, stretch: _Array, m: float) -> tuple[_Array, _Array, _Array]:
    """Return l in R, the unit of depth s l^c in R, and that of load in 1.5 pi R dgamma, of some k and s: (curves,)."""
    from scipy.special import beta  # noqa: PLC0415 (200 ms that no other solver needs)

    c = 0.5 * (1.0 - k)
    depth_factor = 1.0 / (1.0 + k) if m == 2.0 else 0.5 * beta(0.5 * m, 0.5 * (1.0 + k))
    length = (stretch / depth_factor) ** (1.0 / (m - c))
    return length, stretch * length**c, _FORCE / (depth_factor * (1.0 + k)) * length ** (2.0 - m)


def _depth(k: _Array, m: float, pull: _Array, z: _Array) -> _Array:
    """Return the depth on the envelope of a pull."""
    depth: _Array = z**m - pull * z ** (0.5 * (1.0 - k))
    return depth


def _cycle(
    k: _Array, m: float, up: _Array, down: _Array, wave: _Array, rim: _Array
) -> tuple[_Array, _Array, _Array, _Array, _Array]:
    """Return what loading and unloading lose over 2 pi l^2 dgamma, z_2, z_4, and the last depth.

    `wave` is the mean square of the waves over s, which is a part of both and cancels in their sum.
    """
    power = m - 0.5 * (1.0 - k)
    loading, unloading = 1.0 - up, 1.0 + down
    z_in = np.minimum(rim, np.maximum(0.0, loading) ** (1.0 / power))
    z_out = np.minimum(rim, (0.5 * (1.0 - k) / m * unloading) ** (1.0 / power))
    last = _depth(k, m, unloading, z_out)
    square = 2.0 * power + 2.0
    loaded = 0.5 * (loading * z_in) ** 2 - z_in**square / square
    unloaded = z_out**square / square - 2.0 * last * z_out ** (m + 1.0 + k) / (m + 1.0 + k)
    unloaded += last**2 * z_out ** (1.0 + k) / (1.0 + k) - 0.5 * (unloading * z_out) ** 2
    to_rim = np.where(up + down != 0.0, rim, 0.0) ** 2
    for lost, share in ((loaded, up * (2.0 - up) - wave), (unloaded, down * (2.0 + down) + wave)):
        lost += np.where(np.isinf(to_rim), np.inf, 0.5 * share * to_rim)
    return loaded, unloaded, z_in, z_out, last


def solve_envelope(
    parameters: Mapping[str, ArrayLike], names: Sequence[str], outputs: Sequence[str], profile: Profile
) -> dict[str, NDArray[Any]]:
    """Solve all scenes of the parameters `names` by the envelopes of a profile, as `solve` of core/sweep.py."""
    m = profile.exponent
    arrays = np.broadcast_arrays(*(np.asarray(parameters[key], dtype=float) for key in names))
    shape = arrays[0].shape
    k, nu, modulus, c0, wavelength, amplitude, rim = (np.ascontiguousarray(a).ravel() for a in arrays)
    with np.errstate(all="ignore"):
        stretch = np.sqrt(2.0 ** (1.0 + k) * math.pi / stiffness(k, nu, modulus, c0))
        valid = (stretch > 0.0) & (stretch < np.inf) & (wavelength > 0.0) & (wavelength < np.inf)
        valid &= (amplitude >= 0.0) & (amplitude < np.inf) & (rim > 0.0)
        k, stretch, wavelength, amplitude, rim = (
            np.where(valid, each, np.nan) for each in (k, stretch, wavelength, amplitude, rim)
        )
        up, down = chis(k, stretch, wavelength, amplitude, profile)
        one = waviness_strength(k, wavelength, amplitude) / stretch
        wave = sum(0.5 * n ** (1.0 - k) * (even**2 + odd**2) for n, even, odd in rows_of(profile)) * one**2
        length, unit, force = scales_of(k, stretch, m)
        reach, mean = rim / length, wavelength * amplitude * sum(harmonic.cos for harmonic in profile.harmonics)
        power = m - 0.5 * (1.0 - k)
        pull = np.minimum(reach, (0.5 * (3.0 + k) / m * (1.0 + down)) ** (1.0 / power))
        load = pull ** (0.5 * (3.0 + k)) * (1.0 + down - m / (1.0 + k + m) * pull**power)
        loaded, unloaded, z_in, z_out, last = _cycle(k, m, up, down, wave, reach)
        area = 2.0 * math.pi * length**2
        deepest = np.where(np.isinf(rim), np.inf, np.maximum(0.0, mean + unit * _depth(k, m, 1.0 - up, reach)))
        rows = (
            force * load,
            np.where(pull < reach, pull * length, rim),
            area * (loaded + unloaded),
            (z_in > 0.0) * 1.0,
            (z_out > 0.0) * 1.0,
            deepest,
            mean + unit * last,
            area * loaded,
            area * unloaded,
            np.where(up + down == 0.0, z_in * length, np.inf),  # with waves there is no end
        )
    found: dict[str, NDArray[Any]] = {}
    for name in outputs:
        value: NDArray[Any] = np.where(valid, rows[(*RESULTS, REACH).index(name)], -1.0 if name in INTEGERS else np.nan)
        found[name] = (value.astype(np.int32) if name in INTEGERS else value).reshape(shape)
    found["status"] = np.where(valid, 0, NO_VALUE).astype(np.int8).reshape(shape)
    return found
