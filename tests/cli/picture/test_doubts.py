"""Doubtful scenes are hatched in maps and have open markers in lines; failed ones are grey; spreads are bands or bars."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import xarray
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.contour import QuadContourSet
from matplotlib.path import Path

import gradhesion as gr
from gradhesion.cli.dataset.read.model_range import LIMITS
from gradhesion.core import DOUBTFUL, FLAGS
from gradhesion.core.answers.flags import FLAG_WORDS
from tests.cli.conftest import legend
from tests.conftest import mistakes

LOADING, TOLERANCE, GONE = (FLAGS[name] for name in ("loading_contact_not_one_disc", "tolerance_not_met", "no_value"))
HATCH = "////"
MARKS = {LOADING: "o", TOLERANCE: "D"}
PUNCH: dict[str, Any] = {"k": 0.2, "nu": 0.27, "modulus": 430.0, "c0_over_R": 0.013, "A": 0.05, "a_max_over_R": 1.0}
WAVES = {"start": 0.1, "stop": 0.5, "num": 12}
SEVEN = {"k": {"start": 0.0, "stop": 0.9, "num": 7}}
WORDS = {bit: FLAG_WORDS[name] for name, bit in FLAGS.items()}
WRONG = [
    ("loading_jumps", {"band": "std"}), ("pull_off_force_std", {"band": "std"}), ("pull_off_force", {"band": "std", "kind": "map"}),
    ("pull_off_force", {"band": "stdd"}), ("pull_off_force", {"band": "std", "over": {"k": "max"}}), ("pull_off_force", {"band": "quantiles"}),
]  # fmt: skip


def open_marks(axes: Axes, bit: int) -> list[Any]:
    lines = [line for line in axes.get_lines() if line.get_marker() == MARKS[bit] and line.get_mfc() == "white"]
    return [line for line in lines if len(line.get_xdata())]


def hatched(axes: Axes, hatch: str | None) -> list[Path]:
    """List the outlines of what is filled with a hatch, or without any."""
    filled = [one for one in axes.collections if isinstance(one, QuadContourSet) and one.filled]
    return [path for one in filled if one.hatches[0] == hatch for path in one.get_paths() if path.vertices.size]


def inside(paths: list[Path], dataset: xarray.Dataset, y: str) -> np.ndarray:
    return np.array([[any(path.contains_point((u, v)) for path in paths) for u in dataset["lambda_over_R"].values] for v in dataset[y].values])  # fmt: skip


@pytest.fixture
def make() -> Callable[..., xarray.Dataset]:
    """Compute a small study whose status is what a test makes of it."""

    def computed(outputs: Any = ("pull_off_force", "dissipated_energy"), **parameters: Any) -> xarray.Dataset:
        dataset = gr.run({"outputs": [*outputs], "parameters": PUNCH | {"lambda_over_R": WAVES} | parameters})
        dataset["status"][...] = 0
        return dataset

    return computed


def test_a_map_hatches_doubtful_scenes_and_shows_their_values(make: Callable[..., xarray.Dataset]) -> None:
    dataset = make(**SEVEN)
    plain = gr.plot(dataset, "dissipated_energy")
    dataset["status"][2:4, 5:9] = LOADING
    dataset["status"][5:, :3] = FLAGS["close_to_a_jump"]
    shown = gr.plot(dataset, "dissipated_energy")
    assert (legend(plain), legend(shown)) == ([], [WORDS[LOADING]])
    assert hatched(plain[0], HATCH) == []
    np.testing.assert_array_equal(inside(hatched(shown[0], HATCH), dataset, "k"), dataset["status"] == LOADING)
    np.testing.assert_array_equal(shown[0].collections[0].get_array(), plain[0].collections[0].get_array())
    assert legend(gr.plot(dataset, "pull_off_force")) == [], "the force does not depend on loading"
    assert legend(gr.plot(dataset, "status")) == []


def test_a_map_hatches_what_leaves_the_range_of_the_model(make: Callable[..., xarray.Dataset]) -> None:
    amplitudes, waves = np.geomspace(1e-3, 0.2, 10).tolist(), np.geomspace(0.05, 1.0, 12).tolist()
    dataset = make(("pull_off_force", "wave_slope", "johnson_alpha"), k=0.3, A=amplitudes, lambda_over_R=waves)
    steep, several = (LIMITS[name].words for name in ("wave_slope", "johnson_alpha"))
    force = gr.plot(dataset, "pull_off_force")
    assert legend(force) == [steep, several]
    beyond = (dataset["wave_slope"] > 0.5).transpose("A", "lambda_over_R").values
    np.testing.assert_array_equal(inside(hatched(force[0], "++"), dataset, "A")[1:-1, 1:-1], beyond[1:-1, 1:-1])
    assert legend(gr.plot(dataset, "johnson_alpha")) == [several], "a number shows its own limit alone"
    assert len(legend(gr.plot(dataset.isel(A=slice(0, 2)), "pull_off_force", x="lambda_over_R"))) == 2, "lines alone"


def test_a_map_may_have_every_doubt_and_failures_at_once(make: Callable[..., xarray.Dataset]) -> None:
    dataset = make(**SEVEN, a_max_over_R=[0.4, 1.0])
    dataset["status"][...] = DOUBTFUL
    dataset["status"][1:3, 2:5] = GONE | LOADING
    dataset["dissipated_energy"][1:3, 2:5] = np.nan
    panels = gr.plot(dataset)
    found = [WORDS[bit] for bit in FLAGS.values() if bit & DOUBTFUL]
    assert {*legend(panels)} == {*found, "no finite value"}
    assert len(legend(panels)) == len(found) + 1, "once for all panels"
    failed = dataset["lambda_over_R"].values[3], dataset["k"].values[1]
    for axes in panels[2:]:
        assert axes.patch.get_facecolor()[:3] == to_rgb("0.8")
        for hatch in (None, HATCH, "xxxx"):
            paths = hatched(axes, hatch)
            assert paths
            assert not any(path.contains_point(failed) for path in paths), "the grey shows through"


def test_lines_have_open_markers_where_they_are_doubtful(make: Callable[..., xarray.Dataset]) -> None:
    dataset = make(k=[0.0, 0.3])
    dataset["status"][1, 4:7] = LOADING
    dataset["status"][1, 6] |= TOLERANCE
    dataset["dissipated_energy"][0, 2:4] = np.nan
    dataset["status"][0, 2:4] = GONE
    panels = gr.plot(dataset)
    assert {WORDS[LOADING], WORDS[TOLERANCE], "no finite value"} <= {*legend(panels)}
    force, energy = panels
    x = dataset["lambda_over_R"].values
    for bit, axes, name, marked in (
        (LOADING, energy, "dissipated_energy", slice(4, 7)),
        (TOLERANCE, energy, "dissipated_energy", slice(6, 7)),
        (TOLERANCE, force, "pull_off_force", slice(6, 7)),
    ):
        (line,) = open_marks(axes, bit)
        np.testing.assert_array_equal(line.get_xdata(), x[marked])
        np.testing.assert_array_equal(line.get_ydata(), dataset[name][1, marked])
    assert not open_marks(force, LOADING)
    (crosses,) = [line for line in energy.get_lines() if line.get_marker() == "x"]
    np.testing.assert_array_equal(crosses.get_xdata(), x[2:4])
    lists = PUNCH | {"lambda_over_R": [0.3, 0.1, 0.2, 0.4]}
    points = gr.run({"layout": "points", "outputs": ["dissipated_energy"], "parameters": lists})
    points["status"][...] = [LOADING, LOADING, 0, 0]
    assert open_marks(gr.plot(points)[0], LOADING)[-1].get_xdata().tolist() == [0.1, 0.3]


def test_an_optimum_at_a_bound_is_marked_where_its_flag_is() -> None:
    own = {"k": [0.0, 0.2, 0.4, 0.6], "A": {"start": 0.001, "stop": 0.02}, "lambda_over_R": {"start": 0.1, "stop": 1.0}}
    search = {"maximise": "pull_off_force", "over": ["A", "lambda_over_R"], "resolution": 12}
    optima = gr.run({"kind": "optimum", "optimum": search, "parameters": PUNCH | own})
    meanings = optima["on_bound"].attrs["flag_meanings"].split()
    upper, lower = (1 << meanings.index(word) for word in ("A_at_its_upper_bound", "lambda_over_R_at_its_lower_bound"))
    bounds = {"best_A": [0.0, 0.6], "best_lambda_over_R": [0.4, 0.6], "best_pull_off_force": [0.0, 0.4, 0.6]}
    for name, expected in bounds.items():
        optima["on_bound"][...] = [upper, 0, lower, upper | lower]
        panels = gr.plot(optima, name)
        (marks,) = [line for line in panels[0].get_lines() if line.get_marker() == ">"]
        np.testing.assert_array_equal(marks.get_xdata(), expected)
        assert len(legend(panels)) == 1
        optima["on_bound"][...] = 0
        assert not legend(gr.plot(optima, name))


@pytest.fixture(scope="module")
def sampled() -> xarray.Dataset:
    uncertainty = {"modulus": "5 %", "A": "10 %", "samples": 16}
    parameters = PUNCH | {"k": [0.0, 0.4], "A": 0.01, "a_max_over_R": 0.5, "lambda_over_R": WAVES | {"num": 24}}
    outputs = ["pull_off_force", "loading_jumps"]
    return gr.run({"outputs": outputs, "parameters": parameters, "uncertainty": uncertainty})


def edges(axes: Axes) -> list[tuple[np.ndarray, np.ndarray]]:
    """Read the least and the greatest height of each band at its places."""
    found = []
    for path in (band.get_paths()[0] for band in axes.collections if isinstance(band, PolyCollection)):
        if len(path.vertices) > 4:
            rows = [path.vertices[path.vertices[:, 0] == place, 1] for place in np.unique(path.vertices[:, 0])]
            found.append((np.array([row.min() for row in rows]), np.array([row.max() for row in rows])))
    return found


def test_a_band_goes_from_edge_to_edge_and_is_refused_where_there_is_none(sampled: xarray.Dataset) -> None:
    panels = gr.plot(sampled, "pull_off_force")
    quantiles = [sampled[f"pull_off_force_{end}"].values for end in ("p05", "p95")]
    for found, low, high in zip(edges(panels[0]), *quantiles, strict=True):
        np.testing.assert_array_equal(found, [low, high])
    assert "5 % to 95 % of samples" in legend(panels)
    low, high = panels[0].get_ylim()
    assert low < quantiles[0].min() < quantiles[1].max() < high
    ((low, high),) = edges(gr.plot(sampled.isel(k=0), "pull_off_force", band="std")[0])
    value, deviation = (sampled[name].values[0] for name in ("pull_off_force", "pull_off_force_std"))
    np.testing.assert_array_equal([low, high], [value - deviation, value + deviation])
    linear = sampled.drop_vars([name for name in sampled if str(name)[-4:] in ("_p05", "_p95")])
    assert len(edges(gr.plot(linear, "pull_off_force")[0])) == 2, "without samples it is what there is"
    assert len(edges(gr.plot(sampled, "pull_off_force_p50")[0])) == 2
    for name in ("pull_off_force_std", "loading_jumps"):
        assert not edges(gr.plot(sampled, name)[0])
    for choices in ({"band": "none"}, {"over": {"k": "max"}}):
        assert not edges(gr.plot(sampled, "pull_off_force", **choices)[0])
    for name, choices in WRONG:
        assert "band" in mistakes(gr.plot, sampled.drop_vars("pull_off_force_p05"), name, **choices)[0]


def test_few_values_have_bars(sampled: xarray.Dataset) -> None:
    few = sampled.isel(lambda_over_R=slice(0, 24, 4))
    (axes,) = gr.plot(few, "pull_off_force")
    bars = [one for one in axes.collections if isinstance(one, LineCollection)]
    ends = np.array([path.vertices[:, 1] for path in bars[1].get_paths()]).T
    np.testing.assert_allclose(ends, [few[f"pull_off_force_{end}"].values[1] for end in ("p05", "p95")], rtol=1e-15)
    points = few.isel(k=0).rename(lambda_over_R="scene").drop_vars("scene")
    points = points.assign_coords(lambda_over_R=("scene", few["lambda_over_R"].values))
    (axes,) = gr.plot(points, "pull_off_force")
    assert [len(one.get_paths()) for one in axes.collections if isinstance(one, LineCollection)] == [6]
