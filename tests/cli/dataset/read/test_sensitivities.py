"""Sensitivities as outputs of a study: in a file, in Python, in words, as a table and as a picture."""

import csv
import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from click.testing import Result

import gradhesion as gr
from gradhesion.cli.dataset import compute
from gradhesion.cli.dataset.read.sensitivities import parts_of, spread, strongest, with_influence
from gradhesion.cli.errors import StudyError
from gradhesion.cli.study import study_from
from gradhesion.core import SENSITIVITIES, doubts_about, solve

Call = Callable[..., Result]
FORCE, ENERGY = SENSITIVITIES


@pytest.fixture
def data(data: dict[str, Any]) -> dict[str, Any]:
    """The small study, with sensitivities."""
    return data | {"outputs": ["pull_off_force", *SENSITIVITIES]}


@pytest.fixture
def file(gradhesion: Call, study_file: Path, tmp_path: Path) -> Path:
    path = tmp_path / "out.nc"
    assert gradhesion("run", study_file, "-o", path, "--quiet").exit_code == 0
    return path


def test_the_parameter_is_the_last_dimension(data: dict[str, Any]) -> None:
    dataset = compute(study_from(data))
    assert dataset[FORCE].dims == ("k", "lambda_over_R", "A", "a_max_over_R", "parameter")
    assert dataset["parameter"].values.tolist() == list(gr.PARAMETERS)
    scene = {name: float(dataset[name].values.flat[-1]) for name in gr.PARAMETERS}
    exact = solve(scene, SENSITIVITIES)
    for name in SENSITIVITIES:
        np.testing.assert_array_equal(dataset[name].values[-1, -1, -1, -1], exact[name])


def test_a_file_of_many_blocks_has_the_same(
    gradhesion: Call, study_file: Path, data: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = compute(study_from(data))
    monkeypatch.setenv("GRADHESION_CHUNK", "2")
    path = tmp_path / "blocks.nc"
    assert gradhesion("run", study_file, "-o", path, "--quiet").exit_code == 0
    with xarray.open_dataset(path) as dataset:
        for name in (*whole.data_vars, "parameter"):
            np.testing.assert_array_equal(dataset[name], whole[name])


def test_points(data: dict[str, Any]) -> None:
    parameters = data["parameters"] | {"k": [0.0, 0.31], "lambda_over_R": [0.2, 0.4], "A": 0.02, "a_max_over_R": 1.0}
    dataset = compute(study_from(data | {"layout": "points", "parameters": parameters}))
    assert dataset[ENERGY].dims == ("scene", "parameter")


def test_a_turn_is_a_parameter_more(data: dict[str, Any]) -> None:
    parameters = data["parameters"] | {"indentation_max_over_R": [0.01, 0.05]}
    dataset = compute(study_from(data | {"parameters": parameters}))
    assert dataset["parameter"].values.tolist() == [*gr.PARAMETERS, "indentation_max_over_R"]


QUANTITIES = {
    "k": 0.2,
    "nu": 0.3,
    "A": 0.03,
    "R": 1e-6,
    "E_star": 1e9,
    "work_of_adhesion": 0.05,
    "c0": 1e-7,
    "wavelength": 1e-7,
    "indentation_max": 2e-8,
}


def test_quantities_with_units() -> None:
    """Of the values in SI units, by differences of fourth order."""
    found = gr.solve(**QUANTITIES, outputs=["pull_off_force", "dissipated_energy", *SENSITIVITIES])
    named = ["R", "E_star", "work_of_adhesion", "c0", "wavelength", "indentation_max"]
    assert sorted(found["physical_parameter"].values) == sorted(named)
    step = 1e-4
    for name in named:
        around = [
            gr.solve(**{**QUANTITIES, name: QUANTITIES[name] * np.exp(i * step)}, outputs=list(gr.OUTPUTS)[:3])
            for i in (-2, -1, 1, 2)
        ]
        for value in ("pull_off_force", "dissipated_energy"):
            logarithms = [float(np.log(one[f"{value}_si"])) for one in around]
            exact = np.dot([1, -8, 8, -1], logarithms) / (12 * step)
            own = float(found[f"{value}_sensitivity_physical"].sel(physical_parameter=name))
            assert own == pytest.approx(exact, abs=1e-8)


def test_a_machine_is_a_parameter_more(data: dict[str, Any]) -> None:
    parameters = data["parameters"] | {"A": 0.023, "indentation_max_over_R": [0.01, 0.05]}
    machine = {"loading": {"control": "machine", "machine_stiffness": 2.0}}
    dataset = compute(study_from(data | machine | {"parameters": parameters}))
    assert dataset["parameter"].values.tolist() == [*gr.PARAMETERS, "machine_stiffness", "indentation_max_over_R"]
    assert np.all(np.isfinite(dataset[ENERGY].sel(parameter="machine_stiffness")))


def test_a_machine_with_a_unit() -> None:
    """Of the energy in SI units, by differences of fourth order; the stiffness of a machine is its own quantity."""
    machine: dict[str, Any] = QUANTITIES | {"control": "machine", "spring_constant": 1000.0}
    found = gr.solve(**machine, outputs=[ENERGY])[f"{ENERGY}_physical"]
    step = 1e-4
    for name in ("spring_constant", "E_star", "R"):
        around = [
            gr.solve(**{**machine, name: machine[name] * np.exp(i * step)}, outputs=["dissipated_energy"])
            for i in (-2, -1, 1, 2)
        ]
        exact = np.dot([1, -8, 8, -1], [float(np.log(one["dissipated_energy_si"])) for one in around]) / (12 * step)
        assert float(found.sel(physical_parameter=name)) == pytest.approx(exact, abs=1e-8)


def test_realisations_come_before_the_parameter(data: dict[str, Any]) -> None:
    spectrum = {"spectrum": {"hurst": 0.8, "first": 1, "last": 3, "realisations": 2, "seed": 1}}
    dataset = compute(study_from(data | {"profile": spectrum}))
    assert dataset[ENERGY].dims == ("k", "lambda_over_R", "A", "a_max_over_R", "realisation", "parameter")
    assert np.all(np.isfinite(dataset[ENERGY].isel(A=1).sel(parameter="A")))


def test_realisations_with_units() -> None:
    sizes = {name: value for name, value in QUANTITIES.items() if name != "indentation_max"} | {"a_max": 1e-6}
    profile = {"spectrum": {"hurst": 0.8, "first": 1, "last": 3, "realisations": 2, "seed": 1}}
    found = gr.solve(**(sizes | {"k": [0.0, 0.2]}), profile=profile, outputs=SENSITIVITIES)
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


def test_info_names_the_strongest(gradhesion: Call, file: Path) -> None:
    told = " ".join(gradhesion("info", file).stdout.split())
    with xarray.open_dataset(file) as dataset:
        place = strongest(dataset[FORCE].values, dataset["parameter"].values.tolist())
        share = np.mean(place[place >= 0] == list(gr.PARAMETERS).index("lambda_over_R"))
        least = float(dataset[FORCE].sel(parameter="A").min())
    assert "strongest: " in told
    assert f"lambda_over_R in {share:.3g} of the scenes" in told
    assert f"A {least:.4g}" in told


def test_the_strongest_is_no_difference_of_k_or_nu() -> None:
    labels = ["k", "A", "modulus"]
    assert strongest(np.array([[9.0, -2.0, 1.0], [9.0, 0.0, 0.0], [1.0, np.nan, 3.0]]), labels).tolist() == [1, -1, 2]


def test_a_table_has_a_column_for_each(gradhesion: Call, file: Path) -> None:
    rows = list(csv.DictReader(io.StringIO(gradhesion("info", file, "--format", "csv").stdout)))
    with xarray.open_dataset(file) as dataset:
        for i, row in enumerate(rows):
            values = dataset[ENERGY].values.reshape(-1, 7)[i]
            assert [float(row[f"{ENERGY}_{name}"]) for name in gr.PARAMETERS] == values.tolist()
    chosen = gradhesion("info", file, "--format", "csv", "--variable", FORCE).stdout.splitlines()[0]
    assert f"{FORCE}_k,{FORCE}_nu" in chosen
    assert ENERGY not in chosen


def test_spread_keeps_what_is_there(data: dict[str, Any]) -> None:
    dataset = compute(study_from(data))
    flat = spread(dataset)
    assert set(flat["status"].dims) == {"k", "lambda_over_R", "A", "a_max_over_R"}
    assert all(flat[name].dims == flat["status"].dims for name in flat.data_vars)
    parts = parts_of(dataset, FORCE)
    for part, parameter in parts.items():
        np.testing.assert_array_equal(flat[part], dataset[FORCE].sel(parameter=parameter))
    assert f"{FORCE}_A" in with_influence(flat, FORCE, [*parts])
    plain = dataset[["pull_off_force", "status"]]
    assert spread(plain) is plain


@pytest.mark.parametrize("options", [["--at", "a_max_over_R=0.7"], ["--at", "k=0.31", "--at", "A=0.023"]])
def test_plot_draws_the_strongest_and_each(gradhesion: Call, file: Path, tmp_path: Path, options: list[str]) -> None:
    picture = tmp_path / "picture.svg"
    result = gradhesion("plot", file, "--variable", FORCE, "-o", picture, *options)
    assert result.exit_code == 0, result.output
    assert picture.stat().st_size > 10_000


def test_a_page_takes_each(gradhesion: Call, file: Path, tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    assert gradhesion("explore", file, "-o", page).exit_code == 0
    assert f"{FORCE}_lambda_over_R" in page.read_text()


def test_verify_leaves_them_out(gradhesion: Call, file: Path) -> None:
    result = gradhesion("verify", file, "--sample", "1")
    assert result.exit_code == 0
    assert f"{FORCE}, {ENERGY}: there is no independent solution to compare with" in result.stdout


def test_they_are_as_doubtful_as_their_values() -> None:
    assert doubts_about(f"{ENERGY}_A") == doubts_about("dissipated_energy")
    assert doubts_about(FORCE) == doubts_about("pull_off_force")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"method": {"solver": "envelope"}}, 'the solver "envelope" has no such output'),
        ({"kind": "curve"}, 'an output of studies of kind "map"'),
    ],
)
def test_what_is_not_known(change: dict[str, Any], words: str, data: dict[str, Any]) -> None:
    with pytest.raises(StudyError) as caught:
        study_from(data | change)
    assert any("outputs" in one and words in one for one in caught.value.mistakes)
