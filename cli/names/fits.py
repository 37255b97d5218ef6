"""The datasets of fits: every variable, declared once, and what their dimensions are called."""

from typing import Final, NamedTuple

from gradhesion.cli.names.outputs import PARAMETER

OTHER_PARAMETER: Final = "other_parameter"
"""The second dimension of the correlations of a fit."""
PARAMETER_UNITS: Final = "parameter_units"
"""The units of what is fitted, along `parameter`."""
LOOP: Final = "loop"
"""The first dimension of the fits of several loops."""
MINIMUM: Final = "minimum"
"""The dimension of other minima that the noise of a loop allows, the best first."""


class FitVariable(NamedTuple):
    """A variable of a fit."""

    dims: tuple[str, ...]
    about: str
    """What it is; its `long_name`."""
    dtype: str = "f8"
    """Empty: as large as its integers need."""
    unit: str = "1"
    """Empty for what is in the units of what is fitted, or a word."""
    meanings: str = ""
    """What 0 and 1 mean, where it is a flag."""


_VALUES: Final = (PARAMETER,)

FIT: Final = {
    "value": FitVariable(_VALUES, "fitted value, in its unit", unit=""),
    "standard_deviation": FitVariable(_VALUES, "standard deviation of the value, in its unit", unit=""),
    "low": FitVariable(_VALUES, "lower end of the 95 % interval, in its unit", unit=""),
    "high": FitVariable(_VALUES, "upper end of the 95 % interval, in its unit", unit=""),
    "on_bound": FitVariable(_VALUES, "whether the value is within 1 % of an end of its range", "i1", "", "no yes"),
    "correlation": FitVariable((PARAMETER, OTHER_PARAMETER), "correlation of the values"),
    "chi_square": FitVariable((), "sum of the squares of the residuals"),
    "degrees_of_freedom": FitVariable((), "number of points minus number of fitted values", "i4"),
    "converged": FitVariable((), "whether the minimum was found within its tolerance", "i1", "", "no yes"),
}
"""The variables that every fit has, but for its points."""
FIT_MORE: Final = {
    "low_searched": FitVariable(_VALUES, "lower end of the range searched, in its unit", unit=""),
    "high_searched": FitVariable(_VALUES, "upper end of the range searched, in its unit", unit=""),
    "reduced_chi_square": FitVariable((), "sum of the squares of the residuals over the degrees of freedom"),
    "interval_widening": FitVariable((), "factor by which intervals are widened for residuals above the noise"),
    "noise_of_indentation": FitVariable((), "standard deviation of the noise of the depth of a point", unit="m"),
    "noise_of_load": FitVariable((), "standard deviation of the noise of the load of a point", unit="N"),
    "raw_points": FitVariable((), "number of points of the file that were used", "i8"),
    "kept_points": FitVariable((), "number of points that were fitted, after averaging", "i8"),
    "tabor_parameter": FitVariable((), "Tabor parameter of the punch at the fitted values"),
    "contact_depth": FitVariable((), "depth of the contact point that was found before the fit", unit="m"),
    "contact_depth_deviation": FitVariable((), "standard deviation of the depth of the contact point", unit="m"),
    "minimum_value": FitVariable((MINIMUM, PARAMETER), "value at another minimum, in its unit", unit=""),
    "minimum_chi_square": FitVariable((MINIMUM,), "sum of the squares of the residuals at that minimum"),
}
"""Those that fits of version 0.2 lack, or that some fits have."""
FIT_WORDS: Final = {
    "file": "file of the loop; after # the number of the loop in it",
    "sha256": "fingerprint of the file",
    "problem": "why the loop has no values; empty if it has values",
    "alike": "alternatives that the loop cannot distinguish; empty if none are found",
}
"""The words of each of several loops, along `loop`."""
_WAYS: Final = "loading unloading"
_MEASURED: Final = ("measured_point",)
_FITTED: Final = ("fitted_point",)

FIT_POINTS: Final = {
    "measured_point": {
        "measured_indentation": FitVariable(_MEASURED, "measured indentation depth", unit="m"),
        "measured_load": FitVariable(_MEASURED, "measured load, negative if it pulls", unit="N"),
        "measured_unloading": FitVariable(_MEASURED, "whether the point is of loading or unloading", "i1", "", _WAYS),
        "measured_cycle": FitVariable(_MEASURED, "number of the cycle", ""),
        "residual": FitVariable(_MEASURED, "signed distance to the fitted path, in standard deviations of the noise"),
    },
    "fitted_point": {
        "fitted_indentation": FitVariable(_FITTED, "indentation depth on the fitted path, with its offset", unit="m"),
        "fitted_load": FitVariable(_FITTED, "load on the fitted path, with its offset", unit="N"),
        "fitted_unloading": FitVariable(_FITTED, "whether the path is loading or unloading", "i1", "", _WAYS),
    },
}
"""The variables of the points of a fit, by their dimension."""
