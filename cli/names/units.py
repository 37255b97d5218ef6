"""The units of outputs and of curves in SI."""

from typing import Final

from gradhesion.cli.names.outputs import BEST, SI, SPREADS, value_of
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.outputs import OUTPUTS, VARIABLES

_OWN: Final = {name: one.unit for name, one in (OUTPUTS | VARIABLES).items() if one.unit}
UNITS: Final = _OWN | {name: _OWN[value_of(name)] for name in SPREADS if value_of(name) in _OWN}
"""The unit in SI of each output that has one, and of its spread."""


def unit_of(name: str) -> str:
    """Give the unit of a variable of a dataset, as UDUNITS writes it.

    >>> unit_of("R"), unit_of("chi"), unit_of("dissipated_energy"), unit_of("dissipated_energy_si")
    ('m', '1', '1', 'J')
    """
    name = name.removeprefix(BEST)
    if name in INPUTS:
        return INPUTS[name].unit
    return UNITS.get(name.removesuffix(SI), "1") if name.endswith(SI) else "1"
