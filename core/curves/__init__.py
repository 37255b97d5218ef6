"""Curves of one scene for drawing: equilibrium, the path of a cycle, asymptotic form, envelopes, effective path."""

from gradhesion.core.curves.draw import CURVES, INTEGERS, draw_curves

__all__ = ["CURVES", "INTEGERS", "draw_curves"]
