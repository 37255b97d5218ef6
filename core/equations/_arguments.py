"""The arguments that equations share, each described once, in its type: meaning, unit and range.

A function lists its arguments by these types, and `documented` writes them into its docstring, so that `help` shows
them all. Lengths are in R and the material is its one number M R^(1+k)/dgamma (core/problem/material.py).
"""

import inspect
import re
from collections.abc import Callable, Sequence
from typing import Annotated, Any, Final, TypeVar, get_args

from numpy.typing import ArrayLike

from gradhesion.core.equations._domain import Array

Gradient = Annotated[ArrayLike, "Gradient exponent, 0 to 1."]
Stiffness = Annotated[ArrayLike, "M R^(1+k)/dgamma > 0, finite."]
StiffnessOrInf = Annotated[ArrayLike, "M R^(1+k)/dgamma > 0; inf is contact without adhesion."]
Radius = Annotated[ArrayLike, "a/R >= 0, the contact radius."]
PositiveRadius = Annotated[ArrayLike, "a/R > 0, the contact radius."]
LargestRadius = Annotated[ArrayLike, "a_am/R >= 0, the largest contact radius."]
Distance = Annotated[ArrayLike, "r/R >= 0, the distance from the axis."]
Inside = Annotated[ArrayLike, "r/R, the distance from the axis, 0 to a/R."]
Outside = Annotated[ArrayLike, "r/R, the distance from the axis, >= a/R."]
Depth = Annotated[ArrayLike, "delta/R, any: `indentation` of jkr.py or general.py in equilibrium."]
Wavelength = Annotated[ArrayLike, "lambda/R > 0; of a series, that of its first harmonic."]
Amplitude = Annotated[ArrayLike, "A, amplitude over wavelength, >= 0."]
Cosines = Annotated[Sequence[float], "a_1, a_2, ..., over the wavelength; [-A] is one cosine wave, [] a smooth punch."]
Sines = Annotated[Sequence[float], "b_1, b_2, ..., over the wavelength."]
Power = Annotated[ArrayLike, "m >= 1, the power of the smooth part: 1 is a cone, 2 a paraboloid."]
MeanHeight = Annotated[ArrayLike, "Mean height of the waves, lambda A/R or -lambda sum a_n/R; 0 for the printed form."]

Function = TypeVar("Function", bound=Callable[..., Any])

_SECTION: Final = re.compile(r"^(?=[A-Z][a-z]+\n-{3,}$)", re.MULTILINE)


def documented(function: Function) -> Function:
    """Write the sections Parameters and Returns of a docstring, unless it has them, from the types of the arguments.

    The signature that `help` shows has no types: the text gives them.
    """
    contract, *sections = _SECTION.split(inspect.getdoc(function) or "")
    types = dict(function.__annotations__)
    if types.pop("return") is Array and not any(section.startswith("Returns") for section in sections):
        sections.insert(0, "Returns\n-------\nArray of the broadcast shape; NaN outside the ranges.\n\n")
    described = "".join(f"{name}\n    {' '.join(get_args(type_)[1:])}\n" for name, type_ in types.items())
    function.__doc__ = "".join([contract.rstrip(), "\n\nParameters\n----------\n", described, "\n", *sections])
    signature = inspect.signature(function)
    plain = [one.replace(annotation=one.empty) for one in signature.parameters.values()]
    function.__signature__ = signature.replace(  # type: ignore[attr-defined]
        parameters=plain, return_annotation=signature.empty
    )
    return function
