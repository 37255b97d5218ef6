"""Equilibrium curves of one cosine, of any profile and control, of a short wave: states, folds, branches, energies."""
