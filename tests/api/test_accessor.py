"""`dataset.gr` reads the bits of status as they are meant."""

from typing import Any

import numpy as np
import pytest
import xarray

import gradhesion as gr
from gradhesion.core.problem.status import DOUBTFUL, FAILED

PUNCH: dict[str, Any] = {"k": 0.0, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "a_max_over_R": 1.0}  # fmt: skip


@pytest.fixture(scope="module")
def every_status() -> xarray.Dataset:
    """A dataset that has every combination of flags."""
    dataset = gr.solve(PUNCH, ["pull_off_force", "dissipated_energy"], A=np.linspace(0.0, 1e-3, 128), solver="envelope")
    return dataset.assign(status=dataset["status"].copy(data=np.arange(128, dtype=np.int8)))


@pytest.mark.parametrize("flag", gr.FLAGS)
def test_a_flag_is_its_bit(flag: str, every_status: xarray.Dataset) -> None:
    flagged = every_status.gr.flagged(flag)
    assert flagged.dtype == bool
    assert flagged.values.tolist() == [bool(i & gr.FLAGS[flag]) for i in range(128)]


def test_what_is_valid_depends_on_what_is_asked(every_status: xarray.Dataset) -> None:
    whole, energy, force = (
        every_status.gr.valid(name).values for name in (None, "dissipated_energy", "pull_off_force")
    )
    for status in range(128):
        assert whole[status] == (status & FAILED == 0)
        assert energy[status] == (status & (FAILED | DOUBTFUL) == 0)
        assert force[status] == (status & (FAILED | DOUBTFUL & ~gr.FLAGS["loading_contact_not_one_disc"]) == 0)


def test_variables_in_si_and_of_curves_are_doubted_as_what_they_are_of() -> None:
    units = {"R": "1 um", "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "10 nm", "wavelength": "100 nm", "a_max": "1 um"}  # fmt: skip
    rough = gr.solve(units, k=0.0, nu=0.3, A=0.1)
    assert rough.gr.flagged("loading_contact_not_one_disc").item()
    assert [rough.gr.valid(name).item() for name in ("dissipated_energy_si", "pull_off_force_si")] == [False, True]
    curves = gr.curves(PUNCH, ["path", "equilibrium"], A=0.1)
    assert [curves.gr.valid(name).item() for name in ("path_load", "load")] == [False, True]


def test_what_is_not_there_is_refused(every_status: xarray.Dataset) -> None:
    with pytest.raises(gr.DatasetError, match=r'pull_of_force: .*"pull_off_force"'):
        every_status.gr.valid("pull_of_force")
    with pytest.raises(gr.DatasetError, match="status: "):
        every_status.gr.valid("status")
    with pytest.raises(gr.DatasetError, match=r'pull_off_at_rims: .*"pull_off_at_rim"'):
        every_status.gr.flagged("pull_off_at_rims")
    with pytest.raises(gr.DatasetError, match=r"title .*source .*status"):
        xarray.Dataset({"x": 1.0}).gr  # noqa: B018


def test_it_draws_and_says_what_it_is_of(every_status: xarray.Dataset) -> None:
    (panel,) = every_status.drop_vars("dissipated_energy").gr.plot("pull_off_force")
    assert panel.get_xlabel() == "$A$"
    first, *rest = repr(every_status.gr).splitlines()
    assert first == "gradhesion: 128 scenes, pull_off_force, dissipated_energy"
    assert "  loading_contact_not_one_disc: 64" in rest
