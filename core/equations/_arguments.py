"""What equations share: their arguments, each described once, by its name; arrays that are NaN out of range.

Lengths are in R, loads in 1.5 pi R dgamma, and the material is its one number M R^(1+k)/dgamma.
"""

import inspect
import math
import sys
from collections.abc import Callable, Sequence
from typing import Any, Final, TypeAlias, get_origin

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array: TypeAlias = NDArray[np.float64]
Real: TypeAlias = ArrayLike
"""A number, or an array of numbers."""
Waves: TypeAlias = Sequence[float]
"""The coefficients of a Fourier series, from the first harmonic on."""

LOAD_UNIT: Final = 1.5 * math.pi
"""1.5 pi R dgamma over R dgamma."""
MEANINGS: Final = {
    "k": "Gradient exponent, 0 to 1.",
    "stiffness": "M R^(1+k)/dgamma > 0; inf, which is contact without adhesion, has depths but no loads.",
    "radius": "a/R >= 0, the contact radius; > 0 where a formula divides by it.",
    "largest_radius": "a_am/R >= 0, the largest contact radius.",
    "distance": "r/R, the distance from the axis: 0 to a/R for a pressure, >= a/R for a surface or gap.",
    "depth": "delta/R, any: `indentation` of jkr.py or general.py in equilibrium.",
    "wavelength": "lambda/R > 0; of a series, that of its first harmonic.",
    "amplitude": "A, amplitude over wavelength, >= 0.",
    "cosines": "a_1, a_2, ..., over the wavelength; [-A] is one cosine wave, [] a smooth punch.",
    "sines": "b_1, b_2, ..., over the wavelength.",
    "exponent": "m >= 1, the power of the smooth part: 1 is a cone, 2 a paraboloid.",
    "mean_height": "Mean height of the waves, lambda A/R or -lambda sum a_n/R, or whether to add it; the printed form "
    "leaves it out.",
    "adhesion": "s/R^((1+k)/2) > 0, as `envelopes.adhesion_strength`.",
    "waviness": "r/R^((1+k)/2) >= 0, as `envelopes.waviness_strength`.",
    "pull": "s - r for loading, s + r for unloading, over R^((1+k)/2).",
    "ratio": "r/s >= 0; of `saturation.share` u >= 0, the slope of the smooth punch over the steepest of the wave.",
    "alpha": "A value of zeta, between `envelopes.zeta_extrema`.",
    "slope": "f'(r), a function of an array of r/R in (0, a/R); smooth there, and bounded at 0.",
    "shortest": "The shortest wave of f'/R, if it has waves.",
    "x": "Contact radius over wavelength, 0 <= x < 2**49.",
    "xi": "r/lambda or a/lambda, any.",
    "radius_of_punch": "R in m.",
    "work_of_adhesion": "dgamma in J/m^2.",
}


def describe(module: str) -> None:
    """Have `help` describe arguments and results of all public functions of a module that do not do so themselves."""
    for function in list(vars(sys.modules[module]).values()):
        if inspect.isfunction(function) and function.__module__ == module and not function.__name__.startswith("_"):
            text, signature = inspect.getdoc(function) or "", inspect.signature(function)
            if "Parameters\n---" not in text:
                text += "\n\nParameters\n----------\n"
                text += "\n".join(f"{name}\n    {MEANINGS[name]}" for name in signature.parameters)
            several = get_origin(signature.return_annotation) is tuple
            if "Returns\n---" not in text and (several or signature.return_annotation == Array):
                result = "Arrays" if several else "Array"
                text += f"\n\nReturns\n-------\n{result} of the broadcast shape; NaN outside the ranges."
            plain = [one.replace(annotation=one.empty) for one in signature.parameters.values()]  # the text has it
            shown = signature.replace(parameters=plain, return_annotation=signature.empty)
            function.__doc__, function.__signature__ = text, shown  # type: ignore[attr-defined]


def exponent_of(k: Real) -> Array:
    """Return k as an array, NaN outside [0, 1]."""
    values = np.asarray(k, dtype=float)
    return np.where((values >= 0.0) & (values <= 1.0), values, np.nan)


def positive(values: Real) -> Array:
    """Return an array, NaN where it is not above 0."""
    array = np.asarray(values, dtype=float)
    return np.where(array > 0.0, array, np.nan)


def not_negative(values: Real) -> Array:
    """Return an array, NaN where it is not 0 or more."""
    array = np.asarray(values, dtype=float)
    return np.where(array >= 0.0, array, np.nan)


def power_of(exponent: Real) -> Array:
    """Return the power m of a smooth profile as an array, NaN below 1."""
    m = np.asarray(exponent, dtype=float)
    return np.where(m >= 1.0, m, np.nan)


def point_by_point(formula: Callable[..., float], *numbers: Real) -> Array:
    """Return a formula of floats at every point of broadcast arrays, NaN where one of them is NaN."""
    arrays = np.broadcast_arrays(*numbers)
    out = np.full(arrays[0].shape, np.nan)
    for place in np.ndindex(out.shape):
        point: list[Any] = [float(array[place]) for array in arrays]
        if not any(math.isnan(number) for number in point):
            out[place] = formula(*point)
    return out
