"""Slopes of a value to the keys by which its scene is given: parameters, reduced variables, quantities with units.

The sensitivities of `solve` are to its parameters. How each of these depends on the given keys (closed/reduced.py) is
found by differences of fourth order, of logarithms, which are exact for powers; they go one way, since k and nu have
ends. A value in SI units is that of the theory times powers of R and of the work of adhesion.
"""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from gradhesion.core.closed.reduced import WAYS, parameters_from
from gradhesion.core.types import Floats

POWERS: Final = {
    "pull_off_force_sensitivity": {"R": 1.0, "work_of_adhesion": 1.0},
    "dissipated_energy_sensitivity": {"R": 2.0, "work_of_adhesion": 1.0},
}
"""The powers of the quantities in the unit of each value: 1.5 pi R dgamma and R^2 dgamma."""
PLAIN: Final = ("k", "nu")
"""Parameters whose sensitivities are to themselves, not to their logarithms: they may be 0."""
_OTHERS: Final = frozenset(way for ways in WAYS.values() for way in ways)
"""Keys that can stand in the place of a parameter."""
_STEP: Final = 2.0**-11  # of a logarithm, of k or of nu: 1e-14 of the fifth derivative, and 1e-11 of rounding
_WEIGHTS: Final = (-25.0 / 12.0, 4.0, -3.0, 4.0 / 3.0, -0.25)  # of values at 0 ... 4 steps in a slope at 0


def relative_slopes(
    given: Mapping[str, ArrayLike],
    keys: Sequence[str],
    parameters: Sequence[str],
    sensitivity: Floats,
    powers: Mapping[str, float],
) -> dict[str, Floats]:
    """Return d ln(value)/d ln(key) for keys out of `given`; for k and nu d ln(value)/d(key).

    `given` are the keys of the scenes, as arguments of `parameters_from` that broadcast to the scenes, `keys` those of
    them whose slopes are wanted. `sensitivity` is d ln(value)/d ln(parameter), of k and nu d ln(value)/d(parameter), of
    shape (*scenes, parameters), and `parameters` are the names along its last axis, "modulus" among them. `powers` are
    those of the keys in the unit of the value: one of `POWERS` for a value in SI units, else {}. Slopes are of shape
    `scenes`, NaN where a sensitivity that counts is missing; a value that is not positive has none.

    Examples
    --------
    Whatever the modulus, the pull-off force of a smooth unbounded punch is 1.5 pi R dgamma at k = 0:

    >>> ball = dict(k=0.0, nu=0.3, R=1e-6, work_of_adhesion=0.05, E_star=1e9, c0=1e-6, wavelength=1e-7, A=0.0,
    ...             a_max_over_R=np.inf)
    >>> names = ("k", "nu", "modulus", "c0_over_R", "lambda_over_R", "A", "a_max_over_R")
    >>> powers = POWERS["pull_off_force_sensitivity"]
    >>> found = relative_slopes(ball, ("R", "work_of_adhesion", "E_star"), names, np.zeros(7), powers)
    >>> [float(one) for one in found.values()]
    [1.0, 1.0, 0.0]
    """
    arrays, found = {name: np.asarray(one, dtype=float) for name, one in given.items()}, {}
    for key in keys:
        found[key] = powers.get(key, 0.0) + 0.0 * sensitivity[..., parameters.index("modulus")]
        for name, influence in _influences(arrays, key, parameters).items():
            part = sensitivity[..., parameters.index(name)] * influence
            found[key] = found[key] + np.where(influence == 0.0, 0.0, part)
    return found


def slopes_to_keys(
    given: Mapping[str, ArrayLike],
    keys: Sequence[str],
    parameters: Sequence[str],
    value: ArrayLike,
    sensitivity: Floats,
    powers: Mapping[str, float],
) -> dict[str, Floats]:
    """Return d(value)/d(key), NaN where the key is 0, of a value of shape `scenes`; all else as `relative_slopes`."""
    found = {}
    for key, relative in relative_slopes(given, keys, parameters, sensitivity, powers).items():
        place = np.asarray(given[key], dtype=float)
        unit = 1.0 if key in PLAIN else np.where(place == 0.0, np.nan, place)
        found[key] = np.asarray(value, dtype=float) * (relative / unit)
    return found


def _influences(given: Mapping[str, Floats], key: str, parameters: Sequence[str]) -> dict[str, Floats]:
    """Return d ln(parameter)/d ln(key) for each parameter, all other given keys fixed.

    k and nu, as parameter or as key, count by themselves, not by their logarithms. `given` are arrays that broadcast
    to the scenes, and so are the results; `key` is one of them. A parameter has 0 where it does not depend on the key:
    less than 1e-9 is rounding, and what is 0, infinite or NaN has no logarithm. If all that is given are parameters,
    they are independent: the key itself has 1, and others are left out.
    """
    if key in parameters and _OTHERS.isdisjoint(given):
        return {key: np.ones(())}
    step = np.asarray(_STEP)
    if key in PLAIN:  # inwards at the ends of the range, where nothing is on the other side
        step = np.where(given[key] > (0.25 if key == "k" else 0.0), -_STEP, _STEP)
    totals = dict.fromkeys(parameters, np.zeros(()))
    with np.errstate(all="ignore"):  # a key that is 0 or infinite has no logarithm, and no effect
        for i, weight in enumerate(_WEIGHTS):
            moved = given[key] + i * step if key in PLAIN else given[key] * np.exp(i * step)
            made = parameters_from({**given, key: moved})
            for name in parameters:
                one = made[name] if name in PLAIN else np.log(np.abs(made[name]))
                totals[name] = totals[name] + weight / step * one
    return {name: np.where(np.isfinite(total) & (np.abs(total) > 1e-9), total, 0.0) for name, total in totals.items()}
