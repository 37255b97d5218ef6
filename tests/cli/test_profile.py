"""Studies with another shape of punch and another control of its loading: [profile] and [loading]."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray
from click.testing import Result

from gradhesion.cli.dataset import compute
from gradhesion.cli.study import study_from
from gradhesion.core import draw_curves
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.profile import Harmonic, Profile

CONTROLS = ("displacement", "load", "machine")
SHAPE = {"exponent": 1.7, "harmonics": [{"n": 1, "cos": 1.0}, {"n": 3, "sin": -0.2}]}
PROFILE = Profile(exponent=1.7, harmonics=(Harmonic(n=1), Harmonic(n=3, cos=0.0, sin=-0.2)))


@pytest.fixture
def shaped(data: dict[str, Any]) -> Callable[..., dict[str, Any]]:
    """A small study of a shape, under a control; a machine has several stiffnesses."""

    def study(control: str = "machine", **changes: Any) -> dict[str, Any]:
        parameters = data["parameters"] | {"lambda_over_R": 0.3, "a_max_over_R": [0.6, 0.8]}
        stiffness = {"machine_stiffness": [0.1, 3.0, 70.0]} if control == "machine" else {}
        return (
            data | {"parameters": parameters, "profile": SHAPE, "loading": {"control": control} | stiffness} | changes
        )

    return study


@pytest.mark.parametrize("control", CONTROLS)
def test_the_file_says_what_shape_and_control_it_is_of(
    control: str,
    shaped: Callable[..., dict[str, Any]],
    gradhesion: Callable[..., Result],
    write_study: Callable[[str], Path],
    tmp_path: Path,
) -> None:
    path = tmp_path / "x.nc"
    assert gradhesion("run", write_study(study_from(shaped(control)).text), "-o", path).exit_code == 0
    with netCDF4.Dataset(path) as file:
        assert file.control == control
        machine = ["machine_stiffness"] if control == "machine" else []
        assert [*file["pull_off_force"].dimensions] == ["k", "A", *machine, "a_max_over_R"], "stiffness before the rim"
        assert file.profile == "r^1.7/(1.7 R^0.7) + lambda A [(1 - cos(2 pi x)) - 0.2 sin(6 pi x)], x = r/lambda"
        assert ("without its jump-out" in file["dissipated_energy"].long_name) == (control == "load")
    told = gradhesion("info", path).stdout
    assert "profile: r^1.7/(1.7 R^0.7)" in told
    assert f"control: {'displacement through a machine' if control == 'machine' else control}" in told


def test_the_defaults_written_out_are_the_defaults(data: dict[str, Any]) -> None:
    plain = compute(study_from(data))
    profile = {"exponent": 2.0, "harmonics": [{"n": 1, "cos": 1, "sin": 0}]}
    written = compute(study_from(data | {"profile": profile, "loading": {"control": "displacement"}}))
    xarray.testing.assert_identical(plain.drop_attrs(), written.drop_attrs())
    assert plain.attrs["profile"] == written.attrs["profile"] == "r^2/(2 R) + lambda A [1 - cos(2 pi x)], x = r/lambda"


@pytest.mark.parametrize("control", CONTROLS)
def test_curves_of_any_shape_and_control_are_drawn(shaped: Callable[..., dict[str, Any]], control: str) -> None:
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
