"""The outputs of maps and of optima: what each is called in a dataset, and what it is."""

from typing import Final

SI: Final = "_si"
"""What is added to the name of an output, for the variable that has it in SI units."""

BEST: Final = "best_"
"""What a variable of a dataset of optima begins with, before the name of an output or of an input."""

ON_BOUND: Final = "on_bound"
"""The flags of a dataset of optima that say at which bounds an optimum is."""

PARETO_POINT: Final = "pareto_point"
"""The dimension of the best compromises of two outputs."""

OUTPUTS: Final = {
    "pull_off_force": "pull-off force F/(1.5 pi R dgamma)",
    "pull_off_radius": "contact radius a/R at pull-off",
    "dissipated_energy": "energy dissipated in a loading cycle, H/(R^2 dgamma)",
    "loading_jumps": "number of jumps on loading, including the jump-in",
    "unloading_jumps": "number of jumps on unloading, including the jump-out",
    "delta_max": "indentation depth delta/R at which unloading starts, the greatest if the depth is controlled",
    "delta_jump_out": "indentation depth delta/R at the jump-out",
    "loading_energy": "energy dissipated on loading, H/(R^2 dgamma)",
    "unloading_energy": "energy dissipated on unloading, H/(R^2 dgamma)",
    "turning_radius": "contact radius a/R at which unloading starts (0: no contact is made)",
    "front_energy": "energy of the edge, which opens at more work than it closes at, in a cycle, H/(R^2 dgamma)",
    "snap_in_force": "pull just after the jump into contact P/(1.5 pi R dgamma)",
    "pinned_depth": "depth delta/R by which the punch moves back before the edge opens",
    "edge_speed_at_pull_off": "speed of the edge over its reference speed at the pull-off, v/v*",
    "rate_coefficient": "gain of the pull-off force over (V/v*)^n as the speed tends to 0",
    "energy_residual": "dissipated energy less the loop integral of the load over the depth, in R^2 dgamma",
    "roughness_parameter": "roughness parameter chi = r/s of the waviness",
    "saturation_radius": "contact radius a/R beyond which the curve has no fold",
    "adhesion_gain": "pull-off force over that of the smooth punch of the same material and radius",
    "energy_gain": "dissipated energy over that of the smooth punch of the same material and radius",
    "tabor_parameter": "Tabor parameter of the punch: height of its neck over the range of the attraction",
    "wave_tabor_parameter": "Tabor parameter of the crests of the waviness",
    "wave_slope": "steepest slope of the waviness",
    "johnson_alpha": "Johnson's parameter alpha = 1/(sqrt(pi) chi) of the waviness",
    "contact_slope": "slope of the punch at the largest contact radius that the other outputs depend on",
    "pull_off_force_sensitivity": "sensitivity of the pull-off force F to each parameter p: d ln F/d ln p (k, nu: /dp)",
    "dissipated_energy_sensitivity": "sensitivity of the energy H to each parameter p: d ln H/d ln p (k, nu: /dp)",
}
"""Every output of a map, with its `long_name`."""

SENSITIVITIES: Final = tuple(name for name in OUTPUTS if name.endswith("_sensitivity"))
"""Those that have an item for each parameter."""

PARAMETER: Final = "parameter"
"""The dimension of parameter of the sensitivity, after those of the scenes."""

PHYSICAL_PARAMETER: Final = "physical_parameter"
"""The same of the quantities with units."""

OF_PHYSICAL: Final = "_physical"
"""What is added to the name of a sensitivity, for that of the value in SI units to the quantities with units."""

CONTACT_SLOPE: Final = "contact_slope"
"""The output that says how far the contact reaches on the punch."""


def labels_of(variable: str) -> str:
    """
    Name the dimension that a variable of a map has after those of the scenes; empty if it has none.

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
}
"""What a study with [uncertainty] has beside an output, by the ending, with its `long_name`."""

SPREADABLE: Final = tuple(
    name
    for name in OUTPUTS
    if name not in (*SENSITIVITIES, "energy_residual", "contact_slope") and not name.endswith("_jumps")
)
"""The outputs that have a spread: values of a scene, which no count is, nor what is known of an error or of others."""

OF_LINEAR: Final = tuple(name.removesuffix("_sensitivity") for name in SENSITIVITIES)
"""The outputs whose standard deviation is known by sensitivities."""

SPREADS: Final = {f"{name}_{how}": words.format(OUTPUTS[name]) for name in SPREADABLE for how, words in SPREAD.items()}
"""Every variable of a spread, with its `long_name`."""


def value_of(variable: str) -> str:
    """
    Name the output that a variable of a map says something of: itself, or what it is the spread of.

    >>> value_of("pull_off_force_p95_si"), value_of("delta_max")
    ('pull_off_force', 'delta_max')
    """
    plain = variable.removesuffix(SI).removeprefix(BEST)
    return plain.rpartition("_")[0] if plain in SPREADS else plain
