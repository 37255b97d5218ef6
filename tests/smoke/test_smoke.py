"""The dataset of configs/smoke.toml against what is known independently: smooth contact in closed form.

SMOKE_DATASET names a dataset that was written before; without it the study is run here.
"""

import os
from math import pi
from pathlib import Path

import numpy as np
import pytest
import xarray

import gradhesion as gr
from tests.conformance.theory import jump_density, stiffness, stretch


@pytest.fixture(scope="module")
def dataset() -> xarray.Dataset:
    path = os.environ.get("SMOKE_DATASET")
    return xarray.load_dataset(path) if path else gr.run(Path(__file__).parents[2] / "configs" / "smoke.toml")


def smooth_energy(k: float, nu: float, modulus: float, c0: float) -> float:
    """Give the energy of the smooth cycle, H/(R^2 dgamma), with R = dgamma = 1."""
    s = float(stretch(k, stiffness(k, nu, modulus, c0)))
    out, into = (jump_density(k, q) * (q * (1 + k) * s) ** (4 / (3 + k)) for q in ((1 - k) / 4, 1.0))
    return float(pi * (out - into))


def test_it_is_complete(dataset: xarray.Dataset) -> None:
    assert dict(dataset.sizes) == {"k": 4, "c0_over_R": 2, "lambda_over_R": 12, "A": 3, "a_max_over_R": 3}
    assert int((dataset["status"] & 64).sum()) == 0
    for name in ("pull_off_force", "pull_off_radius", "dissipated_energy", "delta_jump_out"):
        assert np.isfinite(dataset[name]).all()


def test_smooth_contact_is_that_of_the_theory(dataset: xarray.Dataset) -> None:
    smooth = dataset.sel(A=0.0)
    force = smooth["pull_off_force"]
    np.testing.assert_allclose(force, ((3 + dataset["k"]) / 3).broadcast_like(force), rtol=1e-13)
    for k in dataset["k"].values:
        for c0 in dataset["c0_over_R"].values:
            energy = smooth_energy(k, dataset["nu"].item(), dataset["modulus"].item(), c0)
            np.testing.assert_allclose(smooth["dissipated_energy"].sel(k=k, c0_over_R=c0), energy, rtol=1e-11)
    jkr = smooth.sel(k=0.0)
    np.testing.assert_allclose(jkr["dissipated_energy"] * 500.0 ** (2 / 3), 7.0922, atol=1e-4)
    assert (jkr["loading_jumps"] == 1).all()
    assert (jkr["unloading_jumps"] == 1).all()
