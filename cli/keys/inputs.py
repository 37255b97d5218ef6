"""The keys of a study that give parameters."""

from typing import Final

from gradhesion.cli.keys.key import Key
from gradhesion.core.problem import inputs
from gradhesion.core.problem.names import CLOSING, MACHINE, PATTERN, SPEED, TURNS
from gradhesion.core.problem.names import RANGE as ADHESION_RANGE

__all__ = [
    "ADHESION_RANGE",
    "CLOSING",
    "CLOSING_WORK",
    "INPUTS",
    "INTERACTION",
    "MACHINE",
    "PARAMETERS",
    "PATTERN",
    "PHYSICAL",
    "REDUCED",
    "SPEED",
    "SPRING",
    "TURNS",
]
SPRING: Final = "spring_constant"
CLOSING_WORK: Final = "work_of_adhesion_closing"
INTERACTION: Final = "adhesion_range"
_ROLES: Final = {
    "modulus": "the reduced modulus",
    "c0_over_R": "the depth of the gradient",
    "lambda_over_R": "the wavelength",
    "A": "the amplitude",
    "a_max_over_R": "the radius of the punch",
}
INPUTS: Final[dict[str, Key]] = {
    name: Key(
        name=name,
        about=one.about,
        example=one.example,
        table=one.table,
        symbol=one.symbol,
        unit=one.unit,
        gives=one.gives,
        role=_ROLES.get(name, ""),
        instead_of=one.instead_of,
        bounds=one.bounds,
        infinite="an unbounded punch" if one.infinite else "",
    )
    for name, one in inputs.INPUTS.items()
}
PARAMETERS: Final = {name: INPUTS[name] for name in inputs.parameters_in("")}
REDUCED: Final = {name: INPUTS[name] for name in inputs.REDUCED}
PHYSICAL: Final = {name: INPUTS[name] for name in inputs.PHYSICAL}
