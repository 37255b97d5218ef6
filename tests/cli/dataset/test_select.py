"""`--at` and `--over` take of a dataset what NumPy takes of its arrays; `gradhesion select` writes that, for all other commands."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray

import gradhesion as gr
from gradhesion.cli.dataset.read.selection import Selection, selection_of
from gradhesion.cli.errors import DatasetError
from gradhesion.core import FLAGS
from tests.cli.conftest import Call, Made, Patch, Told

K = np.array([0.0, 0.2, 0.5, 0.9])
WAVES = np.geomspace(0.4, 0.01, 5)  # falling
RIMS = np.array([0.3, 1.0, np.inf])
FAILED, INFORMED = FLAGS["no_value"], FLAGS["pull_off_at_rim"]
GRID = ["K2=0.1", "nu=0.3", "modulus=1", "k", "k=", "k=0.91", "a_max_over_R=2", "k=inf", "k=many", "k=nan", "k=0.91:2"]
"""Values that are not there, and axes that are none."""
WRONG: list[tuple[str, dict[str, Any]]] = [
    *(("dataset", {"at": [wish]}) for wish in GRID),
    *(("dataset", {"over": over}) for over in (["k"], ["modulus=max"], ["k=maxi"], ["k=max", "k=min"], ["k=argmax", "lambda_over_R=argmin"])),
    ("dataset", {"at": ["k=0.1", "k=0.2"]}), ("dataset", {"at": ["k=0.1"], "over": ["k=max"]}), ("points", {"over": ["k=max"]}),
    ("points", {"at": ["k=0.2"], "interpolate": True}), ("points", {"at": ["k=0.1", "A=3"]}), ("points", {"interpolate": True}),
]  # fmt: skip
Select = Callable[..., tuple[xarray.Dataset, xarray.Dataset, Path]]
REDUCTIONS: dict[str, Callable[..., Any]] = {
    "mean": np.mean, "sum": np.sum, "median": np.median, "p50": np.median,
    "p05": partial(np.quantile, q=0.05), "p95": partial(np.quantile, q=0.95),
}  # fmt: skip
REFUSED = ["", "--at nu=0.27", "--at k=0.32:0.5", "--over k=argmax", "--at k=0 -o part.csv", "--at k=0 -o out.nc"]


@pytest.fixture
def dataset() -> xarray.Dataset:
    """A grid whose force is linear in k and in log lambda/R, with a fixed nu and a modulus that follows from k."""
    force = (1.0 + K[:, None, None]) * (3.0 + np.log(WAVES)[:, None]) + np.array([0.0, 7.0, 9.0])
    dims = ("k", "lambda_over_R", "a_max_over_R")
    outputs = {"pull_off_force": (dims, force), "loading_jumps": (dims, np.round(force).astype(np.int32)), "status": (dims, np.zeros(force.shape, np.int8))}  # fmt: skip
    coordinates: dict[str, Any] = {"k": K, "lambda_over_R": WAVES, "a_max_over_R": RIMS, "nu": 0.3}
    return xarray.Dataset(outputs, coordinates | {"modulus": (("k", "a_max_over_R"), np.ones((4, 3)))})


@pytest.fixture
def points() -> xarray.Dataset:
    force = ("scene", np.arange(5.0))
    coordinates = {"k": ("scene", np.array([0.1, 0.1, 0.3, 0.3, 0.3])), "A": ("scene", np.array([1.0, 2, 1, 2, 3]))}
    return xarray.Dataset({"pull_off_force": force, "status": ("scene", np.zeros(5, np.int8))}, coordinates)


def take(dataset: xarray.Dataset, selection: Selection, name: str = "pull_off_force") -> Any:
    narrow = selection.narrowed(dataset)
    return selection.taken(narrow[name], narrow["status"])


def test_the_nearest_value_is_taken_in_the_scale_of_the_axis(dataset: xarray.Dataset) -> None:
    narrow = selection_of(dataset, ["k=0.34", "lambda_over_R = 0.028", "a_max_over_R=inf"]).narrowed(dataset)
    assert narrow["k"].item() == 0.2
    assert narrow["lambda_over_R"].item() == WAVES[3], "0.028 is nearer to 0.0253 than to 0.0632, by ratio"
    assert narrow["a_max_over_R"].item() == np.inf
    assert narrow["pull_off_force"].item() == dataset["pull_off_force"].values[1, 3, 2]
    # the middle of 0.01 and 0.0253 is 0.0176 by difference and 0.0159 by ratio
    assert selection_of(dataset, ["lambda_over_R=0.0165"]).fixed == {"lambda_over_R": 3}


def test_interpolation_is_exact_for_what_is_linear_in_the_axis_or_its_logarithm(dataset: xarray.Dataset) -> None:
    selection = selection_of(dataset, ["k=0.31", "lambda_over_R=0.017", "a_max_over_R=0.3"], interpolate=True)
    taken = take(dataset, selection)
    np.testing.assert_allclose(taken.values, 1.31 * (3.0 + np.log(0.017)), rtol=1e-14)
    assert taken.values["k"].item() == 0.31
    for wish in ("k=0.5", "k=0.49999999999999994"):
        selection = selection_of(dataset, [wish], interpolate=True)
        assert (selection.fixed, selection.between) == ({"k": 2}, ()), "a neighbour without a value does no harm"


def test_interpolation_keeps_flags_of_both_neighbours_and_takes_jumps_from_the_nearer(dataset: xarray.Dataset) -> None:
    dataset["status"][1] = INFORMED
    dataset["status"][2, 0, 0] = FAILED
    selection = selection_of(dataset, ["k=0.3"], interpolate=True)
    status = take(dataset, selection).status
    assert status[0, 0] == INFORMED | FAILED
    assert (status.values.ravel()[1:] == INFORMED).all()
    jumps = take(dataset, selection, "loading_jumps").values
    np.testing.assert_array_equal(jumps, dataset["loading_jumps"].values[1])


def test_the_place_of_an_extreme_may_be_reduced_further(dataset: xarray.Dataset) -> None:
    dataset["pull_off_force"][2, 1, :] = 50.0
    dataset["pull_off_force"][0, 3, :] = 60.0
    taken = take(dataset, selection_of(dataset, over=["lambda_over_R=argmax"]))
    best = WAVES[[3, 0, 1, 0]]
    np.testing.assert_array_equal(taken.values, np.broadcast_to(best[:, None], (4, 3)))
    # the wavelength of the greatest force over all k
    taken = take(dataset, selection_of(dataset, ["a_max_over_R=1"], ["k=max", "lambda_over_R=argmax"]))
    assert taken.values.item() == WAVES[3]
    taken = take(dataset, selection_of(dataset, ["a_max_over_R=1"], ["lambda_over_R=argmax", "k=min"]))
    assert taken.values.item() == best.min()


def test_failed_scenes_are_left_out_and_counted(dataset: xarray.Dataset) -> None:
    dataset["pull_off_force"][1, 2, 0] = np.nan
    dataset["pull_off_force"][:, :, 1] = np.inf
    dataset["pull_off_force"][3, 0, 2] = 1e9
    dataset["status"][3, 0, 2] = FLAGS["tolerance_not_met"]
    left = np.ma.masked_invalid(dataset["pull_off_force"].values)
    left[3, 0, 2] = np.ma.masked
    for how in ("max", "min", "mean", "sum", "median"):
        taken = take(dataset, selection_of(dataset, over=[f"k={how}", "lambda_over_R=mean"]))
        assert taken.left_out == 1 + 20 + 1
        assert taken.values.dims == ("a_max_over_R",)
        expected = getattr(np.ma, how)(left, axis=0).mean(axis=0).filled(np.nan)
        assert np.isnan(expected[1]), "no value is left"
        np.testing.assert_allclose(taken.values, expected, rtol=4e-16)


def test_an_extreme_has_the_status_of_its_scene_and_other_reductions_that_of_all(dataset: xarray.Dataset) -> None:
    dataset["status"][3] = 1
    dataset["status"][0] = INFORMED
    force = dataset["pull_off_force"].values
    greatest = force.argmax(axis=0)
    status = take(dataset, selection_of(dataset, over=["k=argmax"])).status
    assert {0, 3} <= {*greatest.ravel()}
    np.testing.assert_array_equal(status, np.array([INFORMED, 0, 0, 1])[greatest])
    for how, reduce in REDUCTIONS.items():
        taken = take(dataset, selection_of(dataset, over=[f"k={how}"]))
        np.testing.assert_allclose(taken.values, reduce(force, axis=0), rtol=4e-16)
        assert (taken.status == (1 | INFORMED)).all()


def test_points_with_the_nearest_value_stay(points: xarray.Dataset) -> None:
    narrow = selection_of(points, ["k=0.25"]).narrowed(points)
    assert narrow["pull_off_force"].values.tolist() == [2.0, 3.0, 4.0]
    narrow = selection_of(points, ["A=1.9", "k=0.1"]).narrowed(points)
    assert narrow["pull_off_force"].values.tolist() == [1.0]


def test_quantities_have_their_unit_or_are_in_si() -> None:
    radii = np.array([5e-7, 1e-6, 5e-6])
    dataset = xarray.Dataset({"status": ("R", np.zeros(3, np.int8))}, {"R": ("R", radii)})
    for wish in ("R=1 um", "R=1e-6", "R=900nm"):
        assert selection_of(dataset, [wish]).fixed == {"R": 1}
    for wish in ("R=1 s", "R=1 mm", "R=1e-3", "R=nan m"):
        with pytest.raises(DatasetError, match=f"--at {wish}: "):
            selection_of(dataset, [wish])


@pytest.mark.parametrize(("layout", "wishes"), WRONG)
def test_wrong_wishes_are_refused(layout: str, wishes: dict[str, Any], request: pytest.FixtureRequest) -> None:
    with pytest.raises(DatasetError, match=r"^--[^\n]+$"):
        selection_of(request.getfixturevalue(layout), **wishes)


@pytest.fixture
def select(gradhesion: Call, tmp_path: Path) -> Select:
    """Select, and let what reads datasets take the result; gives the part and the whole."""

    def take(path: Path, *words: str, verify: int = 0) -> tuple[xarray.Dataset, xarray.Dataset, Path]:
        part = tmp_path / "part.nc"
        part.unlink(missing_ok=True)
        gradhesion("select", path, *words, "-o", part, code=0)
        gradhesion("info", part, code=0)
        gr.plot(part).figure.draw_without_rendering()
        gradhesion("verify", part, "--sample", "50", code=verify)
        with xarray.open_dataset(part) as found, xarray.open_dataset(path) as whole:
            return found.load(), whole.load(), part

    return take


def test_a_part_of_a_grid_has_the_values_and_the_study_of_the_whole(dataset_file: Path, select: Select) -> None:
    wishes = ("--at", "k=0.3", "--at", "lambda_over_R=0.2:", "--at", "a_max_over_R=inf")
    found, whole, _ = select(dataset_file, *wishes)
    expected = whole.isel(k=1, lambda_over_R=[1, 2], a_max_over_R=1)
    xarray.testing.assert_identical(found.drop_attrs(deep=False), expected.drop_attrs(deep=False))
    assert found.attrs.pop("history").startswith(expected.attrs.pop("history") + "\n")
    assert found.attrs == expected.attrs
    assert (found["pull_off_force"].dtype, found["status"].dtype) == (np.float64, np.int8)


def test_a_changed_value_of_a_part_is_found(gradhesion: Call, dataset_file: Path, select: Select) -> None:
    *_, part = select(dataset_file, "--at", "k=0.31")
    with netCDF4.Dataset(part, "a") as file:
        file["pull_off_force"][0, 1, 0] *= 1.0 + 1e-11
    assert gradhesion("verify", part, "--sample", "50").exit_code == 3
    with netCDF4.Dataset(part, "a") as file:
        file["lambda_over_R"][0] = 0.12
    assert gradhesion("verify", part).exit_code == 2


def test_solvers_and_points(made: Made, select: Select) -> None:
    solvers = made(method={"solver": ["exact", "envelope"]})
    assert select(solvers, "--at", "solver=envelope", "--at", "k=0")[0]["solver"].item() == "envelope"
    lists = {"k": [0.1, 0.1, 0.6], "lambda_over_R": 0.3, "A": [0.01, 0.02, 0.03], "a_max_over_R": 0.5}
    found, whole, _ = select(made(parameters=lists, layout="points"), "--at", "A=0.015:1")
    xarray.testing.assert_equal(found, whole.isel(scene=[1, 2]))


def test_a_reduction_has_the_flags_of_all_and_says_what_it_is(dataset_file: Path, select: Select) -> None:
    with netCDF4.Dataset(dataset_file, "a") as file:
        file["status"][0, 1, 0, 0] = 4
    found, whole, _ = select(dataset_file, "--over", "lambda_over_R=p95", "--at", "A=0.023", verify=2)
    values = np.quantile(whole["pull_off_force"].isel(A=1).values, 0.95, axis=1)
    np.testing.assert_allclose(found["pull_off_force"], values, rtol=4e-16)
    assert found["pull_off_force"].dims == ("k", "a_max_over_R")
    assert "p95 over lambda_over_R" in found["pull_off_force"].long_name
    expected = np.bitwise_or.reduce(whole["status"].isel(A=1).values, axis=1)
    np.testing.assert_array_equal(found["status"], expected)


def test_curves_are_cut_with_their_jumps(made: Made, select: Select) -> None:
    parameters = {"k": 0.31, "a_max_over_R": [0.44, 0.7]}
    path = made(parameters=parameters, kind="curve", outputs=["path", "jumps"])
    found, whole, _ = select(path, "--at", "A=0.023", "--at", "lambda_over_R=0.2:1", verify=2)
    counts = whole["jump_count"].values
    of_scene = np.repeat(np.arange(counts.size), counts.ravel()).astype(int)
    left = np.arange(counts.size).reshape(counts.shape)[1:, 1].ravel()
    np.testing.assert_array_equal(found["jump_energy"], whole["jump_energy"].values[np.isin(of_scene, left)])
    np.testing.assert_array_equal(found["jump_count"], counts[1:, 1])
    np.testing.assert_array_equal(found["path_load"], whole["path_load"].isel(lambda_over_R=[1, 2], A=1))


@pytest.mark.parametrize("words", REFUSED)
def test_what_cannot_be_selected_is_refused(words: str, refusal: Told, dataset_file: Path, monkeypatch: Patch) -> None:
    monkeypatch.chdir(dataset_file.parent)
    before = dataset_file.read_bytes()
    refusal("select", dataset_file, "-o", "part.nc", *words.split(), code=4 if "out.nc" in words else 2)
    assert dataset_file.read_bytes() == before
    assert not Path("part.nc").exists()


def test_parts_of_datasets_are_not_merged(refusal: Told, dataset_file: Path, select: Select, tmp_path: Path) -> None:
    *_, part = select(dataset_file, "--at", "k=0")
    assert refusal("merge", dataset_file, part, "-o", tmp_path / "both.nc").startswith(f"{part}: has only a part")
