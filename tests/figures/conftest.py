"""The studies of the figures, computed in memory, and the scripts that draw them."""

from collections.abc import Callable
from functools import cache

import pytest
import xarray

from gradhesion.cli.dataset.writer import compute
from gradhesion.cli.study.reading import load_study
from tests.conftest import ROOT

SMALL = {
    "fig4a": ("k={ start = 0.0, stop = 0.98, num = 50 }", "lambda_over_R={ start = 0.1, stop = 0.8, num = 29 }"),
    "fig4b": ("lambda_over_R={ start = 0.1, stop = 0.8, num = 29 }",),
    "fig4c": ("lambda_over_R={ start = 0.1, stop = 0.8, num = 141 }",),
    "fig9": ("k={ start = 0.0, stop = 1.0, num = 16 }",),
    "extra_energy_exponent": ("k={ start = 0.0, stop = 0.98, num = 15 }",),
    "extra_best_exponent": ("nu=[0.0, 0.3]", "c0_over_R=[0.01, 0.1]"),
    "extra_best_wavelength": ("k=[0.0, 0.3, 0.8]",),
    "extra_error_bars": ("lambda_over_R={ start = 0.05, stop = 0.6, num = 41 }",),
    "extra_front": ("k=[0.0, 0.5]", "A={ start = 0.005, stop = 0.02 }"),
    "extra_rim": ("a_max_over_R={ start = 0.02, stop = 0.8, num = 40 }",),
    "extra_energy_map": ('lambda_over_R={ start = 0.0001, stop = 0.01, num = 5, spacing = "log" }', "A={ start = 0.0, stop = 0.15, num = 4 }"),
    "extra_energy_amplitude": ("A={ start = 0.0, stop = 0.15, num = 7 }",),
    "extra_roughness": ("A=[0.0, 0.006]", "profile.spectrum={ hurst = 0.8, first = 1, last = 16, realisations = 8, seed = 1 }"),
    "extra_energy_wavelength": ('lambda_over_R={ start = 0.0001, stop = 0.01, num = 7, spacing = "log" }',),
}  # fmt: skip
"""Shorter axes for the studies that are maps, and fewer random profiles."""


@cache
def _computed(name: str, overrides: tuple[str, ...]) -> xarray.Dataset:
    own = (*SMALL.get(name, ()), *overrides)
    sets = [each if "." in each.split("=")[0] else f"parameters.{each}" for each in own]
    return compute(load_study(ROOT / "configs" / f"{name}.toml", sets))


@pytest.fixture
def computed() -> Callable[..., xarray.Dataset]:
    return lambda name, *overrides: _computed(name, overrides)
