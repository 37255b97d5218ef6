"""Profiles and controls: what is refused, and with what words."""

import dataclasses
import math
from typing import Any

import pytest

from gradhesion.core import Harmonic, Loading, Profile, solve

SCENE = {"k": 0.31, "nu": 0.27, "modulus": 430.0, "c0_over_R": 0.013, "lambda_over_R": 0.11, "A": 0.023}
SCENE["a_max_over_R"] = 0.7


@pytest.mark.parametrize(
    ("changes", "word"),
    [
        ({"exponent": 0.99}, "exponent"),
        ({"exponent": math.inf}, "exponent"),
        ({"exponent": math.nan}, "exponent"),
        ({"harmonics": ()}, "harmonics"),
        ({"harmonics": tuple(Harmonic(n=n) for n in range(1, 66))}, "65"),
        ({"harmonics": (Harmonic(n=1), Harmonic(n=3), Harmonic(n=1))}, r"\[1\]"),
    ],
)
def test_profiles_out_of_range(changes: dict[str, Any], word: str) -> None:
    with pytest.raises(ValueError, match=word):
        Profile(**changes)


@pytest.mark.parametrize("values", [{"n": 0}, {"n": 1.5}, {"n": 2, "cos": math.nan}, {"n": 2, "sin": math.inf}])
def test_harmonics_out_of_range(values: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match=f"n = {values['n']}"):
        Harmonic(**values)


def test_controls() -> None:
    with pytest.raises(ValueError, match="displacement, load, machine"):
        Loading(control="force")


def test_what_another_profile_does_not_have() -> None:
    cone = Profile(exponent=1.0)
    for solver, reason in (("asymptotic", "belong to one energy only up to"), ("envelope", "at a constant depth")):
        solve(SCENE, solver=solver, profile=cone)
        for loading in (Loading(control="load"), Loading(control="machine")):
            spring = {"machine_stiffness": 1.0} if loading.control == "machine" else {}
            with pytest.raises(ValueError, match=f"{solver}.*displacement control only.*{reason}"):
                solve(SCENE | spring, solver=solver, profile=cone, loading=loading)
    with pytest.raises(ValueError, match="energy_residual"):
        solve(SCENE, ["energy_residual"], loading=Loading(control="load"))
    with pytest.raises(ValueError, match="machine_stiffness"):
        solve(SCENE, loading=Loading(control="machine"))
    with pytest.raises(ValueError, match="machine_stiffness"):
        solve(SCENE | {"machine_stiffness": 1.0})


def test_the_default_profile_and_control_change_nothing() -> None:
    plain = solve(SCENE)
    other = solve(SCENE, profile=Profile(), loading=Loading())
    assert all(plain[name].tobytes() == other[name].tobytes() for name in plain)


@pytest.mark.parametrize(
    ("given", "cos", "sin"),
    [({}, 1.0, 0.0), ({"sin": 0.2}, 0.0, 0.2), ({"cos": 0.3}, 0.3, 0.0), ({"cos": 0.0}, 0.0, 0.0), ({"cos": 0.3, "sin": 0.2}, 0.3, 0.2)],
)  # fmt: skip
def test_what_a_harmonic_leaves_out(given: dict[str, float], cos: float, sin: float) -> None:
    harmonic = Harmonic(n=3, **given)
    assert (harmonic.cos, harmonic.sin) == (cos, sin)
    assert dataclasses.replace(harmonic, n=3) == harmonic
    with pytest.raises(dataclasses.FrozenInstanceError):
        harmonic.cos = 2.0  # type: ignore[misc]


def test_a_whole_number_is_a_power_like_any_other() -> None:
    """Kernels are compiled for floats: one of an integer would be compiled anew."""
    assert isinstance(Profile(exponent=3).exponent, float)
    assert Profile(exponent=3) == Profile(exponent=3.0)
