"""What is declared of inputs, outputs, shapes, patterns and laws fits together, costs no compiler, and is refused out of range."""

import dataclasses
import math
import subprocess
import sys
from typing import Any

import numpy as np
import pint
import pytest

import gradhesion.core
from gradhesion.core import Harmonic, Loading, Profile
from gradhesion.core.closed.reduced import WAYS
from gradhesion.core.problem.inputs import INPUTS, PHYSICAL, Input
from gradhesion.core.problem.outputs import CURVES, OUTPUTS, OVER, VARIABLES, without_scale
from gradhesion.core.problem.toughness import (
    Rate,
    Toughness,
    ToughnessHarmonic,
    first_violation,
    lowest,
    rows_of_pattern,
    violation,
)
from tests.core.scene import pattern_of, scene_of

LIGHT = "CONTROLS, CURVES, DOUBTFUL, FAILED, FLAGS, OUTPUTS, PARAMETERS, REPORTS, SOLVERS, Harmonic, Loading, Profile"


def test_light_names_import_no_compiler() -> None:
    show = f"from gradhesion.core import {LIGHT}, doubts_about\nimport gradhesion.core, sys; dir(gradhesion.core)\n"
    show += "print({'numba', 'llvmlite', 'scipy', 'platformdirs'} & sys.modules.keys())"
    done = subprocess.run([sys.executable, "-c", show], capture_output=True, text=True, check=True)
    assert done.stdout == "set()\n"


def test_every_name_is_there_and_no_other() -> None:
    for name in gradhesion.core.__all__:
        assert getattr(gradhesion.core, name) is not None
        assert name in dir(gradhesion.core)
    with pytest.raises(AttributeError, match="has no attribute 'solv'"):
        gradhesion.core.solv  # noqa: B018


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


SCENE = scene_of(0.31, 0.27, 430.0, 0.013, 0.11, 0.023, 0.7)
THRICE = (Harmonic(n=1), Harmonic(n=3), Harmonic(n=1))
REFUSED: list[tuple[Any, dict[str, Any], str]] = [
    *((Profile, {"exponent": value}, "exponent") for value in (0.99, math.inf, math.nan)),
    (Profile, {"harmonics": ()}, "harmonics"),
    (Profile, {"harmonics": tuple(Harmonic(n=n) for n in range(1, 66))}, "65"),
    (Profile, {"harmonics": THRICE}, r"\[1\]"),
    *((Harmonic, {"n": n}, f"n = {n}") for n in (0, 1.5)),
    *((Harmonic, {"n": 2} | bad, "n = 2") for bad in ({"cos": math.nan}, {"sin": math.inf})),
    (Loading, {"control": "force"}, "displacement, load, machine"),
    *((ToughnessHarmonic, {"n": n}, "whole number") for n in (0, 1.5, 10_001)),
    (ToughnessHarmonic, {"n": 1, "cos": math.inf}, "must be finite"),
    (Toughness, {"harmonics": ()}, "1 to 64"),
    (Toughness, {"harmonics": (ToughnessHarmonic(n=2, sin=0.1),) * 2}, "more than once"),
    (Toughness, {"harmonics": (ToughnessHarmonic(n=2, sin=0.1),), "of": "energy"}, "toughness, work"),
    *((Rate, {"exponent": value}, "exponent = ") for value in (0.0, 0.0999, 2.0001, math.nan, math.inf)),
    (Rate, {"exponent": 0.6, "closing": "slow"}, "closing = "),
]


@pytest.mark.parametrize(("kind", "values", "told"), REFUSED)
def test_what_is_out_of_range(kind: Any, values: dict[str, Any], told: str) -> None:
    with pytest.raises(ValueError, match=told):
        kind(**values)


def test_what_a_harmonic_leaves_out_and_a_power_that_is_whole() -> None:
    """Kernels are compiled for floats: one of an integer would be compiled anew."""
    given: list[dict[str, float]] = [{}, {"sin": 0.2}, {"cos": 0.0}, {"cos": 0.3, "sin": 0.2}]
    made = [Harmonic(n=3, **one) for one in given]
    assert [(one.cos, one.sin) for one in made] == [(1.0, 0.0), (0.0, 0.2), (0.0, 0.0), (0.3, 0.2)]
    assert [dataclasses.replace(one, n=3) for one in made] == made
    assert isinstance(Profile(exponent=3).exponent, float)
    assert Profile(exponent=3) == Profile(exponent=3.0)


def drawn(seed: int, count: int = 3, most: int = 9) -> Toughness:
    rng = np.random.default_rng(seed)
    numbers = rng.choice(np.arange(1, most), count, replace=False).tolist()
    return pattern_of("toughness", *((n, rng.normal(), rng.normal()) for n in numbers))


def values(toughness: Toughness, end: float) -> tuple[Any, Any]:
    u = np.linspace(0.0, end, 200_001)
    phases = [2.0 * math.pi * harmonic.n * u for harmonic in toughness.harmonics]
    return u, sum(h.cos * np.cos(x) + h.sin * np.sin(x) for h, x in zip(toughness.harmonics, phases, strict=True))


@pytest.mark.parametrize("seed", range(12))
def test_the_lowest_value_and_the_first_radius_with_a_wrong_sign_are_those_of_a_dense_grid(seed: int) -> None:
    pattern, wavelength = drawn(seed), 0.37
    assert rows_of_pattern(Toughness((*pattern.harmonics, ToughnessHarmonic(n=64)))).shape == (3, 3)
    for end in (1.0, 0.3, 0.05):
        u, dense = values(pattern, end)
        assert -1e-6 < lowest(rows_of_pattern(pattern), end)[0] - dense.min() < 1e-14
        for amplitude in (0.2, 0.7):
            below = 1.0 + amplitude * dense < 0.0
            found = violation(pattern, amplitude, wavelength, end * wavelength)
            assert (found is not None) == below.any()
            if found is not None:
                assert found == pytest.approx(u[np.argmax(below)] * wavelength, abs=2.0 * wavelength * u[1])


def test_a_toughness_may_vanish_at_a_radius_and_a_work_may_not() -> None:
    for even, odd, place in ((-1.0, 0.0, 0.0), (0.0, -1.0, 1.0 / 12.0)):
        tough, work = (pattern_of(of, (3, even, odd)) for of in ("toughness", "work"))
        assert first_violation(tough, 1.0) == math.inf
        assert first_violation(work, 1.0) == pytest.approx(place, abs=1e-7)
        assert first_violation(tough, 1.0 + 1e-9) == pytest.approx(place, abs=1e-4)
        assert first_violation(work, 1.0 - 1e-9) == math.inf
    assert violation(work, 1.0, 2.0, 0.16) is None, "it vanishes beyond the rim"


def test_many_harmonics_of_high_number() -> None:
    pattern = drawn(3, 64, 10_001)
    low, _ = lowest(rows_of_pattern(pattern))
    assert violation(pattern, 0.999 / -low, 0.1, math.inf) is None
    assert violation(pattern, 1.001 / -low, 0.1, math.inf) is not None
