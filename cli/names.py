"""The names in a dataset, with what they stand for; those of its coordinates are keys of the study."""

from typing import Final

from gradhesion.cli.keys import INPUTS

BEST: Final = "best_"
"""What a variable of a dataset of optima begins with, before the name of an output or of an input."""

ON_BOUND: Final = "on_bound"
"""The flags of a dataset of optima that say at which bounds an optimum is."""

PARETO_POINT: Final = "pareto_point"
"""The dimension of the best compromises of two outputs."""


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


OUTPUTS: Final = {
    "pull_off_force": "pull-off force F/(1.5 pi R dgamma)",
    "pull_off_radius": "contact radius a/R at pull-off",
    "dissipated_energy": "energy dissipated in a loading cycle, H/(R^2 dgamma)",
    "loading_jumps": "number of jumps on loading, including the jump-in",
    "unloading_jumps": "number of jumps on unloading, including the jump-out",
    "delta_max": "greatest indentation depth delta/R of the cycle",
    "delta_jump_out": "indentation depth delta/R at the jump-out",
    "loading_energy": "energy dissipated on loading, H/(R^2 dgamma)",
    "unloading_energy": "energy dissipated on unloading, H/(R^2 dgamma)",
    "turning_radius": "contact radius a/R at which unloading starts (0: no contact is made)",
    "front_energy": "energy of the edge, which opens at more work than it closes at, in a cycle, H/(R^2 dgamma)",
    "snap_in_force": "pull just after the jump into contact P/(1.5 pi R dgamma)",
    "pinned_depth": "depth delta/R by which the punch moves back before the edge opens",
    "edge_speed_at_pull_off": "speed of the edge over its reference speed at the pull-off, v/v*",
    "rate_coefficient": "gain of the pull-off force over (V/v*)^n as the speed tends to 0",
    "pull_off_force_error": "estimate of the error of the pull-off force F/(1.5 pi R dgamma)",
    "dissipated_energy_error": "estimate of the error of the dissipated energy H/(R^2 dgamma)",
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
    if name not in (*SENSITIVITIES, "energy_residual", "contact_slope") and not name.endswith(("_jumps", "_error"))
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
    plain = variable.removesuffix("_si").removeprefix(BEST)
    return plain.rpartition("_")[0] if plain in SPREADS else plain


EXTENTS: Final = {
    "equilibrium": "point",
    "closing_equilibrium": "closing_point",
    "path": "path_point",
    "asymptotic": "asymptotic_point",
    "envelope": "envelope_point",
    "effective": "effective_point",
    "smooth": "smooth_point",
    "jumps": "jump",
    "pressure": "pressure_point",
    "surface": "surface_point",
}
"""Every curve of a curve study, with the dimension along it."""

STATE: Final = "state"
"""The dimension of the states whose curves are asked for, before that along the curve."""

NAMED_STATES: Final = ("turning_point", "pull_off", "jump_out")
"""The states of a cycle that are drawn where a study gives no radii."""

STATE_CURVES: Final = ("pressure", "surface")
"""Curves of a state of contact, along the radius, in the place of curves of a scene."""

GENERAL_CURVES: Final = ("equilibrium", "closing_equilibrium", "path", "smooth", "jumps", *STATE_CURVES)
"""Curves under any control; the others are those of short waves, at a prescribed depth."""

RAGGED: Final = {"jumps": "jump_count"}
"""Curves kept as contiguous ragged arrays, one scene after the other, with the variable that counts what each has."""

CURVES: Final = {
    "equilibrium": {
        "contact_radius": "contact radius a/R",
        "indentation": "indentation depth delta/R in equilibrium",
        "load": "load P/(1.5 pi R dgamma) in equilibrium, negative if it pulls",
        "stable": "whether the equilibrium is stable under the control of the study",
    },
    "closing_equilibrium": {
        "closing_contact_radius": "contact radius a/R of an edge that closes",
        "closing_indentation": "indentation depth delta/R in equilibrium of an edge that closes",
        "closing_load": "load P/(1.5 pi R dgamma) in equilibrium of an edge that closes",
        "closing_stable": "whether the equilibrium of an edge that closes is stable under the control of the study",
    },
    "path": {
        "path_contact_radius": "contact radius a/R on the path of a loading cycle",
        "path_indentation": "indentation depth delta/R on the path of a loading cycle",
        "path_load": "load P/(1.5 pi R dgamma) on the path of a loading cycle",
        "path_branch": "stable branch of the path, counted from inside (0: out of contact)",
        "path_jump": "whether the point is reached by a jump",
        "path_unloading": "whether the path is loading or unloading",
    },
    "asymptotic": {
        "asymptotic_contact_radius": "contact radius a/R of the asymptotic curve",
        "asymptotic_indentation": "indentation depth delta/R of the asymptotic curve",
        "asymptotic_load": "load P/(1.5 pi R dgamma) of the asymptotic curve",
    },
    "envelope": {
        "envelope_contact_radius": "contact radius a/R of the envelopes",
        "loading_envelope_indentation": "indentation depth delta/R of the loading envelope",
        "loading_envelope_load": "load P/(1.5 pi R dgamma) of the loading envelope",
        "unloading_envelope_indentation": "indentation depth delta/R of the unloading envelope",
        "unloading_envelope_load": "load P/(1.5 pi R dgamma) of the unloading envelope",
    },
    "effective": {
        "effective_contact_radius": "contact radius a/R on the effective path between the envelopes",
        "effective_indentation": "indentation depth delta/R on the effective path",
        "effective_load": "load P/(1.5 pi R dgamma) on the effective path",
        "effective_jump": "whether the point of the effective path is reached by a jump",
    },
    "smooth": {
        "smooth_contact_radius": "contact radius a/R of the punch without waviness",
        "smooth_indentation": "indentation depth delta/R of the punch without waviness",
        "smooth_load": "load P/(1.5 pi R dgamma) of the punch without waviness",
    },
    "jumps": {
        "jump_count": "number of jumps of a loading cycle; those of all scenes follow one another",
        "jump_indentation": "indentation depth delta/R before the jump; constant under displacement control",
        "jump_radius_before": "contact radius a/R before the jump (0: no contact)",
        "jump_radius_after": "contact radius a/R after the jump (0: no contact)",
        "jump_energy": "energy dissipated by the jump over R^2 dgamma (negative: gained)",
        "jump_load_before": "load P/(1.5 pi R dgamma) before the jump",
        "jump_load_after": "load P/(1.5 pi R dgamma) after the jump",
        "jump_unloading": "whether the jump is on loading or on unloading",
        "jump_at_rim": "whether the jump starts or ends at the rim",
    },
    "pressure": {
        "pressure_radius": "distance r/R from the axis under the punch",
        "pressure": "contact pressure p R/dgamma, positive in compression",
    },
    "surface": {
        "surface_radius": "distance r/R from the axis",
        "surface_displacement": "displacement u_z/R of the surface, positive into the half-space",
        "surface_gap": "gap/R between the surfaces (missing beyond the rim)",
    },
}
"""Every curve of a curve study: its variables, with their `long_name`."""

SI: Final = "_si"
"""What is added to the name of an output, for the variable that has it in SI units."""


def is_of_a_state(variable: str) -> bool:
    """
    Report whether a variable belongs to a curve of a state.

    >>> is_of_a_state("surface_gap_si"), is_of_a_state("path_load")
    (True, False)
    """
    return any(variable.removesuffix(SI) in CURVES[curve] for curve in STATE_CURVES)


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


def long_name_in_si(long_name: str) -> str:
    """
    Report what an output is in SI units.

    >>> long_name_in_si("energy dissipated in a loading cycle, H/(R^2 dgamma)")
    'energy dissipated in a loading cycle, H'
    """
    for over in (" R/dgamma", "/(1.5 pi R dgamma)", "/(R^2 dgamma)", ", in R^2 dgamma", " over R^2 dgamma", "/R"):
        long_name = long_name.replace(over, "")
    return long_name


INTEGERS: Final = {
    "stable": "i1",
    "closing_stable": "i1",
    "path_branch": "i4",
    "path_jump": "i1",
    "path_unloading": "i1",
    "effective_jump": "i1",
    "jump_count": "i4",
    "jump_unloading": "i1",
    "jump_at_rim": "i1",
}
"""The type of the variables of curves that are integers."""

MEANINGS: Final = {
    "stable": "unstable stable",
    "closing_stable": "unstable stable",
    "path_jump": "along_a_branch by_a_jump",
    "path_unloading": "loading unloading",
    "effective_jump": "along_an_envelope by_a_jump",
    "jump_unloading": "loading unloading",
    "jump_at_rim": "within_the_rim at_the_rim",
}
"""What 0 and 1 mean where an integer is a flag."""

IDLE: Final = "without effect"
"""What the comment of a coordinate begins with that is there for completeness."""

STATUS: Final = "flags of a scene (0: nothing to report)"
"""The `long_name` of `status`."""

FLAGS: Final = {
    "loading_contact_not_one_disc": "contact on loading is not one disc",
    "unloading_contact_not_one_disc": "contact on unloading is not one disc",
    "pull_off_at_rim": "the pull-off is at the rim",
    "jump_in_to_rim": "the jump-in reaches the rim",
    "close_to_a_jump": "an input error of 1e-12 could change a number of jumps or the place of the pull-off",
    "tolerance_not_met": "the requested accuracy is not reached",
    "no_value": "a parameter is outside its range, or the scene cannot be resolved",
    "linear_deviation_off": "a linear standard deviation is off: a kink is near",
    "resolution_too_coarse": "a sweep finer than the resolution finds another optimum",
    "nothing_feasible": "no point of the sweep meets the requirements",
    "no_contact": "the cycle turns before first contact",
    "too_many_waves": "the contact contains more waves than can be followed",
    "poor_fit": "the residual exceeds the noise",
    "another_minimum": "other values fit the loop as well within its noise",
}
"""Every flag of `status`, in words."""

CONTACT_SLOPE: Final = "contact_slope"
"""The output that says how far the contact reaches on the punch."""

STEEP: Final = "steep_contact"
"""The coordinate that marks the scenes whose contact reaches a slope of the punch that is not small, if any does."""

STEEP_CONTACT: Final = "whether the contact reaches a slope of the punch above 1"
"""Its `long_name`."""

SOLVERS: Final = "how the scenes are solved"
"""The `long_name` of `solver`."""

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
    "pull_off_force_error": r"error of the force $/\,(\frac{3}{2}\pi R\Delta\gamma)$",
    "dissipated_energy_error": r"error of the energy $/\,(R^2\Delta\gamma)$",
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

OTHER_PARAMETER: Final = "other_parameter"
"""The second dimension of the correlations of a fit."""

PARAMETER_UNITS: Final = "parameter_units"
"""The units of what is fitted, along `parameter`."""

LOOP: Final = "loop"
"""The first dimension of the fits of several loops."""

MINIMUM: Final = "minimum"
"""The dimension of other minima that the noise of a loop allows, the best first."""

FIT: Final = {
    "value": ((PARAMETER,), "fitted value, in its unit"),
    "standard_deviation": ((PARAMETER,), "standard deviation of the value, in its unit"),
    "low": ((PARAMETER,), "lower end of the 95 % interval, in its unit"),
    "high": ((PARAMETER,), "upper end of the 95 % interval, in its unit"),
    "on_bound": ((PARAMETER,), "whether the value is within 1 % of its searched range of an end of it"),
    "correlation": ((PARAMETER, OTHER_PARAMETER), "correlation of the values"),
    "chi_square": ((), "sum of the squares of the residuals"),
    "degrees_of_freedom": ((), "number of points minus number of fitted values"),
    "converged": ((), "whether the minimum of the misfit was found within its tolerance"),
}
"""The variables that every fit has, but for its points: their dimensions, and what they are."""

FIT_MORE: Final = {
    "low_searched": ((PARAMETER,), "lower end of the range searched, in its unit"),
    "high_searched": ((PARAMETER,), "upper end of the range searched, in its unit"),
    "reduced_chi_square": ((), "sum of the squares of the residuals over the degrees of freedom"),
    "interval_widening": ((), "factor by which deviations and intervals are widened for residuals above the noise"),
    "noise_of_indentation": ((), "standard deviation of the noise of the depth of a point"),
    "noise_of_load": ((), "standard deviation of the noise of the load of a point"),
    "raw_points": ((), "number of points of the file that were used"),
    "kept_points": ((), "number of points that were fitted, after averaging"),
    "tabor_parameter": ((), "Tabor parameter of the punch at the fitted values"),
    "contact_depth": ((), "depth of the contact point that was found before the fit"),
    "contact_depth_deviation": ((), "standard deviation of the depth of the contact point"),
    "minimum_value": ((MINIMUM, PARAMETER), "value at another minimum that the noise allows, in its unit"),
    "minimum_chi_square": ((MINIMUM,), "sum of the squares of the residuals at that minimum"),
}
"""Those that fits of version 0.2 lack, or that some fits have."""

FIT_UNITS: Final = {
    "noise_of_indentation": "m",
    "noise_of_load": "N",
    "contact_depth": "m",
    "contact_depth_deviation": "m",
}
"""Their units; all others have none, or that of what is fitted."""

FIT_WORDS: Final = {
    "file": "file of the loop; after # the number of the loop in it",
    "sha256": "fingerprint of the file",
    "problem": "why the loop has no values; empty if it has values",
    "alike": "alternatives that the loop cannot distinguish; empty if none are found",
}
"""The words of each of several loops, along `loop`."""

FIT_POINTS: Final = {
    "measured_point": {
        "measured_indentation": "measured indentation depth",
        "measured_load": "measured load, negative if it pulls",
        "measured_unloading": "whether the point belongs to loading or unloading",
        "measured_cycle": "number of the cycle",
        "residual": "signed distance of the point to the fitted path, in standard deviations of the noise",
    },
    "fitted_point": {
        "fitted_indentation": "indentation depth on the fitted path, with its offset",
        "fitted_load": "load on the fitted path, with its offset",
        "fitted_unloading": "whether the path is loading or unloading",
    },
}
"""The variables of the points of a fit, by their dimension."""

SCENE: Final = "scene"
"""The one dimension of a dataset with `layout = "points"`."""

SOLVER: Final = "solver"
"""The first dimension of a dataset with several solvers."""

REALISATION: Final = "realisation"
"""The last dimension of the scenes of random roughness."""

REALISATIONS: Final = "realisation of the random roughness"
"""The `long_name` of `realisation`."""

REFERENCES: Final = (
    "Jin, Guo & Wan (2013), Mechanics of axisymmetric adhesive contact of rough surfaces involving power-law graded "
    "materials; Johnson, Kendall & Roberts (1971), Surface energy and the contact of elastic solids"
)
"""The theory behind the values."""
