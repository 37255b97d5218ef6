"""The path of a cycle: its branches, loading, unloading, near-degenerate decisions, and the energies of jumps."""
