"""Scenes given in other variables than those of `solve`: in reduced ones, or in SI units.

R, c0, wavelength, amplitude, a_max, indentation_max, toughness_wavelength and adhesion_range are in m, E_star and E =
E_star (1 - nu^2) in Pa, work_of_adhesion and that of closing in J/m^2, spring_constant in N/m, preload in N, speeds in
m/s. lambda_over_L, chi, a_max_over_L and a_max_over_a2 are the variables of closed/similarity.py: a_2 is that of
loading, at the work of closing; all others are at work_of_adhesion, that of opening.
"""

import math
from collections.abc import Callable, Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.closed.similarity import amplitude_of_ratio, jump_in_radius_of_envelope, similarity_length
from gradhesion.core.problem.inputs import INPUTS, PHYSICAL
from gradhesion.core.problem.names import CLOSING, PARAMETERS

_Array = NDArray[np.float64]


def _ways() -> dict[str, dict[str, tuple[str, ...]]]:
    """Return for each parameter the inputs that can give it and what else that needs, reduced ones first."""
    found: dict[str, dict[str, tuple[str, ...]]] = {}
    for name, one in sorted(INPUTS.items(), key=lambda item: item[0] in PHYSICAL):
        if one.needs:
            found.setdefault(one.instead_of or one.gives, {})[name] = one.needs
    return found


def _of_chi(chi: Any, k: Any, nu: Any, modulus: Any, c0_over_R: Any, lambda_over_R: Any) -> Any:
    """Return the amplitude over the wavelength that makes a roughness parameter."""
    return amplitude_of_ratio(k, nu, modulus, c0_over_R, lambda_over_R, chi)


def _over_length(ratio: Any, *material: Any) -> Any:
    """Return what is given over the similarity length L, over R."""
    return ratio * similarity_length(*material)


_FORMULAS: Final[dict[str, Callable[..., Any]]] = {
    **{name: one.follows for name, one in INPUTS.items() if one.follows},
    "lambda_over_L": _over_length,
    "chi": _of_chi,
    "a_max_over_L": _over_length,
    "a_max_over_a2": lambda ratio, *scene: ratio * jump_in_radius_of_envelope(*scene),
}
WAYS: Final = _ways()
"""Variables that can give a parameter, and what else that needs; in the order in which they follow from another."""
_IN_WAYS: Final = {name for ways in WAYS.values() for way, needed in ways.items() for name in (way, *needed)}
"""Inputs from which parameters follow: left out of the result, unless they are wanted themselves."""
_OPTIONAL: Final = tuple(name for name, one in INPUTS.items() if one.is_parameter and one.group)
"""Parameters that not every scene has."""


def parameters_from(given: Mapping[str, ArrayLike]) -> dict[str, _Array]:
    """Return the parameters of `solve`, those that are not given made from what is; ValueError if nothing gives one.

    `given` are arrays by name, all broadcastable: for each parameter itself, or one of those above in its place. Others
    stay as they are; machine_stiffness, indentation_max_over_R, load_max, closing_ratio and adhesion_range_over_R are
    made if spring_constant, indentation_max, preload, work_of_adhesion_closing or adhesion_range is given; R, E_star
    and the like are left out. Each result is over the axes that it depends on. What is out of range or does not exist
    (a_2 for r >= s) is NaN. Accurate to a few units in the last place, but for a_2 (see there).

    Examples
    --------
    A probe of an atomic force microscope, and the same in numbers:

    >>> probe = dict(R=1e-6, E_star=1e9, work_of_adhesion=0.05, c0=1e-8, wavelength=1e-7, a_max=math.inf)
    >>> made = parameters_from(dict(k=0.5, nu=0.3, A=0.02) | probe)
    >>> {name: round(float(values), 9) for name, values in made.items()}
    {'k': 0.5, 'nu': 0.3, 'modulus': 20000.0, 'c0_over_R': 0.01, 'lambda_over_R': 0.1, 'A': 0.02, 'a_max_over_R': inf}
    """
    known = {name: np.asarray(values, dtype=float) for name, values in given.items()}
    wanted = (*PARAMETERS, *(name for name in _OPTIONAL if {name, *WAYS.get(name, ())} & known.keys()))
    closing = (CLOSING,) if CLOSING in wanted else ()
    for parameter in (*closing, *(("E_star",) if "E" in known else ()), *wanted):
        if parameter not in known:
            way, needed = _way(parameter, known)
            others = [known[name] for name in needed]
            with np.errstate(all="ignore"):  # what overflows has no value
                if way == "a_max_over_a2" and closing:
                    others[needed.index("modulus")] = known["modulus"] / known[CLOSING]
                known[parameter] = np.asarray(_FORMULAS[way](known[way], *others))
    return {name: known[name] for name in (*wanted, *(name for name in given if name not in _IN_WAYS | {*wanted}))}


def sources_of(parameter: str, given: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the names out of what is given that a parameter of `solve` follows from: itself if it is one of them.

    `parameter` is one of `PARAMETERS` or `TURNS`, machine_stiffness, closing_ratio or adhesion_range_over_R, `given` as
    to `parameters_from`, only its names; a ValueError if nothing determines it.

    Examples
    --------
    >>> sources_of("lambda_over_R", dict.fromkeys(["k", "nu", "modulus", "c0", "R", "lambda_over_L"]))
    ('lambda_over_L', 'k', 'nu', 'modulus', 'c0', 'R')
    """
    if parameter in given:
        return (parameter,)
    way, needed = _way(parameter, given)
    if way == "a_max_over_a2" and {CLOSING, *WAYS[CLOSING]} & given.keys():
        needed = (*needed, CLOSING)
    return tuple(dict.fromkeys(source for name in (way, *needed) for source in _given_for(name, given)))


def _given_for(name: str, given: Mapping[str, Any]) -> tuple[str, ...]:
    """Return what a name follows from: itself if nothing else gives it."""
    return sources_of(name, given) if name in WAYS or name in PARAMETERS else (name,)


def _way(parameter: str, given: Mapping[str, Any]) -> tuple[str, tuple[str, ...]]:
    """Return the variable that gives a parameter, and what else that needs."""
    for way, needed in WAYS.get(parameter, {}).items():
        if way in given or any(other in given for other in WAYS.get(way, {})):
            return way, needed
    raise ValueError(f"{parameter} is not given, nor is one of {', '.join(WAYS.get(parameter, {})) or 'its kin'}")


def scales_in_si(R: ArrayLike, work_of_adhesion: ArrayLike) -> dict[str, _Array]:
    """Return the units of results in SI, by the unit: of a force 1.5 pi R dgamma, an energy R^2 dgamma, R and R^2.

    R is the radius of the punch at its tip in m, the work of adhesion dgamma in J/m^2, both > 0.

    Examples
    --------
    >>> scales_in_si(2.0, 0.25)["J"].item()
    1.0
    """
    radius, work = np.asarray(R, dtype=float), np.asarray(work_of_adhesion, dtype=float)
    return {"N": 1.5 * math.pi * radius * work, "J": radius * radius * work, "m": radius, "m^2": radius * radius}
