"""The dataset of configs/smoke.toml against what is known independently: smooth contact in closed form.

SMOKE_DATASET names a dataset that was written before; without it the study is run here.
"""

import os

import numpy as np
import xarray

import gradhesion as gr
from tests.conformance.theory import jump_density, stiffness, stretch
from tests.conftest import ROOT


def test_it_is_complete_and_smooth_contact_is_that_of_the_theory() -> None:
    path = os.environ.get("SMOKE_DATASET")
    dataset = xarray.load_dataset(path) if path else gr.run(ROOT / "configs" / "smoke.toml")
    assert dict(dataset.sizes) == {"k": 4, "c0_over_R": 2, "lambda_over_R": 12, "A": 3, "a_max_over_R": 3}
    assert int((dataset["status"] & 64).sum()) == 0
    for name in ("pull_off_force", "pull_off_radius", "dissipated_energy", "delta_jump_out"):
        assert np.isfinite(dataset[name]).all()
    smooth = dataset.sel(A=0.0)
    force, energy = smooth["pull_off_force"], smooth["dissipated_energy"]
    np.testing.assert_allclose(force, ((3 + dataset["k"]) / 3).broadcast_like(force), rtol=1e-13)
    k, c0 = dataset["k"].values[:, None], dataset["c0_over_R"].values
    s = stretch(k, stiffness(k, dataset["nu"].item(), dataset["modulus"].item(), c0))
    out, into = (jump_density(k, q) * (q * (1 + k) * s) ** (4 / (3 + k)) for q in ((1 - k) / 4, 1.0))
    known = xarray.DataArray(np.pi * (out - into), dims=["k", "c0_over_R"])
    np.testing.assert_allclose(energy, known.broadcast_like(energy), rtol=1e-11)
    jkr = smooth.sel(k=0.0)
    np.testing.assert_allclose(jkr["dissipated_energy"] * 500.0 ** (2 / 3), 7.0922, atol=1e-4)
    assert ((jkr["loading_jumps"] == 1) & (jkr["unloading_jumps"] == 1)).all()
