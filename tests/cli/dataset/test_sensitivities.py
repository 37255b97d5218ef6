"""What inputs do to outputs: sensitivities as outputs of a study, and deviations of outputs where inputs are uncertain."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

import gradhesion as gr
from gradhesion.cli.dataset import compute
from gradhesion.cli.dataset.read.sensitivities import strongest
from gradhesion.cli.names.outputs import SPREAD
from gradhesion.cli.picture.shown import doubts_in
from gradhesion.cli.study import study_from
from gradhesion.core import SENSITIVITIES, solve
from gradhesion.core.answers.flags import LINEAR_DEVIATION_OFF
from tests.cli.conftest import Call, Made, Run

FORCE, ENERGY = SENSITIVITIES
SPECTRUM = {"spectrum": {"hurst": 0.8, "first": 1, "last": 3, "realisations": 2, "seed": 1}}
SLOPES = {"outputs": ["pull_off_force", *SENSITIVITIES]}
QUANTITIES: dict[str, Any] = {"k": 0.2, "nu": 0.3, "A": 0.03, "R": 1e-6, "E_star": 1e9, "work_of_adhesion": 0.05, "c0": 1e-7, "wavelength": 1e-7, "indentation_max": 2e-8}  # fmt: skip
MACHINE = QUANTITIES | {"control": "machine", "spring_constant": 1000.0}
INPUTS: dict[str, Any] = {"modulus": "5 %", "A": 0.001, "nu": {"low": 0.25, "high": 0.29}, "lambda_over_R": "1 %"}
IN_UNITS = [
    (QUANTITIES, ["pull_off_force", "dissipated_energy"], ["R", "E_star", "work_of_adhesion", "c0", "wavelength", "indentation_max"]),
    (MACHINE, ["dissipated_energy"], ["spring_constant", "E_star", "R"]),
]  # fmt: skip


def test_the_parameter_is_the_last_dimension(data: dict[str, Any]) -> None:
    dataset = compute(study_from(data | SLOPES))
    assert dataset[FORCE].dims == ("k", "lambda_over_R", "A", "a_max_over_R", "parameter")
    assert dataset["parameter"].values.tolist() == list(gr.PARAMETERS)
    scene = {name: float(dataset[name].values.flat[-1]) for name in gr.PARAMETERS}
    exact = solve(scene, SENSITIVITIES)
    for name in SENSITIVITIES:
        np.testing.assert_array_equal(dataset[name].values[-1, -1, -1, -1], exact[name])
    rough = compute(study_from(data | SLOPES | {"profile": SPECTRUM}))
    assert rough[ENERGY].dims == ("k", "lambda_over_R", "A", "a_max_over_R", "realisation", "parameter")
    assert np.all(np.isfinite(rough[ENERGY].isel(A=1).sel(parameter="A")))


def test_turn_and_machine_are_a_parameter_more(data: dict[str, Any]) -> None:
    parameters = data["parameters"] | {"A": 0.023, "indentation_max_over_R": [0.01, 0.05]}
    loading = {"control": "machine", "machine_stiffness": 2.0}
    dataset = compute(study_from(data | SLOPES | {"parameters": parameters, "loading": loading}))
    assert dataset["parameter"].values.tolist() == [*gr.PARAMETERS, "machine_stiffness", "indentation_max_over_R"]
    assert np.isfinite(dataset[ENERGY].sel(parameter="machine_stiffness")).all()


@pytest.mark.parametrize(("scene", "outputs", "names"), IN_UNITS, ids=["displacement", "machine"])
def test_with_units_they_are_those_in_si(scene: dict[str, Any], outputs: list[str], names: list[str]) -> None:
    """By differences of fourth order; the stiffness of a machine is its own quantity."""
    found = gr.solve(**scene, outputs=[f"{name}_sensitivity" for name in outputs])
    assert {*names} <= {*found["physical_parameter"].values}
    step = 1e-4
    for name in names:
        around = [gr.solve(**(scene | {name: scene[name] * np.exp(i * step)}), outputs=outputs) for i in (-2, -1, 1, 2)]
        for output in outputs:
            exact = np.dot([1, -8, 8, -1], [np.log(one[f"{output}_si"].item()) for one in around]) / (12 * step)
            own = found[f"{output}_sensitivity_physical"].sel(physical_parameter=name)
            assert own.item() == pytest.approx(exact, abs=1e-8), name


def test_sensitivities_of_realisations_with_units() -> None:
    sizes = {name: value for name, value in QUANTITIES.items() if name != "indentation_max"} | {"a_max": 1e-6}
    found = gr.solve(**(sizes | {"k": [0.0, 0.2]}), profile=SPECTRUM, outputs=SENSITIVITIES)
    physical = found[f"{ENERGY}_physical"]
    assert physical.dims == ("k", "realisation", "physical_parameter")
    by_work = 1.0 - found[ENERGY].sel(parameter="modulus", drop=True)
    np.testing.assert_allclose(physical.sel(physical_parameter="work_of_adhesion"), by_work, rtol=1e-9)


def test_arrays_over_dimensions_of_any_names() -> None:
    scene = {"nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "A": 0.05, "a_max_over_R": 0.6}
    lengths = xarray.DataArray([0.1, 0.2, 0.4], dims="sample")
    found = gr.solve(scene, k=[0.0, 0.5], lambda_over_R=lengths, outputs=[FORCE])
    assert dict(found[FORCE].sizes) == {"sample": 3, "k": 2, "parameter": 7}
    exact = solve(scene | {"k": 0.5, "lambda_over_R": 0.2}, [FORCE])[FORCE]
    np.testing.assert_allclose(found[FORCE].isel(sample=1).sel(k=0.5), exact, rtol=1e-12)


def test_info_names_the_strongest_which_is_no_difference_of_k_or_nu(gradhesion: Call, made: Made) -> None:
    file = made(outputs=SLOPES["outputs"])
    told = " ".join(gradhesion("info", file).stdout.split())
    with xarray.open_dataset(file) as dataset:
        sizes = abs(dataset[FORCE]).drop_sel(parameter=["k", "nu"]).values.reshape(-1, 5)
        wave = np.mean((sizes.argmax(axis=1) == 2)[sizes.max(axis=1) > 0.0])
        least = float(dataset[FORCE].sel(parameter="A").min())
    assert f"lambda_over_R in {100.0 * wave:.3g} % of the scenes" in told
    assert f"A {least:.4g}" in told
    gradhesion("select", file, "--over", "A=max", "-o", file.with_name("reduced.nc"), code=0)
    assert "strongest: " not in gradhesion("info", file.with_name("reduced.nc")).stdout, (
        "the largest is not the strongest"
    )
    none = np.array([[9.0, -2.0, 1.0], [9.0, 0.0, 0.0], [1.0, np.nan, 3.0]])
    assert strongest(none, ["k", "A", "modulus"]).tolist() == [1, -1, 2]


@pytest.fixture
def uncertain(data: dict[str, Any]) -> dict[str, Any]:
    parameters = data["parameters"] | {"A": [0.011, 0.023]}
    return data | {"parameters": parameters, "uncertainty": INPUTS}


def test_linear_deviations_are_sums_of_squares(uncertain: dict[str, Any]) -> None:
    outputs = ["pull_off_force", "pull_off_force_sensitivity"]
    dataset = compute(study_from(uncertain | {"outputs": outputs}))
    assert {"pull_off_force_std"} == {*dataset.data_vars} - {*outputs, "status"}
    slopes = dataset["pull_off_force_sensitivity"]
    shares = {"modulus": 0.05, "A": 0.001 / dataset["A"], "lambda_over_R": 0.01, "nu": 0.04 / np.sqrt(12.0)}
    squares = sum((slopes.sel(parameter=name) * share) ** 2 for name, share in shares.items())
    expected = dataset["pull_off_force"] * np.sqrt(squares)
    # eps of some ten terms, and the truncation of the amplitude at 0, 11 deviations away
    found = dataset["pull_off_force_std"]
    np.testing.assert_allclose(found, expected.transpose(*found.dims), rtol=1e-13)
    assert dataset["status"].dtype == np.int16
    known = [name for name in gr.FLAGS if name != "too_many_waves"]  # of patterns and speeds alone
    assert dataset["status"].attrs["flag_meanings"].split() == known


def test_samples_against_scenes_that_are_drawn_here(uncertain: dict[str, Any]) -> None:
    """Normal inputs truncated at their bounds, by another generator: good to 4 standard errors. Counts have none."""
    parameters = uncertain["parameters"] | {"k": 0.31, "A": 0.02, "lambda_over_R": 0.3, "a_max_over_R": 1.7}
    inputs = {"A": 0.015, "modulus": "20 %"}
    outputs = ["pull_off_force", "pull_off_radius"]
    own = {"parameters": parameters, "uncertainty": inputs | {"samples": 4096, "seed": 3}}
    found = compute(study_from(uncertain | own | {"outputs": [*outputs, "loading_jumps"]}))
    assert {f"{name}_{way}" for name in outputs for way in SPREAD} <= {*found.data_vars, "pull_off_radius_std_linear"}
    assert not any(str(name).startswith("loading_jumps_") for name in found.data_vars)
    rng, count = np.random.default_rng(2), 20_000
    amplitude = rng.normal(0.02, 0.015, count)
    amplitude = amplitude[amplitude > 0.0]
    scenes = gr.core.solve(parameters | {"A": amplitude, "modulus": rng.normal(430.0, 86.0, amplitude.size)}, outputs)
    for name in outputs:
        assert found[f"{name}_p05"] < found[f"{name}_p50"] < found[f"{name}_p95"]
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


def test_deviations_with_units() -> None:
    """At k = 0 a smooth ball holds 1.5 pi R dgamma, whatever the modulus."""
    physical = {"R": "1 um", "E": "1 GPa", "work_of_adhesion": "50 mJ/m^2"}
    spread = {"R": "3 %", "work_of_adhesion": "2 mJ/m^2", "E": "10 %", "samples": 512}
    ball = {"parameters": {"k": 0.0, "nu": 0.3, "A": 0.0}, "physical": physical, "uncertainty": spread}
    found = gr.run(ball | {"outputs": ["pull_off_force"]})
    force = 1.5 * np.pi * 1e-6 * 0.05
    assert found["pull_off_force_std"].item() == pytest.approx(0.0, abs=1e-12)
    assert found["pull_off_force_std_linear_si"].item() == pytest.approx(force * np.hypot(0.03, 0.04), rel=1e-9)
    assert found["pull_off_force_std_si"].item() == pytest.approx(force * np.hypot(0.03, 0.04), rel=0.02)
    assert found["pull_off_force_mean_si"].item() == pytest.approx(force, rel=1e-3)
    assert found["pull_off_force_std_si"].attrs["units"] == "N"


def test_run_says_how_many_differ(gradhesion: Call, ran: Run, tmp_path: Path, uncertain: dict[str, Any]) -> None:
    parameters = uncertain["parameters"] | {"k": 0.31, "A": 0.023, "a_max_over_R": 1.7}
    parameters["lambda_over_R"] = {"start": 0.1, "stop": 0.5, "num": 9}
    for samples in (0, 1024):
        spread = {"lambda_over_R": "5 %", "samples": samples}
        study = uncertain | {"outputs": ["pull_off_force"], "parameters": parameters, "uncertainty": spread}
        said, dataset, path = ran(study, output=f"{samples}.nc")
        count = int(dataset.gr.flagged("linear_deviation_off").sum())
        assert 0 < count < 9
        assert f"in {count} of 9 scenes (" in said
    told = gradhesion("info", path).stdout
    head, *rows = told[told.index("uncertain inputs") :].partition("\n\n")[0].splitlines()
    assert "1,024 samples" in head
    assert [row.split()[0] for row in rows] == ["lambda_over_R"]
    assert "1,025 times" in gradhesion("plan", tmp_path / "study.toml", "-o", tmp_path / "new.nc").stdout
    shown = ["plot", path, "-o", tmp_path / "picture.svg", "--variable", "pull_off_force_p95"]
    assert gradhesion(*shown).exit_code == 0
    with xarray.open_dataset(path) as dataset:  # as version 0.3 wrote it
        dataset.drop_vars("pull_off_force_std_linear").to_netcdf(old := tmp_path / "old.nc")
    for command, code in (["info", 0], ["plot", 0], ["verify", 0], ["merge", 2]):
        more = [path, "-o", tmp_path / "joined.nc"] if command == "merge" else []
        assert gradhesion(command, old, *more).exit_code == code


def test_deviations_by_slopes_alone_are_doubtful_where_the_line_is_off(uncertain: dict[str, Any]) -> None:
    for samples, names in ((0, {"std": True}), (64, {"std": False, "std_linear": True})):
        spread = {"uncertainty": {"lambda_over_R": "30 %", "samples": samples}, "outputs": ["pull_off_force"]}
        dataset = compute(study_from(uncertain | spread))
        off = dataset.gr.flagged("linear_deviation_off")
        assert bool(off.any())
        for name, doubtful in names.items():
            drawn = [doubt.bit for doubt in doubts_in(dataset["status"].values, f"pull_off_force_{name}", dataset)]
            assert (gr.FLAGS["linear_deviation_off"] in drawn) == doubtful
            assert bool(dataset.gr.valid(f"pull_off_force_{name}").where(off, other=False).any()) != doubtful


def test_a_percentage_of_zero(uncertain: dict[str, Any]) -> None:
    parameters = uncertain["parameters"] | {"A": [0.0, 0.02]}
    number = compute(study_from(uncertain | {"parameters": parameters, "uncertainty": {"A": 0.001}}))
    assert bool(number["pull_off_force_std"].sel(A=0.0).isnull().all())  # no derivative there
    assert bool(number["pull_off_force_std"].sel(A=0.02).notnull().all())


def test_a_value_that_does_not_depend_on_what_is_uncertain_is_a_straight_line() -> None:
    """The force of a smooth punch is 1.5 pi R w at k = 0: in reduced units it does not depend on w."""
    physical = {"R": "5 um", "E_star": "1 MPa", "work_of_adhesion": "40 mJ/m^2"}
    study = {"outputs": ["pull_off_force"], "parameters": {"k": 0.0, "nu": 0.3, "A": 0.0}, "physical": physical}
    found = compute(study_from(study | {"uncertainty": {"work_of_adhesion": "1 %"}}))
    assert found["status"] & LINEAR_DEVIATION_OFF == 0
    assert found["pull_off_force_std_si"].item() == pytest.approx(0.01 * 1.5 * np.pi * 5e-6 * 0.04, rel=1e-12, abs=0.0)
