"""Datasets that are read: opened, checked, selected from, and what their values mean."""
