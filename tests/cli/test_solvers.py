"""Several solvers side by side: the first dimension of the dataset."""

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

Call = Callable[..., Result]
SEVERAL = ["envelope", "exact", "asymptotic"]


def test_each_solver_gives_what_it_gives_alone(data: dict[str, Any]) -> None:
    together = compute(study_from(data | {"method": {"solver": SEVERAL}}))
    assert next(iter(together["pull_off_force"].dims)) == "solver"
    assert together["solver"].values.tolist() == SEVERAL, "in the order of the study"
    for solver in SEVERAL:
        alone = compute(study_from(data | {"method": {"solver": solver}}))
        assert "solver" not in alone.variables
        for name in alone.variables:
            np.testing.assert_array_equal(
                together[name].sel(solver=solver) if "solver" in together[name].dims else together[name], alone[name]
            )
    exact, envelope = (together["pull_off_force"].sel(solver=one, A=0.023) for one in ("exact", "envelope"))
    assert (exact != envelope).any(), "the solvers differ"


@pytest.mark.parametrize("layout", ["grid", "points"])
def test_the_file_is_the_same_in_whatever_blocks(
    layout: str,
    data: dict[str, Any],
    gradhesion: Call,
    write_study: Callable[[str], Path],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    data |= {"layout": layout, "method": {"solver": SEVERAL}}
    if layout == "points":
        data["parameters"] |= {"k": [0.0, 0.1, 0.2], "A": [0.1, 0.0, 0.2], "a_max_over_R": [1.0, 2.0, float("inf")]}
    study = write_study(study_from(data).text)
    computed = compute(load_study(study))
    monkeypatch.setenv("GRADHESION_CHUNK", "2")
    result = gradhesion("run", study, "-o", tmp_path / "x.nc")
    assert result.exit_code == 0
    scenes = computed["status"].size
    assert f"{scenes} scenes in" in result.stderr
    with xarray.open_dataset(tmp_path / "x.nc") as written:
        for one in (computed, written):
            del one.attrs["history"]
            one["status"].attrs["flag_masks"] = np.atleast_1d(one["status"].attrs["flag_masks"]).tolist()
        xarray.testing.assert_identical(computed, written)
    with netCDF4.Dataset(tmp_path / "x.nc") as file:
        assert file["solver"].dtype is str
        assert file["solver"].long_name
        assert file["pull_off_force"].dimensions[0] == "solver"
    told = gradhesion("info", tmp_path / "x.nc").stdout
    assert "solvers, each for all scenes: envelope, exact, asymptotic\n" in told
    assert gradhesion("plot", tmp_path / "x.nc").exit_code == 0


def test_a_list_of_one_solver_stays_a_dimension(data: dict[str, Any]) -> None:
    assert compute(study_from(data | {"method": {"solver": ["envelope"]}})).sizes["solver"] == 1


def test_the_contact_is_checked_unless_the_study_says_no(
    data: dict[str, Any], write_study: Callable[[str], Path]
) -> None:
    """Only the exact solver checks it; the values are the same without."""
    data["parameters"] |= {"A": [0.0, 0.9]}
    data |= {"outputs": ["dissipated_energy"], "method": {"solver": ["exact", "envelope"]}}
    checked = compute(study_from(data))
    no_disc = checked["status"] & 1
    assert no_disc.sel(solver="exact", A=0.9).any()
    assert not no_disc.sel(solver="exact", A=0.0).any()
    assert not no_disc.sel(solver="envelope").any()
    data["method"] |= {"check_contact": False}
    unchecked = compute(load_study(write_study(study_from(data).text)))
    assert not (unchecked["status"] & 1).any()
    xarray.testing.assert_equal(checked["status"] & ~1, unchecked["status"])
    xarray.testing.assert_equal(checked["dissipated_energy"], unchecked["dissipated_energy"])


def test_every_solver_knows_other_punches(data: dict[str, Any]) -> None:
    """The same numbers as in Python, realisations of a random waviness among them."""
    shape = {"exponent": 3.0, "harmonics": [{"n": 1, "cos": 1.0}, {"n": 3, "sin": 0.2}]}
    study = study_from(data | {"method": {"solver": SEVERAL}, "profile": shape})
    dataset = compute(study)
    scene = {name: dataset[name].values.ravel()[0] for name in PARAMETERS}
    for solver in SEVERAL:
        expected = solve(scene, ["pull_off_force"], solver=solver, profile=study.profile)["pull_off_force"]
        found = dataset["pull_off_force"].sel(solver=solver).values.ravel()[0]
        assert found == pytest.approx(float(expected), rel=1e-14)
    drawn = {"spectrum": {"hurst": 0.8, "first": 1, "last": 8, "realisations": 3, "seed": 1}}
    rough = compute(study_from(data | {"method": {"solver": "asymptotic"}, "profile": drawn}))
    assert rough["pull_off_force"].sizes["realisation"] == 3
    assert np.isfinite(rough["pull_off_force"]).all()
