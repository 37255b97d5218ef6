"""The folder of a run: its lock, the parts of its finished blocks, and its small files."""
