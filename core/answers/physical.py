"""Sensitivities to quantities with units: those to the parameters without units, by the chain rule.

A value in SI units is that of the theory times powers of R and of the work of adhesion, 1.5 pi R dgamma for the force
and R^2 dgamma for the energy. The parameters are powers of the quantities, or follow from them (closed/reduced.py);
how each follows from each is found by differences of logarithms, which are exact for powers.
"""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.closed.reduced import parameters_from

POWERS: Final = {
    "pull_off_force_sensitivity": {"R": 1.0, "work_of_adhesion": 1.0},
    "dissipated_energy_sensitivity": {"R": 2.0, "work_of_adhesion": 1.0},
}
"""The powers of the quantities in the unit of each value."""
_STEP: Final = 2.0**-6
"""In a logarithm: 4 eps/step is left of rounding, and of what is no power step^4/30 of the fifth derivative."""


def physical_sensitivities(
    given: Mapping[str, ArrayLike],
    quantities: Sequence[str],
    parameters: Sequence[str],
    output: str,
    sensitivity: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return d ln(value in SI units)/d ln(quantity) along a last axis.

    Parameters
    ----------
    given
        What gives the scenes, as `parameters_from` takes it; all broadcast to the scenes.
    quantities
        The names of those with units.
    parameters
        What `sensitivity` is to, in order; k and nu first, which no quantity changes.
    output
        One of `SENSITIVITIES`.
    sensitivity
        What `solve` gives; shape (*scenes, parameters).

    Returns
    -------
    Array of shape (*scenes, quantities); NaN where `sensitivity` is.

    Examples
    --------
    Whatever the modulus, the pull-off force of a smooth unbounded punch is 1.5 pi R dgamma at k = 0:

    >>> ball = dict(k=0.0, nu=0.3, R=1e-6, work_of_adhesion=0.05, E_star=1e9, c0=1e-6, wavelength=1e-7, A=0.0,
    ...             a_max_over_R=np.inf)
    >>> names = ("k", "nu", "modulus", "c0_over_R", "lambda_over_R", "A", "a_max_over_R")
    >>> keys = ("R", "work_of_adhesion", "E_star")
    >>> found = physical_sensitivities(ball, keys, names, "pull_off_force_sensitivity", np.zeros((1, 7)))
    >>> found.tolist()
    [[1.0, 1.0, 0.0]]
    """
    arrays = {name: np.asarray(value, dtype=float) for name, value in given.items()}
    found = np.empty((*sensitivity.shape[:-1], len(quantities)))
    for i, quantity in enumerate(quantities):
        total = np.full(sensitivity.shape[:-1], POWERS[output].get(quantity, 0.0))
        around = []
        for step in (-2.0, -1.0, 1.0, 2.0):
            moved = arrays[quantity] * np.exp(step * _STEP)
            around.append(parameters_from({**arrays, quantity: moved}))
        for j, name in enumerate(parameters[2:], 2):
            with np.errstate(all="ignore"):  # what is 0 or infinite has no logarithm, and no influence
                near = np.log(around[2][name] / around[1][name])
                far = np.log(around[3][name] / around[0][name])
            power = (8.0 * near - far) / (12.0 * _STEP)
            part = sensitivity[..., j] * np.where(np.isfinite(power), power, 0.0)
            total = total + part
        found[..., i] = total
    return found
