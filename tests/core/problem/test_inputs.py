"""What is declared of inputs and outputs fits together: names, bounds, units, and formulas by their dimensions."""

import math

import numpy as np
import pint
import pytest

from gradhesion.core.closed.reduced import WAYS
from gradhesion.core.problem.inputs import INPUTS, PHYSICAL, Input
from gradhesion.core.problem.outputs import CURVES, OUTPUTS, OVER, VARIABLES, without_scale

UNITS = pint.UnitRegistry()


def test_what_an_input_names_is_declared() -> None:
    for name, one in INPUTS.items():
        assert INPUTS[one.gives].is_parameter, name
        assert {*one.needs} <= {*INPUTS}, name
        assert one.idle_without in ("", *INPUTS), name
        assert (one.unit != "1") == (one.table == "physical"), name
        assert one.group == INPUTS[one.gives].group or one.gives == "modulus", name
        assert one.follows is None or one.needs, name
    assert {way for ways in WAYS.values() for way in ways} == {name for name, one in INPUTS.items() if one.needs}


@pytest.mark.parametrize("name", INPUTS)
def test_the_bounds_are_exact(name: str) -> None:
    own = INPUTS[name]
    for sign, limit in own.bounds.items():
        outwards = math.inf if sign == "le" else -math.inf
        assert own.admits(limit) == (sign != "gt")
        assert not own.admits(math.nextafter(limit, outwards))
        assert own.admits(math.nextafter(limit, -outwards))
        assert f"{limit:g}" in own.allowed
    assert own.admits(math.inf) == own.infinite
    assert not own.admits(math.nan)
    assert own.admits(np.array([0.25, math.nan, 0.5])).tolist() == [True, False, True]


@pytest.mark.parametrize("name", [name for name, one in PHYSICAL.items() if one.follows])
def test_a_formula_has_the_dimension_of_what_follows(name: str) -> None:
    own = INPUTS[name]

    def quantity(one: Input, value: float) -> pint.Quantity:
        return UNITS.Quantity(value, "" if one.unit == "1" else one.unit)

    assert own.follows is not None
    others = [quantity(INPUTS[need], 0.3 + 0.1 * i) for i, need in enumerate(own.needs)]
    found = own.follows(quantity(own, 0.7), *others)
    assert UNITS.Quantity(found).is_compatible_with(quantity(INPUTS[own.instead_of or own.gives], 1.0))


def test_the_words_of_a_value_say_what_it_is_over() -> None:
    for name, one in (OUTPUTS | VARIABLES).items():
        for unit, over in OVER.items():
            assert any(words in one.about for words in over) == (one.unit == unit), (name, unit)
    for one in OUTPUTS.values():
        assert one.unit == "" or without_scale(one.about, one.unit) != one.about


def test_names_are_given_once() -> None:
    names = [*INPUTS, *OUTPUTS, *VARIABLES, *(curve.extent for curve in CURVES.values())]
    assert sorted({*names}) == sorted(names)
