"""Every equation: NaN for each argument out of range, the broadcast shape, a place in `help`; names of merged modules."""

import importlib
import inspect
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import gradhesion.core.equations
from gradhesion.core.equations import effective, envelopes, general, hertz, jkr, quadrature, short_waves

FUNCTIONS: dict[str, Callable[..., Any]] = {
    f"{module.__name__.rpartition('.')[2]}.{name}": function
    for module in (hertz, jkr, general, quadrature, envelopes, effective, short_waves)
    for name, function in vars(module).items()
    if inspect.isfunction(function) and function.__module__ == module.__name__ and name[0] != "_"
}
GOOD: dict[str, Any] = {
    "k": 0.3, "stiffness": 90.0, "radius": 0.2, "largest_radius": 0.9, "distance": 0.25, "depth": 0.01, "x": 0.7,
    "wavelength": 0.1, "amplitude": 0.01, "cosines": [-0.01], "sines": [0.02], "waves": [(1, -0.01, 0.0)],
    "exponent": 2.0, "mean_height": 0.0, "adhesion": 0.2, "waviness": 0.1, "pull": 0.1, "ratio": 0.5, "alpha": 0.01,
    "slope": np.sinh, "shortest": 1.0, "xi": 0.4, "radius_of_punch": 1.0, "work_of_adhesion": 1.0,
}  # fmt: skip
BAD = {
    "k": [-0.1, 1.1], "stiffness": [0.0, -1.0], "radius": [-0.2], "largest_radius": [-0.9, 1e-3], "x": [-0.1, np.inf],
    "wavelength": [0.0, -0.1], "amplitude": [-0.01], "exponent": [0.99], "waviness": [-0.1], "ratio": [-0.1],
    "depth": [], "alpha": [], "pull": [], "distance": [],
}  # fmt: skip
OF_ARRAYS = {name: one for name, one in FUNCTIONS.items() if not {*inspect.signature(one).parameters} & {"terms"}}
CASES = [(name, bad) for name, one in OF_ARRAYS.items() for bad in inspect.signature(one).parameters if bad in BAD]


def call(name: str, **changed: Any) -> Any:
    """Return what a function gives for good arguments but for some, the last of several arrays."""
    good = GOOD | ({"distance": 0.15} if "pressure" in name else {})
    found = FUNCTIONS[name](**{one: good[one] for one in inspect.signature(FUNCTIONS[name]).parameters} | changed)
    return found[-1] if isinstance(found, tuple) else found


@pytest.mark.parametrize(("name", "bad"), CASES)
def test_nothing_out_of_range(name: str, bad: str) -> None:
    good = np.asarray(call(name), dtype=float)
    assert np.isfinite(good).all()
    if name == "hertz.cosine_wave":
        return
    for value in (*BAD[bad], np.nan):
        found = np.asarray(call(name, **{bad: value}), dtype=float)
        assert found.shape == good.shape
        assert not found.any() if name == "general.is_monotonic" else np.isnan(found).all(), value


def test_where_a_formula_has_no_value_or_a_last_one() -> None:
    for name in ("jkr.energy_release_rate", "jkr.fold_number", "general.stress_intensity", "short_waves.load"):
        assert np.isnan(call(name, radius=0.0)), name
    assert np.isnan(call("quadrature.pressure", distance=0.201))
    assert np.isnan(call("quadrature.series_gap", distance=0.199))
    assert np.isnan(call("effective.jump_in_radius", waviness=0.2))
    for name in ("second_part", "dissipated_energy", "fitted_energy"):
        assert np.isnan(call(f"effective.{name}", amplitude=5.0)), name
    assert (
        call("quadrature.gap", distance=0.2)
        == call("quadrature.hertz_load", radius=0.0)
        == call("hertz.load", radius=0.0)
        == 0.0
    )
    assert call("hertz.indentation") == call("jkr.indentation", stiffness=np.inf)
    assert call("effective.jump_out_radius", k=1.0) == 0.0
    s, r = envelopes.adhesion_strength(0.3, 500.0), envelopes.waviness_strength(0.3, 0.1, 0.02)
    assert effective.second_part(0.3, 500.0, 0.1, 0.02, effective.jump_in_radius(0.3, s, r)) == 0.0
    assert call("short_waves.share", ratio=[1.0, 1.5, np.inf]).tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize("name", [name for name in OF_ARRAYS if "k" in inspect.signature(FUNCTIONS[name]).parameters])
def test_the_shape_is_the_broadcast_one(name: str) -> None:
    several = [one for one in ("radius", "stiffness", "wavelength", "xi", "pull", "waviness", "ratio", "x")
               if one in inspect.signature(FUNCTIONS[name]).parameters][:1]  # fmt: skip
    found = np.asarray(call(name, k=np.array([[0.3], [0.4]]), **{one: np.full(3, GOOD[one]) for one in several}))
    assert found.shape[-2:] == (2, 3 if several else 1)
    one = np.asarray(call(name, k=0.4))
    np.testing.assert_allclose(found[..., 1, -1], one, rtol=1e-15)  # to the last place of a power


@pytest.mark.parametrize(
    ("old", "function", "new"),
    [
        ("any_profile", "load", quadrature), ("gap", "series_gap", quadrature), ("pressure", "pressure", quadrature),
        ("early_unloading", "drop", effective), ("energy", "first_part", effective), ("profile", "height", general),
        ("fourier", "coefficients", general), ("stress_intensity", "stress_intensity", general),
        ("pair", "sine_integrals", hertz), ("saturation", "share", short_waves),
    ],
)  # fmt: skip
def test_names_of_merged_modules_work(old: str, function: str, new: Any) -> None:
    for module in (
        importlib.import_module(f"gradhesion.core.equations.{old}"),
        getattr(gradhesion.core.equations, old),
    ):
        assert getattr(module, function) is getattr(new, function)
