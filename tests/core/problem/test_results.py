"""What is stored of the results, and what counts as asked for."""

import math
from itertools import product

import numpy as np
import pytest

from gradhesion.core.problem import results
from gradhesion.core.problem.names import REACH, RESULTS
from gradhesion.core.problem.results import (
    INTEGERS,
    Results,
    put,
    put_all,
    wants_cycle,
    wants_folds,
    wants_force,
    wants_losses,
)

ROWS = {
    "pull_off_force": results.FORCE,
    "pull_off_radius": results.RADIUS,
    "dissipated_energy": results.ENERGY,
    "loading_jumps": results.LOADING,
    "unloading_jumps": results.UNLOADING,
    "delta_max": results.DEEPEST,
    "delta_jump_out": results.LAST,
    "loading_energy": results.LOADED,
    "unloading_energy": results.UNLOADED,
}


def slots_of(*names: str) -> np.ndarray:
    return results.slots_of(names, check_contact=True, turned=False)


def test_each_name_has_its_row() -> None:
    assert tuple(ROWS) == RESULTS
    assert list(ROWS.values()) == list(range(len(RESULTS)))
    assert len(RESULTS) == results.CONTACT
    assert set(INTEGERS) < set(RESULTS)


@pytest.mark.parametrize("plain", [False, True])
def test_only_what_was_asked_for_is_stored_and_where_it_was_asked(plain: bool) -> None:
    one, every = (put.py_func, put_all.py_func) if plain else (put, put_all)
    slots = slots_of("delta_max", "pull_off_force")
    single, together = np.full((2, 3), math.nan), np.full((2, 3), math.nan)
    status = np.zeros(3, dtype=np.int8)
    values = (1.7, 2.9, 3.1, 4.0, 5.0, 6.3, 7.7, 8.1, 9.3)
    for row, value in enumerate(values):
        one(Results(slots, single, status), row, 1, value)
    every(Results(slots, together, status), 1, values)
    expected = [[math.nan, 6.3, math.nan], [math.nan, 1.7, math.nan]]
    np.testing.assert_array_equal(single, expected)
    np.testing.assert_array_equal(together, expected)


def test_what_is_needed_follows_from_what_is_asked() -> None:
    for chosen in product([False, True], repeat=len(RESULTS)):
        names = {name for name, wanted in zip(RESULTS, chosen, strict=True) if wanted}
        slots = slots_of(*sorted(names))
        assert wants_force(slots) == bool(names & {"pull_off_force", "pull_off_radius"})
        losses = names & {"dissipated_energy", "loading_energy", "unloading_energy"}
        assert wants_losses(slots) == bool(losses)
        jumps = losses | names & {"loading_jumps", "unloading_jumps", "delta_jump_out"}
        assert wants_cycle(slots) == bool(jumps)
        assert wants_folds(slots) == bool(jumps or "delta_max" in names)
    reach = slots_of(REACH)
    assert (reach[results.CONTACT], reach[results.TURNED], reach[results.OUTERMOST]) == (0, 0, 0)
    assert wants_cycle(reach)
    assert not wants_losses(reach)
    assert not wants_force(reach)
