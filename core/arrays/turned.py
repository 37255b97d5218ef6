"""The results of cycles that turn before the rim: those of a punch with its rim at the turning radius.

Loading does not depend on where it will turn, and unloading from a branch not on how the contact got there, so that
force, energy and counts are those of a punch whose rim is at the turning radius (docs/theory.md, section 16).
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final, Protocol, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.problem.names import TURNS
from gradhesion.core.problem.status import JUMP_IN_TO_RIM, NO_CONTACT, NO_VALUE, TOO_MANY_WAVES

Results: TypeAlias = dict[str, NDArray[Any]]
_GAINS: Final = {"adhesion_gain": "pull_off_force", "energy_gain": "dissipated_energy"}
_OF_THE_CURVE: Final = ("roughness_parameter", "saturation_radius")
"""Results of the curve, whether or not contact is made."""
_NOTHING: Final = {"pull_off_radius": np.nan, "delta_jump_out": np.nan}
"""Results without a value where there is no contact; all others are 0 then."""


class Solver(Protocol):
    """A function that solves scenes up to their rims."""

    def __call__(self, scenes: Mapping[str, ArrayLike], wanted: Sequence[str], *, turned: bool) -> Results:
        """Return the results `wanted` and `status`, all of the broadcast shape."""
        ...


def turned_results(
    parameters: Mapping[str, ArrayLike],
    turn: str,
    outputs: Sequence[str],
    radii: NDArray[np.float64],
    flags: NDArray[Any],
    passed: NDArray[np.bool_],
    solve: Solver,
    smooth: Callable[[Mapping[str, ArrayLike], Sequence[str]], Results],
) -> Results:
    """Solve scenes that turn at given radii.

    Parameters
    ----------
    parameters, turn, outputs
        As those of `solve` in core/sweep.py; `turn` is the one of `TURNS` that `parameters` has.
    radii, flags
        Where unloading starts, and the bits of the status for it; of the broadcast shape (turning_cosine).
    passed
        Whether a jump has passed the depth or load, under a load or by a machine (turning_general).
    solve
        The function that solves scenes up to their rims.
    smooth
        The function that solves scenes with the same turn, for the gains over the smooth punch.

    Returns
    -------
    All `outputs` and `status`, of 16 bits where cycles turn at a depth. Without contact (radius 0, no_contact) force,
    energies and counts are 0, `delta_max` is the depth at which the cycle turns, radii and the depth of the jump-out
    are NaN. The gains are those over the smooth punch that
    turns at the same depth or load.
    """
    limits = np.broadcast_to(np.asarray(parameters["a_max_over_R"], dtype=float), radii.shape)
    targets = np.broadcast_to(np.asarray(parameters[turn], dtype=float), radii.shape)
    away, short = radii == 0.0, radii < limits
    gains = [name for name in outputs if name in _GAINS]
    others = [name for name in outputs if name not in (*gains, "turning_radius")]
    wanted = list(dict.fromkeys([*others, *(_GAINS[name] for name in gains)]))
    scenes = {name: value for name, value in parameters.items() if name != turn}
    found = solve(scenes | {"a_max_over_R": np.where(away, limits, radii)}, wanted, turned=True)
    none = ((found["status"] | flags) & NO_VALUE) != 0
    if turn == "indentation_max_over_R" and "delta_max" in found:
        found["delta_max"] = np.where(short & ~none & ~passed, targets, found["delta_max"])
    for name in (name for name in wanted if away.any() and name not in _OF_THE_CURVE):
        empty = targets if name == "delta_max" else _NOTHING.get(name, 0)
        found[name] = np.where(away, empty, found[name]).astype(found[name].dtype)
    if gains:
        even = {**parameters, "A": 0.0 * np.asarray(parameters["A"], dtype=float)}
        plain = smooth(even, [_GAINS[name] for name in gains])
        with np.errstate(all="ignore"):
            found |= {name: found[_GAINS[name]] / plain[_GAINS[name]] for name in gains}
    status = np.where(short, found["status"] & ~JUMP_IN_TO_RIM, found["status"]).astype(np.int16)
    refused = NO_VALUE | ((status | flags) & TOO_MANY_WAVES)
    status = np.where(none & ~away, refused, np.where(away, NO_CONTACT, status) | flags)
    return found | {
        "status": status.astype(np.int16 if turn == TURNS[0] else found["status"].dtype),
        "turning_radius": np.where(none & ~away, np.nan, radii),
    }
