"""Limits of axes are those that a user writes; what is seen between them sets the rest; wrong ones get a sentence."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from click.testing import Result

from gradhesion.cli.dataset.dataset import compute
from gradhesion.cli.dataset.read.selection import Selection, selection_of
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.picture.curves.picture import drawn_curves
from gradhesion.cli.picture.fits.loops import drawn_fits
from gradhesion.cli.picture.looks import looks_of
from gradhesion.cli.picture.values.picture import drawn
from gradhesion.cli.study.reading import study_from

Call = Callable[..., Result]
UNITS = {"R": "2 um", "E_star": "1 GPa", "work_of_adhesion": "20 mJ/m^2", "c0": "10 nm", "a_max": "0.5 um"}

STATES: dict[str, Any] = {
    "kind": "curve",
    "outputs": ["pressure"],
    "parameters": {
        "k": 0.0,
        "nu": 0.3,
        "modulus": 430.0,
        "c0_over_R": 0.013,
        "lambda_over_R": 0.2,
        "A": 0.01,
        "a_max_over_R": 0.5,
    },
}


@pytest.fixture(scope="module")
def probe() -> xarray.Dataset:
    """Forces in newtons, over six exponents and twenty wavelengths from 50 nm to 1 um."""
    waves = {"start": "50 nm", "stop": "1 um", "num": 20, "spacing": "log"}
    study = {
        "outputs": ["pull_off_force", "dissipated_energy"],
        "parameters": {"k": {"start": 0.0, "stop": 0.5, "num": 6}, "nu": 0.3, "A": 0.01},
        "physical": UNITS | {"wavelength": waves},
    }
    return compute(study_from(study), threads=1)


@pytest.fixture(scope="module")
def curves() -> xarray.Dataset:
    """The curves of one scene in units."""
    study = {
        "kind": "curve",
        "outputs": ["path", "equilibrium"],
        "parameters": {"k": 0.0, "nu": 0.3, "A": 0.02},
        "physical": UNITS | {"wavelength": "0.2 um"},
    }
    return compute(study_from(study), threads=1)


@pytest.mark.parametrize(
    ("xlim", "expected"),
    [
        ("0.1 um:400 nm", (1e-7, 4e-7)),
        ("1e-7:4e-7", (1e-7, 4e-7)),
        ((1e-7, None), (1e-7, None)),
        (":400nm", (None, 4e-7)),
    ],
)
def test_limits_are_in_si_or_have_units(xlim: Any, expected: tuple[float | None, ...], probe: xarray.Dataset) -> None:
    axes = drawn(probe, ["pull_off_force_si"], looks=looks_of(xlim=xlim)).axes[0]
    for given, end, farthest in zip(expected, axes.get_xlim(), (5e-8, 1e-6), strict=True):
        if given is None:
            assert end == pytest.approx(farthest, rel=0.1), "as far as there are values"
        else:
            assert end == pytest.approx(given, rel=1e-12)
    ticks = axes.get_xticks()
    assert len(ticks) >= 2
    assert ((ticks >= axes.get_xlim()[0]) & (ticks <= axes.get_xlim()[1])).all()


def test_what_is_seen_sets_the_other_axis(probe: xarray.Dataset) -> None:
    seen = probe["pull_off_force_si"].sel(wavelength=slice(1.9e-7, 4.1e-7))
    axes = drawn(probe, ["pull_off_force_si"], looks=looks_of(xlim="200 nm:400 nm", kind="lines")).axes[0]
    low, high = axes.get_ylim()
    assert low < float(seen.min())
    assert float(seen.max()) < high
    assert high - low < float(np.ptp(probe["pull_off_force_si"].values))


def test_limits_of_values_are_those_of_lines(probe: xarray.Dataset) -> None:
    looks = looks_of(ylim="0.2 uN:1 uN", kind="lines")
    axes = drawn(probe, ["pull_off_force_si"], looks=looks).axes[0]
    assert axes.get_ylim() == pytest.approx((2e-7, 1e-6), rel=1e-12)
    assert axes.get_ylabel().endswith("(nN)") or axes.get_ylabel().endswith("(µN)")
    linear = drawn(probe, ["dissipated_energy_si"], looks=looks_of(ylim="0:1 fJ", kind="lines")).axes[0]
    assert linear.get_yscale() == "linear"
    assert linear.get_ylim() == pytest.approx((0.0, 1e-15), rel=1e-12)


def test_limits_of_a_map_are_those_of_its_sides(probe: xarray.Dataset) -> None:
    looks = looks_of(xlim="100 nm:400 nm", ylim="0.15:0.4", kind="map")
    for axes in drawn(probe, [], looks=looks).axes[::2]:
        assert axes.get_xlim() == pytest.approx((1e-7, 4e-7), rel=1e-12)
        assert axes.get_ylim() == pytest.approx((0.15, 0.4), rel=1e-12)


def test_limits_of_points_leave_scenes_out(probe: xarray.Dataset) -> None:
    points = probe.isel(k=0).rename(wavelength="scene").assign_coords(wavelength=("scene", probe["wavelength"].values))
    points["wavelength"].attrs = probe["wavelength"].attrs
    axes = drawn(points.drop_vars("scene"), ["pull_off_force"], looks=looks_of(xlim="100 nm:400 nm")).axes[0]
    assert axes.get_xlim() == pytest.approx((1e-7, 4e-7), rel=1e-12)


def test_limits_of_curves_are_in_their_units(curves: xarray.Dataset) -> None:
    looks = looks_of(xlim="-10 nm:5 nm")
    axes = drawn_curves(curves, [], x="indentation", y="load", looks=looks).axes[0]
    assert axes.get_xlabel().endswith("(nm)")
    assert axes.get_xlim() == pytest.approx((-10.0, 5.0), rel=1e-12)
    depth, load = (curves[f"path_{name}_si"].values for name in ("indentation", "load"))
    seen = load[(depth >= -1e-8) & (depth <= 5e-9)] / 1e-6
    assert axes.get_ylabel().endswith("(µN)")
    assert axes.get_ylim()[0] < seen.min()
    assert seen.max() < axes.get_ylim()[1]
    one = drawn_curves(curves, [], x="indentation", looks=looks_of(xlim=(None, "5 nm"))).axes
    assert [axes.get_xlim()[1] for axes in one] == pytest.approx([5.0] * len(one), rel=1e-12)
    up = drawn_curves(curves, [], x="indentation", y="load", looks=looks_of(ylim="-300 nN:100 nN")).axes[0]
    assert up.get_ylim() == pytest.approx((-300.0, 100.0), rel=1e-12)


WRONG = [
    ({"xlim": "2e-7:1e-7"}, "--xlim 2e-7:1e-7: the lower limit comes first and is below the upper one; write 1e-7:2e-7"),
    ({"ylim": (1, 1), "kind": "lines"}, "--ylim 1:1: the lower limit comes first and is below the upper one; write two that"),
    ({"xlim": "0.1"}, "--xlim 0.1: not two ends with a colon between them; write --xlim 0.1:0.5"),
    ({"xlim": 3.0}, "--xlim 3.0: not two ends with a colon between them; write --xlim 0.1:0.5"),
    ({"xlim": ":"}, "--xlim :: neither end is given; write --xlim 0.1:0.5"),
    ({"xlim": "a:b"}, "--xlim a:b: a is not a number; write for example --xlim 0.1:0.5"),
    ({"xlim": "nan:1"}, "--xlim nan:1: nan is not a number"),
    ({"xlim": "50 nN:1 um"}, '--xlim 50 nN:1 um: "nN" is not a unit of wavelength, which is in m'),
    ({"ylim": "0 nN:1", "kind": "lines", "name": "pull_off_force"}, '"nN" is not a unit of pull_off_force, which has no unit'),
    ({"xlim": "0:1e-7"}, "--xlim 0:1e-7: the axis is logarithmic; choose limits above 0"),
    ({"xlim": "2 um:3 um"}, "--xlim 2 um:3 um: outside what is drawn, which is 5e-08 to 1e-06 m; choose limits that meet it"),
    ({"ylim": "1:2", "kind": "lines"}, "--ylim 1:2: outside what is drawn, which is"),
]  # fmt: skip


@pytest.mark.parametrize(("choices", "sentence"), WRONG)
def test_wrong_limits_are_said(choices: dict[str, Any], sentence: str, probe: xarray.Dataset) -> None:
    name = choices.pop("name", "pull_off_force_si")
    with pytest.raises(DatasetError) as error:
        drawn(probe, [name], looks=looks_of(**choices))
    assert sentence in str(error.value)


def test_limits_that_several_panels_do_not_share_are_refused(probe: xarray.Dataset, curves: xarray.Dataset) -> None:
    looks = looks_of(ylim="0:1", kind="lines")
    with pytest.raises(DatasetError, match="pull_off_force_si and dissipated_energy_si have an axis each; choose one"):
        drawn(probe, [], looks=looks)
    with pytest.raises(
        DatasetError, match="--xlim 0:1: the panels have different axes; choose one with --x indentation"
    ):
        drawn_curves(curves, [], looks=looks_of(xlim="0:1"))
    with pytest.raises(DatasetError, match="--ylim 0:1: status is drawn as categories; leave it out"):
        drawn(probe, ["status"], looks=looks)
    with pytest.raises(DatasetError, match="--ylim 0:1: the panels have different axes"):
        drawn_curves(curves, [], looks=looks_of(ylim="0:1"))


def test_pictures_that_are_drawn_whole_take_no_limits() -> None:
    loops = xarray.Dataset(coords={"loop": [0, 1]})
    states = compute(study_from(STATES), threads=1)
    for choices in ({"xlim": "0:1"}, {"ylim": (None, 1)}, {"inset": "0:1"}):
        looks = looks_of(**choices)
        for draw in (lambda looks: drawn_fits(xarray.Dataset(), looks), lambda looks: drawn_fits(loops, looks)):
            with pytest.raises(DatasetError, match=r"--\w+ 0?:1: (a fit is|fits are) drawn as a whole"):
                draw(looks)
        with pytest.raises(DatasetError, match=r"--\w+ 0?:1: curves of states are drawn whole; leave it out"):
            drawn_curves(states, [], looks=looks)


def test_best_compromises_take_limits_and_no_inset() -> None:
    goals = ["pull_off_force", "dissipated_energy"]
    search = {"maximise": goals, "over": ["A"], "resolution": 12}
    parameters = {"k": 0.0, "nu": 0.3, "modulus": 430.0, "c0_over_R": 0.013, "lambda_over_R": 0.2, "a_max_over_R": 0.5}
    study = {"kind": "optimum", "optimum": search, "parameters": parameters | {"A": {"start": 0.0, "stop": 0.02}}}
    front = compute(study_from(study), threads=1)
    least, greatest = (float(front["best_pull_off_force"].quantile(share)) for share in (0.0, 1.0))
    ends = (least - 0.5, greatest + 0.25)
    (axes,) = drawn(front, [], looks=looks_of(xlim=ends)).axes
    assert axes.get_xlim() == pytest.approx(ends, rel=1e-12)
    with pytest.raises(DatasetError, match=r"--inset 0:1: Pareto fronts are drawn as they are; leave it out"):
        drawn(front, [], looks=looks_of(inset="0:1"))


def test_a_command_says_wrong_limits_in_one_line(probe: xarray.Dataset, tmp_path: Path, gradhesion: Call) -> None:
    path = tmp_path / "x.nc"
    probe.to_netcdf(path)
    result = gradhesion("plot", path, "--xlim", "1 um:50 nm")
    assert result.exit_code == 2
    assert result.stderr.splitlines() == [
        "--xlim 1 um:50 nm: the lower limit comes first and is below the upper one; write 50 nm:1 um"
    ]
    assert not path.with_suffix(".png").exists()
    good = gradhesion("plot", path, "--variable", "pull_off_force_si", "--xlim", "50 nm:1 um", "--ylim", "0.1 uN:")
    assert good.exit_code == 0, good.stderr


def test_numbers_at_ticks_differ_where_values_do(probe: xarray.Dataset) -> None:
    near = probe.isel(wavelength=slice(0, 5)).assign_coords(wavelength=2e-6 + 1e-11 * np.arange(5.0))
    near["wavelength"].attrs = probe["wavelength"].attrs
    force = 1e-6 * (1.0 + 1e-7 * np.arange(5.0)) * np.ones((6, 1))
    near["pull_off_force_si"] = near["pull_off_force_si"].copy(data=force)
    figure = drawn(near, ["pull_off_force_si"], x="wavelength", looks=looks_of(kind="lines"))
    figure.draw_without_rendering()
    axes = figure.axes[0]
    for axis in (axes.xaxis, axes.yaxis):
        words = [tick.get_text() for tick in axis.get_ticklabels()]
        assert len(words) >= 3
        assert len({*words}) == len(words)
        assert axis.get_offset_text().get_text() == ""
    numbers = [float(tick.get_text()) for tick in axes.xaxis.get_ticklabels()]
    np.testing.assert_allclose(numbers, 1e6 * axes.get_xticks(), rtol=1e-14)


def test_a_line_of_its_own_for_each_value_however_near(probe: xarray.Dataset) -> None:
    near = probe.assign_coords(k=0.3 + 1e-7 * np.arange(6.0))
    near["k"].attrs = probe["k"].attrs
    lines = drawn(near, ["pull_off_force_si"], looks=looks_of(kind="lines")).axes[0].get_lines()
    assert len({line.get_label() for line in lines}) == 6


@pytest.mark.parametrize(
    ("ends", "symbol"), [((5e-9, 9e-7), "nm"), ((2e-7, 9e-5), "µm"), ((3e-6, 8e-6), "µm"), ((3e-10, 4e-6), "nm")]
)
def test_the_prefix_suits_a_logarithmic_axis(ends: tuple[float, float], symbol: str, probe: xarray.Dataset) -> None:
    wide = probe.assign_coords(wavelength=np.geomspace(*ends, 20))
    wide["wavelength"].attrs = probe["wavelength"].attrs
    assert drawn(wide, ["pull_off_force"]).axes[0].get_xlabel() == rf"$\lambda$ ({symbol})"


def test_the_prefix_suits_what_is_seen(probe: xarray.Dataset) -> None:
    wide = probe.assign_coords(wavelength=np.linspace(1e-9, 5e-6, 20))
    wide["wavelength"].attrs = probe["wavelength"].attrs
    labels = [
        drawn(wide, ["pull_off_force"], Selection(), looks=looks_of(xlim=xlim)).axes[0].get_xlabel()
        for xlim in (None, ":800 nm")
    ]
    assert labels == [r"$\lambda$ (µm)", r"$\lambda$ (nm)"]


def test_an_interpolated_axis_takes_limits(probe: xarray.Dataset) -> None:
    selection = selection_of(probe, ["k=0.25"], interpolate=True)
    axes = drawn(probe, ["pull_off_force_si"], selection, looks=looks_of(xlim="100 nm:400 nm")).axes[0]
    assert axes.get_xlim() == pytest.approx((1e-7, 4e-7), rel=1e-12)
