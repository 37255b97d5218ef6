"""Answers beyond a map of values: what measured data say, and how strongly a value depends on its parameters."""
