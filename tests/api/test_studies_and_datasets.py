"""`import gradhesion as gr`; `gr.load` and `gr.run` of files, mappings and keys; `gr.open`, `gr.verify` and `dataset.gr` of their datasets."""

import subprocess
import sys
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import pint_xarray
import pytest
import xarray

import gradhesion as gr
from gradhesion.cli.dataset.read.reader import in_own_units
from gradhesion.core.problem.status import DOUBTFUL, FAILED
from tests.conftest import command, mistakes

PUNCH: dict[str, Any] = {"k": 0.0, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "a_max_over_R": 1.0}  # fmt: skip
PROBE = {"nu": 0.5, "E": "2 MPa", "work_of_adhesion": "50 mJ/m^2", "k": 0.0, "wavelength": "5 um", "A": 0.02}
SET = [
    ("parameters.A", 0.02), ("parameters.A", [0.0, 0.01]), ("parameters.A", np.array([0.0, 0.01])), ("parameters.k", np.float64(0.3)),
    ("parameters.a_max_over_R", float("inf")), ("parameters.A", 1e-7), ("parameters.A", {"start": 0.0, "stop": 0.1, "num": 3}),
    ("title", 'quotes " and \\'), ("title", "Ångström"), ("method.check_contact", False),
    ("method.solver", ("exact", "envelope")), ("profile", {"exponent": 1.7, "harmonics": [{"n": 1, "cos": 1.0}]}),
]  # fmt: skip


def alone(code: str) -> str:
    """What a program prints; that packages of others use what is out of date is theirs."""
    command = [sys.executable, "-W", "error", "-W", "default::DeprecationWarning", "-c", code]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def test_the_import_loads_nothing_and_names_alone_no_array() -> None:
    code = "import sys, importlib, typing; before = {*sys.modules}; import gradhesion as gr; gr.__all__, dir(gr)\n"
    code += "print(sorted({*sys.modules} - before)); "
    code += "gr.OUTPUTS, gr.PARAMETERS, gr.CURVES, gr.StudyError, gr.__version__\n"
    code += "print([name for name in ('numpy', 'packaging', 'xarray', 'click', 'numba', 'pydantic') if name in sys.modules])"
    assert alone(code).splitlines() == ["['gradhesion']", "[]"]


def test_what_computes_nothing_needs_no_compiler(data: dict[str, Any], tmp_path: Path) -> None:
    data["method"] = {"solver": "envelope"}
    gr.run(data).to_netcdf(tmp_path / "x.nc")
    (tmp_path / "study.toml").write_text(gr.load(data).text)
    code = (
        f"import os, sys, gradhesion as gr, xarray; os.chdir({str(tmp_path)!r}); print(hasattr(xarray.Dataset, 'gr'))\n"
    )
    code += "gr.load('study.toml'); gr.open('x.nc').gr.valid(); gr.plot('x.nc'); print(hasattr(xarray.Dataset, 'gr'))\n"
    code += "print([name for name in ('numba', 'llvmlite') if name in sys.modules])"
    assert alone(code).split() == ["False", "True", "[]"], "the accessor comes with the first dataset"


def test_every_name_is_there_and_says_what_it_is() -> None:
    assert command("--version").stdout.split()[-1] == gr.__version__ == version("gradhesion")
    for name in gr.__all__:
        assert name in dir(gr)
        assert not callable(getattr(gr, name)) or getattr(gr, name).__doc__, name
    with pytest.raises(AttributeError, match="module 'gradhesion' has no attribute 'slove'"):
        gr.slove  # noqa: B018


def test_what_was_imported_before_is_still_there_and_the_accessor_where_xarray_was() -> None:
    code = "import xarray; from gradhesion.core import solve; from gradhesion.cli.dataset import compute; import gradhesion\n"
    code += "from gradhesion.cli.study import Study; from gradhesion.cli.errors import StudyError\n"
    code += "print(gradhesion.StudyError is StudyError, gradhesion.Study is Study, hasattr(xarray.Dataset, 'gr'))"
    assert alone(code) == "True True True"


def test_a_study_is_a_file_or_a_mapping_or_what_load_gave(study_file: Path, data: dict[str, Any]) -> None:
    changes, before = {"outputs": ["pull_off_force"], "title": "x"}, repr(data)
    ways = [gr.run(study, set=changes) for study in (study_file, str(study_file), data, gr.load(study_file))]
    assert all(way.drop_attrs().identical(ways[0].drop_attrs()) for way in ways)
    assert {way.attrs["title"] for way in ways} == {"x"}
    assert repr(data) == before, "a mapping stays as it is"
    assert list(ways[0].data_vars) == ["pull_off_force", "status"]


@pytest.mark.parametrize(("key", "value"), SET)
def test_a_key_is_set_alike_in_file_and_mapping(key: str, value: Any, study_file: Path, data: dict[str, Any]) -> None:
    one, other = gr.load(study_file, set={key: value}), gr.load(data, set={key: value})
    assert (one.sizes, one.title, one.method, one.profile) == (other.sizes, other.title, other.method, other.profile)
    for name, values in one.parameters.items():
        np.testing.assert_array_equal(values, other.parameters[name])


def test_mistakes_name_the_key_that_was_set(study_file: Path, data: dict[str, Any]) -> None:
    wrong = {"parameters.A": -1.0, "outputs": ["pull_of_force"]}
    first, second = mistakes(gr.load, study_file, set=wrong)
    assert first.startswith("set parameters.A=-1.0: parameters.A = -1.0: ")
    assert second.startswith('set outputs=["pull_of_force"]: outputs[0] = "pull_of_force": ')
    assert mistakes(gr.load, data, set={"title.x": 1})[0].startswith("set title.x: ")
    assert "threads = 0: " in mistakes(gr.run, data, threads=0)[0]
    for study in (study_file, data):
        assert (
            "a title is one line of printable characters" in mistakes(gr.load, study, set={"title": "and\na line"})[0]
        )


@pytest.mark.parametrize("changes", ["parameters.A=0.02", ["parameters.A=0.02"], {3: 0.02}, {"parameters.A": None}])
def test_what_is_set_is_a_mapping(changes: Any, study_file: Path, data: dict[str, Any]) -> None:
    for study in (study_file, data, gr.load(data)):
        assert mistakes(gr.run, study, set=changes)[0].startswith("set")


@pytest.fixture(scope="module")
def every_status() -> xarray.Dataset:
    """A dataset that has every combination of flags."""
    dataset = gr.solve(PUNCH, ["pull_off_force", "dissipated_energy"], A=np.linspace(0.0, 1e-3, 128), solver="envelope")
    return dataset.assign(status=dataset["status"].copy(data=np.arange(128, dtype=np.int8)))


def test_a_flag_is_its_bit_and_what_is_valid_depends_on_what_is_asked(every_status: xarray.Dataset) -> None:
    for flag, bit in gr.FLAGS.items():
        flagged = every_status.gr.flagged(flag)
        assert (flagged.dtype, flagged.values.tolist()) == (bool, [bool(i & bit) for i in range(128)]), flag
    names = (None, "dissipated_energy", "pull_off_force")
    whole, energy, force = (every_status.gr.valid(name).values for name in names)
    for status in range(128):
        assert whole[status] == (status & FAILED == 0)
        assert energy[status] == (status & (FAILED | DOUBTFUL) == 0)
        assert force[status] == (status & (FAILED | DOUBTFUL & ~gr.FLAGS["loading_contact_not_one_disc"]) == 0)


def test_a_saturation_radius_beyond_all_waves_is_not_valid() -> None:
    found = gr.solve(PUNCH, ["dissipated_energy", "saturation_radius"], lambda_over_R=1e-4, A=0.05, k=0.0)
    assert [bool(found.gr.valid(name)) for name in ("dissipated_energy", "saturation_radius")] == [True, False]


def test_variables_in_si_and_of_curves_are_doubted_as_what_they_are_of() -> None:
    units = {"R": "1 um", "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "10 nm", "wavelength": "100 nm", "a_max": "1 um"}  # fmt: skip
    rough = gr.solve(units, k=0.0, nu=0.3, A=0.1)
    assert rough.gr.flagged("loading_contact_not_one_disc").item()
    assert [rough.gr.valid(name).item() for name in ("dissipated_energy_si", "pull_off_force_si")] == [False, True]
    curves = gr.curves(PUNCH, ["path", "equilibrium"], A=0.1)
    assert [curves.gr.valid(name).item() for name in ("path_load", "load")] == [False, True]


def test_what_is_not_there_is_refused(every_status: xarray.Dataset) -> None:
    valid, flagged = every_status.gr.valid, every_status.gr.flagged
    refused = ((valid, "pull_of_force", '"pull_off_force"'), (valid, "status", ""), (flagged, "pull_off_at_rims", '"pull_off_at_rim"'))  # fmt: skip
    for call, name, meant in refused:
        (sentence,) = mistakes(call, name)
        assert meant in sentence.partition(f"{name}: ")[2]
    with pytest.raises(gr.DatasetError, match=r"title .*source .*status"):
        xarray.Dataset({"x": 1.0}).gr  # noqa: B018


def test_it_draws_and_says_what_it_is_of(every_status: xarray.Dataset) -> None:
    (panel,) = every_status.drop_vars("dissipated_energy").gr.plot("pull_off_force")
    assert panel.get_xlabel() == "$A$"
    first, *rest = repr(every_status.gr).splitlines()
    assert first == "gradhesion: 128 scenes, pull_off_force, dissipated_energy"
    assert "  loading_contact_not_one_disc: 64" in rest


def test_what_is_kept_is_opened_again(tmp_path: Path) -> None:
    for name, A in {"named.nc": xarray.DataArray([0.0, 0.01], dims="x"), "grid.nc": [0.0, 0.01]}.items():
        dataset = gr.solve(PUNCH, A=A)
        dataset.to_netcdf(tmp_path / name)
        with gr.open(str(tmp_path / name)) as again:
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


def test_a_value_that_was_changed_is_found_whatever_the_order_of_the_axes(tmp_path: Path) -> None:
    for amplitudes in ([0.0, 0.01], [0.0, 0.01, 0.02]):  # a square, whose places would be mistaken, and a rectangle
        dataset = gr.solve(PUNCH, "pull_off_force", A=amplitudes, k=[0.1, 0.3])
        for turned in (dataset.copy(deep=True), dataset.transpose("A", "k")):
            found = gr.verify(turned, seed=1)
            assert (found.exceeding, len(found.deviations), found.seed) == (0, 2 * len(amplitudes), 1)
            turned["pull_off_force"].loc[{"A": 0.01, "k": 0.3}] *= 1.0 + 1e-11
            found = gr.verify(turned, seed=1)
            assert (found.exceeding, dict(found.deviations[0].scene)) == (1, {"k": 0.3, "A": 0.01})
            turned.to_netcdf(tmp_path / "x.nc")
            assert gr.verify(tmp_path / "x.nc", sample=6).exceeding == 1
    assert "the dataset: its status" in mistakes(gr.verify, dataset.where(dataset["A"] > 0.0))[0]


def test_what_cannot_be_verified_says_why() -> None:
    named = gr.solve(PUNCH, "pull_off_force", A=xarray.DataArray([0.0, 0.01], dims="x"))
    assert "the dataset: lacks its study" in mistakes(gr.verify, named)[0]
    assert "sample = 0" in mistakes(gr.verify, named, sample=0)[0]
    points = gr.solve(PUNCH, "pull_off_force", A=xarray.DataArray([0.01, 0.0, 0.02], dims="scene"))
    assert gr.verify(points, seed=3).exceeding == 0
    moved = points.assign_coords(A=points["A"] + 1e-3)
    assert "the dataset: A[0] is 0.011" in mistakes(gr.verify, moved)[0]
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
