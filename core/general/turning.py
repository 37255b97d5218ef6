"""Where a cycle of any profile under any control turns."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.loading_control import Loading
from gradhesion.core.profile import Profile


def turning_general(
    parameters: Mapping[str, ArrayLike],
    turn: str,
    profile: Profile,
    loading: Loading,
    workers: int,
    *,
    check_contact: bool = True,
) -> tuple[NDArray[np.float64], NDArray[np.int8]]:
    """Not there yet."""
    raise NotImplementedError
