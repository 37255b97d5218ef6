"""Adhesive contact of a wavy axisymmetric punch on a power-law graded half-space: arrays in, arrays out."""

from gradhesion.core.curves import CURVES, draw_curves
from gradhesion.core.report import REPORTS
from gradhesion.core.results import OUTPUTS
from gradhesion.core.solvers import SOLVERS
from gradhesion.core.status import DOUBTFUL, FAILED, FLAGS, doubts_about
from gradhesion.core.sweep import PARAMETERS, compiled_before, solve

__all__ = [
    "CURVES",
    "DOUBTFUL",
    "FAILED",
    "FLAGS",
    "OUTPUTS",
    "PARAMETERS",
    "REPORTS",
    "SOLVERS",
    "compiled_before",
    "doubts_about",
    "draw_curves",
    "solve",
]
