"""The results of a cycle up to one rim."""

from typing import NamedTuple


class Cycle(NamedTuple):
    """A cycle of loading and unloading in reduced units: energies in 2 pi l^2 dgamma, depths in s l^c."""

    loaded: float  # what the jumps of loading lose, and their number
    loading_jumps: float
    unloaded: float  # the same of unloading
    unloading_jumps: float
    last: float  # the depth at which contact ends
    highest: float  # the largest value of what is prescribed, on the way to the rim
