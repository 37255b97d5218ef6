"""The envelopes of a short wave, core/closed/envelope.py, for any power and series under displacement control.

Far out the waves of a series swing between +r_+ a^c and -r_- a^c about their mean height, r_+- those of
closed/crest.py. With z = a/l and l^(m-c) = s/F, F the factor of the depth of r^m/m, depths in s l^c and loads in K
l^(1+k) s l^c,

    depth = z^m - (1 - chi_+) z^c on loading,  z^m - (1 + chi_-) z^c on unloading,      chi_+- = r_+-/s
    load  = z^(1+k) [m/(1+k+m) z^m - (1 + chi_-) z^c],   least where z^(m-c) = (3+k)(1+chi_-)/(2m)

Contact is made at z_2^(m-c) = 1 - chi_+ and lost at z_4^(m-c) = c (1+chi_-)/m, both at most the rim, and the energy is
int z [rho_unloading^2 - rho_loading^2] dz as there: the squares of a wave have one mean on both ways and cancel.
"""

import math
from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.closed.crest import swings
from gradhesion.core.equations.envelopes import waviness_strength
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import REACH, RESULTS
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.results import INTEGERS
from gradhesion.core.problem.shape import rows_of
from gradhesion.core.problem.status import NO_VALUE

_Array = NDArray[np.float64]
_FORCE: Final = 8.0 / 3.0
"""4 pi over the 3 pi/2 of the unit of force."""


def _square(k: _Array, stretch: _Array, wavelength: _Array, amplitude: _Array, profile: Profile) -> _Array:
    """Return the mean square of the waves over s."""
    total = np.zeros(k.shape)
    for n, even, odd in rows_of(profile).tolist():
        total += 0.5 * n ** (1.0 - k) * (even * even + odd * odd)
    square: _Array = total * (waviness_strength(k, wavelength, amplitude) / stretch) ** 2
    return square


def chis(k: _Array, stretch: _Array, wavelength: _Array, amplitude: _Array, profile: Profile) -> tuple[_Array, _Array]:
    """Return chi_+ and chi_-, by which loading and unloading are off the mean of the waves, over s: (curves,)."""
    rows = tuple((float(n), float(even), float(odd)) for n, even, odd in rows_of(profile))
    up, down = np.full(k.shape, np.nan), np.full(k.shape, np.nan)
    known = (k >= 0.0) & (k <= 1.0)
    exponents, index = np.unique(k[known], return_inverse=True)
    both = np.array([swings(exponent, rows) for exponent in exponents.tolist()]).reshape(-1, 2)
    up[known], down[known] = both[index, 0], both[index, 1]
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
    c = 0.5 * (1.0 - k)
    power = m - c
    loading, unloading = 1.0 - up, 1.0 + down
    z_in = np.minimum(rim, np.maximum(0.0, loading) ** (1.0 / power))
    z_out = np.minimum(rim, (c / m * unloading) ** (1.0 / power))
    last = _depth(k, m, unloading, z_out)
    square = 2.0 * power + 2.0
    loaded = 0.5 * (loading * z_in) ** 2 - z_in**square / square
    unloaded = z_out**square / square - 2.0 * last * z_out ** (m + 1.0 + k) / (m + 1.0 + k)
    unloaded += last**2 * z_out ** (1.0 + k) / (1.0 + k) - 0.5 * (unloading * z_out) ** 2
    to_rim = np.where((up + down != 0.0) & (rim < np.inf), rim, 0.0) ** 2
    endless = np.where((up + down != 0.0) & (rim == np.inf), np.inf, 0.0)
    loaded += 0.5 * (up * (2.0 - up) - wave) * to_rim + endless
    unloaded += 0.5 * (down * (2.0 + down) + wave) * to_rim + endless
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
        c = 0.5 * (1.0 - k)
        up, down = chis(k, stretch, wavelength, amplitude, profile)
        length, unit, force = scales_of(k, stretch, m)
        reach, mean = rim / length, wavelength * amplitude * sum(harmonic.cos for harmonic in profile.harmonics)
        pull = np.minimum(reach, (0.5 * (3.0 + k) / m * (1.0 + down)) ** (1.0 / (m - c)))
        load = pull ** (0.5 * (3.0 + k)) * (1.0 + down - m / (1.0 + k + m) * pull ** (m - c))
        wave = _square(k, stretch, wavelength, amplitude, profile)
        loaded, unloaded, z_in, z_out, last = _cycle(k, m, up, down, wave, reach)
        area = 2.0 * math.pi * length**2
        deepest = np.where(np.isinf(rim), np.inf, np.maximum(0.0, mean + unit * _depth(k, m, 1.0 - up, reach)))
        values = (
            force * load,
            np.where(pull < reach, pull * length, rim),
            area * (loaded + unloaded),
            np.where(valid, (z_in > 0.0) * 1.0, np.nan),
            np.where(valid, (z_out > 0.0) * 1.0, np.nan),
            np.where(valid, deepest, np.nan),
            mean + unit * last,
            area * loaded,
            area * unloaded,
            np.where(up + down == 0.0, z_in * length, np.where(valid, np.inf, np.nan)),  # with waves there is no end
        )
    found: dict[str, NDArray[Any]] = {}
    for name in outputs:
        value: NDArray[Any] = values[(*RESULTS, REACH).index(name)]
        if name in INTEGERS:
            value = np.where(np.isnan(value), -1.0, value).astype(np.int32)
        found[name] = value.reshape(shape)
    found["status"] = np.where(valid, 0, NO_VALUE).astype(np.int8).reshape(shape)
    return found
