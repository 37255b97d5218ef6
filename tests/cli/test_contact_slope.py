"""Contacts that reach slopes of the punch that are not small are said and marked, without being asked for."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
import xarray
from click.testing import Result
from matplotlib.contour import QuadContourSet

import gradhesion as gr
from gradhesion.cli.dataset.dataset import compute
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.picture.doubts import BEYOND
from gradhesion.cli.picture.values import drawn
from gradhesion.cli.study.reading import study_from

Call = Callable[..., Result]
Write = Callable[[str], Path]
PARAMETERS = {"nu": 0.3, "modulus": 30.0, "c0_over_R": 0.1, "lambda_over_R": [0.05, 0.1, 0.2, 0.4, 0.8], "A": 0.05}
STUDY: dict[str, Any] = {"outputs": ["dissipated_energy"], "parameters": {"k": [0.0, 0.1, 0.2, 0.3]} | PARAMETERS}
WORDS = BEYOND["contact_slope"].words


def written(study: dict[str, Any]) -> str:
    return study_from(study).text


def slopes(study: dict[str, Any]) -> np.ndarray[Any, Any]:
    asked = study | {"outputs": [*study["outputs"], "contact_slope"]}
    values: np.ndarray[Any, Any] = compute(study_from(asked))["contact_slope"].values
    return values


def marks(dataset: xarray.Dataset) -> np.ndarray[Any, Any]:
    return np.asarray(dataset.coords[STEEP].values if STEEP in dataset.coords else np.zeros(dataset["status"].shape))


def test_run_and_info_say_how_many(gradhesion: Call, tmp_path: Path, write_study: Write) -> None:
    steep = slopes(STUDY) > 1.0
    assert 0 < steep.sum() < steep.size
    output = tmp_path / "out.nc"
    result = gradhesion("run", write_study(written(STUDY)), "-o", output)
    assert result.exit_code == 0
    (line,) = [line for line in result.stderr.splitlines() if "slopes of the punch" in line]
    assert f"{steep.sum()} of 20 scenes" in line
    told = gradhesion("info", output).stdout.partition("outside the range of the model\n")[2]
    assert told.splitlines()[0].split()[:5] == ["contact_slope", str(steep.sum()), "of", "20", "scenes"]
    with gr.open(output) as dataset:
        assert set(dataset.data_vars) == {"dissipated_energy", "status"}
        np.testing.assert_array_equal(marks(dataset), steep)
        assert not dataset["status"].any()
        assert dataset["status"].dtype == np.int8
    with netCDF4.Dataset(output) as file:
        assert STEEP in file["dissipated_energy"].coordinates.split()


def test_all_within_says_nothing(gradhesion: Call, tmp_path: Path, write_study: Write) -> None:
    study = STUDY | {"parameters": STUDY["parameters"] | {"k": 0.3, "lambda_over_R": [0.4, 0.8]}}
    for change in ({}, {"a_max_over_R": 1.0}):
        own = study | {"parameters": study["parameters"] | change}
        assert (slopes(own) <= 1.0).all()
        output = tmp_path / f"{len(change)}.nc"
        result = gradhesion("run", write_study(written(own)), "-o", output)
        assert "slope" not in result.stderr
        assert "outside the range" not in gradhesion("info", output).stdout
        with gr.open(output) as dataset:
            assert STEEP not in dataset.variables


def test_force_alone_reaches_to_its_pull_off() -> None:
    force = STUDY | {"outputs": ["pull_off_force", "pull_off_radius"]}
    found = compute(study_from(force))
    assert (found["pull_off_radius"] < 1.0).all()
    assert STEEP not in found.coords
    softer = force | {"parameters": force["parameters"] | {"modulus": 2.0}}
    found = compute(study_from(softer))
    np.testing.assert_array_equal(marks(found), found["pull_off_radius"] > 1.0)
    assert marks(found).any()


@pytest.mark.parametrize("cells", [3, 8])
def test_blocks_parts_and_merges_have_the_same_marks(
    cells: int, gradhesion: Call, tmp_path: Path, write_study: Write, monkeypatch: pytest.MonkeyPatch
) -> None:
    study = write_study(written(STUDY))
    steep = slopes(STUDY) > 1.0
    monkeypatch.setenv("GRADHESION_CHUNK", str(cells))
    outputs = [tmp_path / name for name in ("blocks.nc", "shards.nc", "joined.nc")]
    lines = [gradhesion("run", study, "-o", outputs[0]).stderr]
    for i in (1, 2):
        assert gradhesion("run", study, "-o", outputs[1], "--shard", f"{i}/2").exit_code == 0
    lines.append(gradhesion("merge", outputs[1]).stderr)
    axis = [0.0, 0.1, 0.2, 0.3]
    for name, some in (("low", axis[:2]), ("high", axis[2:3]), ("one", axis[3])):
        own = ["--set", f"parameters.k={some}", "-o", tmp_path / f"{name}.nc"]
        assert gradhesion("run", study, *own).exit_code == 0
    lines.append(
        gradhesion("merge", *(tmp_path / f"{name}.nc" for name in ("low", "high", "one")), "-o", outputs[2]).stderr
    )
    for output, line in zip(outputs, lines, strict=True):
        assert f"{steep.sum()} of 20 scenes" in line
        with gr.open(output) as dataset:
            np.testing.assert_array_equal(marks(dataset), steep)


def test_the_slope_itself_in_place_of_the_marks(gradhesion: Call, tmp_path: Path, write_study: Write) -> None:
    study = STUDY | {"outputs": ["dissipated_energy", "contact_slope"]}
    output = tmp_path / "out.nc"
    steep = int((slopes(STUDY) > 1.0).sum())
    assert f"{steep} of 20 scenes" in gradhesion("run", write_study(written(study)), "-o", output).stderr
    with gr.open(output) as dataset:
        assert STEEP not in dataset.variables
        assert dataset["contact_slope"].attrs["units"] == "1"
        assert WORDS in _legend(drawn(dataset, ["dissipated_energy"]))
    assert gradhesion("info", output).stdout.count("contact_slope   ") == 1


def test_points_units_solvers_and_realisations() -> None:
    punch = {"k": 0.0, "nu": 0.3, "A": 0.05, "R": "1 um", "c0": "1 um", "work_of_adhesion": "50 mJ/m^2"}
    quantities = punch | {"wavelength": ["50 nm", "0.8 um"], "E_star": "1.5 MPa"}
    found = gr.solve(quantities, "dissipated_energy")
    np.testing.assert_array_equal(marks(found), [1, 0])
    assert marks(gr.solve(quantities, "dissipated_energy", a_max="1 um")).sum() == 0
    points = STUDY | {"layout": "points", "parameters": PARAMETERS | {"k": [0.0, 0.1, 0.2, 0.3, 0.3]}}
    np.testing.assert_array_equal(marks(compute(study_from(points))), slopes(points) > 1.0)
    several = STUDY | {"method": {"solver": ["exact", "envelope"]}}
    both = marks(compute(study_from(several)))
    np.testing.assert_array_equal(both[0], slopes(STUDY) > 1.0)
    assert both[1].all(), "envelopes of an unbounded punch have no end"


def test_uncertain_inputs_mark_the_scene_itself_and_optima_what_they_find() -> None:
    uncertain = STUDY | {"uncertainty": {"modulus": "5 %", "samples": 8}}
    np.testing.assert_array_equal(marks(compute(study_from(uncertain))), slopes(STUDY) > 1.0)
    searched = PARAMETERS | {"k": [0.0, 0.3], "lambda_over_R": {"start": 0.05, "stop": 0.8, "spacing": "log"}}
    optimum: dict[str, Any] = {"kind": "optimum", "parameters": searched}
    optimum |= {"optimum": {"maximise": "dissipated_energy", "over": ["lambda_over_R"], "resolution": 20}}
    found = compute(study_from(optimum))
    for i, k in enumerate([0.0, 0.3]):
        best = float(found["best_lambda_over_R"][i])
        own = {"outputs": ["dissipated_energy"], "parameters": PARAMETERS | {"k": k, "lambda_over_R": best}}
        assert marks(found)[i] == (slopes(own) > 1.0)
    assert marks(found)[0] == 1
    shallow = {"maximise": "contact_slope", "over": ["lambda_over_R"], "resolution": 20}
    assert compute(study_from(optimum | {"optimum": shallow}))["best_contact_slope"][0] > 1.0


def test_curves_say_it_of_what_is_drawn(gradhesion: Call, tmp_path: Path, write_study: Write) -> None:
    study = {"kind": "curve", "outputs": ["path"], "parameters": PARAMETERS | {"k": 0.0, "lambda_over_R": 0.8}}
    study["parameters"] |= {"indentation_max_over_R": [0.1, 3.0]}
    output = tmp_path / "out.nc"
    assert "1 of 2 scenes" in gradhesion("run", write_study(written(study)), "-o", output).stderr
    with gr.open(output) as dataset:
        np.testing.assert_array_equal(marks(dataset), dataset["path_contact_radius"].max("path_point") > 1.0)


def test_a_cone_says_it_once(gradhesion: Call, tmp_path: Path, write_study: Write) -> None:
    cone = STUDY | {"profile": {"exponent": 1.0}, "outputs": ["pull_off_force"]}
    cone["parameters"] = {"k": [0.0, 0.3], "nu": 0.3, "modulus": 30.0, "c0_over_R": 0.1, "A": 0.0, "a_max_over_R": 0.2}
    output = tmp_path / "cone.nc"
    result = gradhesion("run", write_study(written(cone)), "-o", output)
    assert result.stderr.count("a cone of slope 1") == 1
    assert "a cone" in gradhesion("info", output).stdout.partition("outside the range")[2]


def _legend(figure: Any) -> list[str]:
    return [text.get_text() for legend in figure.legends for text in legend.get_texts()]


def _hatches(figure: Any) -> set[str]:
    """The patterns with which areas of a figure are filled."""
    filled = [one for axes in figure.axes for one in axes.collections if isinstance(one, QuadContourSet) and one.filled]
    return {one.hatches[0] for one in filled if one.hatches[0]}


def test_pictures_hatch_them_and_pages_say_it(gradhesion: Call, tmp_path: Path, write_study: Write) -> None:
    output, page = tmp_path / "out.nc", tmp_path / "out.html"
    study = STUDY | {"parameters": STUDY["parameters"] | {"k": {"start": 0.0, "stop": 0.3, "num": 12}}}
    study["parameters"] |= {"lambda_over_R": {"start": 0.05, "stop": 0.8, "num": 10, "spacing": "log"}}
    assert gradhesion("run", write_study(written(study)), "-o", output, "--quiet").stderr == ""
    share = f"{(slopes(study) > 1.0).sum()} of 120 scenes"
    with gr.open(output) as dataset:
        figure = drawn(dataset.load(), ["dissipated_energy"])
        assert _legend(figure) == [WORDS]
        assert share in figure.get_suptitle()
        assert _hatches(figure) == {BEYOND["contact_slope"].hatch}
        few = dataset.isel(k=slice(10, 12), lambda_over_R=slice(8, 10))
        assert WORDS not in _legend(drawn(few, ["dissipated_energy"]))
    assert gradhesion("explore", output, "-o", page).exit_code == 0
    assert f"Outside the range of the model: {share}" in page.read_text(encoding="utf-8")


def test_python_says_it_once(capsys: pytest.CaptureFixture[str]) -> None:
    punch = {"k": 0.0, "nu": 0.3, "modulus": 31.7, "lambda_over_R": 0.05, "A": 0.05}
    for _ in range(2):
        found = gr.solve(punch, "dissipated_energy")
    assert found.gr.outside("contact_slope").item()
    assert capsys.readouterr().err.count("contact reaches slopes that are not small") <= 1
    assert not gr.solve(punch, "dissipated_energy", a_max_over_R=0.5).gr.outside("contact_slope").item()
    with pytest.raises(gr.GradhesionError, match="wave_slope: not a variable of this dataset"):
        found.gr.outside("wave_slope")


def test_a_cycle_that_turns_before_contact_is_flagged(gradhesion: Call, tmp_path: Path, write_study: Write) -> None:
    study = STUDY | {"parameters": STUDY["parameters"] | {"indentation_max_over_R": [-1.0, 0.05], "k": 0.0}}
    output = tmp_path / "out.nc"
    assert gradhesion("run", write_study(written(study)), "-o", output).exit_code == 0
    with gr.open(output) as dataset:
        assert dataset["status"].dtype == np.int16
        assert dataset["status"].attrs["flag_meanings"].split()[-1] == "no_contact"
        away = dataset.gr.flagged("no_contact")
        np.testing.assert_array_equal(away, [[True, False]] * 5)
        assert (dataset["dissipated_energy"].where(away, drop=True) == 0.0).all()
        assert dataset.gr.valid("dissipated_energy").all(), "no contact is an answer"
    assert "the cycle turns before first contact" in gradhesion("info", output).stdout
    plain = compute(study_from(STUDY))["status"]
    assert plain.dtype == np.int8
    assert "no_contact" not in plain.attrs["flag_meanings"]
