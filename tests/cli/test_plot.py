"""`gradhesion plot` draws every shape of dataset, and says so where there is nothing to draw."""

from collections.abc import Callable
from pathlib import Path

import matplotlib as mpl
import netCDF4
import numpy as np
import pytest
from click.testing import Result
from matplotlib.contour import QuadContourSet
from matplotlib.figure import Figure

from gradhesion.cli.dataset.read.reader import opened
from gradhesion.cli.dataset.read.selection import selection_of
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.symbols import SYMBOLS
from gradhesion.cli.picture.curves.picture import drawn_curves
from gradhesion.cli.picture.doubts import END
from gradhesion.cli.picture.pictured import save
from gradhesion.cli.picture.scales import scale
from gradhesion.cli.picture.values import layout
from gradhesion.cli.picture.values.layout import Plan, plan_of
from gradhesion.cli.picture.values.picture import drawn

Call = Callable[..., Result]
INF = "a_max_over_R=[0.5, 1.0, 2.0, inf]"
SOLVERS = "../method.solver=['exact', 'asymptotic', 'envelope']"
SHAPES = {
    "a line": ["k=0.2", "A=0.1", "a_max_over_R=1.0"],
    "a line to infinity": ["k=0.2", "A=0.1", "lambda_over_R=0.1", INF],
    "a few lines": ["A=0.1", "lambda_over_R.num=12", "a_max_over_R=1.0"],
    "a map": ["A=0.1", "lambda_over_R.num=12", "a_max_over_R=1.0", "k={start=0, stop=0.9, num=7}"],
    "a map to infinity": ["A=0.1", "k={start=0, stop=0.9, num=9}", "a_max_over_R=[0.1, 0.2, 0.5, 1, 2, inf]", "lambda_over_R=1.0"],
    "panels of lines": [INF],
    "panels of maps": ["lambda_over_R.num=12", "k={start=0, stop=0.9, num=7}", "c0_over_R=[0.1, 1.0]", INF],
    "solvers as lines": [SOLVERS, "k=0.2", "A=0.1", "a_max_over_R=1.0"],
    "solvers beside lines": [SOLVERS, "A=0.1", "lambda_over_R.num=12", "a_max_over_R=1.0"],
    "solvers beside maps": [SOLVERS, "lambda_over_R.num=12", "k={start=0, stop=0.9, num=7}", "a_max_over_R=1.0"],
    "falling axes": ["lambda_over_R=[0.5, 0.2, 0.1]", "k=[0.3, 0.1]", "A=0.1", "a_max_over_R=1.0"],
}  # fmt: skip


@pytest.fixture
def dataset_file(gradhesion: Call, study_file: Path, tmp_path: Path) -> Callable[..., Path]:
    """Make a dataset with some parameters of its own."""

    def make(*parameters: str, layout: str = "grid") -> Path:
        path = tmp_path / "out.nc"
        sets = [f"--set=parameters.{parameter}".replace("parameters.../", "") for parameter in parameters]
        result = gradhesion("run", study_file, "-o", path, "--quiet", f"--set=layout='{layout}'", *sets)
        assert result.exit_code == 0, result.stderr
        return path

    return make


@pytest.mark.parametrize("shape", SHAPES)
def test_every_shape_is_drawn(shape: str, gradhesion: Call, dataset_file: Callable[..., Path]) -> None:
    path = dataset_file(*SHAPES[shape])
    result = gradhesion("plot", path)
    assert result.exit_code == 0, result.stderr
    assert path.with_suffix(".png").read_bytes()[:4] == b"\x89PNG"


@pytest.mark.parametrize(("form", "start"), [("svg", b"<?xml"), ("PDF", b"%PDF"), ("png", b"\x89PNG")])
def test_the_form_follows_the_name(
    form: str, start: bytes, gradhesion: Call, dataset_file: Callable[..., Path], tmp_path: Path
) -> None:
    picture = tmp_path / f"picture.{form}"
    assert gradhesion("plot", dataset_file(), "-o", picture, "--variable", "loading_jumps").exit_code == 0
    assert picture.read_bytes().startswith(start)


@pytest.fixture
def curve_file(gradhesion: Call, study_file: Path, tmp_path: Path) -> Callable[..., Path]:
    """Make a dataset of curves."""

    def make(outputs: str, *sets: str) -> Path:
        path = tmp_path / "curves.nc"
        parameters = ("k=0.3", "lambda_over_R=0.17", "A=[0.0, 0.023, 0.07]", "a_max_over_R=0.4")
        study = ["--set=kind='curve'", f"--set=outputs={outputs}", *(f"--set=parameters.{one}" for one in parameters)]
        result = gradhesion("run", study_file, "-o", path, "--quiet", *study, *(f"--set={one}" for one in sets))
        assert result.exit_code == 0, result.stderr
        return path

    return make


EVERYTHING = "['equilibrium', 'path', 'asymptotic', 'envelope', 'effective', 'smooth']"
CURVES = {
    "everything of one scene": (EVERYTHING, ["parameters.A=0.07"]),
    "everything of several": (EVERYTHING, ["parameters.k=[0.0, 0.3]"]),
    "more scenes than colours": ("['path']", ["parameters.A={start=0, stop=0.1, num=8}"]),
    "points": ("['path']", ["layout='points'", "parameters.k=[0.0, 0.1, 0.2]"]),
    "an axis of one value": ("['path']", ["parameters.A=[0.07]"]),
    "load over depth alone": ("['load', 'indentation']", []),
    "an unbounded punch": (EVERYTHING, ["parameters.a_max_over_R=inf"]),
}


@pytest.mark.parametrize("shape", CURVES)
def test_curves_are_drawn(shape: str, gradhesion: Call, curve_file: Callable[..., Path]) -> None:
    outputs, sets = CURVES[shape]
    path = curve_file(outputs, *sets)
    result = gradhesion("plot", path)
    assert result.exit_code == 0, result.stderr
    assert path.with_suffix(".png").read_bytes()[:4] == b"\x89PNG"


def test_a_picture_of_curves_has_three_panels_and_tells_its_scenes(curve_file: Callable[..., Path]) -> None:
    path = curve_file("['equilibrium', 'path', 'smooth']", "parameters.k=[0.1, 0.3]")
    with opened(path) as dataset:
        figure = drawn_curves(dataset, ["path"])
        labels = [(axes.get_xlabel().split(" $")[0], axes.get_ylabel().split(" $")[0]) for axes in figure.axes]
        assert labels == [("depth", "load"), ("contact radius", "depth"), ("contact radius", "load")]
        legend = [text.get_text() for text in figure.legends[0].get_texts()]
        assert legend == ["$A$ = 0", "$A$ = 0.023", "$A$ = 0.07", "path", "jump"]
        assert "$k$ = 0.1 (first of 2)" in figure.get_suptitle()
        # what is drawn is the path: its lines and its jumps reach from the first depth to the last
        drawn = np.concatenate([line.get_xdata() for line in figure.axes[0].get_lines() if len(line.get_xdata()) > 2])
        first = dataset["path_indentation"].isel(k=0)
        assert np.nanmin(drawn) == float(first.min())
        assert np.nanmax(drawn) == float(first.max())
        assert "scenes" not in figure.get_suptitle(), "all along the last axis are drawn"
        single = drawn_curves(dataset.isel(k=0, A=2), ["equilibrium"])
        legend = [text.get_text() for text in single.legends[0].get_texts()]
        assert legend == ["equilibrium, stable", "equilibrium, unstable"]


def test_a_picture_of_some_scenes_says_so(curve_file: Callable[..., Path]) -> None:
    with opened(curve_file("['path']", "parameters.A={start=0, stop=0.1, num=9}")) as dataset:
        figure = drawn_curves(dataset, [])
        assert "5 of 9 scenes" in figure.get_suptitle()
        legend = [text.get_text() for text in figure.legends[0].get_texts()]
        assert legend[:5] == [f"$A$ = {value:g}" for value in (0, 0.025, 0.05, 0.075, 0.1)]


def test_curves_that_cannot_be_drawn_are_said(gradhesion: Call, curve_file: Callable[..., Path]) -> None:
    path = curve_file("['path', 'load']")
    for name, message in [
        ("pth", '--variable pth: not a curve of this dataset; did you mean "path"?'),
        ("smooth", "--variable smooth: not a curve of this dataset"),
        ("load", "equilibrium: a picture needs two of contact radius, indentation and load"),
        ("equilibrium", 'name whole curves in the outputs of the study, as in outputs = ["equilibrium"]'),
    ]:
        result = gradhesion("plot", path, "--variable", name)
        assert result.exit_code == 2
        assert message in result.stderr
    assert gradhesion("plot", path, "--variable", "path_load").exit_code == 0


def test_points_are_drawn(gradhesion: Call, dataset_file: Callable[..., Path]) -> None:
    path = dataset_file("lambda_over_R=[0.1, 0.2]", layout="points")
    assert gradhesion("plot", path).exit_code == 0
    assert gradhesion("plot", path, "--overwrite", "--variable", "status").exit_code == 0


def test_scenes_without_a_value_are_told(gradhesion: Call, dataset_file: Callable[..., Path]) -> None:
    path = dataset_file(*SHAPES["a map"])
    with netCDF4.Dataset(path, "a") as file:
        values = file["pull_off_force"][:]
        values[2:4] = np.nan
        file["pull_off_force"][:] = values
    picture = path.with_suffix(".svg")
    assert gradhesion("plot", path, "-o", picture, "--variable", "pull_off_force").exit_code == 0
    assert "no finite value" in picture.read_text()


def test_nothing_to_draw_is_said(gradhesion: Call, dataset_file: Callable[..., Path]) -> None:
    path = dataset_file("k=0.1", "A=0.1", "lambda_over_R=0.1", "a_max_over_R=1.0")
    result = gradhesion("plot", path)
    assert result.exit_code == 2
    assert "nothing varies, so there is nothing to draw" in result.stderr
    assert not path.with_suffix(".png").exists()


def test_a_variable_without_any_value_is_said(gradhesion: Call, dataset_file: Callable[..., Path]) -> None:
    path = dataset_file()
    with netCDF4.Dataset(path, "a") as file:
        file["pull_off_force"][:] = np.nan
    result = gradhesion("plot", path)
    assert result.exit_code == 2
    assert "no value in any scene" in result.stderr


def test_wrong_wishes_are_said(gradhesion: Call, dataset_file: Callable[..., Path], tmp_path: Path) -> None:
    path = dataset_file()
    result = gradhesion("plot", path, "--variable", "pull_of_force")
    assert result.exit_code == 2
    assert 'did you mean "pull_off_force"?' in result.stderr
    result = gradhesion("plot", path, "-o", tmp_path / "picture.bmp")
    assert result.exit_code == 2
    assert "ends in .png, .svg or .pdf" in result.stderr


def test_an_existing_picture_stays_without_overwrite(
    gradhesion: Call, dataset_file: Callable[..., Path], tmp_path: Path
) -> None:
    picture = tmp_path / "picture.png"
    picture.write_text("precious")
    path = dataset_file()
    assert gradhesion("plot", path, "-o", picture).exit_code == 4
    assert picture.read_text() == "precious"
    assert gradhesion("plot", path, "-o", picture, "--overwrite").exit_code == 0
    assert picture.read_bytes()[:4] == b"\x89PNG"


def test_every_further_axis_has_its_place() -> None:
    sizes = {"k": 19, "c0_over_R": 4, "lambda_over_R": 60, "A": 5, "a_max_over_R": 6}
    assert plan_of(sizes) == Plan(
        x="lambda_over_R", second="k", is_map=True, columns="a_max_over_R", rows="A", middle=("c0_over_R",)
    )
    assert plan_of({"k": 1}) is None


def test_solvers_are_lines_if_nothing_else_is_and_columns_otherwise() -> None:
    lines = plan_of({"solver": 3, "k": 1, "A": 40})
    assert lines == Plan(x="A", second="solver", is_map=False, columns=None, rows=None, middle=())
    maps = plan_of({"solver": 2, "k": 9, "A": 40, "a_max_over_R": 4})
    assert maps == Plan(x="A", second="k", is_map=True, columns="solver", rows="a_max_over_R", middle=())
    assert plan_of({"solver": 3, "k": 1}) is None


def test_scales_follow_the_spacing() -> None:
    assert scale(np.array([0.01, 0.02, 0.05, 0.1, 1.0])).log
    assert not scale(np.array([0.0, 0.01, 0.1])).log
    assert not scale(np.linspace(0.1, 0.9, 9)).log
    falling = scale(np.array([3.0, np.inf, 1.0]))
    assert falling.order.tolist() == [2, 0, 1]
    assert falling.positions.tolist() == [1.0, 3.0, 5.0]
    assert falling.infinite


def told(figure: Figure) -> str:
    """All that stands above the panels."""
    words = "\n".join([figure.get_suptitle(), *(part.get_suptitle() for part in figure.subfigs[0].subfigs)])
    return words.replace("$", "").replace(",\n", ",  ")


def test_lines_are_the_values_of_the_dataset(dataset_file: Callable[..., Path]) -> None:
    with opened(dataset_file("A=0.1", "lambda_over_R.num=12", "a_max_over_R=1.0")) as dataset:
        figure = drawn(dataset, [])
        force, energy = (part.axes[0] for part in figure.subfigs[0].subfigs)
        assert (force.get_xscale(), force.get_xlabel()) == ("linear", SYMBOLS["lambda_over_R"])
        assert force.get_ylabel() == SYMBOLS["pull_off_force"]
        assert energy.get_ylabel() == SYMBOLS["dissipated_energy"]
        for axes, name in ((force, "pull_off_force"), (energy, "dissipated_energy")):
            lines = [line for line in axes.get_lines() if line.get_linestyle() != "None"]
            assert len(lines) == dataset.sizes["k"]
            for line, values in zip(lines, dataset[name].transpose("k", "lambda_over_R").values, strict=True):
                np.testing.assert_array_equal(line.get_xdata(), dataset["lambda_over_R"])
                np.testing.assert_array_equal(line.get_ydata(), values)
        labels = [text.get_text() for text in figure.subfigs[0].legends[0].get_texts()]
        assert labels == [f"$k$ = {value:g}" for value in dataset["k"].values]
        assert "A = 0.1,  a_{\\max}/R = 1" in told(figure)


def test_a_map_has_its_axes_and_contours_its_values(dataset_file: Callable[..., Path]) -> None:
    wide = "lambda_over_R={start=0.02, stop=1.0, num=20, spacing='log'}"
    with opened(dataset_file("A=0.1", wide, "a_max_over_R=1.0", "k={start=0, stop=0.9, num=7}")) as dataset:
        for x, y in ((None, None), ("k", None), (None, "lambda_over_R"), ("k", "lambda_over_R")):
            figure = drawn(dataset, ["pull_off_force"], x=x, y=y)
            axes, bar = figure.axes
            turned = x is not None or y is not None
            sides = ["lambda_over_R", "k"][:: -1 if turned else 1]
            assert [axes.get_xlabel(), axes.get_ylabel()] == [SYMBOLS[side] for side in sides]
            assert (axes.get_xscale(), axes.get_yscale()) == (("linear", "log") if turned else ("log", "linear"))
            assert bar.get_ylabel() == SYMBOLS["pull_off_force"]
            filled, lines = [one for one in axes.collections if isinstance(one, QuadContourSet)][:2]
            assert lines.labelTexts
            # a contour crosses a line of the grid where the values along it, interpolated, have its level
            crossings = 0
            assert filled.get_array()[0] <= dataset["pull_off_force"].min()
            for level, path in zip(lines.levels, lines.get_paths(), strict=True):
                places = path.vertices[:, ::-1] if turned else path.vertices
                on_grid = [v for v in places if np.isclose(v[1], dataset["k"].values, rtol=1e-12, atol=1e-12).any()]
                for wavelength, k in on_grid:
                    item = int(np.argmin(np.abs(dataset["k"].values - k)))
                    found = np.interp(wavelength, dataset["lambda_over_R"], dataset["pull_off_force"].values[item])
                    assert found == pytest.approx(level, rel=1e-9)
                    crossings += 1
            assert crossings > 20


def test_what_is_fixed_or_reduced_is_said_and_drawn(dataset_file: Callable[..., Path]) -> None:
    with opened(dataset_file("A=[0.0, 0.02, 0.05]", "lambda_over_R.num=12", "a_max_over_R=1.0")) as dataset:
        selection = selection_of(dataset, ["A=0.019"], ["k=max"])
        figure = drawn(dataset, ["pull_off_force"], selection)
        assert "A = 0.02,  a_{\\max}/R = 1,  max over k" in told(figure)
        (line,) = figure.axes[0].get_lines()
        np.testing.assert_array_equal(line.get_ydata(), dataset["pull_off_force"].isel(A=1).max("k"))
        figure = drawn(dataset, ["pull_off_force"], selection_of(dataset, ["A=0.03", "k=0"], interpolate=True))
        assert "A = 0.03 (interpolated)" in told(figure)
        values = dataset["pull_off_force"].isel(k=0).interp(A=0.03)
        np.testing.assert_allclose(figure.axes[0].get_lines()[0].get_ydata(), values, rtol=1e-14)


def test_the_place_of_an_extreme_is_drawn_marked_at_an_end_and_left_out_where_there_is_none(
    dataset_file: Callable[..., Path],
) -> None:
    with opened(dataset_file("A=[0.0, 0.02, 0.05]", "lambda_over_R.num=12", "a_max_over_R=1.0", "k=0.0")) as dataset:
        figure = drawn(dataset, ["pull_off_force"], selection_of(dataset, [], ["lambda_over_R=argmin"]))
        (axes,) = figure.axes
        assert axes.get_ylabel() == r"$\lambda/R$ at minimum pull-off force"
        force = dataset["pull_off_force"].squeeze()
        places = dataset["lambda_over_R"].values[force.argmin("lambda_over_R").values]
        line = axes.get_lines()[0].get_ydata()
        assert np.isnan(line[0]), "without waves the force does not depend on their length"
        np.testing.assert_array_equal(line[1:], places[1:])
        assert "1 left out where all values are equal" in told(figure)
        ends = np.isin(places[1:], dataset["lambda_over_R"].values[[0, -1]])
        marked = [line for line in axes.get_lines() if line.get_marker() == END.mark]
        assert ends.any()
        assert [len(line.get_xdata()) for line in marked] == [ends.sum()]
        assert END.words in [text.get_text() for text in figure.legends[0].get_texts()]


def test_equal_values_have_no_place_of_an_extreme(dataset_file: Callable[..., Path]) -> None:
    with opened(dataset_file("A=0.0", "lambda_over_R=[0.1, 0.2]", "a_max_over_R=1.0")) as dataset:
        with pytest.raises(DatasetError) as refused:
            drawn(dataset, ["pull_off_force"], selection_of(dataset, [], ["lambda_over_R=argmax"]))
        assert "pull_off_force: its values along lambda_over_R are equal, so that no place is that of argmax" in str(
            refused.value
        )


def test_scenes_left_out_of_a_reduction_are_said(dataset_file: Callable[..., Path]) -> None:
    path = dataset_file("A=[0.0, 0.02, 0.05]", "k=0.1", "a_max_over_R=1.0")
    with netCDF4.Dataset(path, "a") as file:
        values = file["pull_off_force"][:]
        values[:, 0] = np.nan
        file["pull_off_force"][:] = values
    with opened(path) as dataset:
        failed = int(np.isnan(dataset["pull_off_force"].values).sum())
        selection = selection_of(dataset, over=["A=mean"])
        figure = drawn(dataset, ["pull_off_force"], selection)
        assert failed > 1
        assert f"mean over A,  {failed} failed scenes left out" in told(figure)


def test_panels_have_the_ends_and_the_middle_of_their_axes(dataset_file: Callable[..., Path]) -> None:
    few = [
        "k={start=0, stop=0.8, num=9}",
        "lambda_over_R.num=12",
        "A=[0.0, 0.01, 0.02, 0.03]",
        "a_max_over_R=[0.5, 1.0]",
    ]
    with opened(dataset_file(*few)) as dataset:
        figure = drawn(dataset, ["pull_off_force"])
        titles = [axes.get_title() for axes in figure.axes[:6]]
        assert titles == ["$A$ = 0", "$A$ = 0.02", "$A$ = 0.03", "", "", ""]
        rows = [text.get_text() for axes in figure.axes for text in axes.texts if "a_" in text.get_text()]
        assert rows == [r"$a_{\max}/R$ = 0.5", r"$a_{\max}/R$ = 1"]


def test_units_have_prefixes_and_values_stay_in_si(gradhesion: Call, root: Path, tmp_path: Path) -> None:
    path = tmp_path / "out.nc"
    assert gradhesion("run", root / "configs/physical.toml", "-o", path, "--quiet").exit_code == 0
    with opened(path) as dataset:
        figure = drawn(dataset, [], selection_of(dataset, ["k=0", "work_of_adhesion=50 mJ/m^2", "A=0"]))
        force, energy = (part.axes[0] for part in figure.subfigs[0].subfigs)
        assert force.get_xlabel() == "$R$ (µm)"
        assert [tick.get_text() for tick in force.get_xticklabels()] == ["0.5", "1", "2", "5"]
        assert force.get_ylabel() == "pull-off force $F$ (µN)"
        line = force.get_lines()[0]
        np.testing.assert_array_equal(line.get_xdata(), dataset["R"])
        # Johnson, Kendall & Roberts: 1.5 pi R dgamma
        np.testing.assert_allclose(line.get_ydata(), 1.5 * np.pi * dataset["R"].values * 0.05, rtol=1e-12)
        assert r"\Delta\gamma = 50 mJ/m^2,  c_0 = 10 nm" in told(figure)
        assert "E^{\\ast}R" not in told(figure), "what follows from other parameters is not told"
        assert energy.get_yscale() == "linear"
        wide = drawn(dataset, [], selection_of(dataset, ["k=0", "work_of_adhesion=0.02"]))
        assert [part.axes[0].get_yscale() for part in wide.subfigs[0].subfigs] == ["log", "log"], (
            "they differ by 50 and more"
        )
        over = drawn(dataset, [], selection_of(dataset, ["k=0", "A=0", "work_of_adhesion=0.02"]), x="c0_over_R")
        np.testing.assert_array_equal(
            over.subfigs[0].subfigs[0].axes[0].get_lines()[0].get_xdata()[::-1], dataset["c0_over_R"]
        )


def test_points_are_drawn_over_the_parameter_that_is_asked_for(dataset_file: Callable[..., Path]) -> None:
    both = ["lambda_over_R=[0.2, 0.1]", "k=[0.1, 0.3]", "A=0.1", "a_max_over_R=1.0"]
    with opened(dataset_file(*both, layout="points")) as dataset:
        for x, order in (("lambda_over_R", [1, 0]), (None, [0, 1])):
            figure = drawn(dataset, ["pull_off_force"], x=x)
            axes = figure.axes[0]
            assert axes.get_xlabel() == SYMBOLS[x or "k"]
            line = axes.get_lines()[0]
            np.testing.assert_array_equal(line.get_xdata(), dataset[x or "k"].values[order])
            np.testing.assert_array_equal(line.get_ydata(), dataset["pull_off_force"].values[order])
        assert "varying too: \\lambda/R" in told(figure)


@pytest.mark.parametrize("shape", ["a map", "a few lines", "panels of lines"])
def test_variables_beside_each_other_share_edges_and_a_legend(shape: str, dataset_file: Callable[..., Path]) -> None:
    with opened(dataset_file(*SHAPES[shape])) as dataset:
        figure = drawn(dataset, [])
    figure.draw_without_rendering()
    (body,) = figure.subfigs
    edges = [sorted({round(box[side], 12) for box in boxes for side in (1, 3)}) for boxes in (
        [axes.get_position().extents for axes in part.axes] for part in body.subfigs
    )]  # fmt: skip
    assert len(edges) == 2
    assert edges[0] == pytest.approx(edges[1], abs=1e-9)
    legends = [legend for part in (body, *body.subfigs) for legend in part.legends]
    assert len(legends) == (shape != "a map")


@pytest.mark.parametrize(("shape", "below"), [("a few lines", False), ("solvers beside lines", True)])
def test_strips_of_panels_stand_below_each_other(shape: str, below: bool, dataset_file: Callable[..., Path]) -> None:
    with opened(dataset_file(*SHAPES[shape])) as dataset:
        figure = drawn(dataset, [])
        first, second = figure.subfigs[0].subfigs
        assert (first.bbox.y0 > second.bbox.y0) == below
        assert (first.bbox.x0 == second.bbox.x0) == below


WRONG = [
    (["--x", "lamda_over_R"], '--x lamda_over_R: not an axis of this dataset; did you mean "lambda_over_R"?'),
    (["--x", "k", "--y", "k"], "--x k --y k: one axis cannot be both sides"),
    (["--x", "k", "--at", "k=0"], "--x k: k is fixed or reduced by --at or --over"),
    (["--y", "k", "--over", "k=max"], "--y k: k is fixed or reduced by --at or --over"),
    (["--x", "nu"], "--x nu: not an axis; nu is 0.27 in the whole dataset"),
    (["--at", "k=0", "--at", "A=0", "--at", "lambda_over_R=0.2", "--over", "a_max_over_R=max"], "fix or reduce fewer axes"),
    (["--variable", "pull_off_force,energy"], "--variable energy: not in this dataset"),
    (["--at", "k=0.5"], "--at k=0.5: outside the axis, which has values of 0 to 0.31; choose one within"),
    (["--at", "k=x"], "x is not a number"),
    (["--over", "k=product"], "--over k=product: not a reduction; choose from"),
]  # fmt: skip


def test_wrong_choices_are_said_in_a_sentence(gradhesion: Call, dataset_file: Callable[..., Path]) -> None:
    path = dataset_file()
    for options, message in WRONG:
        result = gradhesion("plot", path, *options)
        assert result.exit_code == 2, options
        assert message in result.stderr
        assert len(result.stderr.splitlines()) == 1
        assert not path.with_suffix(".png").exists()


def test_curves_take_at_and_nothing_else(gradhesion: Call, curve_file: Callable[..., Path]) -> None:
    path = curve_file("['path']", "parameters.k=[0.1, 0.3]")
    with opened(path) as dataset:
        figure = drawn_curves(selection_of(dataset, ["A=0.02"]).narrowed(dataset), [])
        assert [text.get_text() for text in figure.legends[0].get_texts()][:2] == ["$k$ = 0.1", "$k$ = 0.3"]
        assert "$A$ = 0.023" in figure.get_suptitle()
        marks = [{line.get_marker() for line in axes.get_lines()} for axes in figure.axes]
        assert all({"o", "s"} <= each for each in marks), "a grey print keeps scenes apart"
    for option in (["--over", "A=max"], ["--at", "A=0.01", "--interpolate"]):
        result = gradhesion("plot", path, *option)
        assert result.exit_code == 2
        assert "curves are drawn as they are" in result.stderr


@pytest.mark.parametrize("control", ["displacement", "load", "machine"])
def test_arrows_go_along_the_path(control: str, curve_file: Callable[..., Path]) -> None:
    machine = ["loading.machine_stiffness=2.0"] if control == "machine" else []
    with opened(curve_file("['path']", "parameters.A=0.07", f"loading.control='{control}'", *machine)) as dataset:
        figure = drawn_curves(dataset, [])
        figure.draw_without_rendering()
        assert ("controlled load" in figure.get_suptitle()) == (control == "load")
        assert ("machine" in figure.get_suptitle()) == (control == "machine")
        axes = figure.axes[1]  # depth over contact radius: on loading the radius grows, on unloading it shrinks
        limits = np.array([axes.get_xlim(), axes.get_ylim()])
        points = np.column_stack([dataset["path_contact_radius"], dataset["path_indentation"]])
        points = (points - limits[:, 0]) / np.diff(limits).T
        jumps = int(dataset["path_jump"].sum())
        arrows = [(np.array(text.xyann), np.array(text.xy)) for text in axes.texts]
        assert len(arrows) > jumps / 2
        for tail, head in arrows:
            fine = np.linspace(0.0, len(points) - 1.0, 50 * len(points))
            line = np.array([np.interp(fine, np.arange(len(points)), row) for row in points.T]).T
            near = [np.flatnonzero(np.hypot(*(line - place).T) < 0.01) for place in (tail, head)]
            assert all(places.size for places in near), "an arrow lies on the path"
            assert near[0][0] < near[1][-1], "and goes along it"


def test_the_style_is_that_of_the_project_whatever_the_user_has(
    dataset_file: Callable[..., Path], tmp_path: Path
) -> None:
    with opened(dataset_file(*SHAPES["a map"])) as dataset:
        save(drawn(dataset, []), tmp_path / "a.svg", "svg")
        with mpl.rc_context({"font.size": 30, "axes.facecolor": "red", "lines.linewidth": 9}):
            save(drawn(dataset, []), tmp_path / "b.svg", "svg")
        assert mpl.rcParams["font.family"] != ["STIXGeneral"]
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()


def test_a_file_that_is_not_ours_is_said(gradhesion: Call, tmp_path: Path) -> None:
    path = tmp_path / "other.nc"
    with netCDF4.Dataset(path, "w") as file:
        file.title = "something else"
    result = gradhesion("plot", path)
    assert result.exit_code == 2
    assert "is not a dataset of gradhesion; name one that `gradhesion run` wrote" in result.stderr
    assert not path.with_suffix(".png").exists()


def test_a_fine_map_is_thinned_and_says_so(dataset_file: Callable[..., Path], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(layout, "MOST", 5)
    with opened(dataset_file("A=0.1", "lambda_over_R.num=12", "a_max_over_R=1.0")) as dataset:
        figure = drawn(dataset, ["pull_off_force"])
        assert "5 of 12 values of \\lambda/R" in told(figure)
        places = figure.axes[0].get_lines()[0].get_xdata()
        assert len(places) == 5
        assert {*places} <= {*dataset["lambda_over_R"].values}
        assert (places[0], places[-1]) == (dataset["lambda_over_R"].values[0], dataset["lambda_over_R"].values[-1])
