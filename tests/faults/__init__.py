"""Runs that are killed for real."""
