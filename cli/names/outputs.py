"""The outputs of maps and of optima: what each is called in a dataset, what it is, and its unit."""

from typing import Final

from gradhesion.core.problem import outputs
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.names import SENSITIVITIES

SI: Final = "_si"
"""What is added to the name of an output, for the variable that has it in SI units."""
BEST: Final = "best_"
"""What a variable of a dataset of optima begins with, before the name of an output or of an input."""
ON_BOUND: Final = "on_bound"
"""The flags of a dataset of optima that say at which bounds an optimum is."""
PARETO_POINT: Final = "pareto_point"
"""The dimension of the best compromises of two outputs."""
OUTPUTS: Final = {name: one.about for name, one in outputs.OUTPUTS.items()}
"""Every output of a map, with its `long_name`."""
PARAMETER: Final = "parameter"
"""The dimension of parameter of the sensitivity, after those of the scenes."""
PHYSICAL_PARAMETER: Final = "physical_parameter"
"""The same of the quantities with units."""
OF_PHYSICAL: Final = "_physical"
"""What is added to the name of a sensitivity, for that of the value in SI units to the quantities with units."""


def labels_of(variable: str) -> str:
    """Name the dimension that a variable of a map has after those of the scenes; empty if it has none.

    >>> labels_of("pull_off_force_sensitivity"), labels_of("pull_off_force")
    ('parameter', '')
    """
    if variable.removesuffix(OF_PHYSICAL).removeprefix(BEST) not in SENSITIVITIES:
        return ""
    return PHYSICAL_PARAMETER if variable.endswith(OF_PHYSICAL) else PARAMETER


SPREAD: Final = {
    "std": "standard deviation of the {}",
    "mean": "mean of the {}, of samples of the uncertain inputs",
    "p05": "5 % quantile of the {}, of samples of the uncertain inputs",
    "p50": "median of the {}, of samples of the uncertain inputs",
    "p95": "95 % quantile of the {}, of samples of the uncertain inputs",
    "std_linear": "standard deviation of the {}, by its sensitivities",
}
"""What a study with [uncertainty] has beside an output, by the ending, with its `long_name`: all with samples, else the
first, which is then that by sensitivities."""
SPREADABLE: Final = tuple(name for name, one in outputs.OUTPUTS.items() if one.has_spread)
"""The outputs that have a spread: values of a scene, which no count is, nor what is known of an error or of others."""
OF_LINEAR: Final = tuple(name.removesuffix("_sensitivity") for name in SENSITIVITIES)
"""The outputs whose standard deviation is known by sensitivities."""
SPREADS: Final = {f"{name}_{how}": words.format(OUTPUTS[name]) for name in SPREADABLE for how, words in SPREAD.items()}
"""Every variable of a spread, with its `long_name`."""
_SPREAD_OF: Final = {f"{name}_{how}": name for name in SPREADABLE for how in SPREAD}


def value_of(variable: str) -> str:
    """Name the output that a variable of a map says something of: itself, or what it is the spread of.

    >>> value_of("pull_off_force_std_linear_si"), value_of("delta_max")
    ('pull_off_force', 'delta_max')
    """
    plain = variable.removesuffix(SI).removeprefix(BEST)
    return _SPREAD_OF.get(plain, plain)


_OWN: Final = {name: one.unit for name, one in (outputs.OUTPUTS | outputs.VARIABLES).items() if one.unit}
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
