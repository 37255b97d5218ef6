"""Sensitivities as outputs of a study: their dimension, in units, in words and as a picture."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from click.testing import Result

import gradhesion as gr
from gradhesion.cli.dataset import compute
from gradhesion.cli.dataset.read.sensitivities import strongest
from gradhesion.cli.study import study_from
from gradhesion.core import SENSITIVITIES, solve

Call = Callable[..., Result]
FORCE, ENERGY = SENSITIVITIES
SPECTRUM = {"spectrum": {"hurst": 0.8, "first": 1, "last": 3, "realisations": 2, "seed": 1}}


@pytest.fixture
def data(data: dict[str, Any]) -> dict[str, Any]:
    """The small study, with sensitivities."""
    return data | {"outputs": ["pull_off_force", *SENSITIVITIES]}


@pytest.fixture
def file(made: Callable[..., Path]) -> Path:
    return made()


def test_the_parameter_is_the_last_dimension(data: dict[str, Any]) -> None:
    dataset = compute(study_from(data))
    assert dataset[FORCE].dims == ("k", "lambda_over_R", "A", "a_max_over_R", "parameter")
    assert dataset["parameter"].values.tolist() == list(gr.PARAMETERS)
    scene = {name: float(dataset[name].values.flat[-1]) for name in gr.PARAMETERS}
    exact = solve(scene, SENSITIVITIES)
    for name in SENSITIVITIES:
        np.testing.assert_array_equal(dataset[name].values[-1, -1, -1, -1], exact[name])
    rough = compute(study_from(data | {"profile": SPECTRUM}))
    assert rough[ENERGY].dims == ("k", "lambda_over_R", "A", "a_max_over_R", "realisation", "parameter")
    assert np.all(np.isfinite(rough[ENERGY].isel(A=1).sel(parameter="A")))


@pytest.mark.parametrize(
    ("loading", "more"), [({}, []), ({"control": "machine", "machine_stiffness": 2.0}, ["machine_stiffness"])]
)
def test_a_turn_and_a_machine_are_a_parameter_more(
    loading: dict[str, Any], more: list[str], data: dict[str, Any]
) -> None:
    parameters = data["parameters"] | {"A": 0.023, "indentation_max_over_R": [0.01, 0.05]}
    dataset = compute(study_from(data | {"parameters": parameters, "loading": loading or {"control": "displacement"}}))
    assert dataset["parameter"].values.tolist() == [*gr.PARAMETERS, *more, "indentation_max_over_R"]
    assert all(np.isfinite(dataset[ENERGY].sel(parameter=name)).all() for name in more)


QUANTITIES: dict[str, Any] = {"k": 0.2, "nu": 0.3, "A": 0.03, "R": 1e-6, "E_star": 1e9, "work_of_adhesion": 0.05, "c0": 1e-7, "wavelength": 1e-7, "indentation_max": 2e-8}  # fmt: skip
MACHINE = QUANTITIES | {"control": "machine", "spring_constant": 1000.0}


@pytest.mark.parametrize(
    ("scene", "outputs", "names"),
    [
        (QUANTITIES, ["pull_off_force", "dissipated_energy"], ["R", "E_star", "work_of_adhesion", "c0", "wavelength", "indentation_max"]),
        (MACHINE, ["dissipated_energy"], ["spring_constant", "E_star", "R"]),
    ],
    ids=["displacement", "machine"],
)  # fmt: skip
def test_with_units_they_are_those_of_the_values_in_si(
    scene: dict[str, Any], outputs: list[str], names: list[str]
) -> None:
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


def test_realisations_with_units() -> None:
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


def test_info_names_the_strongest_which_is_no_difference_of_k_or_nu(gradhesion: Call, file: Path) -> None:
    told = " ".join(gradhesion("info", file).stdout.split())
    with xarray.open_dataset(file) as dataset:
        sizes = abs(dataset[FORCE]).drop_sel(parameter=["k", "nu"]).values.reshape(-1, 5)
        wave = np.mean((sizes.argmax(axis=1) == 2)[sizes.max(axis=1) > 0.0])
        least = float(dataset[FORCE].sel(parameter="A").min())
    assert f"lambda_over_R in {wave:.3g} of the scenes" in told
    assert f"A {least:.4g}" in told
    none = np.array([[9.0, -2.0, 1.0], [9.0, 0.0, 0.0], [1.0, np.nan, 3.0]])
    assert strongest(none, ["k", "A", "modulus"]).tolist() == [1, -1, 2]


def test_verify_leaves_them_out(gradhesion: Call, file: Path) -> None:
    result = gradhesion("verify", file, "--sample", "1")
    assert result.exit_code == 0
    assert f"{FORCE}, {ENERGY}: " in result.stdout
