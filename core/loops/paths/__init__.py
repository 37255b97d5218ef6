"""The path that a loop is compared with, how it moves with the parameters, and the misfit."""
