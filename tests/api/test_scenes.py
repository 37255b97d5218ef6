"""`gr.solve` and `gr.curves`: what they take, what they refuse, and that they give what a study or the core gives."""

import math
import tomllib
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray

import gradhesion as gr
from gradhesion import core
from gradhesion.cli.dataset import compute
from gradhesion.cli.study import study_from
from gradhesion.core.problem.status import OF_EVERY_MAP

PUNCH: dict[str, Any] = {"k": 0.31, "nu": 0.27, "modulus": 430.0, "c0_over_R": 0.013, "lambda_over_R": 0.17, "A": 0.023, "a_max_over_R": 1.7}  # fmt: skip
NUMBERS = [
    (0.1, ()), (1, ()), (np.float32(0.1), ()), (np.array(0.1), ()), (xarray.DataArray(0.1), ()), ([0.1], ("A",)), ((0.1, 0.2), ("A",)), (range(3), ("A",)),
    (np.zeros(1), ("A",)), (pd.Series([0.1, 0.2]), ("index",)), (xarray.DataArray([0.1], dims="x"), ("x",)), ({"start": 0.1, "stop": 0.3, "num": 2}, ("A",)),
    (xarray.DataArray([[0.1]], dims=["x", "y"], coords={"x": [1], "y": [2]}).stack(z=["x", "y"]), ("z",)), ([-0.0, 0.1], ("A",)),
]  # fmt: skip


def mistakes_of(*arguments: Any, call: Any = gr.solve, **keywords: Any) -> str:
    """What a call is refused for."""
    with pytest.raises(gr.StudyError) as refused:
        call(*arguments, **keywords)
    assert str(refused.value) == "\n".join(refused.value.mistakes)
    assert isinstance(refused.value, ValueError)
    assert all(sentence.startswith(f"gr.{call.__name__}: ") for sentence in refused.value.mistakes)
    return str(refused.value)


def test_smooth_punches_have_the_force_that_is_known_and_k_may_be_1_where_nu_is_a_half() -> None:
    k, nu = xarray.DataArray([0.0, 0.25, 0.9, 1.0], dims="x"), xarray.DataArray([0.3, 0.3, 0.3, 0.5], dims="x")
    found = gr.solve(PUNCH | {"k": k, "nu": nu, "A": 0.0, "a_max_over_R": math.inf}, "pull_off_force")
    np.testing.assert_allclose(found["pull_off_force"], (3 + k) / 3, rtol=1e-14)
    assert found["pull_off_force"].attrs["long_name"] == gr.OUTPUTS["pull_off_force"]
    assert found["status"].attrs["flag_meanings"].split() == list(OF_EVERY_MAP)
    assert found.attrs["title"] == "pull_off_force"


def test_lists_of_one_length_are_a_grid_and_keep_their_order() -> None:
    A, wavelength = [0.02, 0.0, 0.01], [0.4, 0.1, 0.2]
    found = gr.solve(PUNCH | {"A": A, "lambda_over_R": np.array(wavelength)}, "pull_off_force")
    assert dict(found.sizes) == {"lambda_over_R": 3, "A": 3}
    assert found["A"].values.tolist() == A
    assert "study" not in found.attrs, "whose axes rise or fall"
    assert found["lambda_over_R"].values.tolist() == wavelength
    one = gr.solve(PUNCH | {"A": 0.02, "lambda_over_R": 0.1}, "pull_off_force")["pull_off_force"]
    assert found["pull_off_force"].sel(A=0.02, lambda_over_R=0.1).item() == one.item()
    assert found["pull_off_force"].values[1, 0] == one.item()


def test_a_keyword_stands_in_the_place_of_what_the_mapping_has_whatever_the_threads() -> None:
    A = np.linspace(0.0, 0.05, 40)
    many, one = gr.solve(PUNCH, A=A, k=[0.1, 0.7], threads=3), gr.solve(PUNCH | {"A": A, "k": [0.1, 0.7]}, threads=1)
    xarray.testing.assert_identical(many, one)
    assert PUNCH["A"] == 0.023, "the mapping stays as it is"


@pytest.mark.parametrize(("value", "dims"), NUMBERS)
def test_numbers_of_all_kinds_are_numbers(value: Any, dims: tuple[str, ...]) -> None:
    found = gr.solve(PUNCH | {"A": value}, "pull_off_force", solver="envelope")
    assert found["pull_off_force"].dims == found["A"].dims == dims
    assert found["A"].dtype == np.float64
    assert not np.signbit(found["A"]).any(), "negative zeros are zeros"
    one = gr.solve(PUNCH | {"A": float(np.ravel(found["A"])[-1])}, "pull_off_force", solver="envelope")
    assert one["pull_off_force"].item() == pytest.approx(np.ravel(found["pull_off_force"])[-1], rel=1e-15)


REFUSED: dict[str, list[dict[str, Any]]] = {
    "moduls = 3.0": [{"moduls": 3.0}],
    "zzz": [{"zzz": np.arange(3)}],
    "profil": [{"profil": None}],
    "outputs_": [{"outputs_": ["x"]}],
    "layout": [{"layout": "points"}],
    "A = -0.1": [{"A": -0.1}],
    "A[2] = -0.1": [{"A": [0.1, 0.2, -0.1, 0.3]}],
    "A[1, 1] = -0.4": [{"A": xarray.DataArray([[0.1, 0.2], [0.3, -0.4]], dims=["x", "y"])}],
    "A": [
        {"A": [0.1, 0.2, 0.1]}, {"A": None}, {"A": np.zeros((2, 3))}, {"A": xarray.DataArray([0.1], dims="status")},
        {"A": xarray.DataArray([0.1], dims="k")},
    ],
    "A = []": [{"A": []}],
    'A = "big"': [{"A": "big"}],
    "A = true": [{"A": True}],
    "A[1] = 1j": [{"A": [0.1, 1j]}],
    "A[1] = nan": [{"A": [0.1, math.nan]}, {"A": np.ma.array([0.1, 0.2], mask=[0, 1])}],
    "A: rows of different lengths": [{"A": [[0.1], [0.1, 0.2]]}],
    "A: an array of 1 x 2 x 1 values": [{"A": [[[0.1], [0.2]]]}],
    "parameters: they make 8,000,000,000 scenes": [{name: np.linspace(0.1, 0.2, 2_000) for name in ("A", "k", "nu")}],
    "k = [0.0, 1.0]": [{"k": [0.0, 1.0]}],
    "k = 1.0": [{"k": xarray.DataArray([0.0, 1.0], dims="x"), "nu": xarray.DataArray([0.5, 0.3], dims="x")}],
    "modulus = 430.0": [{"R": "1 um"}],
    "machine_stiffness = 3.0": [{"machine_stiffness": 3.0}],
}  # fmt: skip
"""What each call is refused for: the key, and its value."""


CURVES: list[tuple[str, dict[str, Any], str]] = [
    ("A: ", {"A": [0.1, 0.0, 0.2]}, "path"), ("A: ", {"A": xarray.DataArray([0.1], dims="x")}, "path"),
    ("parameters: they make 1,001 scenes", {"A": np.linspace(0.0, 0.1, 1001)}, "path"),
    ('outputs[0] = "pull_off_force": ', {}, "pull_off_force"), ('outputs[0] = "pathh": ', {}, "pathh"),
    ("contact_radius_over_R[1] = 0.9: ", {"a_max_over_R": 0.5, "contact_radius_over_R": [0.2, 0.9]}, "pressure"),
    ("contact_radius_over_R", {"contact_radius_over_R": [0.2]}, "path"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("what", "changes", "outputs"), [*((what, one, "") for what, calls in REFUSED.items() for one in calls), *CURVES]
)
def test_what_is_refused(what: str, changes: dict[str, Any], outputs: str) -> None:
    """Of curves, and where there are no outputs of a map."""
    call, more = (gr.curves, {"outputs": outputs}) if outputs else (gr.solve, {})
    assert f"gr.{call.__name__}: {what}" in mistakes_of(PUNCH, call=call, **more, **changes)


def test_parameters_are_a_mapping_or_a_table_of_pandas() -> None:
    frame = pd.DataFrame({"A": [0.0, 0.01], "k": [0.1, 0.2]}, index=pd.Index([7, 8], name="test"))
    rest = {name: value for name, value in PUNCH.items() if name not in frame}
    found = gr.solve(frame, **rest, outputs="pull_off_force")
    assert found["pull_off_force"].dims == found["A"].dims == found["k"].dims == ("test",)
    assert found["test"].values.tolist() == [7, 8]
    assert "parameters: a mapping from names to values is expected, not a list" in mistakes_of([0.1])


def test_what_is_missing_and_unknown_is_said_at_once() -> None:
    refused = mistakes_of({"k": 0.3, "modulos": 5.0}, ["pull_of_force"], solver="exactly", control="lode")
    for what in ("nu", "lambda_over_R", "modulos = 5.0", 'outputs[0] = "pull_of_force"', 'solver = "exactly"'):
        assert f"gr.solve: {what}: " in refused
    assert 'gr.solve: control = "lode": ' in refused
    assert refused.count("did you mean") == 4
    assert "gr.solve: modulus" not in refused, "it is misspelt and not missing"
    assert "gr.solve: threads = 0: " in mistakes_of(PUNCH, threads=0)
    assert "gr.solve: outputs = []: " in mistakes_of(PUNCH, [])
    for call in (gr.solve, gr.curves):
        assert f"gr.{call.__name__}: outputs: " in mistakes_of(PUNCH, None, call=call)
    assert "gr.solve: profile.exponent = 0.5: " in mistakes_of(PUNCH, profile={"exponent": 0.5})


def test_dimensions_of_one_name_have_one_length_and_one_set_of_coordinates() -> None:
    A = xarray.DataArray([0.0, 0.01], dims="x", coords={"x": [1, 2]})
    other = xarray.DataArray([0.0, 0.1], dims="x")
    for wrong in (xarray.DataArray([0.0, 0.1, 0.2], dims="x"), other.assign_coords(x=[1, 3])):
        told = mistakes_of(PUNCH | {"A": A, "k": wrong})
        assert "dimensions of the same name differ in length or coordinates" in told
    assert gr.solve(PUNCH | {"A": A, "k": other}, "pull_off_force")["x"].values.tolist() == [1, 2]


def test_an_array_may_follow_an_axis() -> None:
    k = np.array([0.0, 0.3, 0.6])
    A = xarray.DataArray(0.01 + 0.01 * k, dims="k")
    found = gr.solve(PUNCH | {"k": k, "A": A}, "pull_off_force")
    assert found["pull_off_force"].dims == found["A"].dims == ("k",)
    alone = gr.solve(PUNCH | {"k": 0.6, "A": float(A[2])}, "pull_off_force")
    assert found["pull_off_force"].sel(k=0.6).item() == alone["pull_off_force"].item()


def test_points_are_all_over_all_points_and_a_range_beside_them_is_an_axis() -> None:
    A = xarray.DataArray([0.01, 0.02], dims="scene")
    points = gr.solve(PUNCH | {"A": A}, "pull_off_force")
    assert all(points[name].dims == ("scene",) for name in PUNCH)
    assert 'layout = "points"' in points.attrs["study"]
    both = gr.solve(PUNCH | {"A": A, "nu": {"start": 0.1, "stop": 0.3, "num": 2}}, "pull_off_force")
    assert {*both["pull_off_force"].dims} == {"scene", "nu"}
    assert "study" not in both.attrs, "a study would pair them"


def test_a_million_scenes_need_no_text_of_a_million_numbers() -> None:
    rng = np.random.default_rng(3)
    A = xarray.DataArray(rng.uniform(0.0, 1e-3, 1_000_000), dims="sample")
    modulus = xarray.DataArray(rng.uniform(300.0, 500.0, 1_000_000), dims="sample")
    found = gr.solve(PUNCH | {"A": A, "modulus": modulus}, "pull_off_force", solver="envelope")
    assert bool(np.isfinite(found["pull_off_force"]).all())
    assert len(repr(found.attrs)) < 5_000
    for count, has_study in ((10_000, True), (100_000, False)):
        axis = gr.solve(PUNCH | {"A": np.linspace(0.0, 1e-3, count)}, "pull_off_force", solver="envelope")
        assert ("study" in axis.attrs) == has_study


def test_what_has_no_effect_may_be_left_out() -> None:
    found = gr.solve(k=[0.0], nu=0.3, A=xarray.DataArray([0.0, 0.0], dims="x"), modulus=400.0, outputs="pull_off_force")
    np.testing.assert_allclose(found["pull_off_force"], 1.0, rtol=1e-14)
    assert found["a_max_over_R"].item() == math.inf
    assert found["c0_over_R"].attrs["comment"] == "without effect where k = 0; the study leaves it out"
    refused = mistakes_of(k=[0.0], nu=0.3, A=xarray.DataArray([0.0, 0.1], dims="x"), modulus=400.0)
    assert "gr.solve: lambda_over_R: unless A = 0 everywhere, this is required" in refused


def test_curves_are_those_of_a_study() -> None:
    keys = {"kind": "curve", "outputs": ["path", "jumps"], "title": "path, jumps"}
    expected = gr.run(keys | {"parameters": PUNCH | {"A": [0.01, 0.03]}})
    found = gr.curves(PUNCH | {"A": [0.01, 0.03]}, ["path", "jumps"])
    xarray.testing.assert_identical(found.drop_attrs(), expected.drop_attrs())
    assert study_from(tomllib.loads(found.attrs["study"])).kind == "curve"
    pairs = {"A": xarray.DataArray([0.03, 0.01], dims="scene"), "k": xarray.DataArray([0.1, 0.2], dims="scene")}
    assert gr.curves(PUNCH | pairs, "path")["path_load"].dims == ("scene", "path_point")


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
    loading, method = dict(study.get("loading", {})), study.get("method", {})
    control = loading.pop("control", None)
    values = study["parameters"] | study.get("physical", {}) | loading
    if study.get("layout") == "points":
        values = {key: xarray.DataArray(v, dims="scene") if isinstance(v, list) else v for key, v in values.items()}
    return values | {"profile": study.get("profile"), "control": control, "solver": method.get("solver")}


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
    assert ({*found["A"].dims}, found["k"].dims) == ({"row", "column"}, ("column",))
    assert "study" not in found.attrs, "no study says this"


def test_what_follows_from_others_stands_over_their_dimensions() -> None:
    R = xarray.DataArray([1e-6, 2e-6], dims="tip")
    found = gr.solve(AFM | {"R": R, "k": [0.0, 0.31], "nu": 0.27, "A": 0.023}, "pull_off_force")
    assert found["modulus"].dims == found["lambda_over_R"].dims == ("tip",)
    np.testing.assert_allclose(found["modulus"], 1e9 * R.values / 0.05, rtol=4 * 2.0**-52)
    newtons = found["pull_off_force"] * (1.5 * math.pi * 0.05 * R.rename(None))
    np.testing.assert_allclose(found["pull_off_force_si"], newtons, rtol=8 * 2.0**-52)
