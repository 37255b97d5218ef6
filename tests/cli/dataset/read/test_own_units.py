"""Datasets that were quantified, or whose units were changed, are taken by their units."""

from pathlib import Path

import numpy as np
import pytest
import xarray
from pint_xarray import unit_registry

import gradhesion as gr
from gradhesion.cli.dataset.read.reader import in_own_units

PROBE = {"nu": 0.5, "E": "2 MPa", "work_of_adhesion": "50 mJ/m^2", "k": 0.0, "wavelength": "5 um", "A": 0.02}


@pytest.fixture(scope="module")
def dataset() -> xarray.Dataset:
    """The force of two tips, in SI."""
    return gr.solve(PROBE, "pull_off_force", R=["20 um", "40 um"], a_max="10 um")


def test_whatever_the_units_are_the_values_are_those_of_our_files(dataset: xarray.Dataset) -> None:
    quantified = dataset.pint.quantify()
    others = quantified.pint.to(R=unit_registry.um, wavelength="nm", pull_off_force_si="mN", A="percent")
    for given in (quantified, others, others.pint.dequantify()):
        found = in_own_units(given)
        for name in dataset.variables:
            np.testing.assert_allclose(found[name], dataset[name], rtol=4e-16, atol=0.0)
            assert found[name].attrs["units"] == dataset[name].attrs["units"]
    assert in_own_units(dataset) is dataset


def test_pictures_and_recomputed_values_are_the_same(dataset: xarray.Dataset, tmp_path: Path) -> None:
    other = dataset.pint.quantify().pint.to(R=unit_registry.um).pint.dequantify()
    pictures = []
    for given in (dataset, other):
        gr.plot(given, "pull_off_force_si").savefig(tmp_path / "picture.png", metadata={"Software": None})
        pictures.append((tmp_path / "picture.png").read_bytes())
    assert pictures[0] == pictures[1]
    assert gr.verify(other, sample=2, seed=3).exceeding == 0
