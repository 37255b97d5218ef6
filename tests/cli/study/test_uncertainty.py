"""Uncertain inputs of a study: in Python, in a file of many blocks, in units, in words, and what is refused."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from click.testing import Result

import gradhesion as gr
from gradhesion.cli.dataset import compute
from gradhesion.cli.names.outputs import SPREAD
from gradhesion.cli.picture.doubts import doubts_in
from gradhesion.cli.study import study_from

Call = Callable[..., Result]
INPUTS: dict[str, Any] = {"modulus": "5 %", "A": 0.001, "nu": {"low": 0.25, "high": 0.29}, "lambda_over_R": "1 %"}


@pytest.fixture
def data(data: dict[str, Any]) -> dict[str, Any]:
    """The small study with uncertain inputs."""
    parameters = data["parameters"] | {"A": [0.011, 0.023]}
    return data | {"parameters": parameters, "uncertainty": INPUTS}


def test_linear_deviations_are_sums_of_squares(data: dict[str, Any]) -> None:
    outputs = ["pull_off_force", "pull_off_force_sensitivity"]
    dataset = compute(study_from(data | {"outputs": outputs}))
    assert {"pull_off_force_std"} == {*dataset.data_vars} - {*outputs, "status"}
    slopes = dataset["pull_off_force_sensitivity"]
    shares = {"modulus": 0.05, "A": 0.001 / dataset["A"], "lambda_over_R": 0.01, "nu": 0.04 / np.sqrt(12.0)}
    squares = sum((slopes.sel(parameter=name) * share) ** 2 for name, share in shares.items())
    expected = dataset["pull_off_force"] * np.sqrt(squares)
    # eps of some ten terms, and the truncation of the amplitude at 0, 11 deviations away
    np.testing.assert_allclose(
        dataset["pull_off_force_std"], expected.transpose(*dataset["pull_off_force_std"].dims), rtol=1e-13
    )
    assert dataset["status"].dtype == np.int16
    known = [name for name in gr.FLAGS if name != "too_many_waves"]  # of patterns and speeds alone
    assert dataset["status"].attrs["flag_meanings"].split() == known


def test_samples_are_the_same_in_every_scene_and_block(
    data: dict[str, Any],
    gradhesion: Call,
    write_study: Callable[[str], Path],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    study = study_from(data | {"uncertainty": INPUTS | {"samples": 64, "seed": 3}})
    whole = compute(study)
    monkeypatch.setenv("GRADHESION_CHUNK", "130")
    path = tmp_path / "blocks.nc"
    call = gradhesion("run", write_study(study.text), "-o", path)
    assert call.exit_code == 0, call.output
    with xarray.open_dataset(path) as dataset:
        for name in whole.data_vars:
            np.testing.assert_array_equal(dataset[name], whole[name])
    for name in ("pull_off_force", "dissipated_energy"):
        assert bool((whole[f"{name}_p05"] < whole[f"{name}_p50"]).all())
        assert bool((whole[f"{name}_p50"] < whole[f"{name}_p95"]).all())
    assert {f"{name}_{way}" for name in ("pull_off_force", "dissipated_energy") for way in SPREAD} <= {*whole.data_vars}
    assert not any(str(name).startswith("loading_jumps_") for name in whole.data_vars)


def test_samples_against_scenes_that_are_drawn_here(data: dict[str, Any]) -> None:
    """Normal inputs truncated at their bounds, by another generator: 4096 scenes, good to 4 standard errors."""
    parameters = data["parameters"] | {"k": 0.31, "A": 0.02, "lambda_over_R": 0.3, "a_max_over_R": 1.7}
    inputs = {"A": 0.015, "modulus": "20 %"}
    outputs = ["pull_off_force", "pull_off_radius"]
    found = compute(
        study_from(data | {"outputs": outputs, "parameters": parameters, "uncertainty": inputs | {"samples": 4096}})
    )
    rng, count = np.random.default_rng(2), 20_000
    amplitude = rng.normal(0.02, 0.015, count)
    amplitude = amplitude[amplitude > 0.0]
    scenes = gr.core.solve(parameters | {"A": amplitude, "modulus": rng.normal(430.0, 86.0, amplitude.size)}, outputs)
    for name in outputs:
        error = np.std(scenes[name]) / np.sqrt(amplitude.size)
        assert found[f"{name}_mean"].item() == pytest.approx(np.mean(scenes[name]), abs=4 * error)
        density = np.mean(np.abs(scenes[name] - found[f"{name}_p95"].item()) < 2 * error) / (4 * error)
        wide = 4 * np.sqrt(0.05 * 0.95 / amplitude.size) / density
        assert found[f"{name}_p95"].item() == pytest.approx(np.quantile(scenes[name], 0.95), abs=wide)
    # the radius has no sensitivities: its deviation is that of the samples
    assert found["pull_off_radius_std"].item() == pytest.approx(np.std(scenes["pull_off_radius"]), rel=0.05)
    assert "samples" in found["pull_off_radius_std"].attrs["comment"]
    assert found["pull_off_force_std"].item() == pytest.approx(np.std(scenes["pull_off_force"]), rel=0.05)
    assert "by its sensitivities" in found["pull_off_force_std_linear"].attrs["long_name"]
    assert "pull_off_radius_std_linear" not in found, "of which there are no sensitivities"


def test_quantities_with_units() -> None:
    """At k = 0 a smooth ball holds 1.5 pi R dgamma, whatever the modulus."""
    ball = {
        "outputs": ["pull_off_force"],
        "parameters": {"k": 0.0, "nu": 0.3, "A": 0.0},
        "physical": {"R": "1 um", "E": "1 GPa", "work_of_adhesion": "50 mJ/m^2"},
        "uncertainty": {"R": "3 %", "work_of_adhesion": "2 mJ/m^2", "E": "10 %", "samples": 512},
    }
    found = gr.run(ball)
    force = 1.5 * np.pi * 1e-6 * 0.05
    assert found["pull_off_force_std"].item() == pytest.approx(0.0, abs=1e-12)
    assert found["pull_off_force_std_linear_si"].item() == pytest.approx(force * np.hypot(0.03, 0.04), rel=1e-9)
    assert found["pull_off_force_std_si"].item() == pytest.approx(force * np.hypot(0.03, 0.04), rel=0.02)
    assert found["pull_off_force_mean_si"].item() == pytest.approx(force, rel=1e-3)
    assert found["pull_off_force_std_si"].attrs["units"] == "N"


@pytest.mark.slow
def test_linear_deviations_against_samples() -> None:
    """With inputs known to 1 %: within 2 %, and flagged where a kink is within reach."""
    scenes, count, rng = 24, 2**15, np.random.default_rng(5)
    parameters = {
        "k": rng.choice([0.0, 0.3, 0.5, 0.8], scenes),
        "nu": rng.uniform(-0.2, 0.45, scenes),
        "modulus": 10 ** rng.uniform(1.5, 3.5, scenes),
        "c0_over_R": 10 ** rng.uniform(-3.0, 0.0, scenes),
        "lambda_over_R": 10 ** rng.uniform(-1.5, 0.0, scenes),
        "A": rng.uniform(0.002, 0.05, scenes),
        "a_max_over_R": rng.uniform(0.3, 1.5, scenes),
    }
    outputs = ["pull_off_force", "dissipated_energy"]
    spread = {name: 0.01 if name == "nu" else "1 %" for name in parameters if name != "k"}
    study = {"layout": "points", "outputs": outputs, "parameters": parameters, "uncertainty": spread}
    linear, rng = gr.run(study), np.random.default_rng(8)
    off = linear.gr.flagged("linear_deviation_off").values
    deviations = {name: 0.01 * (1.0 if name == "nu" else parameters[name]) for name in spread}
    noise = {name: rng.normal(size=(count, scenes)) * deviations.get(name, 0.0) for name in parameters}
    found = gr.core.solve({name: parameters[name] + one for name, one in noise.items()}, outputs)
    wrong = np.zeros(scenes, bool)
    for name in outputs:
        ratio = linear[f"{name}_std"].values / np.std(found[name], axis=0)
        wrong |= np.abs(ratio - 1.0) > 0.02 + 4.0 / np.sqrt(2.0 * count)
    assert not np.any(wrong & ~off), np.flatnonzero(wrong & ~off)
    assert 1 <= np.count_nonzero(wrong) <= np.count_nonzero(off) < scenes // 2


def test_run_names_the_share_of_scenes_that_differ(
    gradhesion: Call, write_study: Callable[[str], Path], tmp_path: Path, data: dict[str, Any]
) -> None:
    parameters = data["parameters"] | {"k": 0.31, "A": 0.023, "a_max_over_R": 1.7}
    parameters["lambda_over_R"] = {"start": 0.1, "stop": 0.5, "num": 9}
    for samples in (0, 1024):
        spread = {"lambda_over_R": "5 %", "samples": samples}
        study = study_from(data | {"outputs": ["pull_off_force"], "parameters": parameters, "uncertainty": spread})
        file, path = write_study(study.text), tmp_path / f"{samples}.nc"
        call = gradhesion("run", file, "-o", path)
        assert call.exit_code == 0
        with gr.open(path) as dataset:
            count = int(dataset.gr.flagged("linear_deviation_off").sum())
        assert 0 < count < 9
        assert f"in {count} of 9 scenes (" in call.stderr
    told = gradhesion("info", path).stdout
    head, *rows = told[told.index("uncertain inputs") :].partition("\n\n")[0].splitlines()
    assert "1,024 samples" in head
    assert [row.split()[0] for row in rows] == ["lambda_over_R"]
    assert "1,025 times" in gradhesion("plan", file, "-o", tmp_path / "new.nc").stdout
    shown = ["plot", path, "-o", tmp_path / "picture.svg", "--variable", "pull_off_force_p95"]
    assert gradhesion(*shown).exit_code == 0
    with xarray.open_dataset(path) as dataset:  # as version 0.3 wrote it
        dataset.drop_vars("pull_off_force_std_linear").to_netcdf(old := tmp_path / "old.nc")
    for command, code in (["info", 0], ["plot", 0], ["verify", 0], ["merge", 2]):
        more = [path, "-o", tmp_path / "joined.nc"] if command == "merge" else []
        assert gradhesion(command, old, *more).exit_code == code


def test_a_deviation_of_samples_is_as_good_as_its_value_and_one_by_slopes_doubtful_where_the_line_is_off(
    data: dict[str, Any],
) -> None:
    for samples, names in ((0, {"std": True}), (64, {"std": False, "std_linear": True})):
        spread = {"uncertainty": {"lambda_over_R": "30 %", "samples": samples}, "outputs": ["pull_off_force"]}
        dataset = compute(study_from(data | spread))
        off = dataset.gr.flagged("linear_deviation_off")
        assert bool(off.any())
        for name, doubtful in names.items():
            drawn = [doubt.bit for doubt in doubts_in(dataset["status"].values, f"pull_off_force_{name}", dataset)]
            assert (gr.FLAGS["linear_deviation_off"] in drawn) == doubtful
            assert bool(dataset.gr.valid(f"pull_off_force_{name}").where(off, other=False).any()) != doubtful


def test_a_percentage_of_zero(data: dict[str, Any]) -> None:
    parameters = data["parameters"] | {"A": [0.0, 0.02]}
    number = compute(study_from(data | {"parameters": parameters, "uncertainty": {"A": 0.001}}))
    assert bool(number["pull_off_force_std"].sel(A=0.0).isnull().all())  # no derivative there
    assert bool(number["pull_off_force_std"].sel(A=0.02).notnull().all())
