"""Datasets against the studies in them: whether they belong together, recomputed, and several joined."""
