"""Where the model applies: the range of the attraction, the slope of the waves, their strength against adhesion.

    tabor_parameter        h/z0, the height h = L^m/R^(m-1) of the neck over the range z0 of the attraction, with
                           L^(2m-1+k) = R^(2m-2) dgamma/M;   m = 2:  L^2/(R z0),  L^(3+k) = R^2 dgamma/M
    wave_tabor_parameter   L_cr^2/(R_cr z0), L_cr^(3+k) = R_cr^2 dgamma/M, R_cr = lambda/(4 pi^2 A), of a crest
    wave_slope             2 pi A, the steepest slope of the waves
    johnson_alpha          1/(sqrt(pi) chi), chi = r/s of the unloading envelope (core/equations/envelopes.py);
                           k = 0 and one cosine:  sqrt(2 lambda dgamma/(pi^2 E* h^2)),  h = A lambda

Of a series slope and crest are the steepest and the sharpest of the period. Lengths are in R. Sources: Tabor (1977),
Johnson (1995) and Johnson & Greenwood (1997), carried over to a graded half-space in docs/validity.md.
"""

import math
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.closed.envelope import chis
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import PARAMETERS, RANGE, VALIDITY
from gradhesion.core.problem.profile import Profile, rows_of, swings

_Array = NDArray[np.float64]
_SLOPE, _CURVATURE = -1.0, -3.0  # exponents k at which zeta of `swings` is f2'/(2 pi A) and f2''/(4 pi^2 A)


def validity(
    parameters: Mapping[str, ArrayLike], outputs: Sequence[str] = VALIDITY, profile: Profile | None = None
) -> dict[str, _Array]:
    """Return the numbers that show where the model applies.

    Parameters
    ----------
    parameters
        An array for each name of `PARAMETERS`, with their ranges; for the Tabor parameters also adhesion_range_over_R,
        the range z0/R of the attraction, > 0 and finite. All broadcastable; a_max_over_R has no effect.
    outputs
        Names from `VALIDITY`.
    profile
        The shape of the punch, a paraboloid with one cosine wave if not given.

    Returns
    -------
    An array of the broadcast shape for each output; NaN outside the ranges. wave_tabor_parameter is NaN and
    johnson_alpha inf where A = 0. Accurate to a few units in the last place, and wave_tabor_parameter and
    johnson_alpha of a series to those of its terms.

    Raises
    ------
    ValueError
        For an unknown output, or parameters that are missing or do not broadcast.

    Examples
    --------
    A steel ball of 1 mm on rubber has a Tabor number of thousands, so JKR applies:

    >>> ball = dict(k=0.0, nu=0.5, modulus=1e4, c0_over_R=1.0, lambda_over_R=1.0, A=0.0, a_max_over_R=np.inf)
    >>> numbers = validity(ball | {"adhesion_range_over_R": 3e-7}, ["tabor_parameter", "wave_slope"])
    >>> round(float(numbers["tabor_parameter"])), float(numbers["wave_slope"])
    (7181, 0.0)
    """
    profile = profile or Profile()
    needed = (*PARAMETERS, *((RANGE,) if any("tabor" in name for name in outputs) else ()))
    unknown = [name for name in outputs if name not in VALIDITY]
    missing = [name for name in needed if name not in parameters]
    if unknown or missing:
        raise ValueError(f"unknown outputs {unknown}, missing parameters {missing}")
    arrays = {name: np.asarray(parameters[name], dtype=float) for name in (*PARAMETERS, *needed)}
    shape = np.broadcast_shapes(*(np.shape(array) for array in arrays.values()))
    k, nu, modulus, c0, wavelength, amplitude = (arrays[name] for name in PARAMETERS[:6])
    rows = tuple(map(tuple, rows_of(profile).tolist()))
    with np.errstate(all="ignore"):  # a scene that overflows has no value
        M = stiffness(k, nu, modulus, c0)
        reach = np.where(INPUTS[RANGE].admits(arrays[RANGE]), arrays[RANGE], np.nan) if RANGE in arrays else np.nan
        sound = np.isfinite(M)
        for name in PARAMETERS[4:]:
            sound = sound & INPUTS[name].admits(arrays[name])
        found = {}
        for name in outputs:
            if name == "wave_slope":
                values = 2.0 * math.pi * amplitude * max(swings(_SLOPE, rows))
            elif name == "johnson_alpha":
                values = 1.0 / (math.sqrt(math.pi) * chis(k, M, wavelength, amplitude, profile)[1])
            elif name == "tabor_parameter":
                m = profile.exponent
                values = M ** (-m / (2.0 * m - 1.0 + k)) / reach
            else:
                crest = wavelength / (4.0 * math.pi**2 * amplitude * swings(_CURVATURE, rows)[0])
                values = (crest**2 / M) ** (2.0 / (3.0 + k)) / (crest * reach)
                values = np.where(np.isfinite(crest), values, np.nan)
            found[name] = np.array(np.broadcast_to(np.where(sound, values, np.nan), shape))
    return found
