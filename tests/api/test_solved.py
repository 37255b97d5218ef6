"""The dataset of named dimensions is that of a study where the dimensions are a study's, and as many scenes elsewhere."""

import math
import tomllib
from typing import Any

import numpy as np
import pytest
import xarray

import gradhesion as gr
from gradhesion import core
from gradhesion.cli.dataset import compute
from gradhesion.cli.study import study_from

PUNCH: dict[str, Any] = {"k": 0.31, "nu": 0.27, "modulus": 430.0, "c0_over_R": 0.013, "lambda_over_R": 0.17, "A": 0.023, "a_max_over_R": 1.7}  # fmt: skip
AFM: dict[str, Any] = {"R": "1 um", "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "10 nm", "wavelength": "90 nm", "a_max": "0.4 um"}  # fmt: skip

STUDIES: dict[str, dict[str, Any]] = {
    "a number": {"parameters": PUNCH},
    "a grid": {"parameters": PUNCH | {"A": [0.0, 0.023], "k": [0.0, 0.31, 0.9], "a_max_over_R": [1.7, math.inf]}},
    "a range": {"parameters": PUNCH | {"lambda_over_R": {"start": 0.11, "stop": 0.47, "num": 3, "spacing": "log"}}},
    "reduced": {"parameters": {name: value for name, value in PUNCH.items() if name not in ("A", "a_max_over_R")} | {"chi": [0.2, 0.7], "a_max_over_a2": 2.0}},
    "units": {"parameters": {"k": [0.0, 0.31], "nu": 0.27, "A": 0.023}, "physical": AFM | {"R": ["1 um", "2 um"]}},
    "solvers": {"parameters": PUNCH | {"A": [0.0, 0.023]}, "method": {"solver": ["exact", "envelope"]}},
    "a machine": {"parameters": PUNCH, "loading": {"control": "machine", "machine_stiffness": [1.0, 9.0]}},
    "a shape": {"parameters": PUNCH | {"A": [0.0, 0.023]}, "profile": {"exponent": 1.7, "harmonics": [{"n": 1, "cos": 1.0}, {"n": 3, "sin": 0.2}]}},
    "points": {"layout": "points", "parameters": PUNCH | {"A": [0.023, 0.0, 0.023], "k": [0.31, 0.5, 0.1]}},
}  # fmt: skip


def arguments(study: dict[str, Any]) -> dict[str, Any]:
    """The same as keywords."""
    loading, method = study.get("loading", {}), study.get("method", {})
    values = (
        study["parameters"] | study.get("physical", {}) | {key: loading[key] for key in loading if key != "control"}
    )
    if study.get("layout") == "points":
        values = {key: xarray.DataArray(v, dims="scene") if isinstance(v, list) else v for key, v in values.items()}
    settings = {"profile": study.get("profile"), "control": loading.get("control"), "solver": method.get("solver")}
    return values | settings


@pytest.mark.parametrize("kind", STUDIES)
def test_it_is_the_dataset_of_the_study(kind: str) -> None:
    outputs = ["pull_off_force", "dissipated_energy", "loading_jumps"]
    study = STUDIES[kind] | {"outputs": outputs, "title": "The same"}
    expected = compute(study_from(study))
    found = gr.solve(outputs=outputs, title="The same", **arguments(study))
    again = study_from(tomllib.loads(found.attrs["study"]))
    assert again.sha256 == found.attrs["study_sha256"] or again.text != found.attrs["study"]
    for attribute in ("study", "study_sha256"):
        expected.attrs[attribute] = found.attrs[attribute]
    xarray.testing.assert_identical(found, expected)
    for name in expected.variables:
        assert found[name].dtype == expected[name].dtype, name
        assert found[name].encoding.keys() == expected[name].encoding.keys(), name
    xarray.testing.assert_identical(compute(again).drop_attrs(), expected.drop_attrs())


def test_scenes_over_named_dimensions_are_those_of_arrays() -> None:
    rng = np.random.default_rng(7)
    A = xarray.DataArray(rng.uniform(0.0, 0.05, (3, 2)), dims=["row", "column"], coords={"row": [10, 20, 30]})
    k = xarray.DataArray(rng.uniform(0.0, 0.9, 2), dims="column")
    found = gr.solve(PUNCH | {"A": A, "k": k, "nu": [0.1, 0.3]}, ["pull_off_force", "loading_jumps"])
    assert {*found["pull_off_force"].dims} == {"row", "column", "nu"}
    for row, column in np.ndindex(3, 2):
        scene = PUNCH | {"A": float(A[row, column]), "k": float(k[column]), "nu": np.array([0.1, 0.3])}
        for name, values in core.solve(scene, ["pull_off_force", "loading_jumps"]).items():
            np.testing.assert_array_equal(found[name].isel(row=row, column=column), values, err_msg=name)
    assert found["row"].values.tolist() == [10, 20, 30]
    assert set(found["A"].dims) == {"row", "column"}
    assert found["k"].dims == ("column",)
    assert "study" not in found.attrs, "no study says this"


def test_what_follows_from_others_stands_over_their_dimensions() -> None:
    R = xarray.DataArray([1e-6, 2e-6], dims="tip")
    found = gr.solve(AFM | {"R": R, "k": [0.0, 0.31], "nu": 0.27, "A": 0.023}, "pull_off_force")
    assert found["modulus"].dims == found["lambda_over_R"].dims == ("tip",)
    np.testing.assert_allclose(found["modulus"], 1e9 * R.values / 0.05, rtol=4 * 2.0**-52)
    np.testing.assert_allclose(
        found["pull_off_force_si"], found["pull_off_force"] * (1.5 * math.pi * 0.05 * R.rename(None)), rtol=8 * 2.0**-52
    )


def test_the_values_do_not_depend_on_threads() -> None:
    many = gr.solve(PUNCH, A=np.linspace(0.0, 0.05, 40), k=[0.1, 0.7], threads=3)
    one = gr.solve(PUNCH, A=np.linspace(0.0, 0.05, 40), k=[0.1, 0.7], threads=1)
    xarray.testing.assert_identical(many, one)
