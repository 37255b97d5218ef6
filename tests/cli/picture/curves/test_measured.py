"""Measured points on curves: in the units of the picture, in the panels that have them, and what is refused."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from click.testing import Result
from matplotlib.axes import Axes

import gradhesion as gr
from gradhesion.cli.picture.curves.measured import POINTS

pytestmark = pytest.mark.slow

Call = Callable[..., Result]

PROBE: dict[str, Any] = {
    "k": 0.0,
    "nu": 0.3,
    "A": 0.01,
    "R": "5 um",
    "E_star": "10 MPa",
    "work_of_adhesion": "30 mJ/m^2",
}
PROBE |= {"wavelength": "0.5 um", "a_max": "1.5 um"}
RATIOS = {"k": 0.0, "nu": 0.3, "modulus": 500.0, "lambda_over_R": 0.1, "A": 0.02, "a_max_over_R": 0.5}


@pytest.fixture(scope="module")
def probe() -> xarray.Dataset:
    """Curves with units."""
    return gr.curves(PROBE, "path")


@pytest.fixture(scope="module")
def ratios() -> xarray.Dataset:
    """Curves without."""
    return gr.curves(RATIOS, "path")


def drawn(axes: Axes) -> list[np.ndarray]:
    """The points in a panel: those with the look of points."""
    return [
        line.get_xydata() for line in axes.lines if line.get_zorder() == POINTS["zorder"] and line.get_marker() == "o"
    ]


def written(folder: Path, text: str, name: str = "loop.csv") -> Path:
    path = folder / name
    path.write_text(text)
    return path


@pytest.mark.parametrize(
    "text",
    [
        "indentation [nm],load [nN]\n20,-740\n260,3280\n",
        "time,branch,depth [um],force [uN]\n0,loading,0.02,-0.74\n1,unloading,0.26,3.28\n2,lost,nan,1\n",
        "P (N);delta (mm)\n-7.4e-7;2e-5\n3.28e-6;2.6e-4\n",
    ],
)
def test_points_stand_where_they_were_measured_whatever_their_units(
    text: str, probe: xarray.Dataset, tmp_path: Path
) -> None:
    panels = gr.plot(probe, data=written(tmp_path, text))
    (load_over_depth, depth_over_radius, load_over_radius) = panels
    assert (load_over_depth.get_xlabel(), load_over_depth.get_ylabel()) == (r"depth $\delta$ (nm)", "load $P$ (µN)")
    (points,) = drawn(load_over_depth)
    np.testing.assert_allclose(points, [[20.0, -0.74], [260.0, 3.28]], rtol=1e-13)
    assert not drawn(depth_over_radius)
    assert not drawn(load_over_radius)
    assert "measured" in [text.get_text() for text in panels.figure.legends[0].get_texts()]


def test_ratios_have_no_units(ratios: xarray.Dataset, tmp_path: Path) -> None:
    (panel,) = gr.plot(ratios, data=written(tmp_path, "a,load\n0.1,-0.5\n0.3,1.2\n"), x="contact_radius", y="load")
    np.testing.assert_array_equal(drawn(panel)[0], [[0.1, -0.5], [0.3, 1.2]])
    with pytest.raises(gr.DatasetError, match=r"load \[nN\] has a unit, and the curves have none"):
        gr.plot(ratios, data=written(tmp_path, "depth,load [nN]\n1,2\n"))


def test_a_table_in_netcdf(probe: xarray.Dataset, tmp_path: Path) -> None:
    table = xarray.Dataset(
        {"depth": ("i", [1e-8, 2e-8], {"units": "m"}), "load": ("i", [1e-7, np.nan], {"units": "N"})}
    )
    table.to_netcdf(tmp_path / "loop.nc")
    panels = gr.plot(probe, data=tmp_path / "loop.nc")
    np.testing.assert_allclose(drawn(panels[0])[0], [[10.0, 0.1]], rtol=1e-13)


WRONG = {
    "": "the file has 0 bytes",
    "depth,force [nN]\n1,2\n": "the column depth has no unit, and the curves have; write it after the name in brackets, as depth [nm]",
    "depth [nm],force [nm]\n1,2\n": "the unit of force [nm] is no force; write for example force [nN]",
    "depth [N],force [nN]\n1,2\n": "the unit of depth [N] is no length",
    "depth [nm],forse [nN]\n1,2\n": 'the file has depth alone; rename "forse" to "force"',
    "x,y\n1,2\n": "the file has none of them; name them in the header",
    "depth [nm],force [nN]\nnan,2\n1,nan\n": "no row has numbers in all of depth, force",
    "depth [nm],force [nN]\n1,x\n": 'line 2: force = "x" is not a number; write one',
    "depth [nm],force [nN]\n1\n": "line 2 has 1 value under 2 names",
}


@pytest.mark.parametrize("text", WRONG, ids=repr)
def test_what_cannot_be_drawn_is_refused(text: str, probe: xarray.Dataset, tmp_path: Path) -> None:
    with pytest.raises(gr.DatasetError) as caught:
        gr.plot(probe, data=written(tmp_path, text))
    assert WRONG[text] in str(caught.value)
    assert str(caught.value).startswith(f"data {tmp_path / 'loop.csv'}: ")


def test_panels_maps_and_states_that_have_no_such_points(probe: xarray.Dataset, tmp_path: Path) -> None:
    path = written(tmp_path, "depth [nm],force [nN]\n1,2\n")
    with pytest.raises(gr.DatasetError, match="which no panel of this picture has along and up"):
        gr.plot(probe, data=path, x="contact_radius")
    with pytest.raises(gr.DatasetError, match="measured points go on curves, and this is a map"):
        gr.plot(gr.solve(RATIOS | {"A": [0.0, 0.1]}, "pull_off_force"), data=path)
    with pytest.raises(gr.DatasetError, match="this picture has curves of states"):
        gr.plot(gr.curves(RATIOS, "pressure"), data=path)


def test_the_command_counts_what_it_leaves_out(
    gradhesion: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("c.toml").write_text(
        'kind = "curve"\noutputs = ["path"]\n[parameters]\nk = 0.0\nnu = 0.3\nmodulus = 500.0\nlambda_over_R = 0.1\nA = 0.02\na_max_over_R = 0.5\n'
    )
    assert gradhesion("run", "c.toml", "-o", "c.nc", "--quiet").exit_code == 0
    written(tmp_path, "depth,load\n0.01,0.2\nnan,1\n0.02,0.4\n")
    result = gradhesion("plot", "c.nc", "--data", "loop.csv")
    assert result.exit_code == 0, result.stderr
    assert "loop.csv: 1 row was left out, without a number in each column" in result.stderr
    refused = gradhesion("plot", "c.nc", "--data", "absent.csv", "-o", "d.png")
    assert refused.exit_code == 2
    assert refused.stderr.startswith("--data absent.csv: the file cannot be read")
    assert not Path("d.png").exists()
