"""The solver keeps the errors that are stated of it on draws of the stress suite; other kinds are in tests/conformance."""

import pytest

from tests.stress.draw import eventful, hostile

from .compare import Case, compare, of_any_kind, of_one_cosine

DRAWS = {
    "hostile": (of_one_cosine(hostile(5, 120)), 30),
    "eventful": (of_one_cosine(eventful(5, 120)), 30),
    "of any kind": (of_any_kind(7, 10), 4),
}


@pytest.mark.parametrize(("cases", "fewest"), DRAWS.values(), ids=DRAWS)
def test_stated_errors_are_kept(cases: list[Case], fewest: int) -> None:
    made = compare(cases, (0.0, 20.0))
    assert made.scenes >= fewest
    assert made.unsure == 0
    assert made.near <= 4
    assert made.worst <= 1.0
