"""Cycles whose edge opens at a larger work of adhesion than it closes at."""
