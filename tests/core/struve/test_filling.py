"""What an interpolated table lacks is filled when it is read, and nothing else."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core.struve.arches import inner_edge, summit
from gradhesion.core.struve.interpolated import interpolated_tables
from gradhesion.core.struve.layout import ARCHES, ARCHES_AT_ONCE, OF_ARCHES, OF_BINS, OF_MOMENTS
from gradhesion.core.struve.moments import moments
from gradhesion.core.struve.pair import pair
from gradhesion.core.struve.table import build_table

EXPONENT = 0.613
TWO_PI = 2.0 * np.pi


@pytest.fixture
def table() -> Any:
    """Give a table of which nothing has been read."""
    return interpolated_tables(np.array([EXPONENT]))


@pytest.fixture(scope="module")
def whole() -> NDArray[Any]:
    """Give the same one with all that it can have."""
    return interpolated_tables(np.array([EXPONENT]), whole=True)


def filled(table: NDArray[Any], lacks: str) -> list[int]:
    """Return what blocks of a field are in a table."""
    return np.flatnonzero(table[0][lacks] == 0).tolist()


def test_a_bin_is_filled_when_the_pair_is_read(table: NDArray[Any], whole: NDArray[Any]) -> None:
    for i in (0, 37, 79):
        assert pair(table[0], (i + 0.3) / 2.0 / TWO_PI) == pair(whole[0], (i + 0.3) / 2.0 / TWO_PI)
    assert filled(table, OF_BINS.lacks) == [0, 37, 79]
    np.testing.assert_array_equal(table["bins"][0, [0, 37, 79]], whole["bins"][0, [0, 37, 79]])
    pair(table[0], 100.0)  # beyond all bins
    assert filled(table, OF_BINS.lacks) == [0, 37, 79]
    assert filled(table, OF_MOMENTS.lacks) == filled(table, OF_ARCHES.lacks) == []


def test_moments_are_filled_when_they_are_read(table: NDArray[Any], whole: NDArray[Any]) -> None:
    for i in (0, 75):
        x = (i + 4.6) / 2.0 / TWO_PI
        assert moments(table[0], x, 1.0) == moments(whole[0], x, 1.0)
    assert filled(table, OF_MOMENTS.lacks) == [0, 75]
    assert filled(table, OF_BINS.lacks) == []


def test_arches_are_filled_when_they_are_read(table: NDArray[Any], whole: NDArray[Any]) -> None:
    for i in (1, ARCHES - 1, ARCHES):  # the last two are in two groups: the last one overlaps that before
        assert inner_edge(table[0], i) == inner_edge(whole[0], i)
        assert summit(table[0], i) == summit(whole[0], i)
    last = ARCHES // ARCHES_AT_ONCE
    assert filled(table, OF_ARCHES.lacks) == [0, last - 1, last]
    found = np.r_[0:ARCHES_AT_ONCE, ARCHES - ARCHES_AT_ONCE : ARCHES + 1]
    np.testing.assert_array_equal(table["arches"][0, found], whole["arches"][0, found])


def test_groups_of_arches_agree_where_they_overlap() -> None:
    first, second = (interpolated_tables(np.array([EXPONENT])) for _ in range(2))
    before, behind = inner_edge(first[0], ARCHES - 1), inner_edge(second[0], ARCHES)
    inner_edge(first[0], ARCHES)
    assert inner_edge(first[0], ARCHES - 1) == before
    assert inner_edge(first[0], ARCHES) == behind


def test_what_a_table_has_of_its_own_stays() -> None:
    own = np.array([build_table(EXPONENT)])
    before = own.tobytes()
    for x in (0.1, 1.0, 5.0, 100.0):
        pair(own[0], x)
        moments(own[0], x, 1.0)
    for i in range(ARCHES + 1):
        inner_edge(own[0], i)
    assert own.tobytes() == before
