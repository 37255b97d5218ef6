"""What equations share: their arguments, each described once, by its name; arrays that are NaN out of range."""

import inspect
import math
from collections.abc import Sequence
from functools import partial
from types import ModuleType
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array: TypeAlias = NDArray[np.float64]
Real: TypeAlias = ArrayLike
"""A number, or an array of numbers."""
Waves: TypeAlias = Sequence[float]
"""The coefficients of a Fourier series, from the first harmonic on."""
MEANINGS: Final = {
    "k": "Gradient exponent, 0 to 1.",
    "stiffness": "M R^(1+k)/dgamma > 0; inf, which is contact without adhesion, has depths but no loads.",
    "radius": "a/R >= 0, the contact radius; > 0 where a formula divides by it. Of the shape of a punch r/R, the "
    "distance from its axis.",
    "largest_radius": "a_am/R >= 0, the largest contact radius.",
    "distance": "r/R, the distance from the axis: 0 to a/R for a pressure, >= a/R for a surface or gap.",
    "depth": "delta/R, any: `indentation` of jkr.py or general.py in equilibrium.",
    "wavelength": "lambda/R > 0; of a series, that of its first harmonic.",
    "amplitude": "A, amplitude over wavelength, >= 0.",
    "cosines": "a_1, a_2, ..., over the wavelength; [-A] is one cosine wave, [] a smooth punch.",
    "sines": "b_1, b_2, ..., over the wavelength.",
    "waves": "(n, a_n, b_n) of each harmonic, over the wavelength.",
    "heights": "f2 at xi = 0, 1/N, ..., (N-1)/N, over the wavelength; a constant in it has no effect.",
    "terms": "How many harmonics, 1 or more; of N samples up to (N-1)/2.",
    "exponent": "m >= 1, the power of the smooth part: 1 is a cone, 2 a paraboloid.",
    "mean_height": "Mean height of the waves, lambda A/R or -lambda sum a_n/R, or whether to add it; the printed form "
    "leaves it out.",
    "adhesion": "s/R^((1+k)/2) > 0, as `envelopes.adhesion_strength`.",
    "waviness": "r/R^((1+k)/2) >= 0, as `envelopes.waviness_strength`; of `general.coefficients` f2, a function of an "
    "array of xi in [0, 1), over lambda.",
    "pull": "s - r for loading, s + r for unloading, over R^((1+k)/2).",
    "ratio": "r/s >= 0; of `short_waves.share` u >= 0, the slope of the smooth punch over the steepest of the wave.",
    "alpha": "A value of zeta, between `envelopes.zeta_extrema`.",
    "slope": "f'(r), a function of an array of r/R in (0, a/R); smooth there, and bounded at 0.",
    "shortest": "The shortest wave of f'/R, if it has waves.",
    "x": "Contact radius over wavelength, 0 <= x < 2**49.",
    "xi": "r/lambda or a/lambda, any.",
    "radius_of_punch": "R in m.",
    "work_of_adhesion": "dgamma in J/m^2.",
}


def describe(module: ModuleType) -> None:
    """Have `help` describe arguments and results of all public functions of a module."""
    for function in vars(module).values():
        if inspect.isfunction(function) and function.__module__ == module.__name__ and function.__name__[0] != "_":
            signature = inspect.signature(function)
            arguments = "\n".join(f"{name}\n    {MEANINGS[name]}" for name in signature.parameters)
            result = "Returns\n-------\nAn array of the broadcast shape, or several; NaN outside the ranges."
            text = f"{inspect.getdoc(function)}\n\nParameters\n----------\n{arguments}"
            plain = [one.replace(annotation=one.empty) for one in signature.parameters.values()]  # the text has it
            shown = signature.replace(parameters=plain, return_annotation=signature.empty)
            function.__doc__ = text if "Returns\n---" in text else f"{text}\n\n{result}"
            function.__signature__ = shown  # type: ignore[attr-defined]


def _within(values: Real, low: float, high: float = math.inf) -> Array:
    """Return an array, NaN outside [low, high]."""
    array = np.asarray(values, dtype=float)
    return np.where((array >= low) & (array <= high), array, np.nan)


exponent_of: Final = partial(_within, low=0.0, high=1.0)
"""Return k as an array, NaN outside [0, 1]."""
power_of: Final = partial(_within, low=1.0)
"""Return the power m of a smooth profile as an array, NaN below 1."""
not_negative: Final = partial(_within, low=0.0)
"""Return an array, NaN where it is not 0 or more."""
positive: Final = partial(_within, low=math.ulp(0.0))
"""Return an array, NaN where it is not above 0."""
