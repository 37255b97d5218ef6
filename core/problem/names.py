"""The names that a study may use: importing them costs no compiler and no solver."""

from typing import Final

PARAMETERS: Final = ("k", "nu", "modulus", "c0_over_R", "lambda_over_R", "A", "a_max_over_R")
"""The seven parameters of a scene, in the order of a dataset's dimensions."""
RESULTS: Final = (
    "pull_off_force",
    "pull_off_radius",
    "dissipated_energy",
    "loading_jumps",
    "unloading_jumps",
    "delta_max",
    "delta_jump_out",
    "loading_energy",
    "unloading_energy",
)
"""The results of a cycle, in the order of their rows."""
INTEGERS: Final = ("loading_jumps", "unloading_jumps")
"""Those of them that are counts."""
EDGE: Final = ("front_energy", "snap_in_force", "pinned_depth")
"""Further results of a cycle whose edge opens at a larger work of adhesion than it closes at (scenes/cycles.py)."""
RATE: Final = ("edge_speed_at_pull_off", "rate_coefficient")
"""Further results of a cycle whose edge opens at a work that grows with its speed (rate/cycle.py)."""
OUTPUTS: Final = (*RESULTS, "turning_radius")
"""All results of a scene: those of its cycle, and where it turns."""
REACH: Final = "reach"
"""The largest end of a jump of an unbounded punch, a/R: `contact_slope` is computed from it (problem/reach.py)."""
CONTACT_SLOPE: Final = "contact_slope"
"""The slope (a/R)^(m-1) of the punch at the largest radius on which the other outputs depend (problem/reach.py)."""
TURNS: Final = ("indentation_max_over_R", "load_max")
"""Where the cycle turns before the rim, at most one of them: a depth in R, or a load in 1.5 pi R dgamma."""
PATTERN: Final = ("toughness_wavelength_over_R", "toughness_amplitude")
"""The parameters of a pattern of toughness (problem/toughness.py); the amplitude is 1 where it is not given."""
SPEED: Final = "speed_over_reference"
"""The parameter V/v* of an edge whose work grows with its speed (problem/rate.py); 0 where it is not given."""
CLOSING: Final = "closing_ratio"
"""The parameter w_c/w_o in [0, 1]: the work of adhesion of closing over that of opening; 1 where it is not given."""
PULL_OFF: Final = ("pull_off_force", "pull_off_radius")
"""The results that need no path of loading and unloading."""
REPORTS: Final = (
    "energy_residual",
    "roughness_parameter",
    "saturation_radius",
    "adhesion_gain",
    "energy_gain",
)
"""All other outputs on request, in the order of their rows."""
GIVEN_UP: Final = {
    "pull_off_force_error": "its accuracy is promised in docs/accuracy.md and checked by `gradhesion verify`",
    "dissipated_energy_error": "its accuracy is promised in docs/accuracy.md and checked by `gradhesion verify`; "
    "energy_residual is a measure of it in every scene",
}
"""Outputs of earlier versions, with what stands in their place."""
SENSITIVITIES: Final = ("pull_off_force_sensitivity", "dissipated_energy_sensitivity")
"""How strongly a value depends on each parameter: along a last axis of parameters."""
VALIDITY: Final = ("tabor_parameter", "wave_tabor_parameter", "wave_slope", "johnson_alpha")
"""Measures of where the model applies (closed/applicability.py): they need no solution, whatever the solver."""
RANGE: Final = "adhesion_range_over_R"
"""The parameter of the Tabor parameters: the range of the attraction."""
SOLVERS: Final = ("exact", "asymptotic", "envelope")
"""The exact one; and for wavelengths far below the contact radius the leading term, and its envelopes."""
WITHOUT_LOAD: Final[dict[str, str]] = {
    "asymptotic": "the leading terms of depth and load belong to one energy only up to the order of lambda/a, so that "
    "under a load the work of a cycle would not be what its jumps lose",
    "envelope": "the path along the envelopes jumps into and out of contact at a constant depth; under a load or "
    "through a spring it leaves them at other radii, and loses what the load does in its fall, or the spring in its "
    "recoil",
}
"""Why the other solvers, and the curves of short waves, have displacement control only."""
PATTERN_CURVES: Final = ("equilibrium", "closing_equilibrium", "path", "jumps")
"""The curves of an interface whose toughness varies with the radius."""
CURVES: Final[dict[str, tuple[str, ...]]] = {
    "equilibrium": ("contact_radius", "indentation", "load", "stable"),
    "closing_equilibrium": ("closing_contact_radius", "closing_indentation", "closing_load", "closing_stable"),
    "path": ("path_contact_radius", "path_indentation", "path_load", "path_branch", "path_jump", "path_unloading"),
    "asymptotic": ("asymptotic_contact_radius", "asymptotic_indentation", "asymptotic_load"),
    "envelope": (
        "envelope_contact_radius",
        "loading_envelope_indentation",
        "loading_envelope_load",
        "unloading_envelope_indentation",
        "unloading_envelope_load",
    ),
    "effective": ("effective_contact_radius", "effective_indentation", "effective_load", "effective_jump"),
    "smooth": ("smooth_contact_radius", "smooth_indentation", "smooth_load"),
    "jumps": (
        "jump_indentation",
        "jump_radius_before",
        "jump_radius_after",
        "jump_energy",
        "jump_load_before",
        "jump_load_after",
        "jump_unloading",
        "jump_at_rim",
    ),
}
"""The variables of every curve, in order; those of the jumps have an item a jump, the others a point."""
