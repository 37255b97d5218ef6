"""Keys of a map beyond its parameters: reduced variables, shapes and controls, several solvers, random roughness."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import xarray

import gradhesion as gr
from gradhesion.cli.dataset import compute
from gradhesion.cli.study import study_from
from gradhesion.core import FAILED, FLAGS, PARAMETERS, draw_curves, solve
from gradhesion.core.answers.spectrum import Spectrum, random_profile
from gradhesion.core.closed.reduced import jump_in_radius_of_envelope, parameters_from
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.profile import Harmonic, Profile
from tests.cli.conftest import Call, Run

Study = Callable[..., dict[str, Any]]
REDUCED = {
    "similarity": {"lambda_over_L": [0.2, 0.7], "chi": [0.0, 0.4, 1.3], "a_max_over_L": [2.5, float("inf")]},
    "jump-in": {"lambda_over_R": [0.11, 0.47], "A": [0.0, 0.023], "a_max_over_a2": [0.7, 2.0, float("inf")]},
}
FOLLOW = {
    "similarity": {"lambda_over_R": "k lambda_over_L", "A": "k lambda_over_L chi", "a_max_over_R": "k a_max_over_L"},
    "jump-in": {"a_max_over_R": "k lambda_over_R A a_max_over_a2"},
}
"""What follows, and from what."""
CONTROLS = ("displacement", "load", "machine")
SHAPE = {"exponent": 1.7, "harmonics": [{"n": 1, "cos": 1.0}, {"n": 3, "sin": -0.2}]}
PROFILE = Profile(exponent=1.7, harmonics=(Harmonic(n=1), Harmonic(n=3, cos=0.0, sin=-0.2)))
SEVERAL = ["envelope", "exact", "asymptotic"]
SPECTRUM: dict[str, Any] = {"hurst": 0.8, "first": 1, "last": 9, "realisations": 4, "seed": 3}


@pytest.fixture
def reduced(data: dict[str, Any]) -> Study:
    def study(kind: str = "jump-in", **parameters: Any) -> dict[str, Any]:
        table = {name: value for name, value in data["parameters"].items() if name not in FOLLOW[kind]}
        return data | {"parameters": table | REDUCED[kind] | parameters}

    return study


@pytest.mark.parametrize("kind", REDUCED)
def test_reduced_variables_are_axes_and_parameters_follow(kind: str, reduced: Study) -> None:
    study = reduced(kind)
    dataset = compute(study_from(study))
    assert list(dataset["pull_off_force"].dims) == ["k", *REDUCED[kind]]
    assert {*PARAMETERS} <= {*dataset["pull_off_force"].coords}
    assert {name: " ".join(map(str, dataset[name].dims)) for name in FOLLOW[kind]} == FOLLOW[kind]
    given = dict(zip(names := ("k", "nu", "modulus", "c0_over_R", *REDUCED[kind]), xarray.broadcast(*(dataset[name] for name in names)), strict=True))  # fmt: skip
    numbers = {name: one.values for name, one in given.items()}
    if kind == "similarity":
        made = parameters_from(numbers)
    else:
        made = {name: numbers[name] for name in names if name != "a_max_over_a2"}
        made["a_max_over_R"] = jump_in_radius_of_envelope(*made.values()) * numbers["a_max_over_a2"]
    for name in FOLLOW[kind]:
        np.testing.assert_array_equal(dataset[name].broadcast_like(given["k"]).transpose(*given["k"].dims), made[name])
    for name, values in solve(made, study["outputs"]).items():
        np.testing.assert_array_equal(dataset[name], values)


def test_points_take_reduced_variables(reduced: Study) -> None:
    lists = {"k": [0.0, 0.2, 0.4], "lambda_over_R": [0.02, 0.03, 0.01], "A": [0.01, 9.0, 0.02]}
    dataset = compute(study_from(reduced(**lists) | {"layout": "points", "method": {"solver": "asymptotic"}}))
    assert dataset["a_max_over_R"].dims == ("scene",)
    assert (dataset["status"].values & FLAGS["no_value"]).tolist() == [0, FLAGS["no_value"], 0]
    assert np.isfinite(dataset["pull_off_force"].values).tolist() == [True, False, True]


def test_curves_take_reduced_variables(reduced: Study) -> None:
    study = reduced(k=0.31, lambda_over_R=0.1, A=[0.01, 9.0], a_max_over_a2=[1.5, 2.5])
    dataset = compute(study_from(study | {"kind": "curve", "outputs": ["effective"]}))
    assert (dataset["status"].values & FAILED).tolist() == [[0, 0], 2 * [FLAGS["no_value"]]]
    reached = dataset["effective_contact_radius"].max("effective_point")
    np.testing.assert_allclose(reached[0], dataset["a_max_over_R"][0], rtol=1e-15)
    assert reached[1].isnull().all()


def test_where_there_is_no_jump_in_radius_there_is_no_value(reduced: Study, ran: Run) -> None:
    said, dataset, _ = ran(reduced(A=[0.0, 0.023, 9.0]), "--quiet", exit_code=3)
    assert "12 of 36 scenes failed" in said
    strong = dataset["A"] == 9.0
    for name in ("pull_off_force", "a_max_over_R"):
        assert (dataset[name].isnull() == strong).all()
    assert (((dataset["status"] & FAILED) != 0) == strong).all()


@pytest.fixture
def shaped(data: dict[str, Any]) -> Study:
    def study(control: str = "machine", **changes: Any) -> dict[str, Any]:
        parameters = data["parameters"] | {"lambda_over_R": 0.3, "a_max_over_R": [0.6, 0.8]}
        stiffness = {"machine_stiffness": [0.1, 3.0, 70.0]} if control == "machine" else {}
        loading = {"control": control} | stiffness
        return data | {"parameters": parameters, "profile": SHAPE, "loading": loading} | changes

    return study


@pytest.mark.parametrize("control", CONTROLS)
def test_the_file_says_what_shape_and_control_it_is_of(control: str, shaped: Study, ran: Run, gradhesion: Call) -> None:
    _, dataset, path = ran(shaped(control))
    machine = ["machine_stiffness"] if control == "machine" else []
    assert [*dataset["pull_off_force"].dims] == ["k", "A", *machine, "a_max_over_R"], "stiffness before the rim"
    profile = "r^1.7/(1.7 R^0.7) + lambda A [(1 - cos(2 pi x)) - 0.2 sin(6 pi x)], x = r/lambda"
    assert (dataset.attrs["control"], dataset.attrs["profile"]) == (control, profile)
    assert ("without its jump-out" in dataset["dissipated_energy"].attrs["long_name"]) == (control == "load")
    told = gradhesion("info", path).stdout
    assert "profile: r^1.7/(1.7 R^0.7)" in told
    assert f"control: {'displacement through a machine' if control == 'machine' else control}" in told


@pytest.mark.parametrize("control", CONTROLS)
def test_curves_of_any_shape_and_control_are_drawn(shaped: Study, control: str) -> None:
    curves = ["equilibrium", "path", "smooth", "jumps"]
    stiffness = {"machine_stiffness": 3.0} if control == "machine" else {}
    scene = {"k": 0.31, "nu": 0.27, "modulus": 430.0, "c0_over_R": 0.013, "lambda_over_R": 0.3, "a_max_over_R": 0.8}
    keys = {"kind": "curve", "outputs": curves, "parameters": scene | {"A": [0.0, 0.02]}}
    dataset = compute(study_from(shaped(control, **keys, loading={"control": control} | stiffness)))
    for i, amplitude in enumerate([0.0, 0.02]):
        found, status = draw_curves(scene | {"A": amplitude} | stiffness, curves, PROFILE, Loading(control=control))
        assert int(dataset["status"][i]) == status
        for name in ("load", "path_indentation", "path_branch", "smooth_load"):
            np.testing.assert_array_equal(dataset[name][i].values[: found[name].size], found[name])


@pytest.mark.parametrize("shape", [{}, {"profile": SHAPE | {"exponent": 3.0}}])
def test_each_solver_gives_what_it_gives_alone(shape: dict[str, Any], data: dict[str, Any]) -> None:
    together = compute(study_from(data | shape | {"method": {"solver": SEVERAL}}))
    assert next(iter(together["pull_off_force"].dims)) == "solver"
    assert together["solver"].values.tolist() == SEVERAL, "in the order of the study"
    study = study_from(data | shape)
    scenes = dict(zip(PARAMETERS, xarray.broadcast(*(together[name] for name in PARAMETERS)), strict=True))
    for solver in SEVERAL:
        own = solve({name: one.values for name, one in scenes.items()}, data["outputs"], solver=solver, profile=study.profile)  # fmt: skip
        for name, values in own.items():
            found = together[name].sel(solver=solver).transpose(*scenes["k"].dims)
            np.testing.assert_allclose(found, values, rtol=8 * 2.0**-52)  # rims that share a trace share roots
    exact, envelope = (together["pull_off_force"].sel(solver=one, A=0.023) for one in ("exact", "envelope"))
    assert (exact != envelope).any(), "the solvers differ"
    assert compute(study_from(data | {"method": {"solver": ["envelope"]}})).sizes["solver"] == 1
    assert "solver" not in compute(study_from(data | {"method": {"solver": "envelope"}})).variables


def test_the_contact_is_checked_unless_the_study_says_no(data: dict[str, Any]) -> None:
    """Only the exact solver checks it; the values are the same without."""
    data["parameters"] |= {"A": [0.0, 0.9]}
    data |= {"outputs": ["dissipated_energy"], "method": {"solver": ["exact", "envelope"]}}
    checked = compute(study_from(data))
    no_disc = checked["status"] & 1
    assert no_disc.sel(solver="exact", A=0.9).any()
    assert not no_disc.sel(solver="exact", A=0.0).any()
    assert not no_disc.sel(solver="envelope").any()
    data["method"] |= {"check_contact": False}
    unchecked = compute(study_from(data))
    xarray.testing.assert_equal(checked["status"] & ~1, unchecked["status"])
    xarray.testing.assert_equal(checked["dissipated_energy"], unchecked["dissipated_energy"])


@pytest.fixture
def rough() -> dict[str, Any]:
    parameters = {"k": [0.0, 0.31], "nu": 0.27, "modulus": 430.0, "c0_over_R": 0.013, "lambda_over_R": 0.31}
    parameters |= {"A": [0.002, 0.007], "a_max_over_R": [0.4, 0.7]}
    outputs = ["pull_off_force", "dissipated_energy", "loading_jumps", "wave_slope"]
    return {"outputs": outputs, "parameters": parameters, "profile": {"exponent": 2.0, "spectrum": SPECTRUM}}


def test_each_realisation_is_its_series_to_the_last_bit(rough: dict[str, Any]) -> None:
    read = study_from(rough)
    assert read.spectrum == Spectrum(**SPECTRUM), "by which tests/core draw the same, whatever their number"
    found = compute(read)
    assert list(found["status"].dims) == ["k", "A", "a_max_over_R", "realisation"]
    assert found["realisation"].values.tolist() == [0, 1, 2, 3]
    assert "rms height over wavelength" in found["A"].attrs["long_name"]
    assert "Hurst exponent 0.8" in found.attrs["profile"]
    for number in (0, 3):
        waves = random_profile(read.spectrum, number).harmonics
        series = {"harmonics": [{"n": wave.n, "cos": wave.cos, "sin": wave.sin} for wave in waves]}
        one = compute(study_from(rough | {"profile": series}))
        for name in (*rough["outputs"], "status"):
            np.testing.assert_array_equal(found[name].isel(realisation=number), one[name])


def test_realisations_with_points_several_solvers_and_units(rough: dict[str, Any]) -> None:
    points, grid = (compute(study_from(rough | {"layout": layout})) for layout in ("points", "grid"))
    assert dict(points.sizes) == {"scene": 2, "realisation": 4}
    for i in (0, 1):
        scene = grid["pull_off_force"].isel(k=i, A=i, a_max_over_R=i)
        np.testing.assert_array_equal(points["pull_off_force"].isel(scene=i), scene)
    solvers = compute(study_from(rough | {"method": {"solver": ["exact", "asymptotic"]}}))
    np.testing.assert_array_equal(solvers["pull_off_force"].sel(solver="exact"), grid["pull_off_force"])
    assert np.isfinite(solvers["pull_off_force"]).all()
    probe = {"k": 0.0, "nu": 0.3, "R": ["1 um", "2 um"], "E_star": 1e9, "work_of_adhesion": 0.05, "wavelength": "0.3 um"}  # fmt: skip
    made = gr.solve(probe, "pull_off_force", amplitude="1 nm", profile={"spectrum": SPECTRUM})
    assert list(made["pull_off_force_si"].dims) == ["R", "realisation"]
    size = 1.5 * np.pi * made["R"] * 0.05
    np.testing.assert_allclose(made["pull_off_force_si"], made["pull_off_force"] * size, rtol=1e-15)
    assert "rms height" in made["amplitude"].attrs["long_name"]
