"""The dataset of configs/smoke.toml against what is known independently: smooth contact in closed form.

SMOKE_DATASET names a dataset that was written before; without it the study is run here.
"""

import os
from collections.abc import Callable
from math import cos, gamma, pi, sin, sqrt
from pathlib import Path

import numpy as np
import pytest
import xarray
from click.testing import CliRunner


@pytest.fixture(scope="module")
def dataset(tmp_path_factory: pytest.TempPathFactory) -> xarray.Dataset:
    from gradhesion.cli.main import cli

    path = os.environ.get("SMOKE_DATASET")
    if path is None:
        path = str(tmp_path_factory.mktemp("smoke") / "smoke.nc")
        config = Path(__file__).parents[2] / "configs" / "smoke.toml"
        invoke: Callable[..., object] = CliRunner().invoke
        invoke(cli, ["run", str(config), "-o", path], catch_exceptions=False)
    return xarray.load_dataset(path)


def smooth_energy(k: float, nu: float, modulus: float, c0: float) -> float:
    """Give the energy of the smooth cycle, H/(R^2 dgamma), with R = dgamma = 1."""
    beta = sqrt((1 + k) * (1 - k * nu / (1 - nu)))
    c = 2 ** (1 + k) * gamma((3 + k + beta) / 2) * gamma((3 + k - beta) / 2) / (pi * gamma(2 + k))
    theta = 2 ** (1 + k) * (1 + k) * cos(k * pi / 2) * gamma(1 + k / 2) / gamma((1 + k) / 2) / sqrt(pi)
    theta /= c * beta * sin(beta * pi / 2)
    s = sqrt(2 ** (1 + k) * pi / (theta * modulus / c0**k))

    def part(q: float) -> float:
        return 16 * q**2 / ((1 + k) * (3 + k) * (5 + k)) - 8 * q / ((1 + k) * (3 + k)) + 2 / (1 + k) - 1

    q = (1 - k) / 4
    first, second = (((1 + k) * s) ** (2 / (3 + k)), (q * (1 + k) * s) ** (2 / (3 + k)))
    assert first < 0.5, "the smallest punch of the study reaches beyond the jump-in"
    return pi * (part(q) * second**2 - part(1.0) * first**2)


def test_it_is_complete(dataset: xarray.Dataset) -> None:
    assert dict(dataset.sizes) == {"k": 4, "c0_over_R": 2, "lambda_over_R": 12, "A": 3, "a_max_over_R": 3}
    assert int((dataset["status"] & 64).sum()) == 0
    for name in ("pull_off_force", "pull_off_radius", "dissipated_energy", "delta_jump_out"):
        assert np.isfinite(dataset[name]).all()


def test_smooth_pull_off_is_that_of_the_theory(dataset: xarray.Dataset) -> None:
    smooth = dataset["pull_off_force"].sel(A=0.0)
    np.testing.assert_allclose(smooth, ((3 + dataset["k"]) / 3).broadcast_like(smooth), rtol=1e-13)


def test_smooth_energy_is_that_of_the_theory(dataset: xarray.Dataset) -> None:
    smooth = dataset["dissipated_energy"].sel(A=0.0)
    for k in dataset["k"].values:
        for c0 in dataset["c0_over_R"].values:
            expected = smooth_energy(k, dataset["nu"].item(), dataset["modulus"].item(), c0)
            np.testing.assert_allclose(smooth.sel(k=k, c0_over_R=c0), expected, rtol=1e-11)


def test_the_homogeneous_case_is_jkr(dataset: xarray.Dataset) -> None:
    jkr = dataset.sel(k=0.0, A=0.0)
    np.testing.assert_allclose(jkr["pull_off_force"], 1.0, rtol=1e-13)
    np.testing.assert_allclose(jkr["dissipated_energy"] * 500.0 ** (2 / 3), 7.0922, atol=1e-4)
    assert (jkr["loading_jumps"] == 1).all()
    assert (jkr["unloading_jumps"] == 1).all()


def test_without_gradient_its_depth_is_nothing(dataset: xarray.Dataset) -> None:
    homogeneous = dataset.sel(k=0.0)
    for name in ("pull_off_force", "dissipated_energy", "delta_max"):
        first, second = homogeneous[name].transpose("c0_over_R", ...)
        np.testing.assert_array_equal(first, second)


def test_a_larger_punch_never_holds_less(dataset: xarray.Dataset) -> None:
    force = dataset["pull_off_force"].transpose(..., "a_max_over_R").values
    assert (np.diff(force) >= -1e-13 * force[..., 1:]).all()
    assert (dataset["dissipated_energy"] > 0).all()
