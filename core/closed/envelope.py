"""The envelopes of short waves, for any power and series under displacement control: closed forms for lambda << a.

Far out the waves swing between +r_+ a^c and -r_- a^c about their mean height, c = (1-k)/2, as `chis` has them over the
stretch s (of one cosine both are r, (5.26)). Loading is a smooth punch of the pull s (1 - chi_+), unloading one of
s (1 + chi_-), as `equations.envelopes` has them. Loading jumps in at the depth 0, unloading out at its fold, both at
most at the rim, and the energy is int 2 pi a (rho_unloading^2 - rho_loading^2) da, rho = (depth_H - depth)/Delta: a sum
of powers, for m = 2 that of (5.36)-(5.43) for any rim. It grows with the square of the rim without bound: the envelopes
do not include the radius at which folds end.

The printed formulae leave out the mean height of the waves. It is added to delta_max and delta_jump_out. The energy
leaves it out, as printed: its jump-in is at the mean surface, which makes an error of the order (lambda/a)^c beside the
lambda/a of all else. The force has an error of the order (lambda/a)^2, one wave not being at its lowest point. Without
waves all is exact. Jin, Guo & Wan (2013).
"""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.equations import envelopes, hertz
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import INTEGERS, REACH
from gradhesion.core.problem.profile import Profile, rows_of, swings_of
from gradhesion.core.problem.status import NO_VALUE

_Array = NDArray[np.float64]


def chis(k: _Array, M: _Array, wavelength: _Array, amplitude: _Array, profile: Profile) -> tuple[_Array, _Array]:
    """Return chi_+ and chi_-, by which loading and unloading are off the mean of the waves, over s."""
    up, down = swings_of(k, tuple(map(tuple, rows_of(profile).tolist())))
    one = envelopes.waviness_strength(k, wavelength, amplitude) / envelopes.adhesion_strength(k, M)
    return one * up, one * down


def solve_envelope(
    parameters: Mapping[str, ArrayLike], names: Sequence[str], outputs: Sequence[str], profile: Profile
) -> dict[str, NDArray[Any]]:
    """Solve all scenes of the parameters `names` by the envelopes of a profile, as `solve` of core/sweep.py."""
    arrays = np.broadcast_arrays(*(np.asarray(parameters[key], dtype=float) for key in names))
    k, nu, modulus, c0, wavelength, amplitude, rim = arrays
    m, harmonics = profile.exponent, profile.harmonics
    with np.errstate(all="ignore"):
        M = stiffness(k, nu, modulus, c0)
        s, c = envelopes.adhesion_strength(k, M), 0.5 * (1.0 - k)
        valid = (s > 0.0) & (s < np.inf) & (wavelength > 0.0) & (wavelength < np.inf)
        valid &= (amplitude >= 0.0) & (amplitude < np.inf) & (rim > 0.0)
        k = np.where(valid, k, np.nan)
        up, down = chis(k, M, wavelength, amplitude, profile)
        loading, unloading, bounded = s * (1.0 - up), s * (1.0 + down), rim < np.inf
        mean = wavelength * amplitude * sum(harmonic.cos for harmonic in harmonics)

        place, force = envelopes.power_pull_off(k, M, unloading, m)
        force = np.where(place < rim, force, -envelopes.load(k, M, rim, unloading, m))
        deepest = np.maximum(0.0, envelopes.indentation(k, rim, loading, mean, m))
        jump_in = np.minimum(rim, envelopes.power_radii(k, np.maximum(0.0, loading), m)[0])
        jump_out = np.minimum(rim, envelopes.power_radii(k, unloading, m)[1])
        last = envelopes.indentation(k, jump_out, unloading, 0.0, m)

        # 2 pi int a rho^2 da of the jumps, with depth_H and depth at their ends over s a^c
        pressed_in, pressed_out = (hertz.power_indentation(k, 1.0, m) / s * a ** (m - c) for a in (jump_in, jump_out))
        level, power = last / (s * jump_out**c), 2.0 * m + 1.0 + k
        loaded = jump_in**2 * (0.5 * (1.0 - up) ** 2 - pressed_in**2 / power)
        unloaded = pressed_out**2 / power - 2.0 * pressed_out * level / (m + 1.0 + k) + level**2 / (1.0 + k)
        unloaded = jump_out**2 * (unloaded - 0.5 * (1.0 + down) ** 2)
        # and from there to the rim; the mean square of the waves is a part of both, and cancels in their sum
        square = sum(0.5 * n ** (1.0 - k) * (even**2 + odd**2) for n, even, odd in rows_of(profile))
        square = square * (envelopes.waviness_strength(k, wavelength, amplitude) / s) ** 2
        wavy = up + down != 0.0
        loaded, unloaded = (
            2.0 * math.pi * np.where(wavy, np.where(bounded, jumps + 0.5 * rest * rim**2, np.inf), jumps)
            for jumps, rest in ((loaded, up * (2.0 - up) - square), (unloaded, down * (2.0 + down) + square))
        )
        results = {
            "pull_off_force": force,
            "pull_off_radius": np.minimum(place, rim),
            "dissipated_energy": loaded + unloaded,
            "loading_jumps": (jump_in > 0.0) * 1.0,
            "unloading_jumps": (jump_out > 0.0) * 1.0,
            "delta_max": np.where(bounded, deepest, np.inf),
            "delta_jump_out": mean + last,
            "loading_energy": loaded,
            "unloading_energy": unloaded,
            REACH: np.where(wavy, np.inf, jump_in),  # with waves there is no end
        }
    found: dict[str, NDArray[Any]] = {"status": np.where(valid, 0, NO_VALUE).astype(np.int8)}
    for name in outputs:
        value: NDArray[Any] = np.where(valid, results[name], -1.0 if name in INTEGERS else np.nan)
        found[name] = value.astype(np.int32) if name in INTEGERS else value
    return found
