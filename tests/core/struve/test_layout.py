"""The blocks of a table."""

import itertools

import numpy as np

from gradhesion.core.struve.layout import ALL, TABLE, TERMS


def test_coefficients_stand_behind_each_other() -> None:
    assert ALL[0].first == 0
    for before, blocks in itertools.pairwise(ALL):
        assert blocks.first == before.end == before.first + before.terms * before.size * before.number
        assert blocks.terms <= TERMS


def test_every_number_is_in_a_block() -> None:
    """All of a record but its constants and powers of 2^e, once each, and no block reaches into another field."""
    starts = {name: TABLE.fields[name][1] // 8 for name in TABLE.names or ()}  # type: ignore[index]
    numbers = np.zeros(TABLE.itemsize // 8, dtype=int)
    for blocks in ALL:
        numbers[starts[blocks.field] : starts[blocks.field] + blocks.total] += 1
        assert blocks.number == -(-blocks.total // blocks.size)
        assert blocks.size % 4 == 0
    assert (numbers[: starts["theta_front"]] == 0).all()
    power = slice(starts["power_exponent"], starts["bins"])
    assert (numbers[power] == 0).all()
    assert (np.delete(numbers[starts["theta_front"] :], np.r_[power] - starts["theta_front"]) == 1).all()
