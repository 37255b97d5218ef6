"""Adhesive contact of a wavy axisymmetric punch on a power-law graded half-space: arrays in, arrays out."""

from gradhesion.core.curves import CURVES, draw_curves
from gradhesion.core.report import REPORTS
from gradhesion.core.results import OUTPUTS
from gradhesion.core.solvers import SOLVERS
from gradhesion.core.status import FAILED, FLAGS
from gradhesion.core.sweep import PARAMETERS, compiled_before, solve

__all__ = [
    "CURVES",
    "FAILED",
    "FLAGS",
    "OUTPUTS",
    "PARAMETERS",
    "REPORTS",
    "SOLVERS",
    "compiled_before",
    "draw_curves",
    "solve",
]
