"""Arrays of general scenes, plain or on a pattern of toughness, in tasks of one gradient exponent."""

from __future__ import annotations  # those of inner functions would be made anew in every call: 15 us each

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.cosine import SLOPES
from gradhesion.core.arrays.prepared import curves_of, prepared, run_by_exponent
from gradhesion.core.arrays.tables import changes_of, tables_of
from gradhesion.core.compiler.marks import note_compiled
from gradhesion.core.curve.general import Basis
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.names import PULL_OFF
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.results import Results, slots_of, typed
from gradhesion.core.scene.general import solve_pull_offs, solve_scenes
from gradhesion.core.scene.general_long import solve_left
from gradhesion.core.sensitivities.cosine_slopes import COUNT
from gradhesion.core.sensitivities.general_slopes import Sense
from gradhesion.core.sensitivities.neighbours import depth_factor_by_k
from gradhesion.core.sensitivities.wanted import NoSense

if TYPE_CHECKING:
    from gradhesion.core.problem.toughness import Toughness


def _sense_of(toughness: Toughness | None) -> tuple[type, int]:
    """Return the record that sensitivities need, and how many slopes they find."""
    if toughness is None:
        return Sense, COUNT
    from gradhesion.core.sensitivities import patterned_slopes  # noqa: PLC0415 (seldom wanted)

    return patterned_slopes.PatternedSense, patterned_slopes.COUNT


def solve_general(
    parameters: Mapping[str, ArrayLike],
    outputs: Sequence[str],
    profile: Profile,
    loading: Loading,
    threads: int | None,
    *,
    check_contact: bool = True,
    turned: bool = False,
    slopes: tuple[bool, int] | None = None,
    toughness: Toughness | None = None,
) -> dict[str, NDArray[Any]]:
    """Solve all scenes of broadcast parameters for one profile and control, as `solve` of core/sweep.py.

    Scenes that differ along the last axes in a_max alone are solved on one trace.
    `turned` is whether a_max is where the cycles turn, not the rim of a punch. `slopes` is whether the sensitivities of
    force are wanted, and of the energy of which parts of the cycle (`part_of` of problem/results.py); values and place
    are then among `outputs`: the result has `SLOPES` more, of shape (3, COUNT, *scenes), those of the force, of the
    energy, and of the depth where a cycle turns to what sensitivities/cosine_slopes.py names (NaN where there is no
    positive value).
    """
    scenes = prepared(parameters, loading, toughness=toughness)
    rows = list(dict.fromkeys(outputs))
    slots = slots_of(rows, check_contact=check_contact, turned=turned)
    out = np.full((len(rows), scenes.k.size, scenes.rim.shape[1]), np.nan)
    status = np.zeros(out.shape[1:], dtype=np.int8 if toughness is None else np.int16)
    series, curves_at = curves_of(scenes, profile, toughness)
    force_alone = set(rows) <= set(PULL_OFF) and slopes is None and toughness is None
    solve = solve_pull_offs if force_alone else solve_scenes
    long = "general_long" if slopes is None else "general_long_sensitivities"
    kind, count = _sense_of(toughness) if slopes else (NoSense, 0)
    sensed = np.full((3, count, *status.shape), np.nan)

    def sense_at(exponent: float) -> Any:
        """Return the inputs for the sensitivities of the curves of one exponent."""
        if slopes is None:
            return NoSense()
        change, m = changes_of(exponent, series), profile.exponent
        return kind(change, depth_factor_by_k(exponent, m), exponent, m, sensed, *slopes, turned)

    def work(exponent: float, index: NDArray[np.int64], interpolated: bool) -> None:
        basis = Basis(*tables_of(exponent, series, interpolated=interpolated and slopes is None), series)
        curves, results, sense = curves_at(exponent, index), Results(slots, out, status), sense_at(exponent)
        if solve(basis, curves, results, sense):
            solve_left(basis, curves, results, sense)
            note_compiled(long)

    run_by_exponent(scenes.k, work, threads, scenes.rim.shape[1])
    result: dict[str, NDArray[Any]] = {}
    for name in outputs:
        result[name] = typed(name, out[rows.index(name)]).reshape(scenes.shape)
    result["status"] = status.reshape(scenes.shape)
    if slopes is not None:
        result[SLOPES] = sensed.reshape((3, count, *scenes.shape))
    return result
