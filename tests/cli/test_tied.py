"""Parameters in the variables of the similarity: lambda_over_L, chi and a_max_over_L in the place of their kin."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray
from click.testing import Result

from gradhesion.cli.dataset.dataset import compute
from gradhesion.cli.study.reading import load_study, study_from
from gradhesion.core import PARAMETERS, solve
from gradhesion.core.closed.reduced import parameters_from

Call = Callable[..., Result]
SAMPLE = ("--sample", "12", "--seed", "2")
"""Half of the scenes; those of a changed amplitude among them."""


@pytest.fixture
def tied(data: dict[str, Any]) -> dict[str, Any]:
    """The small study in reduced variables."""
    for name in ("lambda_over_R", "A", "a_max_over_R"):
        del data["parameters"][name]
    data["parameters"] |= {"lambda_over_L": [0.2, 0.7], "chi": [0.0, 0.4, 1.3], "a_max_over_L": [2.5, float("inf")]}
    return data


def test_they_are_axes_and_the_parameters_follow(tied: dict[str, Any]) -> None:
    dataset = compute(study_from(tied))
    assert list(dataset["pull_off_force"].dims) == ["k", "lambda_over_L", "chi", "a_max_over_L"]
    assert dataset["lambda_over_R"].dims == ("k", "lambda_over_L")
    assert dataset["A"].dims == ("k", "lambda_over_L", "chi")
    assert dataset["a_max_over_R"].dims == ("k", "a_max_over_L")
    assert {*PARAMETERS} <= {*dataset["pull_off_force"].coords}


def test_values_are_those_of_the_parameters(tied: dict[str, Any]) -> None:
    dataset = compute(study_from(tied))
    names = ("k", "nu", "modulus", "c0_over_R", "lambda_over_L", "chi", "a_max_over_L")
    given = xarray.broadcast(*(dataset[name] for name in names))
    made = parameters_from({name: one.values for name, one in zip(names, given, strict=True)})
    for name, values in solve(made, tied["outputs"]).items():
        np.testing.assert_array_equal(dataset[name], values)
    for name in ("lambda_over_R", "A", "a_max_over_R"):
        np.testing.assert_array_equal(dataset[name].broadcast_like(given[0]).transpose(*given[0].dims), made[name])


@pytest.mark.slow
@pytest.mark.parametrize("layout", ["grid", "points"])
def test_the_file_is_the_same_in_whatever_blocks_and_is_verified(
    layout: str,
    tied: dict[str, Any],
    gradhesion: Call,
    write_study: Callable[[str], Path],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    if layout == "points":
        tied["parameters"] |= {"k": 0.31, "chi": [0.0, 0.4]}
    study, path = write_study(study_from(tied | {"layout": layout}).text), tmp_path / "x.nc"
    computed = compute(load_study(study))
    monkeypatch.setenv("GRADHESION_CHUNK", "2")
    assert gradhesion("run", study, "-o", path).exit_code == 0
    with xarray.open_dataset(path) as written:
        assert set(written.coords) == set(computed.coords)
        for name in computed.variables:
            np.testing.assert_array_equal(written[name].values, computed[name].values)
    told = " ".join(gradhesion("info", path).stdout.split())
    if layout == "grid":
        assert "chi 0, 0.4, 1.3" in told
        assert told.count("following from these") == 1
    assert gradhesion("plot", path).exit_code == 0
    result = gradhesion("verify", path, *SAMPLE)
    assert result.exit_code == 0, result.stdout + result.stderr
    last = result.stdout.split("worst of each")[1]
    assert all(f"{name} " in last for name in ("lambda_over_R", "A", "a_max_over_R"))
    with netCDF4.Dataset(path, "a") as file:
        file["A"][-1] *= 1 + 1e-12
    assert gradhesion("verify", path, *SAMPLE).exit_code == 3


def test_scenes_of_one_similarity_have_one_force(tied: dict[str, Any]) -> None:
    """At one k nothing depends on the material any more."""
    tied["parameters"] |= {"k": 0.31, "nu": [-0.3, 0.4], "modulus": [50.0, 7e4], "c0_over_R": [0.02, 5.0]}
    force = compute(study_from(tied))["pull_off_force"].transpose("nu", "modulus", "c0_over_R", ...).values
    np.testing.assert_allclose(force, np.broadcast_to(force[0, 0, 0], force.shape), rtol=1e-12)
