"""Parameters in the variables of the similarity, and the rim over the radius of the jump-in: `chi`, `a_max_over_a2` and kin."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from click.testing import Result

from gradhesion.cli.dataset import compute
from gradhesion.cli.study import study_from
from gradhesion.core import FAILED, FLAGS, PARAMETERS, solve
from gradhesion.core.closed.reduced import parameters_from
from gradhesion.core.closed.similarity import jump_in_radius_of_envelope

REDUCED = {
    "similarity": {"lambda_over_L": [0.2, 0.7], "chi": [0.0, 0.4, 1.3], "a_max_over_L": [2.5, float("inf")]},
    "jump-in": {"lambda_over_R": [0.11, 0.47], "A": [0.0, 0.023], "a_max_over_a2": [0.7, 2.0, float("inf")]},
}
FOLLOW = {
    "similarity": {"lambda_over_R": "k lambda_over_L", "A": "k lambda_over_L chi", "a_max_over_R": "k a_max_over_L"},
    "jump-in": {"a_max_over_R": "k lambda_over_R A a_max_over_a2"},
}
"""What follows, and from what."""


@pytest.fixture
def reduced(data: dict[str, Any]) -> Callable[..., dict[str, Any]]:
    """The small study in such variables."""

    def study(kind: str = "jump-in", **parameters: Any) -> dict[str, Any]:
        table = {name: value for name, value in data["parameters"].items() if name not in FOLLOW[kind]}
        return data | {"parameters": table | REDUCED[kind] | parameters}

    return study


@pytest.mark.parametrize("kind", REDUCED)
def test_they_are_axes_and_values_are_those_of_the_parameters_that_follow(
    kind: str, reduced: Callable[..., dict[str, Any]]
) -> None:
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


def test_scenes_of_one_similarity_have_one_force(reduced: Callable[..., dict[str, Any]]) -> None:
    """At one k nothing depends on the material any more."""
    study = reduced("similarity", k=0.31, nu=[-0.3, 0.4], modulus=[50.0, 7e4], c0_over_R=[0.02, 5.0])
    force = compute(study_from(study))["pull_off_force"].transpose("nu", "modulus", "c0_over_R", ...).values
    np.testing.assert_allclose(force, np.broadcast_to(force[0, 0, 0], force.shape), rtol=1e-12)


def test_where_there_is_no_jump_in_radius_there_is_no_value(
    reduced: Callable[..., dict[str, Any]],
    gradhesion: Callable[..., Result],
    write_study: Callable[[str], Path],
    tmp_path: Path,
) -> None:
    study = write_study(study_from(reduced(A=[0.0, 0.023, 9.0])).text)
    result = gradhesion("run", study, "-o", tmp_path / "x.nc", "--quiet")
    assert result.exit_code == 3
    assert "12 of 36 scenes failed" in result.stderr
    with xarray.open_dataset(tmp_path / "x.nc") as dataset:
        strong = dataset["A"] == 9.0
        for name in ("pull_off_force", "a_max_over_R"):
            assert (dataset[name].isnull() == strong).all()
        assert (((dataset["status"] & FAILED) != 0) == strong).all()


def test_points_and_other_solvers_take_them_too(reduced: Callable[..., dict[str, Any]]) -> None:
    lists = {"k": [0.0, 0.2, 0.4], "lambda_over_R": [0.02, 0.03, 0.01], "A": [0.01, 9.0, 0.02]}
    for solver in ("envelope", "asymptotic"):
        dataset = compute(study_from(reduced(**lists) | {"layout": "points", "method": {"solver": solver}}))
        assert dataset["a_max_over_R"].dims == ("scene",)
        assert (dataset["status"].values & FLAGS["no_value"]).tolist() == [0, FLAGS["no_value"], 0]
        assert np.isfinite(dataset["pull_off_force"].values).tolist() == [True, False, True]


def test_curves_take_them_too(reduced: Callable[..., dict[str, Any]]) -> None:
    study = reduced(k=0.31, lambda_over_R=0.1, A=[0.01, 9.0], a_max_over_a2=[1.5, 2.5])
    dataset = compute(study_from(study | {"kind": "curve", "outputs": ["effective"]}))
    assert (dataset["status"].values & FAILED).tolist() == [[0, 0], 2 * [FLAGS["no_value"]]]
    reached = dataset["effective_contact_radius"].max("effective_point")
    np.testing.assert_allclose(reached[0], dataset["a_max_over_R"][0], rtol=1e-15)
    assert reached[1].isnull().all()
