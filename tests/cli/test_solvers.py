"""Several solvers side by side: the first dimension of the dataset."""

from typing import Any

import numpy as np
import pytest
import xarray

from gradhesion.cli.dataset import compute
from gradhesion.cli.study import study_from
from gradhesion.core import PARAMETERS, solve

SEVERAL = ["envelope", "exact", "asymptotic"]
SHAPE = {"exponent": 3.0, "harmonics": [{"n": 1, "cos": 1.0}, {"n": 3, "sin": 0.2}]}


@pytest.mark.parametrize("shape", [{}, {"profile": SHAPE}])
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


def test_a_list_of_one_solver_stays_a_dimension(data: dict[str, Any]) -> None:
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
