"""`gr.open` and `gr.verify`, whatever the units of a dataset, and `dataset.gr`, which reads the bits of status as they are meant."""

from pathlib import Path
from typing import Any

import numpy as np
import pint_xarray
import pytest
import xarray

import gradhesion as gr
from gradhesion.cli.dataset.read.reader import in_own_units
from gradhesion.core.problem.status import DOUBTFUL, FAILED
from tests.conftest import mistakes

PUNCH: dict[str, Any] = {"k": 0.0, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "a_max_over_R": 1.0}  # fmt: skip
PROBE = {"nu": 0.5, "E": "2 MPa", "work_of_adhesion": "50 mJ/m^2", "k": 0.0, "wavelength": "5 um", "A": 0.02}


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
    names = (None, "dissipated_energy", "pull_off_force")
    whole, energy, force = (every_status.gr.valid(name).values for name in names)
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


def test_what_is_kept_is_opened_again(tmp_path: Path) -> None:
    named = gr.solve(PUNCH, A=xarray.DataArray([0.0, 0.01], dims="x"))
    grid = gr.solve(PUNCH, A=[0.0, 0.01])
    for number, dataset in enumerate((named, grid)):
        dataset.to_netcdf(tmp_path / f"{number}.nc")
        with gr.open(str(tmp_path / f"{number}.nc")) as again:
            xarray.testing.assert_identical(again, dataset)
            assert again.gr.valid().all()


@pytest.mark.parametrize("lack", ["status", "title", "source", "flag_meanings", "another program 3.1"])
def test_a_dataset_of_another_program_says_what_is_missing(lack: str, tmp_path: Path) -> None:
    dataset = gr.solve(PUNCH, "pull_off_force", A=0.0, solver="envelope")
    if lack == "status":
        dataset = dataset.drop_vars("status")
    elif lack == "flag_meanings":
        del dataset["status"].attrs[lack]
    elif lack == "another program 3.1":
        dataset.attrs["source"] = lack
    else:
        del dataset.attrs[lack]
    path = tmp_path / "x.nc"
    dataset.to_netcdf(path)
    calls: list[tuple[Any, Any, str]] = [(call, path, str(path)) for call in (gr.open, gr.verify, gr.plot, gr.explore)]
    for call, given, name in [*calls, (gr.verify, dataset, "the dataset"), (gr.plot, dataset, "the dataset")]:
        (sentence,) = mistakes(call, given)
        assert sentence.startswith(f"{name}: ")
        assert lack in sentence


def test_a_value_that_was_changed_is_found(tmp_path: Path) -> None:
    pytest.importorskip("flint")
    dataset = gr.solve(PUNCH, "pull_off_force", A=[0.0, 0.01], k=[0.1, 0.3])
    found = gr.verify(dataset, seed=1)
    assert (found.exceeding, len(found.deviations), found.seed) == (0, 4, 1)
    dataset["pull_off_force"][1, 1] *= 1.0 + 1e-11
    found = gr.verify(dataset, seed=1)
    assert found.exceeding == 1
    assert dict(found.deviations[0].scene) == {"k": 0.3, "A": 0.01}
    dataset.to_netcdf(tmp_path / "x.nc")
    assert gr.verify(tmp_path / "x.nc", sample=4).exceeding == 1


def test_a_dataset_is_verified_whatever_the_order_of_its_axes(tmp_path: Path) -> None:
    pytest.importorskip("flint")
    for amplitudes in ([0.0, 0.01], [0.0, 0.01, 0.02]):  # a square, whose places would be mistaken, and a rectangle
        dataset = gr.solve(PUNCH, "pull_off_force", A=amplitudes, k=[0.1, 0.3])
        for turned in (dataset, dataset.transpose("A", "k")):
            found = gr.verify(turned, seed=1)
            assert (found.exceeding, len(found.deviations)) == (0, 2 * len(amplitudes))
        turned.to_netcdf(tmp_path / f"{len(amplitudes)}.nc")
        assert gr.verify(tmp_path / f"{len(amplitudes)}.nc", seed=1).exceeding == 0
    with pytest.raises(gr.DatasetError, match="the dataset: its status"):
        gr.verify(dataset.where(dataset["A"] > 0.0))


def test_what_cannot_be_verified_says_why() -> None:
    pytest.importorskip("flint")
    named = gr.solve(PUNCH, "pull_off_force", A=xarray.DataArray([0.0, 0.01], dims="x"))
    with pytest.raises(gr.DatasetError, match="the dataset: lacks its study"):
        gr.verify(named)
    with pytest.raises(gr.StudyError, match="sample = 0"):
        gr.verify(named, sample=0)
    points = gr.solve(PUNCH, "pull_off_force", A=xarray.DataArray([0.01, 0.0, 0.02], dims="scene"))
    assert gr.verify(points, seed=3).exceeding == 0
    moved = points.assign_coords(A=points["A"] + 1e-3)
    with pytest.raises(gr.DatasetError, match=r"the dataset: A\[0\] is 0.011"):
        gr.verify(moved)
    assert np.isfinite(points["pull_off_force"]).all()


@pytest.fixture(scope="module")
def tips() -> xarray.Dataset:
    return gr.solve(PROBE, "pull_off_force", R=["20 um", "40 um"], a_max="10 um")


def test_whatever_the_units_are_the_values_are_those_of_our_files(tips: xarray.Dataset) -> None:
    quantified = tips.pint.quantify()
    others = quantified.pint.to(R=pint_xarray.unit_registry.um, wavelength="nm", pull_off_force_si="mN", A="percent")
    for given in (quantified, others, others.pint.dequantify()):
        found = in_own_units(given)
        for name in tips.variables:
            np.testing.assert_allclose(found[name], tips[name], rtol=4e-16, atol=0.0)
            assert found[name].attrs["units"] == tips[name].attrs["units"]
    assert in_own_units(tips) is tips


def test_pictures_and_recomputed_values_are_the_same(tips: xarray.Dataset, tmp_path: Path) -> None:
    other = tips.pint.quantify().pint.to(R=pint_xarray.unit_registry.um).pint.dequantify()
    pictures = []
    for given in (tips, other):
        gr.plot(given, "pull_off_force_si").savefig(tmp_path / "picture.png", metadata={"Software": None})
        pictures.append((tmp_path / "picture.png").read_bytes())
    assert pictures[0] == pictures[1]
    assert gr.verify(other, sample=2, seed=3).exceeding == 0
