"""Studies with another shape of punch and another control of its loading: [profile] and [loading]."""

import json
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray
from click.testing import Result

from gradhesion.cli.dataset.dataset import compute
from gradhesion.cli.names.curves import CURVES, STATE_CURVES
from gradhesion.cli.study.reading import load_study, study_from
from gradhesion.core import draw_curves, solve
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.profile import Harmonic, Profile

Call = Callable[..., Result]
SCENES = json.loads((Path(__file__).parents[1] / "reference" / "general.json").read_text())["scenes"]
OUTPUTS = ["pull_off_force", "dissipated_energy", "loading_jumps", "unloading_jumps"]
CONTROLS = ("displacement", "load", "machine")
SHAPE = {"exponent": 1.7, "harmonics": [{"n": 1, "cos": 1.0}, {"n": 3, "sin": -0.2}]}

EPS = 2.0**-52


@pytest.fixture
def shaped(data: dict[str, Any]) -> dict[str, Any]:
    """A small study of a machine of several stiffnesses."""
    parameters = data["parameters"] | {"lambda_over_R": 0.3, "a_max_over_R": [0.6, 0.8]}
    loading = {"control": "machine", "machine_stiffness": [0.1, 3.0, 70.0]}
    return data | {"parameters": parameters, "profile": SHAPE, "loading": loading}


@pytest.mark.parametrize("control", CONTROLS)
def test_reference_scenes_of_every_control(control: str) -> None:
    scenes = [scene for scene in SCENES if scene["parameters"]["control"] == control]
    assert scenes
    for scene in scenes:
        parameters = dict(scene["parameters"])
        study: dict[str, Any] = {"outputs": OUTPUTS, "loading": {"control": parameters.pop("control")}}
        study["profile"] = {name: parameters.pop(name) for name in ("exponent", "harmonics")}
        if control == "machine":
            study["loading"]["machine_stiffness"] = parameters.pop("machine_stiffness")
        dataset = compute(study_from(study | {"parameters": parameters}))
        for name in OUTPUTS:  # the digits that the independent quadrature promises
            assert float(dataset[name]) == pytest.approx(scene["expected"][name], rel=0 if "jumps" in name else 1e-9)


def test_the_stiffness_is_an_axis_before_the_radius(shaped: dict[str, Any]) -> None:
    dataset = compute(study_from(shaped))
    assert list(dataset["pull_off_force"].dims) == ["k", "A", "machine_stiffness", "a_max_over_R"]
    assert dataset["machine_stiffness"].values.tolist() == [0.1, 3.0, 70.0]
    assert dataset["machine_stiffness"].long_name == "stiffness S/(E* R) of the loading machine"
    names = ("k", "nu", "modulus", "c0_over_R", "lambda_over_R", "A", "machine_stiffness", "a_max_over_R")
    given = xarray.broadcast(*(dataset[name] for name in names))
    parameters = {name: one.values for name, one in zip(names, given, strict=True)}
    waves = (Harmonic(n=1), Harmonic(n=3, cos=0.0, sin=-0.2))
    found = solve(
        parameters,
        shaped["outputs"],
        profile=Profile(exponent=1.7, harmonics=waves),
        loading=Loading(control="machine"),
    )
    for name, values in found.items():
        np.testing.assert_allclose(dataset[name], values, rtol=8 * EPS)  # rims that share a trace share roots


@pytest.mark.parametrize("control", CONTROLS)
def test_the_file_says_what_shape_and_control_it_is_of(
    control: str, shaped: dict[str, Any], gradhesion: Call, write_study: Callable[[str], Path], tmp_path: Path
) -> None:
    if control != "machine":
        shaped["loading"] = {"control": control}
    study, path = write_study(study_from(shaped).text), tmp_path / "x.nc"
    computed = compute(load_study(study))
    assert gradhesion("run", study, "-o", path).exit_code == 0
    with netCDF4.Dataset(path) as file:
        assert file.control == control
        assert file.profile == "r^1.7/(1.7 R^0.7) + lambda A [(1 - cos(2 pi x)) - 0.2 sin(6 pi x)], x = r/lambda"
        assert "[profile]" in file.study
        assert ("without its jump-out" in file["dissipated_energy"].long_name) == (control == "load")
    with xarray.open_dataset(path) as written:
        for name in computed.variables:
            np.testing.assert_array_equal(written[name].values, computed[name].values)
    told = gradhesion("info", path).stdout
    assert "profile: r^1.7/(1.7 R^0.7)" in told
    assert f"control: {'displacement through a machine' if control == 'machine' else control}" in told
    assert ("without its jump-out" in told) == (control == "load")
    assert gradhesion("plot", path).exit_code == 0
    result = gradhesion("verify", path, "--sample", "4")
    assert result.exit_code == 0, result.stderr
    assert "4 of " in result.stdout


def test_the_envelopes_of_any_shape_stand_beside_the_exact_solution(
    shaped: dict[str, Any], gradhesion: Call, write_study: Callable[[str], Path], tmp_path: Path
) -> None:
    del shaped["loading"]
    path = tmp_path / "x.nc"
    study = write_study(study_from(shaped | {"method": {"solver": ["exact", "envelope"]}}).text)
    assert gradhesion("run", study, "-o", path).exit_code == 0
    with xarray.open_dataset(path) as written:
        force = written["pull_off_force"].sel(A=0.023)
        ratio = force.sel(solver="exact") / force.sel(solver="envelope")
        assert 0.5 < float(ratio.min()) < float(ratio.max()) < 1.0
    result = gradhesion("verify", path, "--sample", "8", "--seed", "1")
    assert result.exit_code == 0, result.stdout + result.stderr
    assert "solver exact and envelope" in result.stdout


@pytest.mark.parametrize("control", CONTROLS)
def test_reports_of_any_shape_and_control(shaped: dict[str, Any], control: str) -> None:
    from gradhesion.cli.errors import StudyError
    from gradhesion.core import REPORTS

    if control != "machine":
        shaped["loading"] = {"control": control}
    if control == "load":
        with pytest.raises(StudyError, match=r"outputs\[0\]"):
            study_from(shaped | {"outputs": ["energy_residual"]})
    reports = [name for name in REPORTS if control != "load" or name != "energy_residual"]
    dataset = compute(study_from(shaped | {"outputs": [*OUTPUTS, *reports]}))
    for name in reports:
        assert np.isfinite(dataset[name]).all(), name
    assert (dataset["adhesion_gain"].sel(A=0.0) == 1.0).all()


def test_the_defaults_written_out_are_the_defaults(data: dict[str, Any]) -> None:
    data["method"] = {"solver": ["exact", "envelope"]}
    plain = compute(study_from(data))
    profile = {"exponent": 2.0, "harmonics": [{"n": 1, "cos": 1, "sin": 0}]}
    written = compute(study_from(data | {"profile": profile, "loading": {"control": "displacement"}}))
    for name in plain.variables:
        np.testing.assert_array_equal(plain[name].values, written[name].values)
    assert plain.attrs["profile"] == written.attrs["profile"] == "r^2/(2 R) + lambda A [1 - cos(2 pi x)], x = r/lambda"


def test_a_shape_in_units(shaped: dict[str, Any]) -> None:
    quantities = {
        "R": "1 um",
        "E_star": "1 GPa",
        "work_of_adhesion": "50 mJ/m^2",
        "c0": "13 nm",
        "wavelength": "0.3 um",
    }
    parameters = {"k": 0.31, "nu": 0.27, "A": 0.023}
    study = shaped | {"parameters": parameters, "physical": quantities | {"a_max": "0.8 um"}}
    dataset = compute(study_from(study))
    assert dataset["dissipated_energy_si"].dims == ("machine_stiffness",)
    np.testing.assert_allclose(dataset["dissipated_energy_si"], dataset["dissipated_energy"] * 5e-14, rtol=1e-15)


def test_a_series_has_64_waves_at_most(shaped: dict[str, Any]) -> None:
    from gradhesion.cli.errors import StudyError

    shaped["profile"] = {"harmonics": [{"n": n, "cos": 1.0} for n in range(1, 66)]}
    with pytest.raises(StudyError, match=r"profile\.harmonics = ") as caught:
        study_from(shaped)
    assert len(caught.value.mistakes) == 1


def test_all_mistakes_are_told_at_once(shaped: dict[str, Any]) -> None:
    from gradhesion.cli.errors import StudyError

    shaped["profile"] = {"exponent": 0.5, "harmonics": [{"n": 0, "cos": 1.0}, {"n": 2, "tan": 1.0}]}
    shaped["loading"] = {"control": "lode", "machine_stiffness": -1.0}
    with pytest.raises(StudyError) as caught:
        study_from(shaped)
    keys = ["profile.exponent", "harmonics[0].n", "harmonics[1].tan", "loading.machine_stiffness", "loading.control"]
    for key in keys:
        assert sum(key in sentence.split(" = ")[0] for sentence in caught.value.mistakes) == 1
    assert len(caught.value.mistakes) == len(keys)


@pytest.mark.parametrize("control", CONTROLS)
def test_curves_of_any_shape_and_control_are_drawn(shaped: dict[str, Any], control: str) -> None:
    curves = ["equilibrium", "path", "smooth", "jumps"]
    loading = {"control": control} | ({"machine_stiffness": 3.0} if control == "machine" else {})
    parameters = shaped["parameters"] | {"k": 0.31, "A": [0.0, 0.02], "a_max_over_R": 0.8}
    study = study_from(shaped | {"kind": "curve", "outputs": curves, "loading": loading, "parameters": parameters})
    dataset = compute(study)
    assert set(CURVES) - set(curves) == {"asymptotic", "envelope", "effective", "closing_equilibrium", *STATE_CURVES}
    for i, amplitude in enumerate([0.0, 0.02]):
        scene = {name: float(np.max(dataset[name])) for name in ("k", "nu", "modulus", "c0_over_R", "lambda_over_R")}
        scene |= {"A": amplitude, "a_max_over_R": 0.8}
        scene |= {"machine_stiffness": 3.0} if control == "machine" else {}
        found, status = draw_curves(scene, curves, study.profile, Loading(control=control))
        assert int(dataset["status"][i]) == status
        for name in ("load", "path_indentation", "path_branch", "smooth_load"):
            assert np.array_equal(dataset[name][i].values[: found[name].size], found[name]), name


def test_curves_of_short_waves_are_refused_under_a_machine(shaped: dict[str, Any]) -> None:
    from gradhesion.cli.errors import StudyError

    outputs = ["path", "envelope", "asymptotic_load"]  # under a machine, which the asymptotic curve does not know
    with pytest.raises(StudyError) as caught:
        study_from(shaped | {"kind": "curve", "outputs": outputs})
    assert ["outputs[1]" in caught.value.mistakes[0], "outputs[2]" in caught.value.mistakes[1]] == [True, True]


@pytest.mark.parametrize("amplitudes", [{}, {"cos": 0.3}, {"sin": 0.2}, {"cos": 0.3, "sin": 0.2}])
def test_a_wave_is_the_same_in_a_study_and_in_python(amplitudes: dict[str, float], data: dict[str, Any]) -> None:
    text = ", ".join(f"{name} = {value}" for name, value in ({"n": 3} | amplitudes).items())
    read = study_from(data | {"profile": tomllib.loads(f"harmonics = [{{ {text} }}]")})
    assert read.profile.harmonics == (Harmonic(n=3, **amplitudes),)
