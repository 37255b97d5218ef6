"""One curve of equilibrium: its values, its folds, where it has a level, and the energy between two radii."""
