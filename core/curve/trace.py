"""The trace of a curve: its branches, on which what is prescribed rises, from within outwards, a column each.

START, END                  radii y at which a branch begins and ends; inf while its end is not known
START_DEPTH, END_DEPTH      the depths there
START_LOAD, END_LOAD        the loads there (under displacement control 0)
START_LEVEL, END_LEVEL      what is prescribed there
LANDING                     where loading arrives on the branch
LOADED, LOADING_JUMPS       what loading has lost by then, in 2 pi l^2 dgamma, and in how many jumps
UNLOADED, UNLOADING_JUMPS   what unloading still loses from the start of the branch on; NaN: not computed yet
LAST                        the branch from whose start unloading leaves contact
"""

from typing import Final

import numpy as np

from gradhesion.core.types import Floats

START, END, START_DEPTH, END_DEPTH, START_LOAD, END_LOAD, START_LEVEL, END_LEVEL = range(8)
LANDING, LOADED, LOADING_JUMPS, UNLOADED, UNLOADING_JUMPS, LAST = range(8, 14)
CLOSE_PAIR: Final = 14
"""In column 0: the first radius at which two folds are about to be born or to meet; inf if there is none."""
ROWS: Final = 15


def room_for(bins: int) -> Floats:
    """Return room for the trace of a curve of that many bins, (ROWS, branches).

    That is a branch a bin: two folds. Bins with three are rare, and a trace that is full says so (curve/folds.py).
    """
    return np.empty((ROWS, bins + 8))
