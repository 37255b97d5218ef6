"""Every variable and parameter as a picture names it."""

from typing import Final

from gradhesion.cli.keys import INPUTS
from gradhesion.cli.names.outputs import BEST, OF_PHYSICAL, ON_BOUND, SI, SPREADABLE
from gradhesion.cli.names.units import UNITS

SYMBOLS: Final[dict[str, str]] = {
    **{name: key.symbol for name, key in INPUTS.items()},
    "pull_off_force": r"pull-off force $F\,/\,(\frac{3}{2}\pi R\Delta\gamma)$",
    "pull_off_radius": "radius at pull-off $a/R$",
    "dissipated_energy": r"dissipated energy $H\,/\,(R^2\Delta\gamma)$",
    "loading_jumps": "jumps on loading",
    "unloading_jumps": "jumps on unloading",
    "delta_max": r"greatest depth $\delta_{\max}/R$",
    "delta_jump_out": r"depth at jump-out $\delta/R$",
    "loading_energy": r"energy of loading $H\,/\,(R^2\Delta\gamma)$",
    "unloading_energy": r"energy of unloading $H\,/\,(R^2\Delta\gamma)$",
    "turning_radius": r"turning radius $a_t/R$",
    "front_energy": r"energy of the edge $H\,/\,(R^2\Delta\gamma)$",
    "snap_in_force": r"snap-in force $P\,/\,(\frac{3}{2}\pi R\Delta\gamma)$",
    "pinned_depth": r"pinned depth $\delta/R$",
    "edge_speed_at_pull_off": "speed of the edge at pull-off $v/v^*$",
    "rate_coefficient": "rate coefficient",
    "energy_residual": r"residual of the energy $/\,(R^2\Delta\gamma)$",
    "roughness_parameter": r"roughness parameter $\chi$",
    "saturation_radius": "saturation radius $a/R$",
    "adhesion_gain": "gain in force $F/F_0$",
    "energy_gain": "gain in energy $H/H_0$",
    "tabor_parameter": r"Tabor parameter $\mu$",
    "wave_tabor_parameter": r"Tabor parameter of crests $\mu_w$",
    "wave_slope": "steepest slope of the waves",
    "johnson_alpha": r"Johnson's $\alpha$",
    "contact_slope": r"contact slope $(a/R)^{m-1}$",
    "pull_off_force_si": "pull-off force $F$",
    "pull_off_radius_si": "radius at pull-off $a$",
    "dissipated_energy_si": "dissipated energy $H$",
    "delta_max_si": r"greatest depth $\delta_{\max}$",
    "delta_jump_out_si": r"depth at jump-out $\delta$",
    "turning_radius_si": r"turning radius $a_t$",
    "front_energy_si": "energy of the edge $H$",
    "snap_in_force_si": "snap-in force $P$",
    "pinned_depth_si": r"pinned depth $\delta$",
    "loading_energy_si": "energy of loading $H$",
    "unloading_energy_si": "energy of unloading $H$",
    "pull_off_force_error_si": "error of the force",
    "dissipated_energy_error_si": "error of the energy",
    "energy_residual_si": "residual of the energy",
    "saturation_radius_si": "saturation radius $a$",
    "pull_off_force_sensitivity": r"strongest on $F$",
    "dissipated_energy_sensitivity": r"strongest on $H$",
    "status": "status",
    "solver": "solver",
    "realisation": "realisation",
}
"""Every variable as a picture names it."""


def _sensitivity_symbols() -> dict[str, str]:
    """Name each item of the sensitivities."""
    found = {}
    for output, value in (("pull_off_force_sensitivity", "F"), ("dissipated_energy_sensitivity", "H")):
        found[output + OF_PHYSICAL] = SYMBOLS[output]
        for name, key in INPUTS.items():
            step = "d" if name in ("k", "nu") else r"d\,\ln"
            found[f"{output}_{name}"] = rf"$d\,\ln {value}/{step}$ {key.symbol}"
            found[f"{output}{OF_PHYSICAL}_{name}"] = found[f"{output}_{name}"]
    return found


SYMBOLS.update(_sensitivity_symbols())


def _spread_symbols() -> dict[str, str]:
    """Name the spread of each output."""
    words = {"std": "std of {}", "mean": "mean of {}", "p05": "{}, 5 %", "p50": "{}, median", "p95": "{}, 95 %"}
    plain = {f"{name}_{how}": one.format(SYMBOLS[name]) for name in SPREADABLE for how, one in words.items()}
    in_si = {
        f"{name}_{how}{SI}": one.format(SYMBOLS[name + SI])
        for name in SPREADABLE
        if name in UNITS
        for how, one in words.items()
    }
    return plain | in_si


SYMBOLS.update(_spread_symbols())
SYMBOLS.update({BEST + name: f"best {symbol}" for name, symbol in SYMBOLS.items()})
SYMBOLS[ON_BOUND] = "at a bound"
