"""Curves of one scene for drawing: equilibrium, the path of a cycle, its jumps, approximations, states of contact."""
