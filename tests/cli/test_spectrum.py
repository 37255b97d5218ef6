"""Random roughness in a study: a last dimension of realisations, each of them what its harmonics give."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from click.testing import Result

import gradhesion as gr
from gradhesion.cli.dataset import compute
from gradhesion.cli.errors import StudyError
from gradhesion.cli.study import study_from
from gradhesion.core.answers.spectrum import random_profile

pytestmark = pytest.mark.slow

Call = Callable[..., Result]

SPECTRUM = {"hurst": 0.8, "first": 1, "last": 9, "realisations": 4, "seed": 3}


@pytest.fixture
def study() -> dict[str, Any]:
    """A small study of random roughness."""
    parameters = {"k": [0.0, 0.31], "nu": 0.27, "modulus": 430.0, "c0_over_R": 0.013, "lambda_over_R": 0.31}
    parameters |= {"A": [0.002, 0.007], "a_max_over_R": [0.4, 0.7]}
    outputs = ["pull_off_force", "dissipated_energy", "loading_jumps", "wave_slope"]
    return {"outputs": outputs, "parameters": parameters, "profile": {"exponent": 2.0, "spectrum": SPECTRUM}}


def harmonics(number: int) -> list[dict[str, float]]:
    """One realisation as a study would give it."""
    spectrum = study_from(
        {
            "outputs": ["wave_slope"],
            "parameters": {"k": 0, "nu": 0.3, "modulus": 1.0, "lambda_over_R": 1.0, "A": 1.0},
            "profile": {"spectrum": SPECTRUM},
        }
    ).spectrum
    assert spectrum is not None
    return [{"n": wave.n, "cos": wave.cos, "sin": wave.sin} for wave in random_profile(spectrum, number).harmonics]


def test_each_realisation_is_its_series_to_the_last_bit(study: dict[str, Any]) -> None:
    found = compute(study_from(study))
    assert list(found["status"].dims) == ["k", "A", "a_max_over_R", "realisation"]
    assert found["realisation"].values.tolist() == [0, 1, 2, 3]
    assert "rms height over wavelength" in found["A"].attrs["long_name"]
    assert "Hurst exponent 0.8" in found.attrs["profile"]
    for number in (0, 3):
        one = compute(study_from(study | {"profile": {"harmonics": harmonics(number)}}))
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
    parameters = study["parameters"] | {"k": [0.0, 0.31], "A": [0.002, 0.007], "a_max_over_R": [0.4, 0.7]}
    points = compute(study_from(study | {"layout": "points", "parameters": parameters}))
    grid = compute(study_from(study))
    assert dict(points.sizes) == {"scene": 2, "realisation": 4}
    for i in (0, 1):
        scene = grid["pull_off_force"].isel(k=i, A=i, a_max_over_R=i)
        np.testing.assert_array_equal(points["pull_off_force"].isel(scene=i), scene)
    outputs = ["pull_off_force", "dissipated_energy"]
    both = compute(study_from(study | {"outputs": outputs, "method": {"solver": ["exact", "envelope"]}}))
    assert list(both["pull_off_force"].dims) == ["solver", "k", "A", "a_max_over_R", "realisation"]
    np.testing.assert_array_equal(both["pull_off_force"].sel(solver="exact"), grid["pull_off_force"])
    probe = {
        "k": 0.0,
        "nu": 0.3,
        "R": ["1 um", "2 um"],
        "E_star": 1e9,
        "work_of_adhesion": 0.05,
        "wavelength": "0.3 um",
    }
    made = gr.solve(probe, "pull_off_force", amplitude="1 nm", profile={"spectrum": SPECTRUM})
    assert list(made["pull_off_force_si"].dims) == ["R", "realisation"]
    size = 1.5 * np.pi * made["R"] * 0.05
    np.testing.assert_allclose(made["pull_off_force_si"], made["pull_off_force"] * size, rtol=1e-15)
    assert "rms height" in made["amplitude"].attrs["long_name"]


def test_blocks_shards_and_resumed_runs_give_the_same(
    study: dict[str, Any], gradhesion: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    study["parameters"]["a_max_over_R"] = 0.4
    path, whole, cut = tmp_path / "rough.toml", tmp_path / "whole.nc", tmp_path / "cut.nc"
    path.write_text(study_from(study).text)
    assert gradhesion("run", path, "-o", whole, "--quiet").exit_code == 0
    monkeypatch.setenv("GRADHESION_CHUNK", "3")
    for shard in ("1/2", "2/2"):
        assert gradhesion("run", path, "-o", cut, "--quiet", "--shard", shard).exit_code == 0
    assert gradhesion("merge", cut, "--quiet").exit_code == 0
    with xarray.open_dataset(whole) as one, xarray.open_dataset(cut) as other:
        for name in (*study["outputs"], "status"):
            np.testing.assert_array_equal(one[name], other[name])
    told = gradhesion("info", whole).stdout
    assert "realisation       0, 1, 2, 3" in told
    verified = gradhesion("verify", whole, "--sample", "2", "--seed", "1")
    assert verified.exit_code == 0, verified.stdout + verified.stderr
    assert "realisation = " in verified.stdout
    assert gradhesion("plot", whole, "--over", "realisation=mean", "-o", tmp_path / "mean.png").exit_code == 0
    assert gradhesion("plot", whole, "--over", "realisation=p95", "-o", tmp_path / "high.png").exit_code == 0
    assert gradhesion("plot", whole, "--at", "realisation=2", "-o", tmp_path / "one.png").exit_code == 0
    assert gradhesion("explore", whole).exit_code == 0


def test_quantiles_are_those_of_numpy(study: dict[str, Any]) -> None:
    from gradhesion.cli.dataset.read.reductions import QUANTILES, reduced

    found = compute(study_from(study))
    for name, share in QUANTILES.items():
        values, status = reduced(found["pull_off_force"], found["status"], "realisation", name)
        np.testing.assert_array_equal(values, np.quantile(found["pull_off_force"].values, share, axis=-1))
        np.testing.assert_array_equal(status, np.bitwise_or.reduce(found["status"].values, axis=-1))


def test_curves_are_of_one_punch(study: dict[str, Any]) -> None:
    with pytest.raises(StudyError, match=r"profile\.spectrum = "):
        study_from(study | {"kind": "curve", "outputs": ["path"]})
