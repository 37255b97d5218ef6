"""The arguments that equations share, each described once, by its name: meaning, unit and range.

Lengths are in R and the material is its one number M R^(1+k)/dgamma (core/problem/material.py).
"""

import inspect
from collections.abc import Callable, Sequence
from typing import Any, Final, TypeAlias, TypeVar

from numpy.typing import ArrayLike

Real: TypeAlias = ArrayLike
"""A number, or an array of numbers."""
Waves: TypeAlias = Sequence[float]
"""The coefficients of a Fourier series, from the first harmonic on."""

MEANINGS: Final = {
    "k": "Gradient exponent, 0 to 1.",
    "stiffness": "M R^(1+k)/dgamma > 0; inf, which is contact without adhesion, has depths but no loads.",
    "radius": "a/R >= 0, the contact radius.",
    "largest_radius": "a_am/R >= 0, the largest contact radius.",
    "distance": "r/R, the distance from the axis: 0 to a/R for a pressure, >= a/R for a surface or gap.",
    "depth": "delta/R, any: `indentation` of jkr.py or general.py in equilibrium.",
    "wavelength": "lambda/R > 0; of a series, that of its first harmonic.",
    "amplitude": "A, amplitude over wavelength, >= 0.",
    "cosines": "a_1, a_2, ..., over the wavelength; [-A] is one cosine wave, [] a smooth punch.",
    "sines": "b_1, b_2, ..., over the wavelength.",
    "exponent": "m >= 1, the power of the smooth part: 1 is a cone, 2 a paraboloid.",
    "mean_height": "Mean height of the waves, lambda A/R or -lambda sum a_n/R; 0 for the printed form.",
    "adhesion": "s/R^((1+k)/2) > 0, as `envelopes.adhesion_strength`.",
    "waviness": "r/R^((1+k)/2) >= 0, as `envelopes.waviness_strength`.",
    "pull": "s - r for loading, s + r for unloading, over R^((1+k)/2).",
    "alpha": "A value of zeta, between `envelopes.zeta_extrema`.",
    "slope": "f'(r), a function of an array of r/R in (0, a/R); smooth there, and bounded at 0.",
    "shortest": "The shortest wave of f'/R, if it has waves.",
    "x": "Contact radius over wavelength, 0 <= x < 2**49.",
    "xi": "r/lambda or a/lambda, any.",
}

_Function = TypeVar("_Function", bound=Callable[..., Any])


def documented(
    returns: str = "Array of the broadcast shape; NaN outside the ranges.", **others: str
) -> Callable[[_Function], _Function]:
    """Have `help` describe all arguments of a function, those of its own by `others`, and what it returns."""

    def write(function: _Function) -> _Function:
        signature = inspect.signature(function)
        described = [f"{name}\n    {others.get(name) or MEANINGS[name]}\n" for name in signature.parameters]
        text = inspect.getdoc(function)
        function.__doc__ = f"{text}\n\nParameters\n----------\n{''.join(described)}\nReturns\n-------\n{returns}\n"
        plain = [one.replace(annotation=one.empty) for one in signature.parameters.values()]
        shown = signature.replace(parameters=plain, return_annotation=signature.empty)  # the text says what they are
        function.__signature__ = shown  # type: ignore[attr-defined]
        return function

    return write
