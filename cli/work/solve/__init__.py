"""The scenes, curves, optima, spreads and fits of a study, solved block by block."""
