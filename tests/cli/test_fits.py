"""Fits of several loops side by side, and of the same data by several models: as datasets, tables, pictures, refusals."""

import csv
import io
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

import gradhesion as gr
from gradhesion.cli.dataset import fits as of_fits
from gradhesion.cli.picture.fits import doubtful, drawn_fits
from gradhesion.core.problem.status import ANOTHER_MINIMUM, NO_VALUE, POOR_FIT
from tests.cli.conftest import BALL, WORK, Call, Patch, Told, jkr

R = 5e-6
TRUE = {"0": (1.0e7, 0.030, 40), "1": (1.2e7, 0.035, 30), "2": (0.9e7, 0.040, 35)}
"""Modulus in Pa, work of adhesion in J/m^2 and points of loading, by the name of the file."""
STUDY = f"""
title = "Spots on a film"
kind = "fit"
[data]
file = "curves/*.csv"
indentation = "depth"
load = "force"
branch = "way"
{BALL}{WORK}[fit]
intervals = "linear"
noise = {{ indentation = "0.3 nm", load = "5 nN" }}
"""
WRONG = [["plot", "--at", "loop=7"], ["plot", "--at", "k=1"], ["plot", "--at", "loop=3"], ["plot", "--variable", "value"], ["explore"], ["verify"],
         ["info", "many.nc"], ["info", "zeros.nc", "--format", "csv"], ["info", "other.nc"]]  # fmt: skip
"""Of several fits: loops and axes that are not there, what is of scenes, and comparisons of what has no fit."""


def write_loop(path: Path, E_star: float, work: float, seed: int, count: int) -> None:
    """A smooth ball, with noise and zeros of its own."""
    fine = np.linspace(1e-9, 1e-6, 20_001)
    depth, _ = jkr(fine, R, E_star, work)
    last = int(np.argmin(depth))
    first = fine[last:][depth[last:] >= 0.0][0]
    radii = np.linspace(first, 1e-6, count), np.linspace(1e-6, fine[last], count + 9)
    up, down = (jkr(a, R, E_star, work) for a in radii)
    out, home = np.linspace(-2e-7, -1e-9, count // 2), np.linspace(depth[last] - 1e-9, -2e-7, count // 2)
    depths = np.concatenate([out, up[0], down[0], home])
    loads = np.concatenate([0.0 * out, up[1], down[1], 0.0 * home])
    way = np.arange(depths.size) >= out.size + count
    rng = np.random.default_rng(seed)
    x = 1e9 * depths + 20.0 + 0.3 * rng.standard_normal(depths.size)
    y = 1e9 * loads + 3.0 + 5.0 * rng.standard_normal(depths.size)
    rows = "".join(f"{x[i]:.4f},{y[i]:.4f},{way[i]:d}\n" for i in range(depths.size))
    path.write_text("depth [nm],force [nN],way\n" + rows)


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with loops, one of them a row long, and their fits."""
    folder = tmp_path_factory.mktemp("spots")
    (folder / "curves").mkdir()
    for name, (E_star, work, count) in TRUE.items():
        write_loop(folder / f"curves/{name}.csv", E_star, work, int(name), count)
    (folder / "curves/9.csv").write_text("depth [nm],force [nN],way\n1,2,0\n2,2,0\n3,1,1\n")
    (folder / "many.toml").write_text(STUDY)
    found = gr.run(folder / "many.toml")
    found.to_netcdf(folder / "many.nc")
    return folder


@pytest.fixture(scope="module")
def found(home: Path) -> xarray.Dataset:
    with xarray.open_dataset(home / "many.nc") as dataset:
        return dataset.load()


@pytest.fixture
def folder(home: Path, monkeypatch: Patch) -> Path:
    monkeypatch.chdir(home)
    return home


def test_each_loop_gives_what_it_was_made_with_as_alone_and_one_that_fails_keeps_its_row(
    found: xarray.Dataset, models: dict[str, Path]
) -> None:
    assert found["value"].dims == ("loop", "parameter")
    assert found["file"].values.tolist() == [f"curves/{name}.csv" for name in (*TRUE, "9")]
    assert {len(one) for one in found["sha256"].values} == {64}
    for i, (E_star, work, count) in enumerate(TRUE.values()):
        off = (found["value"][i] - [E_star, work, 20e-9, 3e-9]) / found["standard_deviation"][i]
        assert abs(off).max() < 4.0
        assert 0.5 < float(found["reduced_chi_square"][i]) < 1.5
        size = 2 * (count // 2) + 2 * count + 9
        assert int(found["kept_points"][i]) == size
        assert np.isfinite(found["measured_load"].values[i, :size]).all()
        assert np.isnan(found["residual"].values[i, size:]).all()
        assert (found["measured_unloading"].values[i, size:] == -1).all()
    assert (found["status"].values[:3] & (POOR_FIT | ANOTHER_MINIMUM) == 0).all()
    assert np.isnan(found["value"].values[3]).all()
    assert int(found["status"][3]) == NO_VALUE
    assert [bool(problem) for problem in found["problem"].values] == [False, False, False, True]
    with xarray.open_dataset(models["zeros"]) as alone:
        assert "loop" not in alone.dims
        np.testing.assert_array_equal(alone["value"].values, found["value"].values[1])
        np.testing.assert_array_equal(alone["residual"].values, found["residual"].values[1, : alone["residual"].size])


def test_run_says_which_failed_and_writes_what_there_is(gradhesion: Call, folder: Path) -> None:
    for files, code in (("[29]", 3), ("9*", 2)):
        result = gradhesion("run", "many.toml", "-o", f"{code}.nc", f'--set=data.file="curves/{files}.csv"', code=code)
        assert "3 points are too few" in result.stderr
        assert (folder / f"{code}.nc").exists() == (code == 3)


@pytest.mark.usefixtures("folder")
def test_a_table_has_a_row_for_each_loop(gradhesion: Call, found: xarray.Dataset) -> None:
    told = gradhesion("info", "many.nc").stdout.splitlines()
    rows = [line for line in told if line.startswith("curves/") and " to " in line]
    assert len(rows) == 3
    value, low, high = (float(found[name][1, 0]) for name in ("value", "low", "high"))
    assert f"{value:.5g} ({low:.4g} to {high:.4g})" in rows[1]
    assert any(line.startswith("curves/9.csv") and line.endswith("no_value") for line in told)
    assert "averaged" not in "".join(told), "there are few points"
    table = list(csv.DictReader(io.StringIO(gradhesion("info", "many.nc", "--format", "csv").stdout)))
    assert len(table) == 4 * 4
    assert [float(row["value"]) for row in table[:4]] == found["value"].values[0].tolist()
    assert {row["status"] for row in table[12:]} == {str(NO_VALUE)}


@pytest.mark.usefixtures("folder")
def test_pictures_of_all_and_of_one(gradhesion: Call, found: xarray.Dataset) -> None:
    for name, more in {"all": (), "one": ("--at", "loop=1"), "named": ("--at", "loop=curves/2.csv")}.items():
        gradhesion("plot", "many.nc", "-o", f"{name}.svg", *more, code=0)
    panels = gr.plot(found)
    assert [axes.get_xlabel() for axes in panels][:2] == [r"$E^{\ast}$ (MPa)", r"$\Delta\gamma$ (mJ/m$^2$)"]
    top, bottom = gr.plot(found, at={"loop": 1}, ylabel="force", xlabel="height")
    assert (top.get_ylabel(), bottom.get_ylabel(), bottom.get_xlabel()) == (
        "force (nN)",
        "residual (sd)",
        "height (nm)",
    )
    count = sum(line.get_xdata().size for line in top.lines if line.get_marker() == "." and len(line.get_xdata()))
    assert count == int(found["kept_points"][1])
    at_end = found.assign(on_bound=found["on_bound"].copy(data=np.eye(*found["on_bound"].shape, -1, dtype="i1")))
    assert not doubtful(found)[:3].any()
    assert doubtful(at_end)[:3].tolist() == [False, True, True]
    many = xarray.concat([found.isel(loop=[0, 1, 2])] * 10, "loop")
    heights = sum(patch.get_height() for patch in drawn_fits(many).axes[0].patches)
    assert heights == 30, "a histogram of all"


@pytest.mark.usefixtures("folder", "models")
def test_what_several_fits_have_not_is_refused(refusal: Told) -> None:
    for command in WRONG:
        refusal(*command, "many.nc")


def test_too_much_side_by_side_is_refused_before_it_is_fitted(home: Path, monkeypatch: Patch) -> None:
    monkeypatch.setattr(of_fits, "_MOST", 1000)
    with pytest.raises(gr.StudyError, match="average = true"):
        gr.run(home / "many.toml")


@pytest.fixture(scope="module")
def models(home: Path) -> dict[str, Path]:
    """One loop by two models, and with what cannot be compared."""
    one = {"data.file": "curves/1.csv"}
    changes: dict[str, dict[str, Any]] = {
        "zeros": {},
        "tilt": {"fit.offsets": {"slope": True}},
        "other": {"data.file": "curves/0.csv"},
        "noise": {"fit.noise": {"indentation": "0.3 nm", "load": "6 nN"}},
        "branch": {"data.which": "unloading"},
    }
    paths = {name: home / f"{name}.nc" for name in changes}
    for name, change in changes.items():
        gr.run(home / "many.toml", set=one | change).to_netcdf(paths[name])
    return paths


def test_fits_are_compared_by_the_criterion(gradhesion: Call, models: dict[str, Path]) -> None:
    result = gradhesion("info", models["zeros"], models["tilt"], code=0)
    criteria = {}
    for name in ("zeros", "tilt"):
        with xarray.open_dataset(models[name]) as fit:
            criteria[name] = float(fit["chi_square"]) + 2.0 * fit.sizes["parameter"]
    rows = {Path(line.split()[0]).stem: line.split() for line in result.stdout.splitlines() if ".nc" in line}
    differences = {name: one - min(criteria.values()) for name, one in criteria.items()}
    weights = {name: math.exp(-0.5 * one) for name, one in differences.items()}
    for name, row in rows.items():
        assert float(row[3]) == pytest.approx(differences[name], abs=2e-3)
        assert float(row[4]) == pytest.approx(weights[name] / sum(weights.values()), rel=0.05)
    assert [int(rows[name][1]) for name in ("zeros", "tilt")] == [4, 5]


def test_what_differs_is_not_compared(refusal: Told, models: dict[str, Path]) -> None:
    for name, what in (("other", "data_sha256"), ("noise", "noise_of_load"), ("branch", "measured_unloading")):
        assert f"in {what}" in refusal("info", models["zeros"], models[name])


def test_a_tabor_parameter_has_a_range_said_if_long(models: dict[str, Path], gradhesion: Call, folder: Path) -> None:
    """R dgamma^2/E*^2 to a third, over the range (Tabor 1977), given or 0.3 nm."""
    options = ['--set=data.file="curves/1.csv"', '--set=physical.adhesion_range="100 nm"']
    result = gradhesion("run", "many.toml", "-o", "far.nc", *options, code=0)
    assert "Tabor" in result.stderr
    assert ") is below " in gradhesion("info", folder / "far.nc").stdout
    for path, reach, word in ((models["zeros"], 3e-10, "0.3 nm, assumed"), (folder / "far.nc", 1e-7, "100 nm, given")):
        with gr.open(path) as fit:
            E_star, work = fit["value"].values[:2]
            own = (R * work**2 / E_star**2) ** (1 / 3) / reach
            assert float(fit["tabor_parameter"]) == pytest.approx(own, rel=1e-9)
            assert word in fit["tabor_parameter"].attrs["comment"]
