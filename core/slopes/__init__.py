"""Derivatives of values by the parameters of scenes."""
