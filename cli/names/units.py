"""The units of outputs and of curves in SI."""

from typing import Final

from gradhesion.cli.keys import INPUTS
from gradhesion.cli.names.curves import CURVES
from gradhesion.cli.names.outputs import BEST, OUTPUTS, SI, SPREADS


def _units() -> dict[str, str]:
    """Find the unit of each output by what it is over in the dataset."""
    signs = {"R/dgamma": "Pa", "(1.5 pi R dgamma)": "N", "R^2 dgamma": "J", "/R": "m"}
    own = OUTPUTS | SPREADS | {name: long_name for curve in CURVES.values() for name, long_name in curve.items()}
    return {
        name: next(unit for sign, unit in signs.items() if sign in long_name)
        for name, long_name in own.items()
        if any(sign in long_name for sign in signs)
    }


UNITS: Final = _units()
"""The unit in SI of each output that has one."""


def unit_of(name: str) -> str:
    """
    Give the unit of a variable of a dataset, as UDUNITS writes it.

    >>> unit_of("R"), unit_of("chi"), unit_of("dissipated_energy"), unit_of("dissipated_energy_si")
    ('m', '1', '1', 'J')
    """
    name = name.removeprefix(BEST)
    if name in INPUTS:
        return INPUTS[name].unit
    return UNITS.get(name.removesuffix(SI), "1") if name.endswith(SI) else "1"


def long_name_in_si(long_name: str) -> str:
    """
    Report what an output is in SI units.

    >>> long_name_in_si("energy dissipated in a loading cycle, H/(R^2 dgamma)")
    'energy dissipated in a loading cycle, H'
    """
    for over in (" R/dgamma", "/(1.5 pi R dgamma)", "/(R^2 dgamma)", ", in R^2 dgamma", " over R^2 dgamma", "/R"):
        long_name = long_name.replace(over, "")
    return long_name
