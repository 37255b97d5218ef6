"""Where fits start and end: ranges, starts, and the minima of the misfit."""
