"""One curve as its rims see it."""

from typing import NamedTuple

from gradhesion.core.problem.results import Results


class Scene(NamedTuple):
    """The units of a curve, and where the results of its rims go.

    wavelength  lambda/R
    length      l = lambda/2 pi over R
    energy      the unit of energy, 2 pi l^2, in R^2 dgamma
    depth       the unit of depth, s l^c, in R
    results     slots, values and status of all rims
    """

    wavelength: float
    length: float
    energy: float
    depth: float
    results: Results
