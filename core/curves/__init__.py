"""Curves of one scene for drawing: equilibrium, the path of a cycle, asymptotic form, envelopes, effective path."""

from gradhesion.core.curves.draw import CURVES, GENERAL_CURVES, INTEGERS, draw_curves

__all__ = ["CURVES", "GENERAL_CURVES", "INTEGERS", "draw_curves"]
