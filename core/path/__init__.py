"""The path of a cycle: its branches, loading, unloading, near-degenerate decisions, and what jumps lose."""
