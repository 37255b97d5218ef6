"""The keys of a study that give parameters."""

from collections.abc import Mapping
from typing import Final

from gradhesion.cli.keys.key import NOT_NEGATIVE, POSITIVE, Key

_UNBOUNDED: Final = "an unbounded punch"


def _parameter(
    name: str,
    about: str,
    example: str,
    symbol: str,
    *,
    gives: str = "",
    role: str = "",
    bounds: Mapping[str, float] = POSITIVE,
    infinite: str = "",
) -> Key:
    """Make a key of [parameters]: a parameter, unless it gives another."""
    return Key(
        name=name,
        about=about,
        example=f"{name} = {example}",
        table="parameters",
        symbol=symbol,
        gives=gives or name,
        role=role,
        bounds=bounds,
        infinite=infinite,
    )


def _quantity(
    name: str,
    gives: str,
    unit: str,
    about: str,
    example: str,
    symbol: str,
    *,
    instead_of: str = "",
    bounds: Mapping[str, float] = POSITIVE,
    infinite: str = "",
) -> Key:
    """Make a key of [physical]."""
    return Key(
        name=name,
        about=about,
        example=f"{name} = {example}",
        table="physical",
        symbol=symbol,
        unit=unit,
        gives=gives,
        instead_of=instead_of,
        bounds=bounds,
        infinite=infinite,
    )


MACHINE: Final = "machine_stiffness"
"""The key of [loading] that is a parameter: its dimension stands before that of the punch's radius."""
SPRING: Final = "spring_constant"
"""The key of [physical] that gives the same with its unit."""

TURNS: Final = ("indentation_max_over_R", "load_max")
"""The parameters at which a cycle may turn before the rim: those of a scene that need not be there."""
CLOSING: Final = "closing_ratio"
"""The parameter of an edge that closes at a smaller work of adhesion than it opens at."""
CLOSING_WORK: Final = "work_of_adhesion_closing"
"""The key of [physical] that gives the same with its unit."""
PATTERN: Final = ("toughness_wavelength_over_R", "toughness_amplitude")
"""The parameters of a toughness that varies with the radius."""
SPEED: Final = "speed_over_reference"
"""The parameter of an edge whose work grows with its speed."""
ADHESION_RANGE: Final = "adhesion_range_over_R"
"""The parameter that the Tabor parameters need alone: its dimension is the last, since nothing is solved for it."""
INTERACTION: Final = "adhesion_range"
"""The key of [physical] that gives the same with its unit."""

_ALL_INPUTS: Final = (
    _parameter(
        "k",
        "gradient exponent k of the modulus E0 (z/c0)^k",
        "0.5 or k = [0.0, 0.5]",
        "$k$",
        bounds={"ge": 0.0, "le": 1.0},
    ),
    _parameter("nu", "Poisson's ratio", "0.3", r"$\nu$", bounds={"gt": -1.0, "le": 0.5}),
    _quantity("R", "modulus", "m", "radius R of the punch at its tip", '"1 mm"', "$R$"),
    _quantity(
        "E_star",
        "modulus",
        "Pa",
        "reduced modulus E* = E0/(1 - nu^2) at the depth c0",
        '"50 kPa"',
        r"$E^{\ast}$",
    ),
    _quantity("E", "modulus", "Pa", "Young's modulus E0 at the depth c0", '"46 kPa"', "$E_0$", instead_of="E_star"),
    _quantity("work_of_adhesion", "modulus", "J/m^2", "work of adhesion dgamma", '"20 mJ/m^2"', r"$\Delta\gamma$"),
    _parameter(
        "modulus",
        "reduced modulus E* R/dgamma, with E* = E0/(1 - nu^2)",
        "500.0",
        r"$E^{\ast}R/\Delta\gamma$",
        role="the reduced modulus",
    ),
    _quantity("c0", "c0_over_R", "m", "characteristic depth c0 of the gradient", '"0.1 mm"', "$c_0$"),
    _parameter(
        "c0_over_R",
        "characteristic depth c0/R of the gradient",
        "0.01",
        "$c_0/R$",
        role="the depth of the gradient",
    ),
    _quantity("wavelength", "lambda_over_R", "m", "wavelength lambda of the waviness", '"20 um"', r"$\lambda$"),
    _parameter(
        "lambda_over_L",
        "wavelength lambda/L of the waviness over the similarity length",
        "0.5",
        r"$\lambda/L$",
        gives="lambda_over_R",
    ),
    _parameter(
        "lambda_over_R",
        "wavelength lambda/R of the waviness",
        '{ start = 0.02, stop = 1.0, num = 200, spacing = "log" }',
        r"$\lambda/R$",
        role="the wavelength",
    ),
    _quantity(
        "amplitude",
        "A",
        "m",
        "amplitude A lambda of the waviness",
        '"0.5 um"',
        r"$A\lambda$",
        bounds=NOT_NEGATIVE,
    ),
    _parameter(
        "chi", "roughness parameter chi = r/s of the waviness", "0.5", r"$\chi$", gives="A", bounds=NOT_NEGATIVE
    ),
    _parameter(
        "A",
        "amplitude over wavelength of the waviness",
        "0.1",
        "$A$",
        role="the amplitude",
        bounds=NOT_NEGATIVE,
    ),
    _quantity(SPRING, MACHINE, "N/m", "spring constant S of the loading machine", '"0.2 N/m"', "$S$"),
    Key(
        name=MACHINE,
        about="stiffness S/(E* R) of the loading machine",
        example=f"{MACHINE} = 10.0",
        table="loading",
        symbol=r"$S/E^{\ast}R$",
        gives=MACHINE,
        bounds=POSITIVE,
    ),
    _quantity(
        "a_max",
        "a_max_over_R",
        "m",
        "radius a_max of the punch (inf: unbounded)",
        '"0.5 mm" or a_max = inf',
        r"$a_{\max}$",
        infinite=_UNBOUNDED,
    ),
    _parameter(
        "a_max_over_L",
        "radius a_max/L of the punch over the similarity length (inf: unbounded)",
        "5.0",
        r"$a_{\max}/L$",
        gives="a_max_over_R",
        infinite=_UNBOUNDED,
    ),
    _parameter(
        "a_max_over_a2",
        "radius a_max/a_2 of the punch over the jump-in radius of the loading envelope",
        "2.0",
        r"$a_{\max}/a_2$",
        gives="a_max_over_R",
        infinite=_UNBOUNDED,
    ),
    _parameter(
        "a_max_over_R",
        "radius a_max/R of the punch (inf: unbounded)",
        "inf",
        r"$a_{\max}/R$",
        role="the radius of the punch",
        infinite=_UNBOUNDED,
    ),
    _quantity(
        "indentation_max",
        "indentation_max_over_R",
        "m",
        "depth delta_max at which the cycle turns",
        '"50 nm"',
        r"$\delta_{\max}$",
        bounds={},
    ),
    _parameter(
        "indentation_max_over_R",
        "depth delta_max/R at which the cycle turns",
        "0.05",
        r"$\delta_{\max}/R$",
        bounds={},
    ),
    _quantity("preload", "load_max", "N", "load P_max at which the cycle turns", '"50 nN"', r"$P_{\max}$"),
    _parameter(
        "load_max",
        "load P_max/(1.5 pi R dgamma) at which the cycle turns",
        "2.0",
        r"$P_{\max}/\frac{3}{2}\pi R\Delta\gamma$",
    ),
    _quantity(
        CLOSING_WORK,
        CLOSING,
        "J/m^2",
        "work of adhesion w_c at which the edge closes; it opens at work_of_adhesion",
        '"5 mJ/m^2"',
        "$w_c$",
        bounds=NOT_NEGATIVE,
    ),
    _parameter(
        CLOSING,
        "work of adhesion of closing over that of opening, w_c/dgamma",
        "0.5",
        r"$w_c/\Delta\gamma$",
        bounds={"ge": 0.0, "le": 1.0},
    ),
    _quantity(
        "toughness_wavelength",
        PATTERN[0],
        "m",
        "wavelength of the pattern of toughness",
        '"50 um"',
        r"$\lambda_t$",
    ),
    _parameter(PATTERN[0], "wavelength lambda_t/R of the pattern of toughness", "0.1", r"$\lambda_t/R$"),
    _parameter(PATTERN[1], "amplitude of the pattern of toughness", "0.5", "$t$", bounds={}),
    _quantity("speed", SPEED, "m/s", "speed V of the machine", '"1 um/s"', "$V$", bounds=NOT_NEGATIVE),
    _quantity(
        "reference_speed", SPEED, "m/s", "speed v* of the edge at which its work is doubled", '"1 mm/s"', "$v^*$"
    ),
    _parameter(
        SPEED,
        "speed of the machine over the reference speed of the edge, V/v*",
        "0.1",
        "$V/v^*$",
        bounds=NOT_NEGATIVE,
    ),
    _quantity(INTERACTION, ADHESION_RANGE, "m", "range z0 of the attraction", '"0.3 nm"', "$z_0$"),
    _parameter(ADHESION_RANGE, "range z0/R of the attraction, for the Tabor parameters", "3e-7", "$z_0/R$"),
)

INPUTS: Final[dict[str, Key]] = {key.name: key for key in _ALL_INPUTS}
"""
Every key that gives parameters, in the order of a dataset's dimensions.

Each stands before the parameter in whose place it is, those with units first. The radius of the punch and what a cycle
turns at are the last that scenes are solved for, since all of one curve share its trace.
"""

PARAMETERS: Final[dict[str, Key]] = {
    name: key
    for name, key in INPUTS.items()
    if key.table == "parameters" and key.is_parameter and name not in (*TURNS, CLOSING, *PATTERN, SPEED, ADHESION_RANGE)
}
"""Every parameter that all scenes have, in the order of a dataset's dimensions."""

REDUCED: Final[dict[str, Key]] = {
    name: key for name, key in INPUTS.items() if key.table == "parameters" and not key.is_parameter
}
"""The keys of [parameters] in reduced variables, each in the place of a parameter."""

PHYSICAL: Final[dict[str, Key]] = {name: key for name, key in INPUTS.items() if key.table == "physical"}
"""The keys of [physical]."""
