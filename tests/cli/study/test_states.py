"""Pressure and surface of states in curve studies: their dataset, what a wrong study is answered, and the picture."""

from pathlib import Path
from typing import Any

import numpy as np
import xarray

import gradhesion as gr
from gradhesion.cli.dataset.dataset import compute
from gradhesion.cli.study.reading import study_from
from gradhesion.cli.study.study import Study
from gradhesion.cli.words.words import described
from gradhesion.core.draw import states

SCENE = {"k": 0.1, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.2, "A": 0.055}


def study(outputs: list[str], radii: list[Any] | None = None, **more: Any) -> Study:
    data: dict[str, Any] = {"kind": "curve", "outputs": outputs, "parameters": SCENE | {"a_max_over_R": 0.45} | more}
    return study_from(data | ({"states": {"contact_radius_over_R": radii}} if radii is not None else {}))


def test_named_states_and_their_curves() -> None:
    dataset = compute(study(["pressure", "surface"]))
    assert dataset["state"].values.tolist() == ["turning_point", "pull_off", "jump_out"]
    scene = SCENE | {"a_max_over_R": 0.45}
    expected = states.draw_states(scene, states.named_states(scene)[0], ["pressure", "surface"])
    assert {name for name in dataset.data_vars if name != "status"} == set(expected)
    for name, values in expected.items():
        assert dataset[name].dims == ("state", name.split("_")[0] + "_point")
        np.testing.assert_array_equal(dataset[name].values, values)


def test_given_radii_along_an_axis() -> None:
    dataset = compute(study(["pressure"], [0.1, 0.4], A=[0.0, 0.055]))
    assert dataset["pressure"].dims == ("A", "state", "pressure_point")
    assert dataset["state"].values.tolist() == [0.1, 0.4]
    # each scene has as many points as it needs, the others are padded
    for i, amplitude in enumerate((0.0, 0.055)):
        scene = SCENE | {"a_max_over_R": 0.45, "A": amplitude}
        own = states.draw_states(scene, states.equilibrium_states(scene, [0.1, 0.4]), ["pressure"])["pressure"]
        values = dataset["pressure"].values[i]
        np.testing.assert_array_equal(values[:, : own.shape[1]], own)
        assert np.isnan(values[:, own.shape[1] :]).all()


def test_in_units() -> None:
    data = {
        "kind": "curve",
        "outputs": ["pressure"],
        "parameters": {"k": 0.0, "nu": 0.3, "A": 0.0},
        "physical": {"R": "2 um", "E_star": "1 MPa", "work_of_adhesion": "50 mJ/m^2"},
        "states": {"contact_radius_over_R": [0.5]},
    }
    dataset = compute(study_from(data))
    assert dataset["pressure_si"].attrs["units"] == "Pa"
    assert dataset["pressure_si"].attrs["long_name"] == "contact pressure p, positive in compression"
    np.testing.assert_allclose(dataset["pressure_si"], dataset["pressure"] * 0.05 / 2e-6)
    np.testing.assert_allclose(dataset["pressure_radius_si"], dataset["pressure_radius"] * 2e-6)
    panels = gr.plot(dataset)
    assert "Pa" in panels[0].get_ylabel()


def test_words_and_picture(tmp_path: Path) -> None:
    dataset = compute(study(["pressure", "surface", "path"]))
    dataset.to_netcdf(tmp_path / "x.nc")
    assert "96 points per state" in "\n".join(described(dataset, tmp_path / "x.nc"))
    with xarray.open_dataset(tmp_path / "x.nc") as again:
        assert again["state"].values.tolist()[0] == "turning_point"
