"""Curves of scenes and of states, with measured points: what is drawn, in which planes and units, and what is refused."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb

import gradhesion as gr
from gradhesion.core.answers.flags import FLAG_WORDS
from tests.cli.conftest import Call, legend, words
from tests.conftest import mistakes

PUNCH: dict[str, Any] = {"k": 0.3, "nu": 0.27, "modulus": 430.0, "c0_over_R": 0.013, "lambda_over_R": 0.17, "a_max_over_R": 0.4}  # fmt: skip
PROBE: dict[str, Any] = {"k": 0.0, "nu": 0.3, "A": 0.01, "R": "5 um", "E_star": "10 MPa", "work_of_adhesion": "30 mJ/m^2", "wavelength": "0.5 um", "a_max": "1.5 um"}  # fmt: skip
EVERYTHING = ["equilibrium", "path", "asymptotic", "envelope", "effective", "smooth"]
LOAD_OVER_DEPTH = {"x": "indentation", "y": "load"}
WRONG: list[tuple[str, dict[str, Any]]] = [
    ("variable pth", {"variables": "pth"}), ("path_indentation_si", {"variables": ["path_load", "path_indentation_si"]}), ("x k", {"x": "k"}),
    ("x load", {"x": "load", "y": "load"}), ("over", {"over": {"A": "max"}}), ("xlim 0:1", {"xlim": "0:1"}), ("ylim 0:1", {"ylim": "0:1"}),
    ("xlabel", {"xlabel": "depth"}), ("map: ", {"kind": "map"}), ("levels", {"levels": 5}), ("clabel", {"clabel": "pull"}), ("band", {"band": "std"}),
]  # fmt: skip
TABLES = (
    "indentation [nm],load [nN]\n20,-740\n260,3280\n",
    "time,branch,depth [um],force [uN]\n0,loading,0.02,-0.74\n1,unloading,0.26,3.28\n2,lost,nan,1\n",
    "P (N);delta (mm)\n-7.4e-7;2e-5\n3.28e-6;2.6e-4\n",
)


@pytest.fixture(scope="module")
def curves() -> xarray.Dataset:
    """Every curve of some scenes, without units."""
    return gr.curves(PUNCH, EVERYTHING, k=[0.1, 0.3], A=[0.0, 0.023, 0.07])


@pytest.fixture(scope="module")
def probe() -> xarray.Dataset:
    return gr.curves(PROBE, ["path", "equilibrium"])


def planes(panels: Any) -> list[tuple[str, ...]]:
    return [tuple(label.split(" $")[0] for label in (axes.get_xlabel(), axes.get_ylabel())) for axes in panels]


def drawn(axes: Axes, side: int) -> np.ndarray:
    """All that is drawn along (0) or up (1), without lines of zero."""
    return np.concatenate([line.get_xydata()[:, side] for line in axes.get_lines() if len(line.get_xydata()) > 2])


def test_three_panels_tell_their_scenes(curves: xarray.Dataset) -> None:
    panels = gr.plot(curves, "path")
    assert planes(panels) == [("depth", "load"), ("contact radius", "depth"), ("contact radius", "load")]
    assert legend(panels) == ["$A$ = 0", "$A$ = 0.023", "$A$ = 0.07", "path", "jump"]
    assert "(first of 2)" in words(panels)
    first = curves["path_indentation"].isel(k=0)
    assert (np.nanmin(drawn(panels[0], 0)), np.nanmax(drawn(panels[0], 0))) == (float(first.min()), float(first.max()))
    for axes in panels:
        assert {"o", "s", "D"} <= {line.get_marker() for line in axes.get_lines()}, "in a grey print"
    assert legend(gr.plot(curves, "path", at={"A": 0.02}))[:2] == ["$k$ = 0.1", "$k$ = 0.3"]
    one = curves.isel(k=0, A=2)
    assert legend(gr.plot(one, "equilibrium")) == ["equilibrium, stable", "equilibrium, unstable"]
    assert len(legend(gr.plot(one))) == 10, "every line of one scene"
    assert len({axes.get_position().x0 for axes in gr.plot(curves, width="column")}) == 1, "below each other"
    many = gr.plot(gr.curves(PUNCH, "path", A=np.linspace(0.0, 0.1, 9)))
    assert legend(many)[:5] == [f"$A$ = {value:g}" for value in (0, 0.025, 0.05, 0.075, 0.1)]
    assert "5 of 9 scenes" in words(many)


@pytest.mark.parametrize("control", [{}, {"control": "machine", "machine_stiffness": 2.0}])
def test_arrows_go_along_the_path(control: dict[str, Any]) -> None:
    path = gr.curves(PUNCH | {"A": 0.07}, "path", **control)
    panels = gr.plot(path)
    panels.figure.draw_without_rendering()
    axes = panels[1]  # depth over contact radius: on loading the radius grows, on unloading it shrinks
    limits = np.array([axes.get_xlim(), axes.get_ylim()])
    points = np.column_stack([path["path_contact_radius"], path["path_indentation"]])
    points = (points - limits[:, 0]) / np.diff(limits).T
    assert len(axes.texts) > int(path["path_jump"].sum()) / 2
    fine = np.linspace(0.0, len(points) - 1.0, 50 * len(points))
    line = np.array([np.interp(fine, np.arange(len(points)), row) for row in points.T]).T
    for arrow in axes.texts:
        tail, head = (np.flatnonzero(np.hypot(*(line - end).T) < 0.01) for end in (arrow.xyann, arrow.xy))
        assert tail.size * head.size > 0, "an arrow lies on the path"
        assert tail[0] < head[-1], "and goes along it"
        assert 0.01 < np.hypot(*np.subtract(arrow.xy, arrow.xyann)) < 0.1, "by less than a tenth of the panel"


def test_planes_and_limits_are_chosen(curves: xarray.Dataset, probe: xarray.Dataset) -> None:
    for choice, expected in (
        (LOAD_OVER_DEPTH, [("depth", "load")]),
        ({"x": "contact_radius"}, [("contact radius", "depth"), ("contact radius", "load")]),
        ({"y": "contact_radius"}, [("depth", "contact radius"), ("load", "contact radius")]),
        ({"x": "load", "y": "indentation"}, [("load", "depth")]),
    ):
        assert planes(gr.plot(curves, **choice)) == expected
    (axes,) = gr.plot(curves, x="load", y="indentation")
    assert axes.get_xlim()[0] < float(curves["path_load"].min()) < 0.0, "where it pulls is seen"
    (axes,) = gr.plot(probe, **LOAD_OVER_DEPTH, xlim="-50 nm:5 nm")
    assert (axes.get_xlabel(), axes.get_ylabel()) == (r"depth $\delta$ (nm)", "load $P$ (nN)")
    assert axes.get_xlim() == pytest.approx((-5e-8, 5e-9), rel=1e-12)
    seen = probe["path_load_si"].where((probe["path_indentation_si"] >= -5e-8) & (probe["path_indentation_si"] <= 5e-9))
    assert axes.get_ylim()[0] < float(seen.min()) < float(seen.max()) < axes.get_ylim()[1]
    for axes in gr.plot(probe, x="contact_radius", xlim=(None, "1 um")):
        assert axes.get_xlim()[1] == pytest.approx(1e-6, rel=1e-12)
    assert np.nanmin(drawn(gr.plot(probe, "path_load_si")[0], 1)) == float(probe["path_load_si"].min())
    assert gr.plot(probe, "path_load")[0].get_xlabel() == r"depth $\delta/R$"
    (axes,) = gr.plot(probe, **LOAD_OVER_DEPTH, ylim="-300 nN:100 nN")
    assert axes.get_ylim() == pytest.approx((-3e-7, 1e-7), rel=1e-12)


def test_what_curves_do_not_have_is_refused(curves: xarray.Dataset, probe: xarray.Dataset) -> None:
    without = curves.drop_vars([name for name in curves if "load" in str(name) and name != "path_unloading"])
    assert len(gr.plot(without)) == 1
    others = [(without, "y load", {"y": "load"}), (curves[["status", "load"]], "equilibrium", {})]
    others.append((gr.curves(PUNCH | {"A": 0.02}, "jumps"), "jumps", {}))
    for dataset, key, choices in [*((probe, *one) for one in WRONG), *others]:
        (sentence,) = mistakes(gr.plot, dataset, **choices)
        assert key in sentence
        assert "--" not in sentence.replace("info --jumps", ""), "keywords of Python"


def test_a_doubtful_path_has_open_markers_on_loading() -> None:
    punch = {"k": 0.2, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.1, "lambda_over_R": 0.12, "a_max_over_R": 0.6}
    paths = gr.curves(punch, ["path", "smooth"], A=[0.0, 0.15])
    assert [*paths["status"]] == [0, 1], "the scenes are what they are meant to be"
    doubt = FLAG_WORDS["loading_contact_not_one_disc"]
    for panels in (gr.plot(paths), gr.plot(paths.isel(A=1))):
        assert legend(panels)[-1] == doubt
        for axes in panels:
            (line,) = [one for one in axes.get_lines() if one.get_marker() == "o" and one.get_mfc() == "white"]
            assert len(line.get_xdata()) == (paths["path_unloading"].isel(A=1).values == 0).sum()
    for panels in (gr.plot(paths.isel(A=0)), gr.plot(paths, "smooth")):
        assert doubt not in legend(panels)
    paths["path_load"][0] = paths["path_indentation"][0] = paths["path_contact_radius"][0] = np.nan
    panels = gr.plot(paths.drop_vars([name for name in paths if "smooth" in str(name)]))
    assert legend(panels)[0].endswith("(no value)")
    assert to_rgb(panels.figure.legends[0].get_lines()[0].get_color()) == to_rgb("0.6")


def test_states_are_drawn_over_the_distance() -> None:
    states = gr.curves(PUNCH | {"A": 0.02}, ["pressure", "surface", "path"])
    assert len(gr.plot(states)) == 3, "the path"
    panels = gr.plot(states, ["pressure", "surface"])
    assert [axes.get_ylabel() for axes in panels] == [r"pressure $pR/\Delta\gamma$", "surface $u_z/R$"]
    assert legend(panels) == ["turning point", "pull off", "jump out"]
    np.testing.assert_array_equal(panels[0].get_lines()[0].get_ydata(), states["pressure"][0])
    assert "Pa" in gr.plot(gr.curves(PROBE, "pressure", contact_radius_over_R=[0.1]))[0].get_ylabel()
    none = states.where(states["status"] < 0).assign(status=states["status"])
    wrong: list[dict[str, Any]] = [{"variables": ["pressure", "path"]}, {"x": "load"}, {"xlim": (0, 1)}]
    for dataset, choices in [*((states, one) for one in wrong), (states.drop_vars("pressure_radius"), {}), (none, {})]:
        mistakes(gr.plot, dataset, **({"variables": "pressure"} | choices))


def measured(axes: Axes) -> list[Any]:
    return [line for line in axes.lines if line.get_label() == "measured"]


def test_points_stand_where_they_were_measured(curves: xarray.Dataset, probe: xarray.Dataset, tmp_path: Path) -> None:
    path = tmp_path / "loop.csv"
    for text in TABLES:
        path.write_text(text)
        panels = gr.plot(probe, data=path)
        (points,) = measured(panels[0])
        np.testing.assert_allclose(points.get_xydata(), [[2e-8, -7.4e-7], [2.6e-7, 3.28e-6]], rtol=1e-13)
        assert not any(map(measured, panels[1:]))
        assert "measured" in legend(panels)
    path.write_text("a,load\n0.1,-0.5\n0.3,1.2\n")
    (panel,) = gr.plot(curves, data=path, x="contact_radius", y="load")
    np.testing.assert_array_equal(measured(panel)[0].get_xydata(), [[0.1, -0.5], [0.3, 1.2]])


def test_others_refuse_points(gradhesion: Call, curves: xarray.Dataset, probe: xarray.Dataset, tmp_path: Path) -> None:
    path = tmp_path / "loop.csv"
    path.write_text("depth [nm],force [nN]\n1,2\nnan,1\n")
    states = gr.curves(PUNCH | {"A": 0.02}, "pressure")
    maps = gr.solve(PUNCH | {"A": [0.0, 0.1]}, "pull_off_force")
    for dataset, choices in ((probe, {"x": "contact_radius"}), (maps, {}), (states, {}), (curves, {})):
        assert "data" in mistakes(gr.plot, dataset, data=path, **choices)[0]
    probe.to_netcdf(tmp_path / "c.nc")
    result = gradhesion("plot", tmp_path / "c.nc", "--data", path, code=0)
    assert f"{path}: 1 row left out" in result.stderr
    assert gradhesion("plot", tmp_path / "c.nc", "--data", "absent.csv", "-o", tmp_path / "d.png").exit_code == 2
    assert not (tmp_path / "d.png").exists()
