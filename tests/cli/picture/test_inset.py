"""An inset draws a part of a panel once more where nothing else is; without room, or without such a part, it is refused."""

from typing import Any

import numpy as np
import pytest
import xarray
from matplotlib.axes import Axes

from gradhesion.cli.dataset.dataset import compute
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.picture.curves.picture import drawn_curves
from gradhesion.cli.picture.looks import looks_of
from gradhesion.cli.picture.values.picture import drawn
from gradhesion.cli.study.reading import study_from

PARAMETERS: dict[str, Any] = {"k": [0.0, 0.4], "nu": 0.3, "modulus": 430.0, "c0_over_R": 0.013, "A": 0.02}


@pytest.fixture(scope="module")
def bend() -> xarray.Dataset:
    """Two lines that fall and rise: all that is above their middle is free."""
    waves = {"start": 0.1, "stop": 1.0, "num": 60}
    study = {"outputs": ["pull_off_force", "dissipated_energy"], "parameters": PARAMETERS | {"lambda_over_R": waves, "a_max_over_R": 0.5}}  # fmt: skip
    dataset = compute(study_from(study), threads=1)
    shape = 1.0 + (2.0 * dataset["lambda_over_R"] - 1.1) ** 2 + 0.1 * dataset["k"]
    dataset["pull_off_force"] = shape.transpose("k", "lambda_over_R").assign_attrs(dataset["pull_off_force"].attrs)
    return dataset


def _inset(axes: Axes) -> Axes:
    (inset,) = axes.child_axes
    assert isinstance(inset, Axes)
    return inset


def test_an_inset_shows_the_lines_of_a_part(bend: xarray.Dataset) -> None:
    axes = drawn(bend, ["pull_off_force"], looks=looks_of(inset="0.5:0.6")).axes[0]
    inset = _inset(axes)
    assert inset.get_xlim() == pytest.approx((0.5, 0.6), rel=1e-12)
    for own, shown in zip(axes.get_lines(), inset.get_lines(), strict=True):
        np.testing.assert_array_equal(own.get_xydata(), shown.get_xydata())
        assert own.get_color() == shown.get_color()
    part = bend["pull_off_force"].sel(lambda_over_R=slice(0.5, 0.6))
    low, high = inset.get_ylim()
    assert low < float(part.min())
    assert float(part.max()) < high < 1.5
    assert inset.get_xlabel() == inset.get_ylabel() == ""


@pytest.mark.parametrize(("width", "inset"), [(4.0, "0.5:0.6"), (6.0, "0.1:0.2"), (5.0, ":0.3")])
def test_an_inset_and_its_numbers_hide_nothing(width: float, inset: str, bend: xarray.Dataset) -> None:
    figure = drawn(bend, ["pull_off_force"], looks=looks_of(width=width, inset=inset))
    figure.draw_without_rendering()
    axes = figure.axes[0]
    box, frame = _inset(axes).get_tightbbox(), axes.get_window_extent()
    assert box is not None
    assert frame.x0 <= box.x0
    assert box.x1 <= frame.x1
    assert frame.y0 <= box.y0
    assert box.y1 <= frame.y1
    for line in axes.get_lines():
        fine = np.column_stack([np.interp(np.linspace(0, 59, 5000), np.arange(60), row) for row in line.get_xydata().T])
        points = axes.transData.transform(fine)
        inside = ((points > [box.x0, box.y0]) & (points < [box.x1, box.y1])).all(axis=1)
        assert not inside.any()


def test_the_frame_of_an_inset_stays_in_the_panel(bend: xarray.Dataset) -> None:
    step = bend.copy()
    step["pull_off_force"] = bend["pull_off_force"].copy(
        data=np.broadcast_to(2.0 - np.clip(bend["lambda_over_R"] / 0.3 - 0.4, 0.0, 1.0), (2, 60))
    )
    axes = drawn(step, ["pull_off_force"], looks=looks_of(inset="0.1:0.44", width=9.0)).axes[0]
    assert _inset(axes).get_ylim() == pytest.approx(axes.get_ylim(), rel=1e-12), "the part has all of the height"


def test_curves_have_insets_in_their_units() -> None:
    study = {
        "kind": "curve",
        "outputs": ["path", "equilibrium"],
        "parameters": {"k": 0.0, "nu": 0.3, "A": 0.02},
        "physical": {"R": "2 um", "E_star": "1 GPa", "work_of_adhesion": "20 mJ/m^2", "wavelength": "0.2 um", "a_max": "0.5 um", "c0": "1 um"},
    }  # fmt: skip
    curves = compute(study_from(study), threads=1)
    looks = looks_of(inset="-5 nm:0", width=6, height=5)
    inset = _inset(drawn_curves(curves, [], x="indentation", y="load", looks=looks).axes[0])
    assert inset.get_xlim() == pytest.approx((-5.0, 0.0), rel=1e-12)
    assert not inset.texts, "arrows stay where the whole path is"
    with pytest.raises(
        DatasetError, match="--inset -5 nm:0: an inset goes into a single panel; choose one with --x ind"
    ):
        drawn_curves(curves, [], looks=looks)


WRONG = [
    (["pull_off_force"], {"inset": "0.9:1.4"}, "--inset 0.9:1.4: reaches beyond the axis of the panel, which is"),
    (["pull_off_force"], {"inset": "2:3"}, "--inset 2:3: outside what is drawn, which is"),
    (["pull_off_force"], {"inset": "0.6:0.5"}, "--inset 0.6:0.5: the lower limit comes first and is below the upper one; write 0.5:0.6"),
    (["pull_off_force"], {"inset": "0.5:0.6", "width": 1.6}, "no corner or side of the panel has room for an inset; make room with --ylim, --width or --height"),
    (["pull_off_force"], {"inset": "0.5:0.6", "ylim": "1.5:2"}, "--inset 0.5:0.6: nothing is drawn there; choose another part of the axis"),
    ([], {"inset": "0.5:0.6"}, "an inset goes into a single panel of lines; choose one variable with --variable"),
    (["status"], {"inset": "0.5:0.6"}, "an inset goes into a single panel of lines"),
    (["pull_off_force"], {"inset": "0.5:0.6", "kind": "map"}, "--inset 0.5:0.6: this picture is a map, and has no lines; leave it out"),
]  # fmt: skip


@pytest.mark.parametrize(("names", "choices", "sentence"), WRONG)
def test_an_inset_without_room_is_refused(
    names: list[str], choices: dict[str, Any], sentence: str, bend: xarray.Dataset
) -> None:
    with pytest.raises(DatasetError) as error:
        drawn(bend, names, looks=looks_of(**choices))
    assert sentence in str(error.value)


def test_a_full_panel_has_no_room(bend: xarray.Dataset) -> None:
    full = bend.copy()
    full["pull_off_force"] = bend["pull_off_force"].copy(data=np.ones((2, 1)) * np.cos(np.arange(60.0) * np.pi))
    with pytest.raises(DatasetError, match="no corner or side of the panel has room for an inset"):
        drawn(full, ["pull_off_force"], looks=looks_of(inset="0.5:0.6", width=9, height=9))
