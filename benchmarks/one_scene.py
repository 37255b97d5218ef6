"""One scene in a call of Python: what a dataset costs beside its solution."""

import gradhesion as gr
from benchmarks.clock import seconds_of, table
from gradhesion import core

SCENE = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.02, "a_max_over_R": 1.0}


def calls_table(repeat: int = 10) -> str:
    """Return the least processor times of both calls, and their ratio."""
    plain, whole = (seconds_of(lambda one=one: one(SCENE), repeat=repeat) for one in (core.solve, gr.solve))
    rows = [["`gradhesion.core.solve`", 1e3 * plain], ["`gradhesion.solve`", 1e3 * whole], ["ratio", whole / plain]]
    return table(["call", "ms"], rows)
