"""Curves of one scene for drawing: equilibrium, the path of a cycle, asymptotic form, envelopes, effective path."""

from gradhesion.core.curves.draw import GENERAL_CURVES, INTEGERS, draw_curves
from gradhesion.core.problem.names import CURVES

__all__ = ["CURVES", "GENERAL_CURVES", "INTEGERS", "draw_curves"]
