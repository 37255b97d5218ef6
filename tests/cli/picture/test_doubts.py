"""Doubtful scenes are hatched in maps and have open markers in lines; those that have failed are grey."""

from collections.abc import Callable
from pathlib import Path as File
from typing import Any

import numpy as np
import pytest
import xarray
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import to_rgb
from matplotlib.contour import QuadContourSet
from matplotlib.figure import Figure
from matplotlib.path import Path

from gradhesion.cli.dataset.dataset import compute
from gradhesion.cli.picture.curves.picture import drawn_curves
from gradhesion.cli.picture.doubts import BEYOND, CROSS, DOUBTS, GAP, GREY, Doubt, doubts_in
from gradhesion.cli.picture.pictured import save
from gradhesion.cli.picture.values.picture import drawn
from gradhesion.cli.study.reading import study_from
from gradhesion.core import CURVES, DOUBTFUL, FLAGS, OUTPUTS, REPORTS, solve
from gradhesion.core.answers.flags import FLAG_WORDS
from gradhesion.core.answers.flags import FLAGS as ALL_FLAGS
from gradhesion.core.problem.status import OF_FITS

LOADING, UNLOADING, TOLERANCE, *OF_ANSWERS = DOUBTS


def _legend(figure: Figure) -> list[str]:
    return [text.get_text() for legend in figure.legends for text in legend.get_texts()]


def _open_marks(axes: Axes, doubt: Doubt) -> list[Any]:
    return [line for line in axes.get_lines() if line.get_marker() == doubt.mark and line.get_mfc() == "white"]


def _hatched(axes: Axes, doubt: Doubt | None) -> list[Path]:
    """List the outlines of what is filled with the hatch of a doubt, or without any."""
    hatch = None if doubt is None else doubt.hatch
    filled = [one for one in axes.collections if isinstance(one, QuadContourSet) and one.filled]
    return [path for one in filled if one.hatches[0] == hatch for path in one.get_paths() if path.vertices.size]


@pytest.fixture
def make(data: dict[str, Any]) -> Callable[..., xarray.Dataset]:
    """Compute a small study whose status is what a test makes of it."""

    def compute_it(
        status: Any = 0, outputs: Any = ("pull_off_force", "dissipated_energy"), **parameters: Any
    ) -> xarray.Dataset:
        fixed = {"k": 0.2, "A": 0.05, "a_max_over_R": 1.0, "lambda_over_R": {"start": 0.1, "stop": 0.5, "num": 12}}
        study = data | {"outputs": [*outputs], "parameters": data["parameters"] | fixed | parameters}
        dataset = compute(study_from(study), threads=1)
        dataset["status"][...] = status
        return dataset

    return compute_it


MAP = {"k": {"start": 0.0, "stop": 0.9, "num": 7}}


def test_every_flag_has_words_and_every_doubt_looks_of_its_own() -> None:
    assert list(FLAG_WORDS) == [*ALL_FLAGS, *OF_FITS]
    assert sum(doubt.bit for doubt in (LOADING, UNLOADING, TOLERANCE)) == DOUBTFUL
    assert {doubt.bit for doubt in OF_ANSWERS} <= {*ALL_FLAGS.values()} - {*FLAGS.values()}
    for looks in ([doubt.hatch for doubt in DOUBTS], [doubt.mark for doubt in DOUBTS]):
        assert len(set(looks)) == len(DOUBTS)
    sizes = [doubt.size for doubt in DOUBTS]
    assert sizes == sorted(sizes), "the larger ones are drawn first"


def test_loading_casts_no_doubt_on_what_follows_full_contact() -> None:
    status = np.array([0, *FLAGS.values()])
    doubtful = {name for name in (*OUTPUTS, *REPORTS, *CURVES) if LOADING in doubts_in(status, name)}
    assert doubtful == {
        "dissipated_energy", "loading_energy", "energy_gain", "loading_jumps", "delta_max", "path", "jumps"
    }  # fmt: skip
    for name in OUTPUTS:
        assert {UNLOADING, TOLERANCE} <= {*doubts_in(status, name)}
    assert (
        doubts_in(np.array([FLAGS["pull_off_at_rim"], FLAGS["jump_in_to_rim"], FLAGS["close_to_a_jump"]]), "delta_max")
        == []
    )
    assert doubts_in(status, "status") == []


def test_a_map_hatches_doubtful_scenes_and_shows_their_values(
    make: Callable[..., xarray.Dataset], tmp_path: File
) -> None:
    dataset = make(**MAP)
    plain = drawn(dataset, ["dissipated_energy"])
    dataset["status"][2:4, 5:9] = LOADING.bit
    dataset["status"][5:, :3] = FLAGS["close_to_a_jump"]
    hatched = drawn(dataset, ["dissipated_energy"])
    assert _legend(plain) == []
    assert _legend(hatched) == [LOADING.words]
    assert _hatched(plain.axes[0], LOADING) == []
    paths = _hatched(hatched.axes[0], LOADING)
    x, y = dataset["lambda_over_R"].values, dataset["k"].values
    inside = np.array([[any(path.contains_point((u, v)) for path in paths) for u in x] for v in y])
    np.testing.assert_array_equal(inside, dataset["status"] == LOADING.bit)
    np.testing.assert_array_equal(hatched.axes[0].collections[0].get_array(), plain.axes[0].collections[0].get_array())
    save(hatched, tmp_path / "x.svg", "svg")
    assert _legend(drawn(dataset, ["pull_off_force"])) == [], "the force does not depend on loading"
    assert _legend(drawn(dataset, ["status"])) == []


def test_a_map_hatches_what_leaves_the_range_of_the_model(make: Callable[..., xarray.Dataset], tmp_path: File) -> None:
    grid = {"lambda_over_R": np.geomspace(0.05, 1.0, 12).tolist(), "A": np.geomspace(1e-3, 0.2, 10).tolist(), "k": 0.3}
    dataset = make(outputs=("pull_off_force", "wave_slope", "johnson_alpha"), **grid)
    force = drawn(dataset, ["pull_off_force"])
    steep, several = (BEYOND[name] for name in ("wave_slope", "johnson_alpha"))
    assert _legend(force) == [steep.words, several.words]
    x, y = dataset["lambda_over_R"].values, dataset["A"].values
    beyond = (dataset["wave_slope"] > 0.5).transpose("A", "lambda_over_R").values
    paths = _hatched(force.axes[0], steep)
    inside = np.array([[any(path.contains_point((u, v)) for path in paths) for u in x] for v in y])
    np.testing.assert_array_equal(inside[1:-1, 1:-1], beyond[1:-1, 1:-1])
    assert _legend(drawn(dataset, ["johnson_alpha"])) == [several.words], "a number shows its own limit alone"
    assert _legend(drawn(dataset.isel(A=slice(0, 2)), ["pull_off_force"])) == []
    save(force, tmp_path / "x.svg", "svg")


def test_a_map_may_have_every_doubt_and_failures_at_once(make: Callable[..., xarray.Dataset], tmp_path: File) -> None:
    dataset = make(**MAP, a_max_over_R=[0.4, 1.0])
    dataset["status"][...] = DOUBTFUL
    dataset["status"][1:3, 2:5] = FLAGS["no_value"] | LOADING.bit
    dataset["dissipated_energy"][1:3, 2:5] = np.nan
    figure = drawn(dataset, [])
    assert _legend(figure) == [*(doubt.words for doubt in (LOADING, UNLOADING, TOLERANCE)), GAP], "once for all panels"
    save(figure, tmp_path / "x.png", "png")
    for axes in figure.subfigs[0].subfigs[1].axes[:2]:
        assert axes.patch.get_facecolor()[:3] == to_rgb(GREY)
        failed = dataset["lambda_over_R"].values[3], dataset["k"].values[1]
        for doubt in (None, LOADING, UNLOADING, TOLERANCE):
            paths = _hatched(axes, doubt)
            assert paths
            assert not any(path.contains_point(failed) for path in paths), "the grey shows through"


def test_lines_have_open_markers_where_they_are_doubtful(make: Callable[..., xarray.Dataset], tmp_path: File) -> None:
    dataset = make(k=[0.0, 0.3])
    dataset["status"][1, 4:7] = LOADING.bit
    dataset["status"][1, 6] |= TOLERANCE.bit
    dataset["dissipated_energy"][0, 2:4] = np.nan
    dataset["status"][0, 2:4] = FLAGS["no_value"]
    figure = drawn(dataset, [])
    save(figure, tmp_path / "x.png", "png")
    assert _legend(figure) == [LOADING.words, TOLERANCE.words, GAP]
    force, energy = (part.axes[0] for part in figure.subfigs[0].subfigs)
    x = dataset["lambda_over_R"].values
    for doubt, axes, marked in (
        (LOADING, energy, slice(4, 7)),
        (TOLERANCE, energy, slice(6, 7)),
        (TOLERANCE, force, slice(6, 7)),
    ):
        (line,) = [line for line in _open_marks(axes, doubt) if len(line.get_xdata())]
        np.testing.assert_array_equal(line.get_xdata(), x[marked])
        name = "dissipated_energy" if axes is energy else "pull_off_force"
        np.testing.assert_array_equal(line.get_ydata(), dataset[name][1, marked])
    assert not any(len(line.get_xdata()) for line in _open_marks(force, LOADING))
    (crosses,) = [line for line in energy.get_lines() if line.get_marker() == "x"]
    assert crosses.get_color() == CROSS
    np.testing.assert_array_equal(crosses.get_xdata(), x[2:4])


def test_long_lines_have_some_of_their_markers_and_the_ends_of_each_run(make: Callable[..., xarray.Dataset]) -> None:
    dataset = make(lambda_over_R={"start": 0.1, "stop": 0.5, "num": 400})
    dataset["status"][17:321] = LOADING.bit
    dataset["status"][333] = LOADING.bit
    (axes,) = drawn(dataset, ["dissipated_energy"]).axes
    (line,) = _open_marks(axes, LOADING)
    places = np.searchsorted(dataset["lambda_over_R"].values, line.get_xdata())
    assert {17, 320, 333} <= {*places.tolist()}
    assert (dataset["status"].values[places] == LOADING.bit).all()
    assert 20 < places.size < 50


def test_points_have_open_markers(make: Callable[..., xarray.Dataset], data: dict[str, Any], tmp_path: File) -> None:
    data["layout"] = "points"
    dataset = make(lambda_over_R=[0.3, 0.1, 0.2, 0.4])
    dataset["status"][0:2] = LOADING.bit
    dataset["dissipated_energy"][3] = np.nan
    figure = drawn(dataset, ["dissipated_energy"])
    save(figure, tmp_path / "x.png", "png")
    assert _legend(figure) == [LOADING.words, GAP]
    (axes,) = figure.axes
    (line,) = _open_marks(axes, LOADING)[-1:]
    assert line.get_xdata().tolist() == [0.1, 0.3]


def test_a_doubtful_path_has_open_markers_on_loading(data: dict[str, Any], tmp_path: File) -> None:
    parameters = {"k": 0.2, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.1, "lambda_over_R": 0.12, "a_max_over_R": 0.6}
    parameters["A"] = [0.0, 0.15]
    assert [*solve(parameters)["status"]] == [0, LOADING.bit], "the scenes are what they are meant to be"
    dataset = compute(study_from(data | {"kind": "curve", "outputs": ["path", "smooth"], "parameters": parameters}))
    for figure in (drawn_curves(dataset, []), drawn_curves(dataset.isel(A=1), [])):
        save(figure, tmp_path / "x.png", "png")
        assert _legend(figure)[-1] == LOADING.words
        for axes in figure.axes:
            (line,) = _open_marks(axes, LOADING)
            loading = dataset["path_unloading"].isel(A=1).values == 0
            assert len(line.get_xdata()) == loading.sum()
    for figure in (drawn_curves(dataset.isel(A=0), []), drawn_curves(dataset, ["smooth"])):
        assert LOADING.words not in _legend(figure)


def test_a_scene_without_curves_is_grey_in_the_legend(data: dict[str, Any]) -> None:
    parameters = data["parameters"] | {"k": 0.2, "A": 0.1, "a_max_over_R": 0.4, "lambda_over_R": [1e-9, 0.2]}
    dataset = compute(study_from(data | {"kind": "curve", "outputs": ["path"], "parameters": parameters}))
    figure = drawn_curves(dataset, [])
    first, second = figure.legends[0].get_texts()[:2]
    assert first.get_text().endswith("(no value)")
    assert not second.get_text().endswith("(no value)")
    assert to_rgb(figure.legends[0].get_lines()[0].get_color()) == to_rgb(CROSS)


def test_a_map_of_the_status_has_a_colour_for_each_set_of_flags(
    make: Callable[..., xarray.Dataset], tmp_path: File
) -> None:
    dataset = make(**MAP)
    codes = [0, FLAGS["pull_off_at_rim"], LOADING.bit | FLAGS["jump_in_to_rim"]]
    dataset["status"][...] = np.array(codes)[np.arange(12) // 4]
    figure = drawn(dataset, ["status"])
    save(figure, tmp_path / "x.png", "png")
    axes, bar = figure.axes
    (mesh,) = [one for one in axes.collections if isinstance(one, QuadMesh)]
    np.testing.assert_array_equal(np.array(codes)[mesh.get_array().astype(int)], dataset["status"])
    words = [tick.get_text() for tick in bar.get_yticklabels()]
    assert words == ["nothing to report", "pull off at rim", "loading contact not one disc\n+ jump in to rim"]
    shades = mesh.cmap(mesh.norm(np.arange(3))) @ [0.299, 0.587, 0.114, 0.0]
    assert (np.diff(shades) > 0.2).all(), "they differ in a grey print"
