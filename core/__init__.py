"""Adhesive contact of a wavy axisymmetric punch on a power-law graded half-space: arrays in, arrays out."""

from gradhesion.core._jit import CACHE_FOLDER, SOURCES
from gradhesion.core.curves import CURVES, draw_curves
from gradhesion.core.loading_control import CONTROLS, Loading
from gradhesion.core.profile import Harmonic, Profile
from gradhesion.core.report import REPORTS
from gradhesion.core.results import OUTPUTS
from gradhesion.core.solvers import SOLVERS
from gradhesion.core.status import DOUBTFUL, FAILED, FLAGS, doubts_about
from gradhesion.core.sweep import PARAMETERS, compiled_before, solve

__all__ = [
    "CACHE_FOLDER",
    "CONTROLS",
    "CURVES",
    "DOUBTFUL",
    "FAILED",
    "FLAGS",
    "OUTPUTS",
    "PARAMETERS",
    "REPORTS",
    "SOLVERS",
    "SOURCES",
    "Harmonic",
    "Loading",
    "Profile",
    "compiled_before",
    "doubts_about",
    "draw_curves",
    "solve",
]
