"""The datasets of fits: what their variables and dimensions are called, and what they are."""

from typing import Final

from gradhesion.cli.names.outputs import PARAMETER

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
