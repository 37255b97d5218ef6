"""One curve as its rims see it."""

from typing import NamedTuple

from gradhesion.core.problem.results import Results


class Scene(NamedTuple):
    """The units of a curve, and where the results of its rims go."""

    wavelength: float  # lambda/R
    length: float  # l = lambda/2 pi over R
    energy: float  # the unit of energy, 2 pi l^2, in R^2 dgamma
    depth: float  # the unit of depth, s l^c, in R
    results: Results  # slots, values and status of all rims
