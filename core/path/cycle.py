"""What a cycle up to one rim comes to."""

from typing import NamedTuple


class Cycle(NamedTuple):
    """A cycle of loading and unloading in reduced units: energies in 2 pi l^2 dgamma, depths in s l^c.

    loaded, loading_jumps       what the jumps of loading lose, and their number
    unloaded, unloading_jumps   the same of unloading
    last                        the depth at which contact ends
    highest                     the largest value of what is prescribed, on the way to the rim
    """

    loaded: float
    loading_jumps: float
    unloaded: float
    unloading_jumps: float
    last: float
    highest: float
