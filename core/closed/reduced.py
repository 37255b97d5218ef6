"""Scenes given in other variables than those of `solve`: in reduced ones, or in SI units.

    L   = (R^2 dgamma/M)^(1/(3+k)),   the length of the problem
    chi = r/s,   r = pi^((1-k)/2) G((1+k)/2) A lambda^((1+k)/2),   s = sqrt(2^(1+k) pi dgamma/M)
    a_2 = [(1+k) R (s - r)]^(2/(3+k)), the jump-in radius of the loading envelope (5.34)

At one gradient exponent a paraboloid with one cosine wave depends on lambda/L, chi and a_max/L alone: nu, E* and c0 act
through M only (docs/theory.md). Arguments of the functions of these variables are the first of `PARAMETERS`, with their
ranges, all broadcastable; results are NaN outside the ranges, and accurate to a few units in the last place.

R, c0, wavelength, amplitude, a_max, indentation_max, toughness_wavelength and adhesion_range are in m, E_star and E =
E_star (1 - nu^2) in Pa, work_of_adhesion and that of closing in J/m^2, spring_constant in N/m, preload in N, speeds in
m/s. a_max_over_a2 is over the a_2 of loading, at the work of closing; all others are at work_of_adhesion, that of
opening.
"""

import math
from collections.abc import Callable, Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.equations.effective import jump_in_radius
from gradhesion.core.equations.envelopes import adhesion_strength, waviness_strength
from gradhesion.core.problem.inputs import INPUTS, PHYSICAL
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.names import CLOSING, PARAMETERS

_Array = NDArray[np.float64]


def similarity_length(k: ArrayLike, nu: ArrayLike, modulus: ArrayLike, c0_over_R: ArrayLike) -> _Array:
    """Return L/R = (dgamma/(M R^(1+k)))^(1/(3+k)), the size of a contact that adhesion alone makes.

    On a homogeneous half-space L^3 = R^2 dgamma/E*:

    >>> float(similarity_length(0.0, 0.3, 1000.0, 0.01).round(12))
    0.1
    """
    with np.errstate(all="ignore"):  # what overflows has no value
        exponents = np.asarray(k, dtype=float)
        return np.power(stiffness(exponents, nu, modulus, c0_over_R), -1.0 / (3.0 + exponents))


def amplitude_of_ratio(
    k: ArrayLike, nu: ArrayLike, modulus: ArrayLike, c0_over_R: ArrayLike, lambda_over_R: ArrayLike, chi: ArrayLike
) -> _Array:
    """Return the amplitude A over the wavelength at which the waviness is chi = r/s >= 0 times as strong as adhesion.

    At 1 the jump-in of the envelopes ends, and the pull-off force of short waves grows as (1 + chi)^2. It is the
    inverse of the report `roughness_parameter`:

    >>> from gradhesion.core import solve
    >>> scene = dict(k=0.5, nu=0.3, modulus=500.0, c0_over_R=0.01, lambda_over_R=0.1)
    >>> scene |= {"A": amplitude_of_ratio(**scene, chi=0.25), "a_max_over_R": 1.0}
    >>> float(solve(scene, ["roughness_parameter"])["roughness_parameter"].round(12))
    0.25
    """
    with np.errstate(all="ignore"):
        ratio = np.asarray(chi, dtype=float)
        adhesion = adhesion_strength(k, stiffness(k, nu, modulus, c0_over_R))
        amplitude = np.where(ratio >= 0.0, ratio, np.nan) * adhesion / waviness_strength(k, lambda_over_R, 1.0)
    return np.where(np.isfinite(amplitude), amplitude, np.nan)


def jump_in_radius_of_envelope(
    k: ArrayLike, nu: ArrayLike, modulus: ArrayLike, c0_over_R: ArrayLike, lambda_over_R: ArrayLike, A: ArrayLike
) -> _Array:
    """Return a_2/R, the radius to which the contact jumps in on the loading envelope (5.34).

    NaN also where r >= s: there the waves lift the loading envelope above zero depth everywhere. Where s and r are
    close the error is that of their difference. The smooth punch of Johnson, Kendall & Roberts (1971) has
    a^3 = 2 pi R^2 dgamma/E* at zero depth:

    >>> radius = jump_in_radius_of_envelope(0.0, 0.3, 500.0, 0.01, 0.1, A=0.0)
    >>> round(float(radius**3 * 500.0 / (2.0 * np.pi)), 12)
    1.0
    """
    with np.errstate(all="ignore"):
        adhesion = adhesion_strength(k, stiffness(k, nu, modulus, c0_over_R))
        return jump_in_radius(k, adhesion, waviness_strength(k, lambda_over_R, A))


def _over_length(ratio: Any, *material: Any) -> Any:
    """Return what is given over the similarity length L, over R."""
    return ratio * similarity_length(*material)


_FORMULAS: Final[dict[str, Callable[..., Any]]] = {
    **{name: one.follows for name, one in INPUTS.items() if one.follows},
    "lambda_over_L": _over_length,
    "chi": lambda chi, *scene: amplitude_of_ratio(*(*scene, chi)),
    "a_max_over_L": _over_length,
    "a_max_over_a2": lambda ratio, *scene: ratio * jump_in_radius_of_envelope(*scene),
}
WAYS: Final[dict[str, dict[str, tuple[str, ...]]]] = {}
"""Variables that can give a parameter, and what else that needs; in the order in which they follow from another."""
for _name, _one in sorted(INPUTS.items(), key=lambda item: item[0] in PHYSICAL):  # reduced ones first
    if _one.needs:
        WAYS.setdefault(_one.instead_of or _one.gives, {})[_name] = _one.needs
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
    followed = (sources_of(name, given) if name in WAYS or name in PARAMETERS else (name,) for name in (way, *needed))
    return tuple(dict.fromkeys(source for sources in followed for source in sources))


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
