"""The kernels that a study needs, and how they are compiled ahead."""
