"""Every variable and parameter as a picture names it."""

from typing import Final

from gradhesion.cli.names.outputs import BEST, OF_PHYSICAL, ON_BOUND, SI, SPREADABLE
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.outputs import OUTPUTS, VARIABLES, Output


def _symbols() -> dict[str, str]:
    """Name the variables of maps and optima; those of errors are of earlier versions."""
    found = {name: one.symbol for name, one in (INPUTS | OUTPUTS).items()}
    found |= {name + SI: one.symbol_in_si for name, one in OUTPUTS.items() if one.unit}
    found |= {"pull_off_force_error_si": "error of the force", "dissipated_energy_error_si": "error of the energy"}
    found |= {name: name for name in ("status", "solver", "realisation")}
    for output, value in (("pull_off_force_sensitivity", "F"), ("dissipated_energy_sensitivity", "H")):
        found[output + OF_PHYSICAL] = found[output]
        for name, key in INPUTS.items():
            step = "d" if name in ("k", "nu") else r"d\,\ln"
            found[f"{output}_{name}"] = rf"$d\,\ln {value}/{step}$ {key.symbol}"
            found[f"{output}{OF_PHYSICAL}_{name}"] = found[f"{output}_{name}"]
    words = {"std": "std of {}", "mean": "mean of {}", "p05": "{}, 5 %", "p50": "{}, median", "p95": "{}, 95 %"}
    words["std_linear"] = "linear std of {}"
    ends = [(name, end) for name in SPREADABLE for end in ("", SI) if name + end in found]
    found |= {f"{name}_{how}{end}": one.format(found[name + end]) for name, end in ends for how, one in words.items()}
    found |= {BEST + name: f"best {symbol}" for name, symbol in found.items()}
    return found | {ON_BOUND: "at a bound"}


SYMBOLS: Final = _symbols()
"""Every variable as a picture names it."""
_QUANTITIES: Final = {
    "contact_radius": ("contact radius $a$", "m"),
    "indentation": (r"depth $\delta$", "m"),
    "load": ("load $P$", "N"),
    "radius": ("distance $r$", "m"),
    "displacement": ("surface $u_z$", "m"),
}
"""What a picture of curves has along its axes, by the end of the names of its variables: symbols and units in SI."""


CURVE_SYMBOLS: Final = {"pressure": r"pressure $pR/\Delta\gamma$", "pressure" + SI: "pressure $p$"}
"""Every variable of a curve that is drawn over another, as a picture names it."""
for _name in VARIABLES:
    for _end, (_symbol, _unit) in _QUANTITIES.items():
        if _name.endswith(_end):
            _quantity = Output(_name, "", _symbol, "", _unit)
            CURVE_SYMBOLS[_name], CURVE_SYMBOLS[_name + SI] = _quantity.symbol, _quantity.symbol_in_si
            break
