"""Scenes given in other variables than those of `solve`: in reduced ones, or in SI units.

Each of the parameters of `solve` may be left out where others determine it:

    modulus         R, E_star, work_of_adhesion     E* R/dgamma
                    R, E, work_of_adhesion          with E* = E/(1 - nu^2)
    c0_over_R       c0, R
    lambda_over_R   lambda_over_L                   times L/R of variables/similarity.py
                    wavelength, R
    A               chi                             r/s of variables/similarity.py
                    amplitude                       over the wavelength
    a_max_over_R    a_max_over_L                    times L/R
                    a_max_over_a2                   times a_2/R of variables/jump_in_radius.py
                    a_max, R
    machine_stiffness    spring_constant, E_star, R
    indentation_max_over_R    indentation_max, R
    load_max        preload, R, work_of_adhesion    P/(1.5 pi R dgamma)
    closing_ratio   work_of_adhesion_closing, work_of_adhesion
    toughness_wavelength_over_R    toughness_wavelength, R
    speed_over_reference    speed, reference_speed
    adhesion_range_over_R    adhesion_range, R

a_2 is that of loading, at the work of closing; all else in reduced variables is at work_of_adhesion, that of opening.
R, c0, wavelength, amplitude, a_max, indentation_max, toughness_wavelength and adhesion_range are in m, E_star and E in
Pa, work_of_adhesion and that of closing in J/m^2, spring_constant in N/m, preload in N, speeds in m/s.
"""

import math
from collections.abc import Callable, Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.problem.names import CLOSING, PARAMETERS, PATTERN, RANGE, SPEED, TURNS
from gradhesion.core.variables.jump_in_radius import jump_in_radius_of_envelope
from gradhesion.core.variables.similarity import amplitude_of_ratio, similarity_length

_Array = NDArray[np.float64]
_MATERIAL: Final = PARAMETERS[:4]
_MACHINE: Final = "machine_stiffness"

WAYS: Final[dict[str, dict[str, tuple[str, ...]]]] = {
    "E_star": {"E": ("nu",)},
    "modulus": {"E_star": ("R", "work_of_adhesion")},
    "c0_over_R": {"c0": ("R",)},
    "lambda_over_R": {"lambda_over_L": _MATERIAL, "wavelength": ("R",)},
    "A": {"chi": PARAMETERS[:5], "amplitude": ("R", "lambda_over_R")},
    "a_max_over_R": {"a_max_over_L": _MATERIAL, "a_max_over_a2": PARAMETERS[:6], "a_max": ("R",)},
    _MACHINE: {"spring_constant": ("E_star", "R")},
    "indentation_max_over_R": {"indentation_max": ("R",)},
    "load_max": {"preload": ("R", "work_of_adhesion")},
    CLOSING: {"work_of_adhesion_closing": ("work_of_adhesion",)},
    PATTERN[0]: {"toughness_wavelength": ("R",)},
    SPEED: {"speed": ("reference_speed",)},
    RANGE: {"adhesion_range": ("R",)},
}
"""Variables that can give a parameter, and what else that needs; in the order in which they follow from another."""

_IN_WAYS: Final = {name for ways in WAYS.values() for way, needed in ways.items() for name in (way, *needed)}
"""Inputs from which parameters follow: left out of the result, unless they are wanted themselves."""
_OPTIONAL: Final = (_MACHINE, *TURNS, CLOSING, *PATTERN, SPEED, RANGE)
"""Parameters that not every scene has."""

_FOLLOWS: Final[dict[str, Callable[..., Any]]] = {
    "E": lambda E, nu: E / ((1.0 - nu) * (1.0 + nu)),
    "E_star": lambda E_star, R, work_of_adhesion: E_star * R / work_of_adhesion,
    "c0": lambda c0, R: c0 / R,
    "lambda_over_L": lambda ratio, *material: ratio * similarity_length(*material),
    "wavelength": lambda wavelength, R: wavelength / R,
    "chi": lambda chi, k, nu, modulus, c0, wavelength: amplitude_of_ratio(k, nu, modulus, c0, wavelength, chi),
    "amplitude": lambda amplitude, R, lambda_over_R: amplitude / R / lambda_over_R,
    "a_max_over_L": lambda ratio, *material: ratio * similarity_length(*material),
    "a_max_over_a2": lambda ratio, *others: ratio * jump_in_radius_of_envelope(*others),
    "a_max": lambda a_max, R: a_max / R,
    "adhesion_range": lambda adhesion_range, R: adhesion_range / R,
    "spring_constant": lambda spring_constant, E_star, R: spring_constant / (E_star * R),
    "indentation_max": lambda indentation_max, R: indentation_max / R,
    "toughness_wavelength": lambda wavelength, R: wavelength / R,
    "speed": lambda speed, reference_speed: speed / reference_speed,
    "work_of_adhesion_closing": lambda closing, opening: closing / opening,
    "preload": lambda preload, R, work_of_adhesion: preload / (1.5 * math.pi * R * work_of_adhesion),
}


def parameters_from(given: Mapping[str, ArrayLike]) -> dict[str, _Array]:
    """Return the parameters of `solve`, those that are not given made from what is.

    Parameters
    ----------
    given
        Arrays by name, all broadcastable: for each parameter of `solve` itself, or one of those above in its place.
        Others stay as they are; machine_stiffness, indentation_max_over_R, load_max, closing_ratio and
        adhesion_range_over_R are made if spring_constant, indentation_max, preload, work_of_adhesion_closing or
        adhesion_range is given; R, E_star and the like are left out.

    Returns
    -------
    An array for each parameter, over the axes that it depends on. What is out of range or does not exist (a_2 for
    r >= s) is NaN. Accurate to a few units in the last place, but for a_2 (see there).

    Raises
    ------
    ValueError
        For a parameter that nothing given determines.

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
                known[parameter] = np.asarray(_FOLLOWS[way](known[way], *others))
    return {name: known[name] for name in (*wanted, *(name for name in given if name not in _IN_WAYS | {*wanted}))}


def sources_of(parameter: str, given: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the names of what is given that a parameter of `solve` follows from.

    Parameters
    ----------
    parameter
        One of `PARAMETERS` or `TURNS`, machine_stiffness, closing_ratio or adhesion_range_over_R.
    given
        As in `parameters_from`; only its names count.

    Returns
    -------
    Names out of `given`; the parameter alone if it is given itself.

    Raises
    ------
    ValueError
        For a parameter that nothing given determines.

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
    """Return the units of results in SI: of a force 1.5 pi R dgamma, an energy R^2 dgamma, a length R.

    Parameters
    ----------
    R
        Radius of the punch at its tip in m, > 0.
    work_of_adhesion
        dgamma in J/m^2, > 0.

    Returns
    -------
    Arrays by the unit "N", "J" and "m".

    Examples
    --------
    >>> scales_in_si(2.0, 0.25)["J"].item()
    1.0
    """
    radius, work = np.asarray(R, dtype=float), np.asarray(work_of_adhesion, dtype=float)
    return {"N": 1.5 * math.pi * radius * work, "J": radius * radius * work, "m": radius}
