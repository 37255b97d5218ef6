"""Kernels count references to arrays only where they own some: what they are given is neither lost nor kept."""

import sys
from collections.abc import Iterator
from typing import Any, NamedTuple

import numba
import numpy as np
import pytest
from numba.core.runtime import _nrt_python, rtsys

from gradhesion.core import Harmonic, Loading, Profile, solve
from gradhesion.core.compiler import cache, jit


@pytest.fixture
def _watched() -> Iterator[None]:
    """What numba allocates and frees is counted."""
    rtsys.initialize(numba.core.registry.cpu_target.target_context)
    _nrt_python.memsys_enable_stats()
    yield
    _nrt_python.memsys_disable_stats()


def counts_references(kernel: Any) -> bool:
    """Whether the code that numba has made of a kernel counts references."""
    return any("NRT_incref" in code or "NRT_decref" in code for code in kernel.inspect_llvm().values())


class Pair(NamedTuple):
    """A table, and one of its rows."""

    table: Any
    row: int


with pytest.MonkeyPatch.context() as patch:
    patch.setattr(cache, "place", lambda: cache.Place(None))  # code that is read from a cache cannot be looked at

    @jit.kernel()
    def last_of_row(table: Any, row: int) -> float:
        part = table[row]
        return part[part.size - 1]

    @jit.kernel()
    def last_in_pair(pair: Any) -> float:
        table, row = pair
        other = (table, row)
        return last_of_row(other[0], row)

    @jit.kernel()
    def last_in_record(table: Any, row: int) -> float:
        pair = Pair(table, row)
        return last_in_pair(pair) + pair.table[0, 0]

    @jit.kernel()
    def half_of(values: Any) -> Any:
        return values[: values.size // 2]

    @jit.kernel()
    def doubled(values: Any) -> Any:
        return 2.0 * values

    @jit.kernel()
    def last_of_doubled(values: Any) -> float:
        own = doubled(values)
        return own[own.size - 1]

    @jit.kernel()
    def sum_at(values: Any, places: Any) -> float:
        taken = values[places]
        total = 0.0
        for i in range(taken.size):
            total += taken[i]
        return total

    @jit.kernel()
    def shift(values: Any) -> float:
        values[1:] = values[:-1]
        return values[0]


def test_what_only_reads_arrays_counts_nothing() -> None:
    table = np.arange(6.0).reshape(2, 3)
    held = sys.getrefcount(table)
    assert [last_of_row(table, 1), last_in_pair((table, 0)), last_in_record(table, 1)] == [5.0, 2.0, 5.0]
    assert sys.getrefcount(table) == held
    assert not counts_references(last_of_row)
    assert not counts_references(last_in_record)


def test_an_array_that_is_returned_or_made_is_counted() -> None:
    values = np.arange(6.0)
    half = half_of(values)
    twice = doubled(half)
    del values
    assert half.tolist() == [0.0, 1.0, 2.0]
    assert twice.tolist() == [0.0, 2.0, 4.0]
    assert counts_references(half_of)
    assert counts_references(doubled)


@pytest.mark.usefixtures("_watched")
def test_what_gets_an_array_of_its_own_frees_it() -> None:
    values, places = np.arange(6.0), np.array([1, 1, 4])
    last_of_doubled(values), sum_at(values, places)
    before = rtsys.get_allocation_stats()
    for _ in range(10):
        assert last_of_doubled(values) == 10.0
        assert sum_at(values, places) == 6.0
    after = rtsys.get_allocation_stats()
    assert after.alloc - before.alloc >= 20
    assert after.alloc - before.alloc == after.free - before.free


def test_a_part_may_be_moved_within_its_array() -> None:
    values = np.arange(4.0)
    shift(values)
    assert values.tolist() == [0.0, 0.0, 1.0, 2.0]


@pytest.mark.usefixtures("_watched")
@pytest.mark.parametrize(
    ("profile", "loading", "wavelength"),
    [
        (Profile(), Loading(), 0.3),
        (Profile(), Loading(), 1e-3),
        (Profile(), Loading(control="load"), 0.3),
        (Profile(harmonics=(Harmonic(n=1), Harmonic(n=3, cos=0.2))), Loading(), 0.3),
    ],
)
def test_solving_keeps_nothing_and_loses_nothing(profile: Profile, loading: Loading, wavelength: float) -> None:
    rims = np.linspace(0.1, 1.0, 7)
    base = {"k": 0.3, "nu": 0.3, "modulus": 500, "c0_over_R": 0.05, "A": 0.02}
    scenes = {**base, "lambda_over_R": wavelength, "a_max_over_R": rims}

    def energies() -> Any:
        return solve(scenes, ["dissipated_energy"], profile=profile, loading=loading, threads=1)["dissipated_energy"]

    first = energies()
    before = rtsys.get_allocation_stats()
    for _ in range(3):
        np.testing.assert_array_equal(energies(), first)
    after = rtsys.get_allocation_stats()
    assert after.alloc - before.alloc == after.free - before.free
    assert after.mi_alloc - before.mi_alloc == after.mi_free - before.mi_free
