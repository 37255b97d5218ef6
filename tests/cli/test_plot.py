"""`gradhesion plot` draws every shape of dataset, and says so where there is nothing to draw."""

from collections.abc import Callable
from pathlib import Path

import netCDF4
import numpy as np
import pytest
from click.testing import Result

from gradhesion.cli.curve_picture import drawn_curves
from gradhesion.cli.picture import Plan, plan_of
from gradhesion.cli.reader import opened
from gradhesion.cli.scales import scale

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
