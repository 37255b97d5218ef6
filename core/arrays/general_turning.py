"""The turning radii of arrays of general scenes that turn at a depth or a load."""

from __future__ import annotations  # those of inner functions would be made anew in every call: 15 us each

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.prepared import curves_of, prepared, run_by_exponent
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve.general import Basis
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.names import PARAMETERS
from gradhesion.core.problem.profile import Profile
from gradhesion.core.turning.general import turn_scenes
from gradhesion.core.turning.turns import Turns

if TYPE_CHECKING:
    from gradhesion.core.problem.toughness import Toughness


def turning_general(
    parameters: Mapping[str, ArrayLike],
    turn: str,
    profile: Profile,
    loading: Loading,
    threads: int | None,
    *,
    check_contact: bool = True,
    toughness: Toughness | None = None,
) -> tuple[NDArray[np.float64], NDArray[Any], NDArray[np.bool_]]:
    """Return where the cycles turn, the bits of `status` for the turn, and whether a jump has passed the target.

    Parameters
    ----------
    parameters, turn, profile, loading, threads, check_contact, toughness
        As those of `solve` of core/sweep.py; `turn` is the one of `TURNS` that `parameters` has. Scenes that differ
        along the last axes in it and in a_max alone are followed on one trace.

    Returns
    -------
    The radius a/R at which unloading starts, 0 where no contact is made, NaN where there is no value; and the bits
    close_to_a_jump (a step is within 4e-12 of the target's terms), loading_contact_not_one_disc (of the contact that
    turns) and no_value. Where a jump has passed the depth or load, the cycle turns beyond it, where the jump ends. All
    have the broadcast shape.
    """
    scenes = prepared(parameters, loading, (*PARAMETERS[-1:], turn), toughness)
    assert scenes.target is not None  # noqa: S101 -- it was requested
    rims = scenes.rim
    series, curves_at = curves_of(scenes, profile, toughness)
    radii = np.empty((scenes.k.size, rims.shape[1]))
    flags, passed = (
        np.zeros(radii.shape, dtype=np.int8 if toughness is None else np.int16),
        np.zeros(radii.shape, dtype=np.bool_),
    )
    turns = Turns(rims, scenes.target, turn == "load_max", check_contact, radii, flags)

    def work(exponent: float, index: NDArray[np.int64], interpolated: bool) -> None:
        basis = Basis(*tables_of(exponent, series, interpolated=interpolated), series)
        turn_scenes(basis, curves_at(exponent, index), turns, passed)

    run_by_exponent(scenes.k, work, threads, rims.shape[1])
    return radii.reshape(scenes.shape), flags.reshape(scenes.shape), passed.reshape(scenes.shape)
