"""Edges that close at less work than they open at, in studies: their keys, units, outputs, and what is refused."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from click.testing import Result

import gradhesion as gr
from gradhesion.cli.dataset.dataset import compute
from gradhesion.cli.study.reading import study_from
from gradhesion.core import solve

Call = Callable[..., Result]
Write = Callable[[str], Path]
PLAIN: dict[str, Any] = {"k": 0.1, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.2, "A": 0.02}
STUDY: dict[str, Any] = {
    "outputs": ["pull_off_force", "dissipated_energy", "front_energy", "snap_in_force", "pinned_depth"],
    "parameters": PLAIN | {"indentation_max_over_R": [0.02, 0.05], "closing_ratio": [0.0, 0.5, 1.0]},
}
OUTPUTS = 'outputs = ["pull_off_force", "dissipated_energy"]\n'
PARAMETERS = "[parameters]\nk = 0.0\nnu = 0.3\nA = 0.02\n"
PHYSICAL = '[physical]\nR = "1 mm"\nE_star = "50 kPa"\nwork_of_adhesion = "50 mJ/m^2"\nwavelength = "0.1 mm"\n'


def test_the_ratio_is_the_last_dimension_of_what_a_scene_is_solved_for() -> None:
    dataset = compute(study_from(STUDY))
    assert dataset["dissipated_energy"].dims == ("indentation_max_over_R", "closing_ratio")
    assert dataset["status"].dtype == np.int16
    known = {name: np.array(value) for name, value in STUDY["parameters"].items() if name in PLAIN}
    known |= {"a_max_over_R": np.array(np.inf), "indentation_max_over_R": np.array([[0.02], [0.05]])}
    found = solve(known | {"closing_ratio": np.array([0.0, 0.5, 1.0])}, STUDY["outputs"])
    for name in STUDY["outputs"]:
        assert np.array_equal(dataset[name], found[name], equal_nan=True)


def test_a_study_without_the_key_has_nothing_of_it() -> None:
    plain = {
        **STUDY,
        "parameters": {key: value for key, value in STUDY["parameters"].items() if key != "closing_ratio"},
    }
    dataset = compute(study_from(plain | {"outputs": ["dissipated_energy", "dissipated_energy_sensitivity"]}))
    assert "closing_ratio" not in dataset.coords
    assert "closing_ratio" not in dataset["parameter"].values
    edge = compute(study_from(plain | {"outputs": ["front_energy", "pinned_depth", "snap_in_force"]}))
    assert "closing_ratio" not in edge.coords
    assert not edge["front_energy"].any()


def test_sensitivities_name_the_ratio_last() -> None:
    dataset = compute(study_from(STUDY | {"outputs": ["dissipated_energy_sensitivity"]}))
    assert dataset["parameter"].values[-2:].tolist() == ["indentation_max_over_R", "closing_ratio"]


def test_works_in_si_give_the_ratio(gradhesion: Call, write_study: Write) -> None:
    text = (
        OUTPUTS
        + PARAMETERS
        + PHYSICAL
        + 'work_of_adhesion_closing = ["0 J/m^2", "5 mJ/m^2", "0.05 N/m"]\na_max = "0.5 mm"\n'
    )
    path = write_study(text)
    result = gradhesion("run", path, "-o", path.with_suffix(".nc"))
    assert result.exit_code == 0, result.output
    with gr.open(path.with_suffix(".nc")) as dataset:
        np.testing.assert_allclose(dataset["closing_ratio"], [0.0, 0.1, 1.0], rtol=1e-15)
        assert dataset["work_of_adhesion_closing"].attrs["units"] == "J/m^2"
        energy = 1e-6 * 0.05 * dataset["dissipated_energy"]
        np.testing.assert_allclose(dataset["dissipated_energy_si"], energy, rtol=1e-15)
    assert gradhesion("verify", path.with_suffix(".nc"), "--sample", "3").exit_code == 0


def test_the_envelope_radius_of_loading_is_that_of_closing() -> None:
    scene = PLAIN | {"closing_ratio": 0.4, "a_max_over_a2": 1.5}
    made = compute(study_from({"outputs": ["pull_off_force"], "parameters": scene}))["a_max_over_R"]
    closing = PLAIN | {"modulus": 500.0 / 0.4, "a_max_over_a2": 1.5}
    own = compute(study_from({"outputs": ["pull_off_force"], "parameters": closing}))["a_max_over_R"]
    np.testing.assert_allclose(made, own, rtol=1e-15)


def test_samples_of_the_work_of_closing_stay_below_that_of_opening() -> None:
    works = {"work_of_adhesion": "50 mJ/m^2", "work_of_adhesion_closing": "49.9 mJ/m^2"}
    lengths = {"R": "1 mm", "E_star": "50 kPa", "wavelength": "0.1 mm", "a_max": "0.5 mm"}
    study: dict[str, Any] = {
        "outputs": ["dissipated_energy"],
        "parameters": {"k": 0.0, "nu": 0.3, "A": 0.02},
        "physical": works | lengths,
        "uncertainty": {"work_of_adhesion_closing": "5 %", "work_of_adhesion": "5 %", "samples": 1024},
    }
    dataset = compute(study_from(study))
    assert np.isfinite(dataset["dissipated_energy_p95"])
    assert dataset["dissipated_energy_p95"] > dataset["dissipated_energy_p05"]


def test_an_optimum_may_be_sought_over_the_ratio() -> None:
    study = {
        "kind": "optimum",
        "parameters": PLAIN | {"a_max_over_R": 0.5, "closing_ratio": {"start": 0.1, "stop": 1.0}},
        "optimum": {"maximise": "dissipated_energy", "over": ["closing_ratio"], "resolution": 50},
    }
    found = compute(study_from(study))
    grid = np.linspace(0.1, 1.0, 2001)
    energies = solve(PLAIN | {"a_max_over_R": 0.5, "closing_ratio": grid}, ["dissipated_energy"])["dissipated_energy"]
    assert float(found["best_dissipated_energy"]) >= energies.max() * (1.0 - 1e-12)


def test_a_forced_pull_alone_needs_no_turn() -> None:
    scene = PLAIN | {"closing_ratio": [0.2, 0.8]}
    forces = compute(study_from({"outputs": ["pull_off_force", "loading_energy"], "parameters": scene}))
    assert forces["pull_off_force"][0] == forces["pull_off_force"][1]


def test_python_takes_the_ratio_as_it_takes_every_parameter() -> None:
    found = gr.solve(outputs=["dissipated_energy", "front_energy"], **PLAIN, a_max_over_R=0.5, closing_ratio=[0.3, 0.6])
    assert found["dissipated_energy"].dims == ("closing_ratio",)
    drawn = gr.curves(PLAIN | {"a_max_over_R": 0.5, "closing_ratio": 0.3}, ["path", "closing_equilibrium"])
    assert drawn["closing_load"].dims == ("closing_point",)
