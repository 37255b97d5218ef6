"""Random roughness in a study: a last dimension of realisations, each of them what its harmonics give."""

from typing import Any

import numpy as np
import pytest

import gradhesion as gr
from gradhesion.cli.dataset import compute
from gradhesion.cli.study import study_from
from gradhesion.core.answers.spectrum import random_profile

SPECTRUM = {"hurst": 0.8, "first": 1, "last": 9, "realisations": 4, "seed": 3}


@pytest.fixture
def study() -> dict[str, Any]:
    """A small study of random roughness."""
    parameters = {"k": [0.0, 0.31], "nu": 0.27, "modulus": 430.0, "c0_over_R": 0.013, "lambda_over_R": 0.31}
    parameters |= {"A": [0.002, 0.007], "a_max_over_R": [0.4, 0.7]}
    outputs = ["pull_off_force", "dissipated_energy", "loading_jumps", "wave_slope"]
    return {"outputs": outputs, "parameters": parameters, "profile": {"exponent": 2.0, "spectrum": SPECTRUM}}


def test_each_realisation_is_its_series_to_the_last_bit(study: dict[str, Any]) -> None:
    read = study_from(study)
    assert read.spectrum is not None
    found = compute(read)
    assert list(found["status"].dims) == ["k", "A", "a_max_over_R", "realisation"]
    assert found["realisation"].values.tolist() == [0, 1, 2, 3]
    assert "rms height over wavelength" in found["A"].attrs["long_name"]
    assert "Hurst exponent 0.8" in found.attrs["profile"]
    for number in (0, 3):
        waves = random_profile(read.spectrum, number).harmonics
        series = {"harmonics": [{"n": wave.n, "cos": wave.cos, "sin": wave.sin} for wave in waves]}
        one = compute(study_from(study | {"profile": series}))
        for name in (*study["outputs"], "status"):
            np.testing.assert_array_equal(found[name].isel(realisation=number), one[name])


def test_the_same_seed_gives_the_same_dataset_and_more_realisations_add_to_it(study: dict[str, Any]) -> None:
    one, again = compute(study_from(study)), compute(study_from(study), threads=1)
    more = compute(study_from(study | {"profile": {"spectrum": SPECTRUM | {"realisations": 6}}}))
    for name in study["outputs"]:
        np.testing.assert_array_equal(one[name], again[name])
        np.testing.assert_array_equal(one[name], more[name].isel(realisation=slice(4)))
    other = compute(study_from(study | {"profile": {"spectrum": SPECTRUM | {"seed": 4}}}))
    assert not np.any(other["pull_off_force"].values == one["pull_off_force"].values)


def test_with_points_several_solvers_and_units(study: dict[str, Any]) -> None:
    points, grid = (compute(study_from(study | {"layout": layout})) for layout in ("points", "grid"))
    assert dict(points.sizes) == {"scene": 2, "realisation": 4}
    for i in (0, 1):
        scene = grid["pull_off_force"].isel(k=i, A=i, a_max_over_R=i)
        np.testing.assert_array_equal(points["pull_off_force"].isel(scene=i), scene)
    solvers = compute(study_from(study | {"method": {"solver": ["exact", "asymptotic"]}}))
    np.testing.assert_array_equal(solvers["pull_off_force"].sel(solver="exact"), grid["pull_off_force"])
    assert np.isfinite(solvers["pull_off_force"]).all()
    probe = {"k": 0.0, "nu": 0.3, "R": ["1 um", "2 um"], "E_star": 1e9, "work_of_adhesion": 0.05, "wavelength": "0.3 um"}  # fmt: skip
    made = gr.solve(probe, "pull_off_force", amplitude="1 nm", profile={"spectrum": SPECTRUM})
    assert list(made["pull_off_force_si"].dims) == ["R", "realisation"]
    size = 1.5 * np.pi * made["R"] * 0.05
    np.testing.assert_allclose(made["pull_off_force_si"], made["pull_off_force"] * size, rtol=1e-15)
    assert "rms height" in made["amplitude"].attrs["long_name"]
